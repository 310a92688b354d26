//! Shadows in real time against what is known in closed form, and against the reference.
//!
//! Real time takes what is blocked from a closed form, so that a picture of n samples is off by noise that falls with n, and where
//! nothing is blocked not at all.

use glam::{DVec2, DVec3, Mat4, Vec2, Vec3};
use velour::picture::{DisplayImage, LinearImage};
use velour::reference::{self, Filter, Options, Picture, Reference};
use velour::renderer::{Effort, Offscreen};
use velour::scene::{AlphaMode, Drawn, Edits, LightEdits, Material, Projection, PunctualKind, PunctualLight};
use velour::table::SheenTable;

use super::compare::GPU;
use super::modelling::ball;
use super::obstacles::{self, Case, cloth, floor, window};
use super::stage::{Stage, Thing, facing, glow, looking, plain};
use super::truth::Truth;

const SIZE: [u32; 2] = [40, 30];

/// Samples at the pixels' centres.
pub fn centred(samples: u32, seed: u32) -> Effort {
    Effort { samples, seed, spread: false }
}

pub fn offscreen(case: &Case, is_shown: bool, effort: Effort) -> Offscreen {
    let (table, drawn) = (SheenTable::embedded(), Drawn::new(&case.scene, &case.edits));
    let make = if is_shown { Offscreen::for_display } else { Offscreen::for_linear };
    let mut offscreen = make(&GPU, 1, &table, &drawn).unwrap();
    offscreen.effort = effort;
    offscreen
}

/// Real time's picture, in linear radiance.
pub fn pictured(case: &Case, size: [u32; 2], effort: Effort) -> LinearImage {
    let settings = case.edits.settings();
    let mut offscreen = offscreen(case, false, effort);
    GPU.block_on(offscreen.linear(&GPU, &case.scene.cameras[0], size, &settings)).unwrap()
}

/// The same without shadows.
fn unshadowed(case: &Case) -> LinearImage {
    let edits = Edits { shadows: Some(false), ..case.edits.clone() };
    pictured(&Case { scene: case.scene.clone(), edits, ..*case }, SIZE, centred(1, 0))
}

/// The reference's.
pub fn traced(case: &Case, size: [u32; 2], filter: Filter, samples: u64) -> Picture {
    let drawn = Drawn::new(&case.scene, &case.edits);
    let options = Options { filter, ..Options::default() };
    let reference = Reference::new(&drawn, &SheenTable::embedded(), options).unwrap();
    reference.render(&case.scene.cameras[0], size, reference::Effort { samples, seed: 1 }, |_, _| true).unwrap()
}

fn channels(image: &LinearImage) -> Vec<f64> {
    image.pixels.as_flattened().iter().map(|&value| value.into()).collect()
}

/// The mean absolute error of a picture, with the truth's own taken off in squares, and its mean error; both over the mean of the
/// truth.
pub fn apart(picture: &LinearImage, truth: &Picture) -> [f64; 2] {
    let [found, expected, errors] = [picture, &truth.radiance, &truth.errors].map(channels);
    let differences = || found.iter().zip(&expected).map(|(found, expected)| found - expected);
    let sum: f64 = expected.iter().sum();
    let absolute = differences().map(f64::abs).sum::<f64>() / sum;
    // The mean of the absolute value of a normal variable.
    let own = (2.0 / std::f64::consts::PI).sqrt() * errors.iter().sum::<f64>() / sum;
    [(absolute.powi(2) - own.powi(2)).max(0.0).sqrt(), differences().sum::<f64>() / sum]
}

/// Samples of a picture that is held to the reference.
const MANY: u32 = 144;

