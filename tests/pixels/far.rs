//! A scene looks the same wherever in its file it stands.

use serde_json::json;
use velour::picture::LinearImage;
use velour::reference::{Filter, Options, SpecularModel};
use velour::scene::{Edits, Scene, gltf};
use velour::table::SheenTable;

use super::compare::{SIZE, linear};
use super::reference::traced;
use super::stage::{Stage, Thing, container, facing, glow, looking, velvet};

/// With shadows, so that rays count too.
const TRACED: Options = Options { max_bounces: 1, shadows: true, filter: Filter::Box, specular: SpecularModel::Ltc };
/// The most by which pictures may differ, mean |a - b| / mean |b|. Measured: 1e-7.
const MOST: f64 = 1e-5;

/// A floor, a card and a window below a node that stands at `place`; seen by the file's camera, or framed.
fn scene_at(place: [f64; 3], has_camera: bool) -> Scene {
    let floor = Thing::rectangle([1.5, 1.5], velvet([0.9, 0.5, 0.2], 0.4)).placed(facing([0.0; 3], [0.0, 1.0, 0.0]));
    let card =
        Thing::rectangle([0.4, 0.3], velvet([0.2, 0.5, 0.9], 0.7)).placed(facing([0.3, 0.5, 0.1], [0.9, 1.0, 1.2]));
    let window = Thing::rectangle([0.6, 0.4], glow([4.0, 3.0, 2.0])).placed(facing([0.7, 0.8, -1.3], [0.0; 3]));
    let (mut json, bytes) = Stage::new(vec![floor, card, window], looking([0.2, 0.9, 2.4], [0.0; 3])).chunks();
    let below = if has_camera { vec![0, 1, 2, 3] } else { vec![0, 1, 2] };
    json["nodes"].as_array_mut().unwrap().push(json!({ "translation": place, "children": below }));
    json["scenes"] = json!([{ "nodes": [4] }]);
    let glb = container(json.to_string().as_bytes(), &bytes);
    gltf::from_slice(&glb, "far.glb", &gltf::Options::default()).unwrap()
}

fn relative_difference(left: &LinearImage, right: &LinearImage) -> f64 {
    let channels =
        |picture: &LinearImage| picture.pixels.iter().flatten().map(|&value| f64::from(value)).collect::<Vec<_>>();
    let (left, right) = (channels(left), channels(right));
    let differences: f64 = left.iter().zip(&right).map(|(left, right)| (left - right).abs()).sum();
    differences / right.iter().sum::<f64>()
}

#[test]
fn a_scene_looks_the_same_however_far_it_stands() {
    let (table, edits) = (SheenTable::embedded(), Edits::default());
    for has_camera in [true, false] {
        let near = scene_at([0.0; 3], has_camera);
        let drawn = linear(&near, &table, &edits, SIZE);
        let reference = traced(&near, &table, &edits, TRACED, 4);
        for place in [[1e4, 0.0, -1e4], [-1e6, 1e6, 1e6], [6.4e6, 120.0, -6.4e6]] {
            let far = scene_at(place, has_camera);
            let off = relative_difference(&linear(&far, &table, &edits, SIZE), &drawn);
            assert!(off < MOST, "render at {place:?}, camera {has_camera}: {off}");
            let off = relative_difference(&traced(&far, &table, &edits, TRACED, 4).radiance, &reference.radiance);
            assert!(off < MOST, "reference at {place:?}, camera {has_camera}: {off}");
        }
    }
    // A picture of nothing is the same everywhere too.
    let drawn = linear(&scene_at([0.0; 3], true), &table, &edits, SIZE);
    assert!(relative_difference(&linear(&scene_at([0.0; 3], false), &table, &edits, SIZE), &drawn) > 0.1);
}
