//! The reference renderer against the real-time one, and against what is known of it.

use glam::{DVec3, Vec3};
use velour::picture::LinearImage;
use velour::reference::{Effort, Filter, Options, Picture, Reference, SpecularModel};
use velour::scene::{Drawn, Edits, Layering, Material, MaterialEdits, Scene, Sheen, SheenModel};
use velour::table::SheenTable;

use super::compare::{CORNER_SHIFT, SIZE, linear, moves_corners, sheen_alone};
use super::stage::{Stage, Thing, facing, glow, looking, plain, velvet};

/// What real time computes: direct light, with nothing in its way, at the pixels' centres.
const REAL_TIME: Options =
    Options { max_bounces: 0, shadows: false, filter: Filter::Centre, specular: SpecularModel::Ltc };
/// Tolerance relative to a pixel's value, however little noise there is.
const RELATIVE: f64 = 1e-3;
/// Tolerance of the picture's mean, relative.
const MEAN: f64 = 5e-3;
/// Tolerance relative to the picture's greatest value: rounding in f32 where a light's plane or the horizon passes (see
/// `compare`).
const OF_GREATEST: f64 = 1e-5;
/// The share of pixels that may be off: those that noise moves by more than three standard errors, 5 in 1000 with 32
/// batches, and edges.
const MOST_OFF: f64 = 0.01;

pub fn traced(scene: &Scene, table: &SheenTable, edits: &Edits, options: Options, samples: u64) -> Picture {
    let drawn = Drawn::new(scene, edits);
    let reference = Reference::new(&drawn, table, options).unwrap();
    reference.render(&scene.cameras[0], SIZE, Effort { samples, seed: 1 }, |_, _| true).unwrap()
}

fn mean(picture: &LinearImage) -> f64 {
    picture.pixels.iter().flatten().map(|&value| f64::from(value)).sum::<f64>() / (3 * picture.pixels.len()) as f64
}

/// How far a pixel's value moves, per channel, where the driver moves corners: along the steepest slope to its
/// neighbours.
fn slack(radiance: &LinearImage, index: usize) -> DVec3 {
    if !moves_corners() {
        return DVec3::ZERO;
    }
    let width = radiance.width as usize;
    let at = |index: usize| radiance.pixels.get(index).map(|pixel| Vec3::from(*pixel).as_dvec3());
    let here = at(index).unwrap_or_default();
    let steepest = |step: usize| {
        let around = [at(index + step), index.checked_sub(step).and_then(at)];
        around.into_iter().flatten().map(|there| (there - here).abs()).fold(DVec3::ZERO, DVec3::max)
    };
    CORNER_SHIFT * (steepest(1) + steepest(width))
}

/// Holds a picture to one of the reference: nearly all pixels within three standard errors or 0.1%, the mean within
/// 0.5%.
pub fn differences(picture: &LinearImage, reference: &Picture) -> Result<(), String> {
    let radiance = &reference.radiance;
    let greatest = radiance.pixels.iter().flatten().fold(0.0_f32, |greatest, &value| greatest.max(value));
    let is_off = |index: &usize| {
        let images = [&picture.pixels, &radiance.pixels, &reference.errors.pixels];
        let [found, expected, error] = images.map(|pixels| Vec3::from(pixels[*index]).as_dvec3());
        let allowed =
            (3.0 * error).max(RELATIVE * expected) + OF_GREATEST * f64::from(greatest) + slack(radiance, *index);
        !(found - expected).abs().cmple(allowed).all()
    };
    let off: Vec<usize> = (0..picture.pixels.len()).filter(is_off).collect();
    if off.len() as f64 > MOST_OFF * picture.pixels.len() as f64 {
        let at = off[off.len() / 2];
        return Err(format!(
            "{} pixels are off, [{}, {}] among them: {:?}, not {:?} within 3 times {:?}",
            off.len(),
            at as u32 % picture.width,
            at as u32 / picture.width,
            picture.pixels[at],
            radiance.pixels[at],
            reference.errors.pixels[at],
        ));
    }
    let [found, expected] = [picture, radiance].map(mean);
    if (found - expected).abs() > MEAN * expected {
        return Err(format!("the mean is {found}, not {expected}"));
    }
    Ok(())
}

