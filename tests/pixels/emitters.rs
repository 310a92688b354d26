//! What a file's emitters send to a white, matte floor below them, in closed form.

use std::f64::consts::{PI, TAU};

use glam::{Mat4, Vec3};
use serde_json::json;
use velour::reference::{Effort, Filter, Options, Reference, SpecularModel};
use velour::scene::{Drawn, Edits, Scene, gltf};
use velour::table::SheenTable;

use super::compare::linear;
use super::stage::{Stage, Thing, container, facing, glow, looking, plain};

/// Direct light, with nothing in its way, at the pixels' centres.
const DIRECT: Options =
    Options { max_bounces: 0, shadows: false, filter: Filter::Centre, specular: SpecularModel::Ltc };
/// With one pixel in the middle, which shows the floor's middle.
const SIZE: [u32; 2] = [9, 9];

/// A floor of 4 m, seen from beside what is above it.
fn stage(lamps: Vec<Thing>) -> Stage {
    let floor = Thing::rectangle([2.0, 2.0], plain()).placed(facing([0.0; 3], [0.0, 1.0, 0.0]));
    Stage::new([vec![floor], lamps].concat(), looking([0.0, 1.0, 2.5], [0.0; 3]))
}

/// A lamp of 1 x 1 m and radiance 1 that shines down from 2 m above.
fn lamp() -> Thing {
    Thing::rectangle([0.5, 0.5], glow([1.0; 3])).placed(facing([0.0, 2.0, 0.0], [0.0; 3]))
}

/// The radiance of the floor's middle, by both ways of rendering.
fn middle(scene: &Scene, samples: u64) -> [f64; 2] {
    let (table, edits) = (SheenTable::embedded(), Edits::default());
    let drawn = Drawn::new(scene, &edits);
    let reference = Reference::new(&drawn, &table, DIRECT).unwrap();
    let traced = reference.render(&scene.cameras[0], SIZE, Effort { samples, seed: 1 }, |_, _| true).unwrap();
    [linear(scene, &table, &edits, SIZE), traced.radiance].map(|picture| f64::from(picture.pixels[40][1]))
}

fn read(glb: &[u8]) -> Scene {
    gltf::from_slice(glb, "emitters.glb", &gltf::Options::default()).unwrap()
}

#[track_caller]
fn assert_middle(scene: &Scene, expected: f64, tolerance: f64) {
    let found = middle(scene, 1);
    assert!(found.iter().all(|found| (found / expected - 1.0).abs() < tolerance), "{found:?} {expected}");
}

/// The form factor of a rectangle of sides x and y in a plane above, whose corner is straight above at distance 1
/// (Howell's catalogue of configuration factors, B-3).
fn corner(x: f64, y: f64) -> f64 {
    let along = |one: f64, other: f64| one / (1.0 + one * one).sqrt() * (other / (1.0 + one * one).sqrt()).atan();
    (along(x, y) + along(y, x)) / TAU
}

