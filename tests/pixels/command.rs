//! What the binary does when all is well.

use velour::picture::{DisplayImage, LinearImage, ToneCurve};
use velour::scene::{Edits, gltf};
use velour::table::{GgxTable, SheenTable, SlabTable};

use super::compare::{changed, differences, linear, sheen_alone};
use super::run::{Bench, small_stage};
use super::stage::Stage;
use super::truth::Truth;

const MEASURED: &str = "--size 96x64 --msaa 1 --tonemap none --lights-visible off --lobes sheen";

fn exr(bench: &Bench, name: &str) -> LinearImage {
    let bytes = std::fs::read(bench.path(name)).unwrap();
    let image = image::load_from_memory_with_format(&bytes, image::ImageFormat::OpenExr).unwrap().into_rgb32f();
    let (width, height) = image.dimensions();
    LinearImage { width, height, pixels: image.pixels().map(|pixel| pixel.0).collect() }
}

fn png(bench: &Bench, name: &str) -> DisplayImage {
    DisplayImage::from_png(&std::fs::read(bench.path(name)).unwrap()).unwrap()
}

/// Renders the stage by the binary with these flags beside `MEASURED`, and holds the picture against the truth.
fn hold(stage: &Stage, flags: &str, table: &SheenTable, edits: &Edits) {
    hold_file(stage.glb(), stage, flags, table, edits);
}

/// The same of a file that is to look as the stage does.
pub fn hold_file(glb: Vec<u8>, stage: &Stage, flags: &str, table: &SheenTable, edits: &Edits) {
    let bench = Bench::new();
    bench.put("stage.glb", glb);
    bench.put("table.csv", table.to_csv(&["of a test".to_owned()]));
    bench.put("table.dds", table.to_dds());
    bench.run(&format!("render stage.glb -o out.exr {MEASURED} {flags}"));
    differences(&exr(&bench, "out.exr"), &Truth::new(stage, table, edits, [96, 64]))
        .unwrap_or_else(|said| panic!("{flags}: {said}"));
}

#[test]
fn a_linear_file_is_the_designs_sum_at_pixel_centres() {
    hold(&small_stage(), "", &SheenTable::embedded(), &sheen_alone());
    // Exposure and tone curve have no effect on it, whatever the flags say.
    hold(&small_stage(), "--exposure 3", &SheenTable::embedded(), &sheen_alone());
    let changed = changed(Some(0.8), Some([0.2, 0.4, 1.0].into()), sheen_alone());
    hold(&small_stage(), "--alpha 0.8 --sheen-color 0.2,0.4,1", &SheenTable::embedded(), &changed);
}

#[test]
fn another_table_is_read_from_either_format() {
    // Halves, so that both formats hold the same numbers.
    let cells = (0..12).map(|k| [0.25 + f64::from(k % 5) / 8.0, -f64::from(k % 3) / 4.0, f64::from(k) / 16.0]);
    let table = SheenTable::new([4, 3], cells.collect());
    hold(&small_stage(), "--sheen-table table.csv", &table, &sheen_alone());
    hold(&small_stage(), "--sheen-table table.dds", &table, &sheen_alone());
}

#[test]
fn a_shown_file_is_the_linear_one_shown() {
    let bench = Bench::new();
    bench.run("render scene.glb -o linear.exr --size 96x64 --msaa 1");
    let linear = exr(&bench, "linear.exr");
    for (flags, exposure, tone) in [
        ("", 0.0, ToneCurve::Neutral),
        ("--exposure -1.5 --tonemap none", -1.5, ToneCurve::None),
        ("--exposure 2 --tonemap neutral", 2.0, ToneCurve::Neutral),
        ("--exposure 1 --tonemap agx", 1.0, ToneCurve::Agx),
    ] {
        bench.run(&format!("render scene.glb -o shown.png --size 96x64 --msaa 1 {flags}"));
        let (shown, expected) = (png(&bench, "shown.png"), linear.display(exposure, tone));
        let pairs = shown.pixels.as_flattened().iter().zip(expected.pixels.as_flattened());
        assert!(pairs.clone().all(|(left, right)| left.abs_diff(*right) <= 1), "{flags}");
        assert!(pairs.clone().any(|(left, _)| *left > 20), "{flags}: all is dark");
    }
    assert_eq!(bench.names(), ["linear.exr", "scene.glb", "shown.png"]);
}

#[test]
fn a_camera_is_chosen_by_name_or_index() {
    let bench = Bench::new();
    let (mut json, binary) = small_stage().chunks();
    let other =
        serde_json::json!({ "type": "perspective", "perspective": { "yfov": 0.3, "znear": 0.1 }, "name": "near" });
    json["cameras"].as_array_mut().unwrap().push(other);
    let node = serde_json::json!({ "camera": 1, "translation": [0.0, 0.5, 4.0] });
    json["nodes"].as_array_mut().unwrap().push(node);
    json["scenes"][0]["nodes"].as_array_mut().unwrap().push(3.into());
    bench.put("two.glb", super::stage::container(json.to_string().as_bytes(), &binary));
    for (flags, name) in [("", "a.png"), ("--camera 0", "b.png"), ("--camera near", "c.png"), ("--camera 1", "d.png")] {
        bench.run(&format!("render two.glb -o {name} --size 48x32 {flags}"));
    }
    let [a, b, c, d] = ["a.png", "b.png", "c.png", "d.png"].map(|name| png(&bench, name));
    assert_eq!(a, b);
    assert_eq!(c, d);
    assert_ne!(a, c);
}

