//! Heads of .exr that claim far more than the file holds: refused by what they say, before memory is taken for it.

use super::{MAX_PIXELS, MAX_SIDE, Picture, ReadError};

/// What a part of a file says of itself.
#[derive(Clone, Copy)]
struct Part {
    /// Columns and rows of its data.
    data: [i32; 2],
    shown: [i32; 2],
    tile: Option<[u32; 2]>,
    channels: usize,
}

const SMALL: Part = Part { data: [2, 2], shown: [2, 2], tile: None, channels: 3 };

fn attribute(name: &str, kind: &str, value: &[u8]) -> Vec<u8> {
    [name.as_bytes(), b"\0", kind.as_bytes(), b"\0", &(value.len() as u32).to_le_bytes(), value].concat()
}

fn window([width, height]: [i32; 2]) -> Vec<u8> {
    [0, 0, width - 1, height - 1].iter().flat_map(|number| number.to_le_bytes()).collect()
}

/// Blue, green, red, and numbered others, all of 32-bit floats.
fn channels(count: usize) -> Vec<u8> {
    let names = ["B", "G", "R"].map(str::to_owned).into_iter().chain((3..count).map(|number| format!("Z{number:05}")));
    let one = |name: String| [name.as_bytes(), b"\0", &[2, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0]].concat();
    names.take(count).flat_map(one).chain([0]).collect()
}

fn head(part: &Part, name: Option<&str>) -> Vec<u8> {
    let one = 1_f32.to_le_bytes();
    let mut head = [
        attribute("channels", "chlist", &channels(part.channels)),
        attribute("compression", "compression", &[0]),
        attribute("dataWindow", "box2i", &window(part.data)),
        attribute("displayWindow", "box2i", &window(part.shown)),
        attribute("lineOrder", "lineOrder", &[0]),
        attribute("pixelAspectRatio", "float", &one),
        attribute("screenWindowCenter", "v2f", &[0; 8]),
        attribute("screenWindowWidth", "float", &one),
    ]
    .concat();
    if let Some([width, height]) = part.tile {
        let tiles = [&width.to_le_bytes()[..], &height.to_le_bytes(), &[0]].concat();
        head.extend(attribute("tiles", "tiledesc", &tiles));
    }
    if let Some(name) = name {
        head.extend(attribute("name", "string", name.as_bytes()));
        head.extend(attribute("type", "string", if part.tile.is_some() { b"tiledimage" } else { b"scanlineimage" }));
        head.extend(attribute("chunkCount", "int", &part.data[1].to_le_bytes()));
    }
    head.push(0);
    head
}

/// A file of these parts; `pixels` follow the heads.
fn exr(parts: &[Part], pixels: &[u8]) -> Vec<u8> {
    let flags: u32 = match parts {
        [Part { tile: None, .. }] => 2,
        [_] => 2 | 1 << 9,
        _ => 2 | 1 << 12,
    };
    let mut file = [[0x76, 0x2f, 0x31, 0x01], flags.to_le_bytes()].concat();
    for (index, part) in parts.iter().enumerate() {
        file.extend(head(part, (parts.len() > 1).then(|| format!("part {index}")).as_deref()));
    }
    file.extend(if parts.len() > 1 { &[0][..] } else { &[] });
    file.extend(pixels);
    file
}

fn load(file: &[u8]) -> Result<Picture, ReadError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("claims.exr");
    std::fs::write(&path, file).unwrap();
    let read = Picture::load(&path);
    if let Err(error) = &read {
        let said = error.to_string();
        assert!(said.contains("claims.exr: ") && !said.contains('\n'), "{said}");
    }
    read
}

#[test]
fn each_window_of_each_part_is_within_the_limits() {
    let side = MAX_SIDE as i32 + 1;
    let area = [MAX_SIDE as i32, (MAX_PIXELS / u64::from(MAX_SIDE)) as i32 + 1];
    for large in [[side, 1], [1, side], area, [500_000_000, 500_000_000], [9, 16_777_000]] {
        let (data, shown) = (Part { data: large, ..SMALL }, Part { shown: large, ..SMALL });
        let tiled = Part { tile: Some([64, 64]), ..data };
        for parts in [vec![data], vec![shown], vec![tiled], vec![SMALL, data], vec![data, SMALL]] {
            let error = load(&exr(&parts, &[0; 64])).unwrap_err();
            let [width, height] = large.map(|side| side as u64);
            assert!(
                matches!(error, ReadError::TooLarge { width: w, height: h, .. } if [w, h] == [width, height]),
                "{error}"
            );
        }
    }
}

#[test]
fn pieces_that_are_decoded_at_once_are_within_the_limit() {
    let tiled = |tile| Part { tile: Some(tile), ..SMALL };
    let many = Part { data: [MAX_SIDE as i32, 2], channels: 10_000, ..SMALL };
    for part in [tiled([1 << 29, 1 << 29]), tiled([1 << 14, 1 << 13]), many] {
        let error = load(&exr(&[part], &[0; 64])).unwrap_err();
        assert!(matches!(error, ReadError::Pieces { .. }), "{error}");
    }
}

/// Within the limits nothing is taken on trust either: the pixels are not there.
#[test]
fn files_that_end_early_are_broken() {
    let largest = [8192, (MAX_PIXELS / 8192) as i32];
    for part in [Part { data: largest, shown: largest, ..SMALL }, Part { tile: Some([4096, 4096]), ..SMALL }] {
        let error = load(&exr(&[part], &[0; 64])).unwrap_err();
        assert!(matches!(error, ReadError::Decode { .. }), "{error}");
    }
}

/// Data may lie beyond what is shown: that is left out.
#[test]
fn data_beyond_what_is_shown_is_left_out() {
    let part = Part { data: [3, 1], shown: [2, 1], ..SMALL };
    let offset = (exr(&[part], &[]).len() + 8) as u64;
    let line = [[0.25_f32; 3], [0.5; 3], [1.0; 3]].concat();
    let bytes: Vec<u8> = line.iter().flat_map(|number| number.to_le_bytes()).collect();
    let pixels = [&offset.to_le_bytes()[..], &[0; 4], &(bytes.len() as i32).to_le_bytes(), &bytes].concat();
    assert_eq!(load(&exr(&[part], &pixels)).unwrap().pixels, [[1.0, 0.5, 0.25]; 2]);
}
