//! What files say of their numbers, read back by the formats' own rules.

use super::{DisplayImage, LinearImage};

const COMMENT: &str = "velour render 'größe.glb' --exposure -2";

fn shown() -> DisplayImage {
    DisplayImage { width: 3, height: 2, pixels: (0..6).map(|index| [index * 40, 255 - index, 7]).collect() }
}

/// The chunks of a PNG file, in order, each with its data (PNG 3, section 5).
fn chunks(mut file: &[u8]) -> Vec<(String, Vec<u8>)> {
    file = file.strip_prefix(b"\x89PNG\r\n\x1a\n").unwrap();
    let mut chunks = Vec::new();
    while !file.is_empty() {
        let length = u32::from_be_bytes(file[..4].try_into().unwrap()) as usize;
        let (name, data) = (&file[4..8], &file[8..8 + length]);
        assert_eq!(crc32fast::hash(&file[4..8 + length]).to_be_bytes(), file[8 + length..12 + length]);
        chunks.push((String::from_utf8(name.to_vec()).unwrap(), data.to_vec()));
        file = &file[12 + length..];
    }
    chunks
}

fn position(chunks: &[(String, Vec<u8>)], name: &str) -> usize {
    let mut places = chunks.iter().enumerate().filter(|(_, chunk)| chunk.0 == name).map(|(index, _)| index);
    let place = places.next().unwrap_or_else(|| panic!("no {name}"));
    assert_eq!(places.next(), None, "{name} stands once");
    place
}

#[test]
fn png_says_that_it_is_srgb() {
    for file in [shown().to_png().unwrap(), shown().to_png_with_comment(COMMENT).unwrap()] {
        let chunks = chunks(&file);
        let data = |name| chunks[position(&chunks, name)].1.clone();
        assert_eq!(data("sRGB"), [1], "relative colorimetric");
        // PNG 3, 11.3.2.5: what stands beside sRGB for readers that do not know it.
        assert_eq!(data("gAMA"), 45455_u32.to_be_bytes());
        let primaries = [31270_u32, 32900, 64000, 33000, 30000, 60000, 15000, 6000].map(u32::to_be_bytes);
        assert_eq!(data("cHRM"), primaries.concat());
        for name in ["sRGB", "gAMA", "cHRM"] {
            assert!(position(&chunks, name) < position(&chunks, "IDAT"), "{name}");
        }
        assert_eq!(data("tEXt"), format!("Software\0Velour {}", env!("CARGO_PKG_VERSION")).into_bytes());
        assert_eq!(DisplayImage::from_png(&file).unwrap(), shown());
    }
}

#[test]
fn png_has_the_comment_that_it_is_given() {
    let file = chunks(&shown().to_png_with_comment(COMMENT).unwrap());
    // Keyword; not compressed, by method 0; no language, no translated keyword; text in UTF-8.
    let expected = [b"Comment\0\0\0\0\0", COMMENT.as_bytes()].concat();
    assert_eq!(file[position(&file, "iTXt")].1, expected);
    assert!(chunks(&shown().to_png().unwrap()).iter().all(|(name, _)| name != "iTXt"));
}

/// The attributes of the first part of an OpenEXR file: name, type and value.
fn attributes(file: &[u8]) -> Vec<(String, String, Vec<u8>)> {
    let mut rest = &file[8..];
    let mut attributes = Vec::new();
    while rest[0] != 0 {
        let mut word = || {
            let end = rest.iter().position(|&byte| byte == 0).unwrap();
            let word = String::from_utf8(rest[..end].to_vec()).unwrap();
            rest = &rest[end + 1..];
            word
        };
        let (name, kind) = (word(), word());
        let length = i32::from_le_bytes(rest[..4].try_into().unwrap()) as usize;
        attributes.push((name, kind, rest[4..4 + length].to_vec()));
        rest = &rest[4 + length..];
    }
    attributes
}

#[test]
fn exr_names_its_primaries_and_has_the_comment_that_it_is_given() {
    let picture = LinearImage { width: 2, height: 1, pixels: vec![[1e-30, 2.0, 7e30], [0.1, 0.2, 0.3]] };
    let [bare, file] = [picture.to_exr().unwrap(), picture.to_exr_with_comment(COMMENT).unwrap()];
    for (file, comment) in [(&bare, None), (&file, Some(COMMENT))] {
        let attributes = attributes(file);
        let find = |wanted: &str| attributes.iter().find(|(name, ..)| name == wanted);
        let (_, kind, value) = find("chromaticities").unwrap();
        // Red, green, blue, white: ITU-R BT.709-6, item 1.3.
        let expected = [0.64_f32, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329].map(f32::to_le_bytes).concat();
        assert_eq!((kind.as_str(), value), ("chromaticities", &expected));
        let text = |name| find(name).map(|(_, kind, value)| (kind.clone(), String::from_utf8(value.clone()).unwrap()));
        assert_eq!(text("comments"), comment.map(|comment| ("string".to_owned(), comment.to_owned())));
        assert!(text("software").unwrap().1.starts_with("Velour "));
    }
}