#[test]
fn half_of_a_lamp_is_cut_out_or_transparent() {
    let whole = 4.0 * corner(0.25, 0.25);
    assert_middle(&read(&stage(vec![lamp()]).glb()), whole, 1e-4);
    let (mut json, bytes) = stage(vec![lamp()]).chunks();
    json["materials"][1]["pbrMetallicRoughness"]["baseColorFactor"] = json!([0, 0, 0, 0.5]);
    for (mode, expected) in [("OPAQUE", 1.0), ("BLEND", 0.5)] {
        json["materials"][1]["alphaMode"] = json!(mode);
        assert_middle(&read(&container(json.to_string().as_bytes(), &bytes)), expected * whole, 1e-4);
    }
    // The vertices' alpha runs from 0 to 1 across the lamp.
    let (mut json, mut bytes) = stage(vec![lamp()]).chunks();
    let alphas = [0.0f32, 1.0, 1.0, 0.0].map(|alpha| [1.0, 1.0, 1.0, alpha]);
    let view = json!({ "buffer": 0, "byteOffset": bytes.len(), "byteLength": 64 });
    bytes.extend_from_slice(bytemuck::cast_slice(&alphas));
    json["buffers"][0]["byteLength"] = json!(bytes.len());
    let views = json["bufferViews"].as_array_mut().unwrap();
    views.push(view);
    let accessor = json!({ "bufferView": views.len() - 1, "componentType": 5126, "type": "VEC4", "count": 4 });
    let accessors = json["accessors"].as_array_mut().unwrap();
    accessors.push(accessor);
    json["meshes"][1]["primitives"][0]["attributes"]["COLOR_0"] = json!(accessors.len() - 1);
    json["materials"][1]["alphaMode"] = json!("MASK");
    for (cutoff, beyond) in [(0.5, 0.0), (0.25, corner(0.125, 0.25))] {
        json["materials"][1]["alphaCutoff"] = json!(cutoff);
        let [drawn, traced] = middle(&read(&container(json.to_string().as_bytes(), &bytes)), 1 << 14);
        let left = 2.0 * (corner(0.25, 0.25) + beyond);
        assert!((drawn / left - 1.0).abs() < 2e-3, "{drawn} {left}");
        assert!((traced / left - 1.0).abs() < 0.01, "{traced} {left}");
    }
}

/// A second lamp half beside the first: together a rectangle of 1.5 x 1 m.
#[test]
fn lamps_in_one_plane_shine_as_their_union() {
    let beside = Mat4::from_translation(Vec3::new(0.5, 0.0, 0.0)) * lamp().world_from_mesh;
    let union = 2.0 * (corner(0.25, 0.25) + corner(0.5, 0.25));
    assert_middle(&read(&stage(vec![lamp(), lamp().placed(beside)]).glb()), union, 1e-4);
    assert_middle(&read(&stage(vec![lamp(), lamp()]).glb()), 4.0 * corner(0.25, 0.25), 1e-4);
}

/// A ball of radius 0.3 that glows, 2 m above, of triangles and quads as modelling programs make them.
fn ball(columns: u32, rows: u32) -> Thing {
    let positions = (0..=rows).flat_map(|row| {
        let (sine, cosine) = (f64::from(row) / f64::from(rows) * PI).sin_cos();
        (0..columns).map(move |column| {
            let (y, x) = (f64::from(column) / f64::from(columns) * TAU).sin_cos();
            Vec3::new((sine * x) as f32, cosine as f32, (-sine * y) as f32)
        })
    });
    let at = move |row: u32, column: u32| row * columns + column % columns;
    let quads = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
    let triangles = quads.flat_map(|(row, column)| {
        let [a, b] = [at(row, column), at(row, column + 1)];
        let [c, d] = [at(row + 1, column + 1), at(row + 1, column)];
        [[a, d, c], [a, c, b]]
    });
    let positions: Vec<Vec3> = positions.collect();
    Thing {
        normals: positions.clone(),
        positions,
        triangles: triangles.collect(),
        contours: Vec::new(),
        world_from_mesh: Mat4::from_translation(2.0 * Vec3::Y) * Mat4::from_scale(Vec3::splat(0.3)),
        material: glow([1.0; 3]),
    }
}

/// A smooth ball of radius r at distance d has the form factor (r / d)^2. Facets are within it: of 32 x 16 they are
/// 0.9% too few, and of 64 x 32 and more, which are merged, a fourth of that and less.
#[test]
fn balls_of_many_facets_light_as_balls() {
    let smooth = 0.0225;
    for ((columns, rows), tolerance) in [((32, 16), 0.011), ((64, 32), 0.006), ((160, 80), 0.006)] {
        let scene = read(&stage(vec![ball(columns, rows)]).glb());
        assert_eq!(scene.notices.len(), usize::from(columns > 32), "{:?}", scene.notices);
        assert_middle(&scene, smooth, tolerance);
    }
}
