//! Scenes of hardly anything, of next to nothing, and of very large things: with shadows, which every picture has.

use velour::picture::{LinearImage, Picture};
use velour::renderer::Offscreen;
use velour::scene::{Drawn, Edits};
use velour::table::SheenTable;

use super::compare::{GPU, SIZE};
use super::obstacles::{cloth, floor, window};
use super::run::Bench;
use super::stage::{Stage, Thing, facing, looking, plain};

/// The most by which a picture with something very large in the scene may differ, mean |a - b| / mean |b|: rays start up to a
/// thousandth of the distance to the camera off the surface. Measured: 5e-4.
const MOST: f64 = 0.005;

/// A board between the window and the floor.
fn board() -> Thing {
    Thing::rectangle([0.3, 0.2], plain()).placed(facing([0.4, 0.5, -0.4], [0.9, 1.5, -1.0]))
}

fn stage(more: Option<Thing>) -> Stage {
    let things = [floor(cloth()), window(), board()];
    Stage::new(things.into_iter().chain(more).collect(), looking([0.4, 1.1, 2.6], [0.0; 3]))
}

fn picture(stage: &Stage, shadows: bool) -> LinearImage {
    let (scene, edits) = (stage.scene(), Edits { shadows: Some(shadows), ..Edits::default() });
    let drawn = Drawn::new(&scene, &edits);
    let mut renderer = Offscreen::for_linear(&GPU, 1, &SheenTable::embedded(), &drawn).unwrap();
    renderer.effort.samples = 16;
    assert_eq!(renderer.has_shadows(&drawn.settings), shadows);
    GPU.block_on(renderer.linear(&GPU, &scene.cameras[0], SIZE, &drawn.settings)).unwrap()
}

fn relative_difference(left: &LinearImage, right: &LinearImage) -> f64 {
    let channels = |picture: &LinearImage| picture.pixels.iter().flatten().map(|&value| f64::from(value)).collect();
    let (left, right): (Vec<f64>, Vec<f64>) = (channels(left), channels(right));
    let differences: f64 = left.iter().zip(&right).map(|(left, right)| (left - right).abs()).sum();
    differences / right.iter().sum::<f64>()
}

/// Rounding of the scene's coordinates, by which rays start off surfaces, was larger than all that is seen.
#[test]
fn shadows_do_not_depend_on_something_large_out_of_sight() {
    let expected = picture(&stage(None), true);
    for half in [1e4, 1e6, 1e8] {
        let below = Thing::rectangle([half; 2], plain()).placed(facing([0.0, -half, 0.0], [0.0, 1.0, 0.0]));
        let off = relative_difference(&picture(&stage(Some(below)), true), &expected);
        println!("{half:e} m: {off:.5}");
        assert!(off < MOST, "{half:e} m: {off}");
    }
    assert!(relative_difference(&picture(&stage(None), false), &expected) > 2.0 * MOST);
}

#[test]
fn triangles_without_area_change_no_picture() {
    let corners = [[0.1, 0.0], [0.2, 0.0], [0.3, 0.0], [1e-40, 2e-41], [3e-40, 1e-41], [1e-20, 0.0], [0.0, 1e-20]];
    let triangles = [[0, 0, 0], [0, 1, 2], [0, 0, 1], [3, 3, 4], [3, 4, 5], [3, 5, 6]];
    let none = Thing::flat(&corners, &triangles, &[], plain()).placed(facing([0.1, 0.4, 0.0], [0.9, 1.5, -1.0]));
    let bench = Bench::new();
    bench.put("none.glb", stage(Some(none)).glb());
    bench.put("scene.glb", stage(None).glb());
    for command in ["render", "reference"] {
        let drawn = |name: &str| {
            bench.run(&format!("{command} {name}.glb -o {name}.exr --size 48x32 --spp 4"));
            Picture::load(&bench.path(&format!("{name}.exr"))).unwrap()
        };
        assert_eq!(drawn("none"), drawn("scene"), "{command}");
    }
}

#[test]
fn scenes_of_hardly_anything_are_drawn() {
    let bench = Bench::new();
    let camera = looking([0.4, 1.1, 2.6], [0.0; 3]);
    bench.put("light.glb", Stage::new(vec![window()], camera).glb());
    bench.put("floor.glb", Stage::new(vec![floor(cloth())], camera).glb());
    for (scene, hint) in [("light.glb", "nothing that is lit"), ("floor.glb --rig off", "black")] {
        for command in ["render --shadows on", "render --shadows off", "reference --spp 1"] {
            let said = bench.run(&format!("{command} {scene} -o out.png --size 32x20"));
            assert!(said.stderr.contains(hint), "{command} {scene}: {said:?}");
            Picture::load(&bench.path("out.png")).unwrap();
        }
    }
}