/// Holds a picture of real time to the reference's of the same scene.
pub fn hold(picture: &LinearImage, scene: &Scene, table: &SheenTable, edits: &Edits) {
    let reference = traced(scene, table, edits, REAL_TIME, 64);
    differences(picture, &reference).unwrap_or_else(|said| panic!("against the reference: {said}"));
}

const UP: [f32; 3] = [0.0, 1.0, 0.0];
const ORIGIN: [f32; 3] = [0.0; 3];

fn stage(alpha: f32) -> Stage {
    let floor = Thing::rectangle([1.5, 1.5], velvet([0.9, 0.5, 0.2], alpha)).placed(facing(ORIGIN, UP));
    let window = Thing::rectangle([0.5, 0.3], glow([4.0, 3.0, 2.0])).placed(facing([1.0, 1.2, -1.0], ORIGIN));
    Stage::new(vec![floor, window], looking([0.4, 1.1, 2.6], ORIGIN))
}

fn with_model(model: SheenModel) -> Edits {
    let overrides = MaterialEdits { sheen_model: Some(model), ..MaterialEdits::default() };
    Edits { every_material: overrides, ..sheen_alone() }
}

#[test]
fn wrong_pictures_are_rejected() {
    let (table, edits) = (SheenTable::embedded(), sheen_alone());
    let scene = stage(0.4).scene();
    let reference = traced(&scene, &table, &edits, REAL_TIME, 64);
    let right = linear(&scene, &table, &edits, SIZE);
    differences(&right, &reference).unwrap();
    let changed = |change: &dyn Fn(usize, &mut [f32; 3])| {
        let mut picture = right.clone();
        picture.pixels.iter_mut().enumerate().for_each(|(index, pixel)| change(index, pixel));
        differences(&picture, &reference)
    };
    let brighter = |share: f32| changed(&|_, pixel| *pixel = pixel.map(|value| share * value));
    assert!(brighter(1.006).is_err() && brighter(0.994).is_err());
    assert!(changed(&|_, pixel| pixel.swap(0, 2)).is_err());
    assert!(changed(&|_, pixel| *pixel = [0.0; 3]).is_err());
    assert!(changed(&|index, pixel| pixel[1] = if index % 40 == 0 { f32::NAN } else { pixel[1] }).is_err());
    let mut shifted = right.clone();
    shifted.pixels.rotate_right(1);
    assert!(differences(&shifted, &reference).is_err());
    let other = linear(&stage(0.42).scene(), &table, &edits, SIZE);
    assert!(differences(&other, &reference).is_err());
}

#[test]
fn a_seed_gives_the_same_picture_on_any_number_of_threads() {
    let (table, edits) = (SheenTable::embedded(), with_model(SheenModel::Walk));
    let scene = stage(0.5).scene();
    let on = |threads: usize, seed: u64| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let drawn = Drawn::new(&scene, &edits);
            let reference = Reference::new(&drawn, &table, Options { max_bounces: 2, ..Options::default() });
            let effort = Effort { samples: 3, seed };
            reference.unwrap().render(&scene.cameras[0], [50, 30], effort, |_, _| true).unwrap().radiance
        })
    };
    assert_eq!(on(1, 7), on(3, 7));
    assert_ne!(on(2, 7), on(2, 8));
}

#[test]
fn a_picture_that_is_asked_to_end_is_made_of_whole_batches() {
    let (table, edits) = (SheenTable::embedded(), sheen_alone());
    let scene = stage(0.5).scene();
    let drawn = Drawn::new(&scene, &edits);
    let reference = Reference::new(&drawn, &table, Options::default()).unwrap();
    let render = |samples: u64, stop_after: u64| {
        let effort = Effort { samples, seed: 0 };
        reference.render(&scene.cameras[0], [40, 20], effort, |done, _| done < stop_after).unwrap()
    };
    let early = render(4096, 1);
    assert_eq!((early.samples, early.batches), (1, 1));
    assert_eq!(early.relative_error(), None);
    // Batches of 1, 1, 2, 4, 8, 16, 16 and so on, four tiles each.
    let later = render(4096, 4 * 7 + 1);
    assert_eq!(later.samples, 48);
    // What is there is the picture of that many samples.
    assert_eq!(later.radiance, whole_batches(&reference, &scene, later.samples));
    let whole = render(100, u64::MAX);
    assert_eq!((whole.samples, whole.batches), (100, 51));
}

