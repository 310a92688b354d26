//! The device, and the ruler that holds linear pictures against the truth.

use std::sync::LazyLock;

use glam::{DVec3, Vec3};
use velour::picture::LinearImage;
use velour::renderer::{Gpu, Offscreen, device};
use velour::scene::{Edits, Lobes, MaterialEdits, Scene, gltf};
use velour::table::SheenTable;

use super::reference;
use super::run::unshadowed;
use super::stage::Stage;
use super::truth::Truth;

/// The device of all tests. That there is none is a failure.
pub static GPU: LazyLock<Gpu> =
    LazyLock::new(|| pollster::block_on(device::open_offscreen(None)).unwrap_or_else(|error| panic!("{error}")));

pub const SIZE: [u32; 2] = [96, 64];

/// Tolerance relative to the truth: rounding in 32-bit floats of positions, directions, the form factor and the table's
/// lookup. Measured on lavapipe: 3e-6 on planes, 2.4e-5 where normals are interpolated.
const RELATIVE: f64 = 5e-5;
/// Tolerance relative to the picture's greatest radiance: at a light's plane and at the horizon the result is a small
/// difference of large numbers. Measured: 2.4e-6.
const OF_GREATEST: f64 = 5e-6;
/// Drivers may move corners to a grid of at least 16 steps a pixel (Vulkan's least `subPixelPrecisionBits`), by half a
/// step at most, and what they interpolate moves with the corners: SwiftShader does so, lavapipe interpolates between
/// the true corners.
pub const CORNER_SHIFT: f64 = 0.5 / 16.0;
/// A pixel's centre this near to an edge, in pixels, may fall on either side of it: CORNER_SHIFT and some more.
const EDGE: f64 = 0.05;
/// The share of a picture that may be left out as edges. Stages are made of a few large things.
const EDGES_MOST: f64 = 0.05;

/// Edits with another sheen for every material that has one, or for all where none has one.
pub fn changed(alpha: Option<f32>, sheen_color: Option<Vec3>, edits: Edits) -> Edits {
    Edits { every_material: MaterialEdits { alpha, sheen_color, ..MaterialEdits::default() }, ..edits }
}

/// The sheen alone, under lights that are not drawn.
pub fn sheen_alone() -> Edits {
    let lobes = Lobes { sheen: true, diffuse: false, specular: false, emission: false };
    Edits { lobes: Some(lobes), lights_visible: Some(false), ..Edits::default() }
}

pub fn linear(scene: &Scene, table: &SheenTable, edits: &Edits, size: [u32; 2]) -> LinearImage {
    let drawn = unshadowed(scene, edits);
    let mut renderer = Offscreen::for_linear(&GPU, 1, table, &drawn).unwrap();
    GPU.block_on(renderer.linear(&GPU, &scene.cameras[0], size, &drawn.settings)).unwrap()
}

/// Renders the stage, both as a scene made here and as a file read in, and holds both pictures against the truth and
/// the reference.
pub fn hold(stage: &Stage, edits: &Edits) {
    let table = SheenTable::embedded();
    let truth = Truth::new(stage, &table, edits, SIZE);
    let read = gltf::from_slice(&stage.glb(), "stage.glb", &gltf::Options::default()).unwrap();
    assert_eq!(read.notices, [""; 0]);
    for (way, scene) in [("made", stage.scene()), ("read", read)] {
        let picture = linear(&scene, &table, edits, SIZE);
        differences(&picture, &truth).unwrap_or_else(|said| panic!("the scene {way}: {said}"));
        reference::hold(&picture, &scene, &table, edits);
    }
}

/// What the truth says about each pixel of a picture: the radiance at its centre, or none at edges.
fn expected(truth: &Truth, size: [u32; 2]) -> Vec<Option<DVec3>> {
    let pixels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [f64::from(x) + 0.5, f64::from(y) + 0.5]));
    let thing = |[x, y]: [f64; 2], [right, down]: [f64; 2]| truth.at([x + right, y + down]).map(|hit| hit.thing);
    let around = [[EDGE, EDGE], [EDGE, -EDGE], [-EDGE, EDGE], [-EDGE, -EDGE]];
    let one = |center: [f64; 2]| {
        let hit = truth.at(center);
        let alone = around.iter().all(|&offset| thing(center, offset) == hit.as_ref().map(|hit| hit.thing));
        alone.then(|| hit.map_or(DVec3::ZERO, |hit| hit.radiance))
    };
    pixels.map(one).collect()
}

/// Whether the driver moves corners to its grid before it interpolates.
pub fn moves_corners() -> bool {
    !GPU.adapter.get_info().name.starts_with("llvmpipe")
}

/// How far the truth moves, per channel, when the corners do.
fn slack(truth: &Truth, [x, y]: [f64; 2]) -> DVec3 {
    if !moves_corners() {
        return DVec3::ZERO;
    }
    let at = |x, y| truth.at([x, y]).map_or(DVec3::ZERO, |hit| hit.radiance);
    let center = at(x, y);
    let along = |dx: f64, dy: f64| (at(x + dx, y + dy) - center).abs().max((at(x - dx, y - dy) - center).abs());
    along(CORNER_SHIFT, 0.0) + along(0.0, CORNER_SHIFT)
}

/// Holds every pixel that is not at an edge to the truth; says which is worst where any is off.
pub fn differences(picture: &LinearImage, truth: &Truth) -> Result<(), String> {
    let size = [picture.width, picture.height];
    let expected = expected(truth, size);
    let edges = expected.iter().filter(|pixel| pixel.is_none()).count() as f64;
    assert!(edges <= EDGES_MOST * expected.len() as f64, "{edges} of {} pixels are at edges", expected.len());
    let greatest = expected.iter().flatten().fold(DVec3::ZERO, |greatest, pixel| greatest.max(*pixel)).max_element();
    assert!(greatest > 1e-4, "the truth is black, {greatest}: nothing is tested");
    let mut wrong = Vec::new();
    for (index, (pixel, expected)) in picture.pixels.iter().zip(expected).enumerate() {
        let Some(expected) = expected else { continue };
        let difference = (Vec3::from(*pixel).as_dvec3() - expected).abs();
        let allowed = RELATIVE * expected + OF_GREATEST * greatest;
        let place = [index as u32 % size[0], index as u32 / size[0]];
        // Put so that what is not a number is wrong too.
        if !difference.cmple(allowed).all() {
            let allowed = allowed + slack(truth, place.map(|at| f64::from(at) + 0.5));
            if !difference.cmple(allowed).all() {
                wrong.push(((difference / allowed).max_element(), place, *pixel, expected));
            }
        }
    }
    wrong.sort_by(|left, right| right.0.total_cmp(&left.0));
    match wrong.first() {
        None => Ok(()),
        Some((times, place, found, expected)) => Err(format!(
            "{} pixels are off, {place:?} most: {found:?} instead of {expected}, {times:.1} times what is allowed",
            wrong.len()
        )),
    }
}