/// A light that is half blocked is as a coin that is tossed: off by its mean after one toss, and by 1 / sqrt(n) after n. Even sequences
/// do better, and not all of a picture is in half shadow; edges are off likewise. Measured: 0.06 to 0.17 of that, and the mean 0.04 of it.
#[test]
fn shadows_converge_to_the_reference() {
    for case in obstacles::all() {
        let is_dear = case.scene.lights.len() > 8;
        // At the pixels' centres there is no noise but that of shadows.
        let is_telling = ["two-sided light", "blend", "moved", "gloss and blue sheen"].contains(&case.name);
        for spread in [true, false].into_iter().filter(|spread| *spread || is_telling) {
            let filter = if spread { Filter::Box } else { Filter::Centre };
            let truth = traced(&case, SIZE, filter, if is_dear { 32 } else { 256 });
            let picture = pictured(&case, SIZE, Effort { samples: MANY, seed: 3, spread });
            let [off, more] = apart(&picture, &truth);
            let tossed = 1.0 / f64::from(MANY).sqrt();
            assert!(off < 0.25 * tossed && more.abs() < 0.06 * tossed, "{}, {spread}: {off} {more}", case.name);
        }
    }
}

/// What nothing blocks is to the bit what it is without shadows: no noise, and no surface or light that shadows itself.
#[test]
fn what_nothing_blocks_is_as_without_shadows() {
    for name in ["board", "concave light", "two-sided light", "moved", "normal map", "reciprocal layering"] {
        let mut open = Case::named(name);
        // The floor and the light.
        open.scene.instances.truncate(2);
        let (with, without) = (pictured(&open, SIZE, centred(3, 1)), unshadowed(&open));
        assert!(with == without, "{}", open.name);
    }
}

/// A ball of few facets under lights that graze it: where they are above its curved surface, its facets do not stop them.
#[test]
fn most_of_what_is_round_does_not_shadow_itself() {
    let lamp = Thing::rectangle([0.3, 0.3], glow([4.0, 3.0, 2.0])).placed(facing([2.0, 0.2, 0.1], [0.0; 3]));
    let stage = Stage::new(vec![ball(cloth(), 24), lamp], looking([2.5, 0.5, 3.5], [0.0; 3]));
    let case = Case { name: "round", scene: stage.scene(), edits: Edits::default() };
    let (with, without) = (pictured(&case, SIZE, centred(16, 1)), unshadowed(&case));
    let [with, without] = [with, without].map(|picture| channels(&picture).iter().sum::<f64>());
    assert!((with / without - 1.0).abs() < 2e-3, "{with} {without}");
}

#[test]
fn the_seed_says_what_noise_there_is() {
    let case = Case::named("board");
    let [first, again, other] = [1, 1, 2].map(|seed| pictured(&case, SIZE, centred(4, seed)));
    let plain = unshadowed(&case);
    assert!(first == again);
    let differ = |index: &usize| first.pixels[*index] != other.pixels[*index];
    let noisy: Vec<usize> = (0..plain.pixels.len()).filter(differ).collect();
    assert!(noisy.len() > plain.pixels.len() / 20 && noisy.len() < plain.pixels.len() / 2, "{}", noisy.len());
    // What is noisy is in half shadow: nowhere brighter than without shadows in all seeds.
    let brighter =
        noisy.iter().filter(|&&at| first.pixels[at][1].min(other.pixels[at][1]) > plain.pixels[at][1]).count();
    assert!(brighter < noisy.len() / 20, "{brighter} of {}", noisy.len());
}

/// With lobes of many colours one sample may take away more than there is. What is shown of it is black; it counts in full in
/// the mean of many.
#[test]
fn negative_samples_count() {
    const SEEDS: u32 = 256;
    let case = Case::named("gloss and blue sheen");
    let mut one = offscreen(&case, false, centred(1, 0));
    let settings = case.edits.settings();
    let mut clamped = vec![0.0; 3 * 1200];
    for seed in 0..SEEDS {
        one.effort.seed = seed;
        let picture = GPU.block_on(one.linear(&GPU, &case.scene.cameras[0], SIZE, &settings)).unwrap();
        clamped.iter_mut().zip(channels(&picture)).for_each(|(sum, value)| *sum += value / f64::from(SEEDS));
    }
    one.effort = centred(SEEDS, 1);
    let mean = GPU.block_on(one.linear(&GPU, &case.scene.cameras[0], SIZE, &settings)).unwrap();
    let truth = traced(&case, SIZE, Filter::Centre, 512);
    let sums = [clamped, channels(&mean), channels(&truth.radiance)].map(|values| values.iter().sum::<f64>());
    let [clamped, mean] = [sums[0], sums[1]].map(|sum| sum / sums[2] - 1.0);
    assert!(clamped > 3e-3 && mean.abs() < 1e-3, "{clamped} {mean}");
}

