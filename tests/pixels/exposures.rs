//! `--exposure auto`, and what is said of pictures that show next to nothing.

use velour::picture::{DisplayImage, Exposure};
use velour::renderer::{Offscreen, RenderError};
use velour::scene::{Camera, Edits, Scene, Settings};
use velour::table::SheenTable;

use super::compare::GPU;
use super::run::{Bench, small_stage, unshadowed};
use super::stage::{Stage, Thing, facing, glow, looking, plain};

/// A white floor that fills the picture, under a sky of this radiance, which is all that it scatters; and a lamp in sight,
/// that lights nothing, for it looks away.
fn floor(sky: f32, lamp: f32) -> (Scene, Edits) {
    let floor = Thing::rectangle([50.0, 50.0], plain()).placed(facing([0.0; 3], [0.0, 1.0, 0.0]));
    let lamp = Thing::rectangle([0.6, 0.6], glow([lamp; 3])).placed(facing([0.0, 1.0, 0.0], [0.0, 2.0, 0.0]));
    let stage = Stage::new(vec![floor, lamp], looking([0.1, 3.0, 0.1], [0.0; 3]));
    let edits = Edits { ambient: Some([sky; 3].into()), exposure: Some(Exposure::Auto), ..Edits::default() };
    (stage.scene(), edits)
}

fn metered(scene: &Scene, edits: &Edits, samples: u32) -> Result<Option<f32>, RenderError> {
    let drawn = unshadowed(scene, edits);
    let mut renderer = Offscreen::for_display(&GPU, samples, &SheenTable::embedded(), &drawn)?;
    GPU.block_on(renderer.meter(&GPU, &edits.camera(scene), [320, 180], &drawn.settings))
}

/// A white floor under a sky of radiance L has radiance L, but for a dielectric's reflection, at most 4% of it more or
/// less seen from above: 0.06 stops. What the lamp emits does not count, whatever it is.
#[test]
fn what_surfaces_scatter_is_metered_at_any_radiance() {
    for (sky, lamp) in [(1.0, 3.0), (3e-12, 1.0), (2e9, 1.0), (0.02, 5e4)] {
        let (scene, edits) = floor(sky, lamp);
        let expected = (0.18 / sky).log2();
        for samples in [1, 4] {
            let found = metered(&scene, &edits, samples).unwrap().unwrap();
            assert!((found - expected).abs() < 0.07, "{sky} {lamp} {samples}: {found} is not {expected}");
        }
    }
}

#[test]
fn where_nothing_is_scattered_what_is_emitted_counts() {
    let (mut scene, edits) = floor(0.0, 32.0);
    // From above, where the lamp shines to.
    let found = metered(&scene, &edits, 1).unwrap().unwrap();
    assert!((found - (0.18_f32 / 32.0).log2()).abs() < 0.02, "{found}");
    scene.cameras[0] =
        Camera { world_from_camera: looking([0.1, 3.0, 0.1], [0.0, 9.0, 0.0]), ..scene.cameras[0].clone() };
    assert_eq!(metered(&scene, &edits, 1).unwrap(), None);
}

#[test]
fn a_screenshot_meters_where_its_edits_say_so() {
    let (scene, edits) = floor(1000.0, 1.0);
    let shot = |edits: &Edits| GPU.block_on(Offscreen::screenshot(&GPU, &scene, edits, [64, 36])).unwrap();
    let exposure = metered(&scene, &edits, 4).unwrap().unwrap();
    assert_eq!(shot(&edits), shot(&Edits { exposure: Some(exposure.into()), ..edits.clone() }));
    let settings = Settings { exposure, ..edits.settings() };
    assert!(settings.exposure < -12.0 && edits.settings().exposure == 0.0);
}

/// What a run says that it took.
fn took(stdout: &str) -> f32 {
    let line = stdout.lines().find_map(|line| line.strip_prefix("exposure auto took ")).expect("it says what it took");
    line.strip_suffix(" EV").unwrap().parse().unwrap()
}

#[test]
fn all_ways_take_the_same_exposure_and_it_can_be_pasted() {
    let bench = Bench::new();
    bench.put("state.toml", "exposure = \"auto\"\n");
    let picture = |name: &str| DisplayImage::from_png(&std::fs::read(bench.path(name)).unwrap()).unwrap();
    let mut all = Vec::new();
    for command in ["render", "reference --spp 4"] {
        let metered = took(&bench.run(&format!("{command} scene.glb -o auto.png --size 96x54 --exposure auto")).stdout);
        bench.run(&format!("{command} scene.glb -o same.png --size 96x54 --exposure {metered}"));
        assert_eq!(picture("auto.png"), picture("same.png"), "{command}");
        let stated = bench.run(&format!("{command} scene.glb -o state.png --size 96x54 --state state.toml"));
        assert_eq!((took(&stated.stdout), picture("state.png")), (metered, picture("same.png")), "{command}");
        let json = bench.run(&format!("{command} scene.glb -o auto.png --size 96x54 --exposure auto --json"));
        let json: serde_json::Value = serde_json::from_str(&json.stdout).unwrap();
        assert_eq!(json["exposure"].as_f64().map(|found| found as f32), Some(metered), "{command}");
        // Linear radiance has no exposure.
        let exr = bench.run(&format!("{command} scene.glb -o a.exr --size 96x54 --exposure auto --json"));
        let exr: serde_json::Value = serde_json::from_str(&exr.stdout).unwrap();
        assert!(exr["exposure"].is_null(), "{command}");
        all.push(metered);
    }
    assert!((all[0] - all[1]).abs() <= 0.05, "{all:?}");
    bench.refused(&mut bench.command("render scene.glb -o a2.png --exposure automatic"), 2, "or auto");
}

#[test]
fn pictures_that_show_next_to_nothing_say_so() {
    let bench = Bench::new();
    let mut stage = small_stage();
    stage.things[1].material = glow([4e5, 3e5, 2e5]);
    bench.put("bright.glb", stage.glb());
    stage.things[1].material = glow([4e-5, 3e-5, 2e-5]);
    bench.put("dark.glb", stage.glb());
    stage.world_from_camera = looking([0.4, 1.1, 2.6], [0.4, 9.0, 9.0]);
    bench.put("away.glb", stage.glb());
    for command in ["render", "reference --spp 1"] {
        for (scene, hint) in [("bright", "past white: try --exposure -1"), ("dark", "is black: try --exposure 1")] {
            let run = |flags: &str| {
                bench
                    .run(&format!("{command} {scene}.glb -o a.png --size 96x54 --lights-visible off --rig off {flags}"))
            };
            let said = run("");
            assert!(said.stderr.contains(hint) && said.stderr.lines().count() == 1, "{command} {scene}: {said:?}");
            assert!(said.stderr.contains(" or --exposure auto"), "{said:?}");
            assert_eq!(run("--exposure auto").stderr, "", "{command} {scene}");
            assert_eq!(bench.run(&format!("{command} {scene}.glb -o a.exr --size 96x54 --rig off")).stderr, "");
        }
        let said = bench.run(&format!("{command} away.glb -o a.png --size 96x54 --rig off"));
        assert!(
            said.stderr.contains("the picture is black at any exposure") && said.stderr.contains("--ambient"),
            "{said:?}"
        );
        assert_eq!(bench.run(&format!("{command} scene.glb -o a.png --size 96x54")).stderr, "");
    }
    // What stands in for a window says so, too.
    assert!(bench.run("bright.glb").stderr.contains("past white"));
}
