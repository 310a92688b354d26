//! Silhouettes of curved surfaces at four samples a pixel, against pictures of 64 samples a pixel, unfiltered.

use glam::{Mat4, Vec3};
use velour::picture::LinearImage;
use velour::renderer::Offscreen;
use velour::scene::{Edits, Material, Projection, Scene, gltf};
use velour::table::SheenTable;

use super::compare::{GPU, changed, linear};
use super::golden::root;
use super::run::unshadowed;
use super::stage::{Stage, Thing, facing, glow, looking, plain};

/// Samples a pixel along each axis.
const SAMPLES: u32 = 8;

/// A sphere of radius 1.
fn ball(material: Material) -> Thing {
    let (rows, columns) = (48_u32, 96_u32);
    let corner = |index: u32| {
        let (row, column) = (index / (columns + 1), index % (columns + 1));
        let polar = std::f32::consts::PI * row as f32 / rows as f32;
        let azimuth = std::f32::consts::TAU * column as f32 / columns as f32;
        Vec3::new(polar.sin() * azimuth.sin(), polar.cos(), polar.sin() * azimuth.cos())
    };
    let positions: Vec<Vec3> = (0..(rows + 1) * (columns + 1)).map(corner).collect();
    let quad = |index: u32| {
        let at = index / columns * (columns + 1) + index % columns;
        [[at, at + columns + 1, at + columns + 2], [at, at + columns + 2, at + 1]]
    };
    Thing {
        normals: positions.clone(),
        triangles: (0..rows * columns).flat_map(quad).collect(),
        contours: Vec::new(),
        positions,
        world_from_mesh: Mat4::IDENTITY,
        material,
    }
}

fn lit_ball(material: Material) -> Scene {
    let lamp = |eye: [f32; 3]| Thing::rectangle([2.0, 2.0], glow([1.0; 3])).placed(facing(eye, [0.0; 3]));
    let lamps = [[0.0, 3.0, 0.0], [3.0, 0.0, 0.0], [-3.0, 0.0, 0.0]].map(lamp);
    let things = [ball(material)].into_iter().chain(lamps).collect();
    let mut stage = Stage::new(things, looking([0.0, 0.5, 4.0], [0.0; 3]));
    stage.projection = Projection::Perspective { yfov: 0.6, near: 0.1, far: 100.0 };
    stage.scene()
}

fn filtered(scene: &Scene, edits: &Edits, size: [u32; 2]) -> LinearImage {
    let drawn = unshadowed(scene, edits);
    let mut renderer = Offscreen::for_linear(&GPU, 4, &SheenTable::embedded(), &drawn).unwrap();
    GPU.block_on(renderer.linear(&GPU, &scene.cameras[0], size, &drawn.settings)).unwrap()
}

/// Mean and range, over the channels, of a pixel's 64 samples.
struct Sampled {
    mean: Vec3,
    low: Vec3,
    high: Vec3,
}

fn sampled(scene: &Scene, edits: &Edits, size: [u32; 2]) -> Vec<Sampled> {
    let fine = linear(scene, &SheenTable::embedded(), edits, size.map(|side| SAMPLES * side));
    let pixel = |index: u32| {
        let corner = [index % size[0], index / size[0]].map(|at| at * SAMPLES);
        let samples = (0..SAMPLES * SAMPLES).map(|sample| {
            let at = (corner[1] + sample / SAMPLES) * fine.width + corner[0] + sample % SAMPLES;
            Vec3::from(fine.pixels[at as usize])
        });
        let none = Sampled { mean: Vec3::ZERO, low: Vec3::INFINITY, high: Vec3::NEG_INFINITY };
        let sampled = samples.fold(none, |sum, sample| Sampled {
            mean: sum.mean + sample,
            low: sum.low.min(sample),
            high: sum.high.max(sample),
        });
        Sampled { mean: sampled.mean / (SAMPLES * SAMPLES) as f32, ..sampled }
    };
    (0..size[0] * size[1]).map(pixel).collect()
}

/// The mean difference to the samples' mean; the greatest where the samples of a pixel are within 0.05, away from
/// reflections' edges; and how far a pixel is above all of its samples.
fn off(found: &LinearImage, expected: &[Sampled]) -> [f32; 3] {
    let (mut sum, mut flat, mut above) = (0.0, 0.0_f32, 0.0_f32);
    for (pixel, expected) in found.pixels.iter().zip(expected) {
        let off = (Vec3::from(*pixel) - expected.mean).abs().max_element();
        sum += off;
        if (expected.high - expected.low).max_element() < 0.05 {
            flat = flat.max(off);
        }
        above = above.max((Vec3::from(*pixel) - expected.high).max_element());
    }
    [sum / found.pixels.len() as f32, flat, above]
}

/// Shaded once a pixel, with widened lobes, the rims would be grey: single pixels off by 0.3.
#[test]
fn glossy_balls_have_no_grey_rim() {
    let edits = Edits { lights_visible: Some(false), ..Edits::default() };
    for (roughness, side, most) in [(0.0, 64, 0.006), (0.0, 128, 0.003), (0.1, 128, 0.002), (0.3, 128, 0.003)] {
        let scene = lit_ball(Material { metallic: 1.0, roughness, ..plain() });
        let [mean, flat, above] = off(&filtered(&scene, &edits, [side; 2]), &sampled(&scene, &edits, [side; 2]));
        println!("roughness {roughness}, {side} pixels: {mean:.5} {flat:.4} {above:.4}");
        assert!(
            mean < most && flat < 0.05 && above < 0.02,
            "roughness {roughness}, {side} pixels: {mean} {flat} {above}"
        );
    }
}

/// No pixel of a dusty scene is brighter than all of its 64 samples.
#[test]
fn dusty_silhouettes_are_no_brighter_than_their_samples() {
    let scene = gltf::load(&root().join("assets/dust.glb"), &gltf::Options::default()).unwrap();
    // Of dust all over one pixel sticks out, where the rim light grazes a thin edge.
    for (alpha, most) in [(0.4, 0.016), (0.6, 0.016), (1.0, 0.03)] {
        let (edits, size) = (changed(Some(alpha), None, Edits::default()), [320, 180]);
        let expected = sampled(&scene, &edits, size);
        let [mean, flat, above] = off(&filtered(&scene, &edits, size), &expected);
        let mut greatest: Vec<f32> = expected.iter().map(|sampled| sampled.mean.max_element()).collect();
        greatest.sort_by(f32::total_cmp);
        // Of which one pixel in a thousand has more.
        let bright = greatest[greatest.len() * 999 / 1000];
        println!("alpha {alpha}: {mean:.5} {flat:.4} {above:.4} of {bright:.2}");
        assert!(mean < 0.002 && above < most * bright, "alpha {alpha}: {mean} {above} of {bright}");
    }
}