/// The picture of the first `samples` of 4096.
fn whole_batches(reference: &Reference, scene: &Scene, samples: u64) -> LinearImage {
    let effort = Effort { samples: 4096, seed: 0 };
    // At the last tile of these batches.
    let stop_after = 4 * 7;
    let picture = reference.render(&scene.cameras[0], [40, 20], effort, |done, _| done < stop_after).unwrap();
    assert_eq!(picture.samples, samples);
    picture.radiance
}

/// The estimated errors are those that other seeds show.
#[test]
fn errors_are_what_they_are_estimated_to_be() {
    let (table, edits) = (SheenTable::embedded(), with_model(SheenModel::Slab));
    let scene = stage(0.3).scene();
    let drawn = Drawn::new(&scene, &edits);
    let reference = Reference::new(&drawn, &table, Options::default()).unwrap();
    let render = |samples: u64, seed: u64| {
        reference.render(&scene.cameras[0], [24, 16], Effort { samples, seed }, |_, _| true).unwrap()
    };
    let truth = render(32_768, 99);
    let (mut square, mut beyond, mut count) = (0.0, 0, 0);
    for seed in 0..8 {
        let picture = render(128, seed);
        for ((found, expected), error) in
            picture.radiance.pixels.iter().zip(&truth.radiance.pixels).zip(&picture.errors.pixels)
        {
            if error[0] > 1e-4 * expected[0] && expected[0] > 0.0 {
                let deviation = f64::from((found[0] - expected[0]) / error[0]);
                square += deviation * deviation;
                beyond += usize::from(deviation.abs() > 3.0);
                count += 1;
            }
        }
    }
    assert!(count > 1000, "{count} pixels have an error");
    // Of Student's t with 33 degrees of freedom the variance is 1.06, and 0.5% lie beyond 3.
    let variance = square / f64::from(count as u32);
    assert!((0.85..1.3).contains(&variance), "deviations have the variance {variance}");
    assert!((beyond as f64) < 0.02 * count as f64, "{beyond} of {count} lie beyond three standard errors");
}

/// Light from a window past a screen with an edge: shadows are where straight lines say.
#[test]
fn shadows_are_where_straight_lines_say() {
    let (table, edits) = (SheenTable::embedded(), sheen_alone());
    let options = Options { shadows: true, ..REAL_TIME };
    let mut stage = stage(0.5);
    // Wholly below the window and wholly off its way.
    let plate =
        |place, half| Thing::rectangle([half; 2], velvet([0.0; 3], 0.5)).placed(facing(place, [1.0, 1.2, -1.0]));
    let open = traced(&stage.scene(), &table, &edits, options, 64);
    stage.things.push(plate([0.9, 1.08, -0.9], 2.0));
    let covered = traced(&stage.scene(), &table, &edits, options, 64);
    let bare = linear(&self::stage(0.5).scene(), &table, &edits, SIZE);
    differences(&bare, &open).unwrap();
    assert!(mean(&covered.radiance) < 0.02 * mean(&open.radiance));
}

/// The walk through the slab, the slab's table and its fit stand for the same lobe: the first two agree within their
/// noise, and the fit does not.
#[test]
fn the_walk_is_the_slab_and_the_fit_is_near() {
    let table = SheenTable::embedded();
    for alpha in [0.3, 0.8] {
        let scene = stage(alpha).scene();
        let of = |model, samples| traced(&scene, &table, &with_model(model), REAL_TIME, samples);
        let slab = of(SheenModel::Slab, 256);
        let walk = of(SheenModel::Walk, 256);
        assert!(differences(&of(SheenModel::Ltc, 64).radiance, &slab).is_err(), "alpha {alpha}");
        let (found, expected) = (mean(&walk.radiance), mean(&slab.radiance));
        // Three standard errors of the mean, and what the slab's table may be off.
        let square =
            |picture: &Picture| picture.errors.pixels.iter().map(|error| f64::from(error[0]).powi(2)).sum::<f64>();
        let error = (square(&walk) + square(&slab)).sqrt() / walk.errors.pixels.len() as f64;
        let allowed = 3.0 * error + 0.002 * expected;
        assert!(
            error < 0.03 * expected && (found - expected).abs() < allowed,
            "alpha {alpha}: {found} {expected} {error}"
        );
        if alpha < 0.5 {
            // Few paths return light here, and a pixel that received none has an estimated error of 0.
            continue;
        }
        // Pixels one by one, each with its own noise.
        let deviation = |((walk, slab), error): ((&[f32; 3], &[f32; 3]), &[f32; 3])| (walk[0] - slab[0]) / error[0];
        let pixels = walk.radiance.pixels.iter().zip(&slab.radiance.pixels).zip(&walk.errors.pixels);
        let deviations: Vec<f32> = pixels.filter(|(_, error)| error[0] > 0.0).map(deviation).collect();
        let beyond = deviations.iter().filter(|deviation| deviation.abs() > 4.0).count();
        assert!(deviations.len() > 1000 && (beyond as f64) < 0.03 * deviations.len() as f64, "alpha {alpha}: {beyond}");
    }
}