/// Surfaces of one lobe have no noise where all of a light is behind one thing: of a veil the rest of its opacity is left, of a
/// board nothing.
#[test]
fn a_veil_leaves_the_rest_of_its_opacity() {
    for (alpha_mode, opacity, left) in [
        (AlphaMode::Blend, 0.6, 0.4),
        (AlphaMode::Blend, 0.25, 0.75),
        (AlphaMode::Mask { cutoff: 0.5 }, 0.6, 0.0),
        (AlphaMode::Mask { cutoff: 0.7 }, 0.6, 1.0),
        (AlphaMode::Opaque, 0.6, 0.0),
    ] {
        let mut veil = Thing::rectangle([20.0, 20.0], Material { alpha_mode, opacity, ..plain() });
        veil.world_from_mesh = facing([0.0, 1.2, 0.0], [0.0, 2.0, 0.0]);
        let lit = Thing::rectangle([0.5, 0.3], glow([8.0, 6.0, 4.0])).placed(facing([0.0, 1.6, 0.0], [0.0; 3]));
        let scene = Stage::new(vec![floor(plain()), lit, veil], looking([0.0, 0.8, 0.8], [0.0; 3])).scene();
        let case = Case { name: "veil", scene, edits: Edits::default() };
        let [with, without] =
            [pictured(&case, SIZE, centred(1, 1)), unshadowed(&case)].map(|picture| channels(&picture));
        for (with, without) in with.into_iter().zip(without) {
            assert!(
                without > 0.0 && (with - left * without).abs() < 1e-4 * without,
                "{alpha_mode:?}: {with}, {without}"
            );
        }
    }
}

/// A box that glows inwards too: of its far sides' light nothing comes through the near ones, whose own light nothing stops.
#[test]
fn the_inside_of_a_box_is_hidden_by_its_outside() {
    let mut inwards = Case::named("box of light");
    inwards.scene.instances.truncate(2);
    let mut outwards = Case { scene: inwards.scene.clone(), edits: Edits::default(), ..inwards };
    outwards.scene.lights[0].two_sided = false;
    let of = |case: &Case, samples| pictured(case, SIZE, centred(samples, 1));
    let [found, expected, all] = [of(&inwards, 256), of(&outwards, 4), unshadowed(&inwards)];
    assert!(expected == unshadowed(&outwards));
    let (sum, [mut off, mut hidden]) = (channels(&expected).iter().sum::<f64>(), [0.0; 2]);
    for ((found, expected), all) in channels(&found).into_iter().zip(channels(&expected)).zip(channels(&all)) {
        (off, hidden) = (off + (found - expected).abs(), hidden + all - expected);
    }
    assert!(off < 0.02 * sum && hidden > 0.2 * sum, "{} {}", off / sum, hidden / sum);
}

/// A lamp is in the way of another one's light as long as it is shown.
#[test]
fn lamps_that_are_not_shown_hide_nothing() {
    let mut lamp = Thing::rectangle([0.4, 0.3], glow([0.1; 3])).placed(facing([0.4, 0.7, -0.4], [0.9, 1.5, -1.0]));
    lamp.material.double_sided = true;
    let of = |lights_visible| {
        let scene =
            Stage::new(vec![floor(cloth()), window(), lamp.clone()], looking([0.4, 1.1, 2.6], [0.0; 3])).scene();
        let case =
            Case { name: "lamp", scene, edits: Edits { lights_visible: Some(lights_visible), ..Edits::default() } };
        let [with, without] = [pictured(&case, SIZE, centred(2, 1)), unshadowed(&case)];
        with.pixels.iter().zip(&without.pixels).filter(|(with, without)| with != without).count()
    };
    assert!(of(true) > 100 && of(false) == 0, "{} {}", of(true), of(false));
}

