//! Which layer of a .exr is taken, of files with channels and parts as programs name them.

use exr::image::write::WritableImage;
use exr::image::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer};
use exr::meta::attribute::{AttributeValue, Text};
use exr::meta::header::{ImageAttributes, LayerAttributes};
use exr::prelude::{IntegerBounds, SmallVec};
use half::f16;

use super::{Picture, ReadError};

/// A part of a file: its name, and channels with the number that is in all of their pixels.
type Part<'a> = (&'a str, &'a [(&'a str, f32)]);

fn channel((name, value): &(&str, f32), count: usize) -> AnyChannel<FlatSamples> {
    // Halves where they hold the number, as compositors save it.
    let samples = match f16::from_f32(*value).to_f32() == *value {
        true => FlatSamples::F16(vec![f16::from_f32(*value); count]),
        false => FlatSamples::F32(vec![*value; count]),
    };
    AnyChannel::new(*name, samples)
}

/// A file of 3 x 2 pixels.
fn file(parts: &[Part], mattes: &[&str]) -> Vec<u8> {
    let layer = |(name, channels): &Part| {
        let mut channels: SmallVec<[_; 4]> = channels.iter().map(|named| channel(named, 6)).collect();
        channels.sort_by(|a: &AnyChannel<_>, b| a.name.cmp(&b.name));
        let mut attributes = LayerAttributes::named(*name);
        for matte in mattes {
            let key = Text::new_or_panic(format!("cryptomatte/{:07x}/name", matte.len()));
            attributes.other.insert(key, AttributeValue::Text(Text::new_or_panic(matte)));
        }
        Layer::new((3, 2), attributes, Encoding::UNCOMPRESSED, AnyChannels::sort(channels))
    };
    let image = Image {
        attributes: ImageAttributes::new(IntegerBounds::from_dimensions((3, 2))),
        layer_data: parts.iter().map(layer).collect::<SmallVec<[_; 2]>>(),
    };
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

fn load(file: &[u8], layer: Option<&str>) -> Result<[f32; 3], ReadError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    std::fs::write(&path, file).unwrap();
    let picture = Picture::load_layer(&path, layer).inspect_err(|error| {
        let said = error.to_string();
        assert!(said.contains("a.exr: ") && said.chars().count() < 700 && !said.contains(char::is_control), "{said}");
    })?;
    assert_eq!((picture.width, picture.height), (3, 2));
    assert!(picture.pixels.iter().all(|pixel| *pixel == picture.pixels[0]));
    Ok(picture.pixels[0])
}

/// The picture is the one with 1, 2 and 0.3.
const WANTED: [f32; 3] = [1.0, 2.0, 0.3];

#[test]
fn the_picture_itself_is_taken() {
    let plain: &[_] = &[("A", 1.0), ("R", 1.0), ("G", 2.0), ("B", 0.3)];
    let other: &[_] = &[("diffuse.R", 8.0), ("diffuse.G", 8.0), ("diffuse.B", 8.0)];
    let other_part: &[_] = &[("R", 8.0), ("G", 8.0), ("B", 8.0)];
    let blender: &[_] = &[
        ("View Layer.Combined.R", 1.0),
        ("View Layer.Combined.G", 2.0),
        ("View Layer.Combined.B", 0.3),
        ("View Layer.Combined.A", 1.0),
        ("View Layer.Depth.Z", 9.0),
        ("View Layer.Normal.X", 9.0),
        ("View Layer.Normal.Y", 9.0),
        ("View Layer.Normal.Z", 9.0),
        ("View Layer.DiffCol.R", 8.0),
        ("View Layer.DiffCol.G", 8.0),
        ("View Layer.DiffCol.B", 8.0),
    ];
    let renderman: &[_] = &[("Ci.r", 1.0), ("Ci.g", 2.0), ("Ci.b", 0.3)];
    let long: &[_] = &[("rgba.red", 1.0), ("rgba.green", 2.0), ("rgba.blue", 0.3)];
    let alone: &[_] = &[("specular.R", 1.0), ("specular.G", 2.0), ("specular.B", 0.3), ("depth.Z", 9.0)];
    let repeated: &[_] = &[("beauty.R", 1.0), ("beauty.G", 2.0), ("beauty.B", 0.3)];
    for parts in [
        &[("", plain)][..],
        &[("", &[plain, other].concat())],
        &[("", blender)],
        &[("", &[other, renderman].concat())],
        &[("", &[other, long].concat())],
        &[("", alone)],
        // Of several parts, whose names are the layers'.
        &[("depth", &[("Z", 9.0)]), ("diffuse", other_part), ("rgba", plain)],
        &[("ViewLayer.DiffCol", other_part), ("ViewLayer.Combined", plain)],
        &[("diffuse", other), ("beauty", repeated)],
        &[("depth", &[("Z", 9.0)]), ("left", plain)],
    ] {
        assert_eq!(load(&file(parts, &[]), None).unwrap(), WANTED, "{parts:?}");
    }
    let grey = file(&[("", &[("Y", 0.7), ("A", 1.0)])], &[]);
    assert_eq!(load(&grey, None).unwrap(), [0.7; 3]);
}