/// In a white furnace nothing absorbs: all light comes back, through the layer and off the base, whatever alpha.
#[test]
fn the_walk_through_layer_and_base_loses_and_makes_no_light() {
    let table = SheenTable::embedded();
    for (alpha, weight) in [(0.1, 1.0), (0.5, 1.0), (1.0, 0.6)] {
        let mut stage = stage(alpha);
        stage.things.truncate(1);
        let material = &mut stage.things[0].material;
        material.base_color = Vec3::ONE;
        material.sheen = Some(Sheen { weight, ..Sheen::new(Vec3::ONE, alpha) });
        let overrides = MaterialEdits { layering: Some(Layering::Walk), ..MaterialEdits::default() };
        for shadows in [true, false] {
            let edits = Edits { ambient: Some(Vec3::ONE), every_material: overrides, ..Edits::default() };
            let picture = traced(&stage.scene(), &table, &edits, Options { shadows, ..REAL_TIME }, 16);
            let lit: Vec<f32> =
                picture.radiance.pixels.iter().map(|pixel| pixel[1]).filter(|&value| value > 0.0).collect();
            assert!(lit.len() > 1000);
            // Each path brings back what it started with, except for those that are ended at random.
            let mean = lit.iter().map(|&value| f64::from(value)).sum::<f64>() / lit.len() as f64;
            assert!((mean - 1.0).abs() < 1e-3, "alpha {alpha}: {mean}");
        }
    }
}

/// In a closed box whose walls glow and reflect half of what arrives, each bounce adds half of the one before.
#[test]
fn bounces_add_up_to_what_a_closed_box_has() {
    let table = SheenTable::embedded();
    let wall = Material { base_color: Vec3::splat(0.5), ..glow([1.0; 3]) };
    let places = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
    let walls = places.map(|at| Thing::rectangle([1.0, 1.0], wall.clone()).placed(facing(at.to_array(), ORIGIN)));
    let scene = Stage::new(walls.to_vec(), looking([0.1, 0.2, 0.3], [0.5, -0.4, -0.9])).scene();
    for (max_bounces, expected) in [(0, 1.5), (1, 1.75), (4, 2.0 - 0.5_f64.powi(5))] {
        let options = Options { max_bounces, shadows: true, ..REAL_TIME };
        let picture = traced(&scene, &table, &Edits::default(), options, 32);
        assert!((mean(&picture.radiance) / expected - 1.0).abs() < 1e-3, "{max_bounces}: {}", mean(&picture.radiance));
    }
}

/// An open floor receives all of a uniform environment; under a wide roof next to nothing of it arrives.
#[test]
fn the_environment_is_shadowed() {
    let table = SheenTable::embedded();
    let edits = Edits { ambient: Some(Vec3::ONE), ..Edits::default() };
    let grey = Material { base_color: Vec3::splat(0.5), ..plain() };
    let floor = Thing::rectangle([1.5, 1.5], grey.clone()).placed(facing(ORIGIN, UP));
    let open = Stage::new(vec![floor.clone()], looking([0.4, 1.1, 2.6], ORIGIN));
    let options = Options { shadows: true, ..REAL_TIME };
    let picture = traced(&open.scene(), &table, &edits, options, 16);
    let lit = picture.radiance.pixels.iter().map(|pixel| pixel[0]).filter(|&value| value > 0.0);
    assert!(lit.clone().count() > 1000 && lit.clone().all(|value| (value - 0.5).abs() < 1e-6));
    let mut roofed = open;
    let roof = Thing::rectangle([300.0, 300.0], grey).placed(facing([0.0, 3.0, 0.0], ORIGIN));
    roofed.things.push(roof);
    let picture = traced(&roofed.scene(), &table, &edits, options, 64);
    let floor_pixels = &picture.radiance.pixels[96 * 40..];
    let mean = floor_pixels.iter().map(|pixel| f64::from(pixel[0])).sum::<f64>() / floor_pixels.len() as f64;
    assert!(mean < 0.01, "{mean}");
}