#[test]
fn figures_for_machines_stand_alone_on_stdout() {
    let bench = Bench::new();
    let said = bench.run("render scene.glb -o out.png --size 40x30 --json");
    assert_eq!(said.stderr, "");
    let figures: serde_json::Value = serde_json::from_str(&said.stdout).unwrap();
    assert_eq!(figures["output"], "out.png");
    assert_eq!(figures["size"], serde_json::json!([40, 30]));
    assert_eq!((&figures["msaa"], &figures["triangles"], &figures["lights"]), (&4.into(), &4.into(), &1.into()));
    assert!(figures["adapter"].as_str().is_some_and(|name| !name.is_empty()));
    let parts = figures["seconds"].as_object().unwrap().values().map(|seconds| seconds.as_f64().unwrap());
    let total = figures["total_seconds"].as_f64().unwrap();
    assert!((parts.sum::<f64>() - total).abs() < 1e-9 && total > 0.0, "{figures}");
}

#[test]
fn what_is_added_to_a_bare_scene_is_said_once() {
    let bench = Bench::new();
    let (mut json, binary) = small_stage().chunks();
    json["scenes"][0]["nodes"] = serde_json::json!([0]);
    bench.put("bare.glb", super::stage::container(json.to_string().as_bytes(), &binary));
    let said = bench.run("render bare.glb -o out.png --size 48x32");
    assert_eq!(said.stderr.lines().count(), 2, "{said:?}");
    assert!(said.stderr.lines().all(|line| line.starts_with("velour: ")), "{said:?}");
    assert_eq!(said.stdout.lines().count(), 1, "{said:?}");
    assert!(png(&bench, "out.png").pixels.concat().iter().any(|channel| *channel > 50));
}

#[test]
fn the_adapter_is_chosen_by_a_part_of_its_name() {
    let bench = Bench::new();
    let info = bench.run("info").stdout;
    let name = info.lines().find_map(|line| line.strip_prefix("adapter: ")).expect("an adapter");
    let part = name.split([' ', '(']).next().unwrap().to_uppercase();
    bench.run(&format!("render scene.glb -o out.png --size 16x16 --adapter {part}"));
    let checksums =
        [SheenTable::embedded().checksum(), SlabTable::embedded().checksum(), GgxTable::embedded().checksum()];
    for checksum in checksums {
        assert!(info.contains(&format!("{checksum:08x}")), "{info}");
    }
    assert!(info.contains(env!("CARGO_PKG_VERSION")), "{info}");
}

#[test]
fn help_and_version_are_given() {
    let bench = Bench::new();
    let help = bench.run("--help").stdout;
    for word in ["view", "render", "fit", "compare", "figures", "export", "golden", "info", "Exit codes"] {
        assert!(help.contains(word), "no {word} in {help}");
    }
    assert_eq!(bench.run("--version").stdout, format!("velour {}\n", env!("CARGO_PKG_VERSION")));
    let render = bench.run("render --help").stdout;
    for flag in [
        "--size",
        "--camera",
        "--alpha",
        "--sheen-color",
        "--set",
        "--layering",
        "--roughness-map",
        "--sheen-model",
        "--ambient",
        "--sheen-table",
        "--lobes",
        "--lights-visible",
        "--tonemap",
    ] {
        assert!(render.contains(flag), "no {flag} in {render}");
    }
}

#[test]
fn without_a_display_the_default_scene_is_rendered() {
    let bench = Bench::new();
    let said = bench.run("");
    assert!(said.stdout.contains("velour.png"), "{said:?}");
    assert_eq!(said.stderr, "");
    let picture = png(&bench, "velour.png");
    assert_eq!([picture.width, picture.height], [1280, 720]);
    assert!(picture.pixels.concat().iter().any(|channel| *channel > 100));
    assert_eq!(bench.names(), ["scene.glb", "velour.png"]);
}

#[test]
fn without_a_display_a_scene_alone_is_rendered() {
    let bench = Bench::new();
    // A file may be called as a command is.
    bench.put("render", small_stage().glb());
    let said = bench.run("./render");
    assert!(said.stdout.contains("./render is rendered to velour.png"), "{said:?}");
    assert_eq!(said.stderr, "");
    bench.run("render scene.glb -o same.png");
    assert_eq!(png(&bench, "velour.png"), png(&bench, "same.png"));
    assert_eq!(bench.names(), ["render", "same.png", "scene.glb", "velour.png"]);
}

#[test]
fn a_scene_alone_comes_with_its_notices() {
    let bench = Bench::new();
    let mut stage = small_stage();
    stage.things.pop();
    bench.put("unlit.glb", stage.glb());
    let said = bench.run("unlit.glb");
    assert_eq!(said.stderr, bench.run("render unlit.glb -o out.png").stderr);
    assert!(said.stderr.starts_with("velour: "), "{said:?}");
}

#[test]
fn the_file_and_the_library_give_the_same_picture() {
    let bench = Bench::new();
    bench.run(&format!("render scene.glb -o out.exr {MEASURED}"));
    let scene = gltf::load(&bench.path("scene.glb"), &gltf::Options::default()).unwrap();
    assert_eq!(exr(&bench, "out.exr"), linear(&scene, &SheenTable::embedded(), &sheen_alone(), [96, 64]));
}