#[test]
fn a_layer_is_picked_by_name() {
    let layer = |name: &'static str, value: f32| {
        ["R", "G", "B"].map(|color| (&*Box::leak(format!("{name}.{color}").into_boxed_str()), value))
    };
    let bytes =
        file(&[("", &[layer("one.Combined", 1.0), layer("two.Combined", 2.0), layer("two.Env", 3.0)].concat())], &[]);
    assert!(matches!(load(&bytes, None), Err(ReadError::Undecided { names, .. })
        if names == "one.Combined, two.Combined, two.Env"));
    for (name, value) in [("one.Combined", 1.0), ("two.Combined", 2.0), ("two.Env", 3.0), ("Env", 3.0)] {
        assert_eq!(load(&bytes, Some(name)).unwrap(), [value; 3], "{name}");
    }
    for name in ["Combined", "three", "", "env", "wo.Env", "two"] {
        let said = load(&bytes, Some(name)).unwrap_err().to_string();
        assert!(said.contains(&format!("no layer {name}: it has one.Combined, ")), "{said}");
    }
    // In parts, too, of which only the wanted one is read.
    let plain = |value| ["R", "G", "B"].map(|color| (color, value));
    let parts = file(&[("left", &plain(1.0)), ("right", &plain(2.0))], &[]);
    assert!(matches!(load(&parts, None), Err(ReadError::Undecided { .. })));
    assert_eq!(load(&parts, Some("right")).unwrap(), [2.0; 3]);
    // Plain channels alone are whatever is asked for; beside others they are not.
    assert_eq!(load(&file(&[("", &plain(4.0))], &[]), Some("right")).unwrap(), [4.0; 3]);
    let both = file(&[("", &[plain(4.0), layer("two.Env", 3.0)].concat())], &[]);
    assert!(load(&both, Some("right")).is_err());
}

#[test]
fn what_only_looks_like_a_picture_is_not_offered() {
    let matte = ["CryptoObject00", "CryptoObject01", "CryptoObject"];
    let mut channels: Vec<(String, f32)> =
        vec![("Depth.Z".into(), 1.0), ("Normal.Y".into(), 1.0), ("Normal.X".into(), 1.0)];
    for name in matte {
        channels.extend(["r", "g", "b", "a"].map(|color| (format!("{name}.{color}"), 1.0)));
    }
    channels.extend(["Y", "RY", "BY"].map(|name| (format!("chroma.{name}"), 1.0)));
    let channels: Vec<(&str, f32)> = channels.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    let bytes = file(&[("", &channels)], &["CryptoObject"]);
    assert!(matches!(load(&bytes, None), Err(ReadError::NoColors { .. })));
}

#[test]
fn many_and_odd_names_make_a_short_line() {
    let names: Vec<String> = (0..500).map(|index| format!("{index}\n{}", "x".repeat(index % 200))).collect();
    let channels: Vec<(String, f32)> =
        names.iter().flat_map(|name| ["R", "G", "B"].map(|color| (format!("{name}.{color}"), 1.0))).collect();
    let channels: Vec<(&str, f32)> = channels.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    let said = load(&file(&[("", &channels)], &[]), None).unwrap_err().to_string();
    assert!(said.contains("488 more"), "{said}");
}