/// Microfacets themselves, of a colour for each channel: near their fit, but not equal to it; and they make no light.
#[test]
fn microfacets_are_near_their_fit() {
    let (table, edits) = (SheenTable::embedded(), Edits { lights_visible: Some(false), ..Edits::default() });
    let mut stage = stage(0.5);
    stage.things[0].material = Material { metallic: 1.0, roughness: 0.5, ..velvet([0.0; 3], 0.5) };
    let of = |specular, edits: &Edits| traced(&stage.scene(), &table, edits, Options { specular, ..REAL_TIME }, 64);
    let (fit, facets) = (of(SpecularModel::Ltc, &edits), of(SpecularModel::Ggx, &edits));
    let [near, truth] = [&fit, &facets].map(|picture| mean(&picture.radiance));
    assert!((near / truth - 1.0).abs() < 0.15, "{near} {truth}");
    assert!(differences(&fit.radiance, &facets).is_err());
    // Of a uniform environment about the share that is the base's colour comes back.
    stage.things.truncate(1);
    let furnace = Edits { ambient: Some(Vec3::ONE), ..edits };
    let reference = traced(&stage.scene(), &table, &furnace, Options { specular: SpecularModel::Ggx, ..REAL_TIME }, 16);
    let base = Vec3::new(0.3, 0.6, 0.9);
    let lit = reference.radiance.pixels.iter().filter(|pixel| pixel[0] > 0.0).map(|pixel| Vec3::from(*pixel));
    let fits = |pixel: Vec3| pixel.cmpge(0.9 * base).all() && pixel.cmple(1.01 * base.lerp(Vec3::ONE, 0.3)).all();
    assert!(lit.clone().count() > 1000 && lit.clone().all(fits));
}

/// A ball of few facets beside its light: what is meant to be round casts no shadow on itself, and neither does the
/// light.
#[test]
fn a_round_thing_does_not_shadow_itself_nor_does_its_light() {
    let (table, edits) = (SheenTable::embedded(), Edits::default());
    for columns in [12, 48] {
        for distance in [1.1, 2.0, 5.0] {
            let ball = super::modelling::ball(velvet([0.9, 0.5, 0.2], 0.5), columns);
            let window =
                Thing::rectangle([0.3, 0.3], glow([4.0, 3.0, 2.0])).placed(facing([distance, 0.2, 0.1], ORIGIN));
            let scene = Stage::new(vec![ball, window], looking([2.5, 0.5, 3.5], ORIGIN)).scene();
            let of = |shadows| traced(&scene, &table, &edits, Options { shadows, ..REAL_TIME }, 16);
            let (with, without) = (of(true), of(false));
            let [with, without] = [&with, &without].map(|picture| mean(&picture.radiance));
            assert!((with / without - 1.0).abs() < 0.02, "{columns} columns, {distance} m: {with} {without}");
        }
    }
}

/// Where the shading normal turns away from the view, as at the silhouettes of coarse meshes, the walk scatters as the
/// slab does.
#[test]
fn the_walk_goes_on_where_the_view_is_along_the_surface() {
    let table = SheenTable::embedded();
    let mut stage = stage(0.5);
    // Normals that lean away from the view by more than a right angle.
    stage.things[0].normals = vec![Vec3::new(0.0, 0.9, 0.4).normalize(); 4];
    let scene = stage.scene();
    let of = |model| {
        let edits = with_model(model);
        mean(&traced(&scene, &table, &edits, REAL_TIME, 256).radiance)
    };
    let (walk, slab) = (of(SheenModel::Walk), of(SheenModel::Slab));
    assert!(slab > 1e-5 && (walk / slab - 1.0).abs() < 0.05, "{walk} {slab}");
}
