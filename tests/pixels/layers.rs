//! `velour compare` on .exr of several layers.

use exr::image::write::WritableImage;
use exr::image::{AnyChannel, AnyChannels, FlatSamples, Image};

use super::run::Bench;

/// A file of 4 x 3 pixels whose layers are of one grey each.
fn file(layers: &[(&str, f32)]) -> Vec<u8> {
    let channel = |name: &str, color: &str, grey: f32| {
        AnyChannel::new(&*format!("{name}.{color}"), FlatSamples::F32(vec![grey; 12]))
    };
    let channels = layers.iter().flat_map(|&(name, grey)| ["R", "G", "B"].map(|color| channel(name, color, grey)));
    let image = Image::from_channels((4, 3), AnyChannels::sort(channels.collect()));
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

#[test]
fn layers_are_compared_as_asked() {
    let bench = Bench::new();
    bench.put("a.exr", file(&[("ViewLayer.Combined", 0.5), ("ViewLayer.Emit", 2.0)]));
    bench.put("b.exr", file(&[("ViewLayer.Combined", 0.75), ("ViewLayer.Emit", 1.0)]));
    let plain = velour::picture::LinearImage { width: 4, height: 3, pixels: vec![[4.0; 3]; 12] };
    bench.put("plain.exr", plain.to_exr().unwrap());
    for (command, mean) in [
        ("a.exr b.exr", "mean error: -0.25"),
        ("a.exr b.exr --layer ViewLayer.Emit", "mean error: 1.0"),
        ("a.exr b.exr --layer Emit", "mean error: 1.0"),
        ("a.exr plain.exr --layer Emit", "mean error: -2.0"),
        ("plain.exr a.exr", "mean error: 3.5"),
    ] {
        let said = bench.run(&format!("compare {command}"));
        assert!(said.stdout.contains(mean), "{command}: {said:?}");
    }
}

#[test]
fn layers_that_are_not_there_are_one_line() {
    let bench = Bench::new();
    bench.put("a.exr", file(&[("one.Combined", 0.5), ("two.Combined", 0.5)]));
    bench.put("a.png", velour::picture::DisplayImage { width: 1, height: 1, pixels: vec![[0; 3]] }.to_png().unwrap());
    for (command, hint) in [
        ("a.exr a.exr", "one.Combined, two.Combined: pick one with --layer NAME"),
        ("a.exr a.exr --layer x", "a.exr: has no layer x: it has one.Combined, two.Combined"),
        ("a.png a.png --layer x", "a .png has no layers"),
        ("a.exr a.exr --layer=", "--layer"),
    ] {
        bench.refused(&mut bench.command(&format!("compare {command}")), 2, hint);
    }
}
