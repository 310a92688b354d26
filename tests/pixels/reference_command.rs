//! `velour reference` as users run it, and `velour render` on machines without a device.

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;
use velour::picture::DisplayImage;

use super::bad_input::deviceless;
use super::run::Bench;

fn figures(bench: &Bench, arguments: &str) -> Value {
    serde_json::from_str(&bench.run(arguments).stdout).unwrap()
}

#[test]
fn pictures_come_with_their_figures() {
    let bench = Bench::new();
    let base = "reference scene.glb --size 40x30 --json";
    let said = figures(&bench, &format!("{base} -o a.exr --spp 70 --errors errors.exr"));
    assert_eq!([&said["samples"], &said["samples_wanted"], &said["batches"]], [70, 70, 36]);
    assert!(said["rays"].as_u64().unwrap() > 40 * 30 * 70 && said["rays_per_second"].as_f64().unwrap() > 0.0);
    assert!((0.0..0.2).contains(&said["relative_error"].as_f64().unwrap()), "{said}");
    assert_eq!(bench.names(), ["a.exr", "errors.exr", "scene.glb"]);
    let errors = image::open(bench.path("errors.exr")).unwrap().into_rgb32f();
    assert_eq!(errors.dimensions(), (40, 30));
    // The same seed gives the same file; another one another.
    figures(&bench, &format!("{base} -o b.exr --spp 70"));
    figures(&bench, &format!("{base} -o c.exr --spp 70 --seed 5"));
    let bytes = |name: &str| std::fs::read(bench.path(name)).unwrap();
    assert_eq!(bytes("a.exr"), bytes("b.exr"));
    let pixels = |name: &str| velour::picture::Picture::load(&bench.path(name)).unwrap();
    assert_ne!(pixels("a.exr"), pixels("c.exr"));
    // Errors cannot be estimated from one batch.
    assert!(figures(&bench, &format!("{base} -o d.png --spp 1"))["relative_error"].is_null());
    let words = bench.run("reference scene.glb -o e.png --size 40x30 --spp 64").stdout;
    assert!(words.contains("64 samples a pixel") && words.contains("standard error"), "{words}");
}

#[test]
fn every_model_and_rule_gives_a_picture() {
    let bench = Bench::new();
    let mut seen = std::collections::HashSet::new();
    for flags in [
        "--sheen-model ltc",
        "--sheen-model slab",
        "--sheen-model walk",
        "--sheen-model burley",
        "--sheen-model conty-kulla",
        "--sheen-model neubelt-pettineo",
        "--sheen-model patry",
        "--layering openpbr",
        "--layering reciprocal",
        "--layering walk",
        "--shadows off --filter centre",
        "--lobes sheen",
        "--set 0.sheen-model=slab --set 0.layering=none",
        "--ambient 0.2,0.2,0.2 --roughness-map square",
    ] {
        bench.run(&format!("reference scene.glb -o out.png --size 32x24 --spp 8 {flags}"));
        let picture = DisplayImage::from_png(&std::fs::read(bench.path("out.png")).unwrap()).unwrap();
        assert!(picture.pixels.iter().any(|pixel| pixel[0] > 20), "{flags}");
        assert!(seen.insert(picture.pixels), "{flags} changes nothing");
    }
}

#[test]
fn what_is_wrong_is_said_before_the_work() {
    let bench = Bench::new();
    let refused = |arguments: &str, hint: &str| bench.refused(&mut bench.command(arguments), 2, hint);
    let base = "reference scene.glb -o out.png";
    refused(&format!("{base} --spp 0"), "--spp");
    refused(&format!("{base} --spp -3"), "--spp");
    refused(&format!("{base} --spp many"), "--spp");
    refused(&format!("{base} --seed x"), "--seed");
    refused(&format!("{base} --max-bounces 100000"), "--max-bounces");
    refused(&format!("{base} --shadows maybe"), "--shadows");
    refused(&format!("{base} --filter gauss"), "--filter");
    refused(&format!("{base} --sheen-model felt"), "--sheen-model");
    refused(&format!("{base} --size 400000x400000"), "--size");
    refused(&format!("{base} --size 0x10"), "--size");
    refused(&format!("{base} --errors errors.png"), "errors.png");
    refused(&format!("{base} --errors gone/errors.exr"), "gone");
    refused("reference scene.glb -o out.exr --errors out.exr", "--errors");
    bench.put("scene.exr", std::fs::read(bench.path("scene.glb")).unwrap());
    refused("reference scene.exr -o scene.exr", "the scene itself");
    refused("render scene.exr -o scene.exr", "the scene itself");
    refused("reference scene.exr -o out.png --errors scene.exr", "the scene itself");
    refused("reference scene.glb -o gone/out.png --spp 4000000000", "gone");
    refused("reference scene.glb -o out.tiff", "out.tiff");
    refused("reference gone.glb -o out.png", "gone.glb");
    refused("reference scene.glb", "--output");
    refused("render scene.glb -o out.png --sheen-model slab", "velour reference");
    refused("render scene.glb -o out.png --layering walk", "velour reference");
    refused("render scene.glb -o out.png --set 0.sheen-model=walk", "velour reference");
}

/// Asked to end, it writes what it has, whole, and says how much that is.
#[cfg(unix)]
#[test]
fn an_interrupted_picture_is_whole_and_says_its_samples() {
    let bench = Bench::new();
    let arguments = "reference scene.glb -o out.png --size 64x48 --spp 4000000 --json";
    let child = bench.command(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    std::thread::sleep(Duration::from_millis(1500));
    let interrupted = Instant::now();
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert!(interrupted.elapsed() < Duration::from_secs(20), "{:?}", interrupted.elapsed());
    let (stdout, stderr) = (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    assert_eq!(output.status.code(), Some(0), "{stderr}");
    let said: Value = serde_json::from_str(&stdout).unwrap();
    let samples = said["samples"].as_u64().unwrap();
    assert!((1..4_000_000).contains(&samples), "{samples}");
    assert!(stderr.contains(&format!("{samples} of 4000000 samples")), "{stderr}");
    let picture = DisplayImage::from_png(&std::fs::read(bench.path("out.png")).unwrap()).unwrap();
    assert_eq!([picture.width, picture.height], [64, 48]);
    assert_eq!(bench.names(), ["out.png", "scene.glb"]);
}

/// Without a driver the picture is the same but for noise and edges, and a line says how it was made.
#[test]
fn without_a_device_the_reference_renders() {
    let bench = Bench::new();
    let shown = |name: &str| DisplayImage::from_png(&std::fs::read(bench.path(name)).unwrap()).unwrap();
    for msaa in [1, 4] {
        let arguments = format!("render scene.glb --size 48x32 --spp 64 --msaa {msaa} -o");
        bench.run(&format!("{arguments} device.png"));
        let output = deviceless(bench.command(&format!("{arguments} bare.png"))).output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(0), "{stderr}");
        assert!(stderr.contains("no graphics adapter") && stderr.trim_end().lines().count() == 1, "{stderr}");
        let [device, bare] = ["device.png", "bare.png"].map(shown);
        let far = device
            .pixels
            .iter()
            .zip(&bare.pixels)
            .filter(|(one, other)| one.iter().zip(*other).any(|(one, other)| one.abs_diff(*other) > 3));
        let far = far.count();
        assert!(far < device.pixels.len() / 20, "{far} pixels differ at {msaa} samples");
    }
}