/// The light of a point goes past an edge or it does not: shadows are sharp, where they must be, and black.
#[test]
fn points_cast_sharp_shadows() {
    let [point, from] = [Vec3::new(0.3, 2.0, -0.2), Vec3::new(0.1, 1.0, 0.05)];
    for kind in [
        PunctualKind::Point { range: f32::INFINITY },
        PunctualKind::Spot { range: 9.0, inner: 1.0, outer: 1.2 },
        PunctualKind::Directional,
    ] {
        // Covers what is to the right of and behind one corner.
        let slab = Thing::rectangle([10.0, 10.0], plain());
        let slab = slab.placed(facing([from.x + 10.0, from.y, from.z - 10.0], [from.x + 10.0, 0.0, from.z - 10.0]));
        let mut stage = Stage::new(vec![floor(cloth()), slab], looking([0.0, 0.8, 0.0], [0.0; 3]));
        stage.projection = Projection::Orthographic { ymag: 1.0, near: 0.1, far: 10.0 };
        let direction = Vec3::new(0.2, -1.0, -0.1).normalize();
        stage.punctual.push(PunctualLight {
            name: String::new(),
            kind,
            intensity: Vec3::ONE,
            position: point,
            direction,
        });
        let case = Case { name: "point", scene: stage.scene(), edits: Edits::default() };
        let [with, without] = [pictured(&case, SIZE, centred(1, 1)), unshadowed(&case)];
        let right = case.scene.cameras[0].world_from_camera.transform_vector3(Vec3::X);
        let up = case.scene.cameras[0].world_from_camera.transform_vector3(Vec3::Y);
        let mut dark = 0;
        for (index, (with, without)) in with.pixels.iter().zip(&without.pixels).enumerate() {
            let at = Vec2::new((index % 40) as f32 + 0.5, (index / 40) as f32 + 0.5);
            let p = right * ((2.0 * at.x - 40.0) / 30.0) + up * (1.0 - 2.0 * at.y / 30.0);
            let way = if kind == PunctualKind::Directional { -direction } else { point - p };
            let over = p + way * (from.y / way.y);
            let inside = [over.x - from.x, from.z - over.z];
            if inside.iter().any(|inside| inside.abs() < 1e-4) {
                continue;
            }
            assert!(without[1] > 1e-3);
            if inside.iter().all(|&inside| inside > 0.0) {
                dark += 1;
                assert!(
                    with.iter().zip(without).all(|(with, without)| *with <= 1e-5 * without),
                    "{kind:?} {index}: {with:?}"
                );
            } else {
                assert_eq!(with, without, "{kind:?} {index}");
            }
        }
        assert!((200..1000).contains(&dark), "{dark}");
    }
}

/// At rest, what is shown is the picture and not what a filter makes of it; with few samples it is what the filter makes.
#[test]
fn shown_pictures_of_many_samples_are_not_filtered() {
    let case = Case::named("board");
    let settings = case.edits.settings();
    let greatest = |samples: u32| {
        let mut shown = offscreen(&case, true, centred(samples, 1));
        let shown = GPU.block_on(shown.display(&GPU, &case.scene.cameras[0], SIZE, &settings)).unwrap();
        let expected: DisplayImage =
            pictured(&case, SIZE, centred(samples, 1)).display(settings.exposure, settings.tone);
        let codes = |image: &DisplayImage| image.pixels.as_flattened().to_vec();
        codes(&shown).into_iter().zip(codes(&expected)).map(|(left, right)| left.abs_diff(right)).max().unwrap()
    };
    let [few, many] = [greatest(2), greatest(velour::renderer::UNFILTERED)];
    assert!(few > 10 && many <= 2, "{few} {many}");
}

/// Moved lights have the shadows of new ones.
#[test]
fn lights_that_are_moved_cast_other_shadows() {
    let mut case = Case::named("board");
    let mut moving = offscreen(&case, false, centred(4, 1));
    let position = case.scene.lights[0].position() + Vec3::new(-0.2, 0.1, 0.1);
    case.edits.lights.insert(0, LightEdits { position: Some(position), ..LightEdits::default() });
    moving.update(&GPU, &Drawn::new(&case.scene, &case.edits)).unwrap();
    let moved = GPU.block_on(moving.linear(&GPU, &case.scene.cameras[0], SIZE, &case.edits.settings())).unwrap();
    assert!(moved == pictured(&case, SIZE, centred(4, 1)));
}

/// Half of a panel is behind a slab that covers all on one side of an edge. What is left of the panel, as a point of the floor sees it, is
/// a rectangle again, of which the radiance is known.
#[test]
fn half_a_light_is_seen_past_an_edge() {
    const HALF: f32 = 0.6;
    let panel = |from: f32| {
        let corners = [[from, -HALF], [HALF, -HALF], [HALF, HALF], [from, HALF]];
        Thing::flat(&corners, &[[0, 1, 2], [0, 2, 3]], &[&[0, 1, 2, 3]], glow([4.0, 3.0, 2.0]))
            .placed(facing([0.0, 2.0, 0.0], [0.0; 3]))
    };
    let camera = looking([0.0, 0.8, 0.8], [0.0; 3]);
    let stage = |from: f32| Stage::new(vec![floor(cloth()), panel(from)], camera);
    let mut blocked = stage(-HALF);
    // All that is on the negative side of the panel's own x.
    let axis = panel(0.0).world_from_mesh.transform_vector3(Vec3::X);
    blocked.things.push(
        Thing::rectangle([20.0, 20.0], plain()).placed(facing([-20.0 * axis.x, 1.0, 0.0], [-20.0 * axis.x, 0.0, 0.0])),
    );
    let case = Case { name: "half", scene: blocked.scene(), edits: Edits::default() };
    let table = SheenTable::embedded();
    // Mean absolute and mean error over the mean, of pixels in half shadow.
    let errors = |samples: u32| {
        let picture = pictured(&case, SIZE, centred(samples, 1));
        let (mut sum, mut off, mut more) = (0.0, 0.0, 0.0);
        for (index, found) in picture.pixels.iter().enumerate() {
            let at = DVec2::new((index % 40) as f64 + 0.5, (index / 40) as f64 + 0.5);
            let x = f64::from(axis.x) * on_floor(camera, at).x;
            // Through the edge, half as high as the panel.
            let from = (-x).max(-f64::from(HALF));
            let expected = match from < f64::from(HALF) {
                true => Truth::new(&stage(from as f32), &table, &case.edits, SIZE).at(at.to_array()).unwrap().radiance,
                false => DVec3::ZERO,
            };
            let difference = Vec3::from(*found).as_dvec3() - expected;
            (sum, off) = (sum + expected.element_sum(), off + difference.abs().element_sum());
            more += difference.element_sum();
        }
        [off / sum, more / sum]
    };
    let [few, many] = [errors(16), errors(1024)];
    assert!(many[0] < 0.01 && many[1].abs() < 1e-3, "{few:?} {many:?}");
    // To a slope of -0.45 at least.
    assert!(many[0] < few[0] * 64.0_f64.powf(-0.45), "{few:?} {many:?}");
}

/// Where the ray of a point of the picture meets the floor, for the stages' projection.
fn on_floor(camera: Mat4, at: DVec2) -> DVec3 {
    let extent = (0.5 * f64::from(0.8_f32)).tan() / 30.0;
    let way = DVec3::new((2.0 * at.x - 40.0) * extent, (30.0 - 2.0 * at.y) * extent, -1.0);
    let [eye, way] = [camera.as_dmat4().transform_point3(DVec3::ZERO), camera.as_dmat4().transform_vector3(way)];
    eye - eye.y / way.y * way
}
