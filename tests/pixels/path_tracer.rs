//! The path tracer of `examples/` against what is known in closed form, and against the reference renderer.

#[path = "../../examples/path_tracer/bvh.rs"]
mod bvh;
#[path = "../../examples/path_tracer/scene.rs"]
mod scene;
#[path = "../../examples/path_tracer/tracer.rs"]
mod tracer;

use glam::{DVec3, Vec3};
use statrs::distribution::{ContinuousCDF, StudentsT};
use velour::models::Schlick;
use velour::picture::LinearImage;
use velour::reference::{Effort, Filter, Options, Reference, SpecularModel};
use velour::scene::assets::DUST;
use velour::scene::{AlphaMode, Drawn, Edits, Layering, Material, PunctualKind, PunctualLight, Scene, Sheen, gltf};
use velour::table::{GgxTable, SheenTable};

use super::compare::GPU;
use super::stage::{Stage, Thing, facing, glow, looking, plain, velvet};
use scene::TracedScene;
use tracer::{SOURCE, Settings, Tracer};

const SIZE: [u32; 2] = [48, 36];
/// Pixels along a block's side: the means of blocks are compared.
const BLOCK: usize = 6;
/// Independent batches, from whose scatter errors are estimated.
const BATCHES: u32 = 32;
/// The probability that a right picture is rejected, for one seed; seeds are fixed.
const SIGNIFICANCE: f64 = 1e-3;

/// A mean and its standard error.
#[derive(Clone, Copy)]
struct Estimate {
    mean: f64,
    error: f64,
}

/// The pixels of each block, and those of the whole picture.
fn regions() -> Vec<Vec<usize>> {
    let [width, height] = SIZE.map(|side| side as usize);
    let across = width / BLOCK;
    let mut regions = vec![Vec::new(); across * (height / BLOCK)];
    (0..width * height).for_each(|at| regions[at / width / BLOCK * across + at % width / BLOCK].push(at));
    regions.push((0..width * height).collect());
    regions
}

/// Each region's mean in each channel, of so many samples a pixel in each batch.
fn traced(scene: &Scene, max_bounces: u32, samples: u32, source: &str) -> Vec<Estimate> {
    let scene = TracedScene::new(&Drawn::new(scene, &Edits::default())).unwrap();
    let settings = Settings { size: SIZE, max_bounces, seed: 7 };
    let mut tracer = Tracer::new(&GPU, &scene, source, settings).unwrap();
    let mut before = vec![DVec3::ZERO; (SIZE[0] * SIZE[1]) as usize];
    let mut batches = Vec::new();
    for batch in 1..=BATCHES {
        tracer.add(samples, |_| ());
        let picture = tracer.picture();
        let sums: Vec<DVec3> =
            picture.pixels.iter().map(|pixel| f64::from(batch) * Vec3::from(*pixel).as_dvec3()).collect();
        batches.push(sums.iter().zip(&before).map(|(sum, before)| *sum - *before).collect::<Vec<DVec3>>());
        before = sums;
    }
    let count = f64::from(BATCHES);
    let estimate = |region: &Vec<usize>, channel: usize| {
        let mean = |batch: &Vec<DVec3>| region.iter().map(|&at| batch[at][channel]).sum::<f64>() / region.len() as f64;
        let means: Vec<f64> = batches.iter().map(mean).collect();
        let mean = means.iter().sum::<f64>() / count;
        let variance = means.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (count - 1.0);
        Estimate { mean, error: (variance / count).sqrt() }
    };
    regions().iter().flat_map(|region| [0, 1, 2].map(|channel| estimate(region, channel))).collect()
}

/// The same of a picture and each pixel's standard error.
fn pooled(radiance: &LinearImage, errors: &LinearImage) -> Vec<Estimate> {
    let estimate = |region: &Vec<usize>, channel: usize| {
        let count = region.len() as f64;
        let values = |image: &LinearImage| -> Vec<f64> {
            region.iter().map(|&at| f64::from(image.pixels[at][channel])).collect()
        };
        let error = values(errors).iter().map(|error| error * error).sum::<f64>().sqrt() / count;
        Estimate { mean: values(radiance).iter().sum::<f64>() / count, error }
    };
    regions().iter().flat_map(|region| [0, 1, 2].map(|channel| estimate(region, channel))).collect()
}

fn referenced(scene: &Scene, max_bounces: u32, samples: u64) -> Vec<Estimate> {
    let (drawn, table) = (Drawn::new(scene, &Edits::default()), SheenTable::embedded());
    let options = Options { max_bounces, shadows: true, filter: Filter::Box, specular: SpecularModel::Ltc };
    let reference = Reference::new(&drawn, &table, options).unwrap();
    let picture = reference.render(&scene.cameras[0], SIZE, Effort { samples, seed: 1 }, |_, _| true).unwrap();
    pooled(&picture.radiance, &picture.errors)
}

/// Holds the means of all regions to those expected, by a t-test: with as many degrees of freedom as the tracer's batches
/// give, which are no more than there are, and shared by all regions and channels (Bonferroni). Rounding in f32, of the points
/// from which rays start too, may add `rounding` of each value.
fn differences(found: &[Estimate], expected: &[Estimate], rounding: f64) -> Result<f64, String> {
    let student = StudentsT::new(0.0, 1.0, f64::from(BATCHES - 1)).unwrap();
    let most = student.inverse_cdf(1.0 - 0.5 * SIGNIFICANCE / found.len() as f64);
    let mut worst = 0.0_f64;
    for (index, (found, expected)) in found.iter().zip(expected).enumerate() {
        let error = found.error.hypot(expected.error).hypot(rounding * expected.mean);
        let off = (found.mean - expected.mean).abs() / error;
        let (region, channel) = (index / 3, index % 3);
        if found.mean != expected.mean && (off > most || off.is_nan()) {
            let Estimate { mean, error } = *found;
            return Err(format!(
                "region {region}, channel {channel}: {mean} +- {error}, not {} +- {}: {off} errors apart, of {most}",
                expected.mean, expected.error,
            ));
        }
        worst = worst.max(if error > 0.0 { off } else { 0.0 });
    }
    Ok(worst)
}

const UP: [f32; 3] = [0.0, 1.0, 0.0];
const ORIGIN: [f32; 3] = [0.0; 3];
/// What f32 rounds in flat scenes a metre large.
const ROUNDING: f64 = 1e-4;

/// A room of glowing walls of this material, with half sides of a metre; the camera sees one wall, face on from 1.3 m.
fn furnace(material: &Material) -> Stage {
    let directions = [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], UP, [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    let wall = |at: [f32; 3]| Thing::rectangle([1.0, 1.0], material.clone()).placed(facing(at, ORIGIN));
    Stage::new(directions.map(wall).to_vec(), looking([0.05, -0.02, 0.3], [0.05, -0.02, -1.0]))
}

fn loaded(stage: &Stage) -> Scene {
    gltf::from_slice(&stage.glb(), "stage.glb", &gltf::Options::default()).unwrap()
}

/// The mean over each pixel of what a wall shows that is seen at a cosine, from the camera's field of view alone.
fn over_wall(radiance: impl Fn(f64) -> DVec3) -> Vec<Estimate> {
    const STEPS: u32 = 8;
    let [width, height] = SIZE.map(f64::from);
    let extent = f64::from(0.8_f32 / 2.0).tan();
    let at = |pixel: u32, step: u32| f64::from(pixel) + (f64::from(step) + 0.5) / f64::from(STEPS);
    let pixel = |pixel: u32| {
        let mut sum = DVec3::ZERO;
        for step in 0..STEPS * STEPS {
            let (x, y) = (at(pixel % SIZE[0], step % STEPS), at(pixel / SIZE[0], step / STEPS));
            let toward = extent * DVec3::new(2.0 * x - width, height - 2.0 * y, 0.0) / height - DVec3::Z;
            sum += radiance(1.0 / toward.length());
        }
        (sum / f64::from(STEPS * STEPS)).as_vec3().to_array()
    };
    let picture = |pixels| LinearImage { width: SIZE[0], height: SIZE[1], pixels };
    let black = picture(vec![[0.0; 3]; (SIZE[0] * SIZE[1]) as usize]);
    pooled(&picture((0..SIZE[0] * SIZE[1]).map(pixel).collect()), &black)
}

/// Walls that reflect a share R of light evenly and emit E show E (1 + R + ... + R^(n + 1)) after n bounces.
#[test]
fn a_furnace_fills_with_light_bounce_by_bounce() {
    let (emission, share) = (Vec3::new(0.5, 1.0, 2.0), Vec3::new(0.5, 0.4, 0.2));
    let scene = loaded(&furnace(&Material { base_color: share, emission, ..plain() }));
    for bounces in [0, 4] {
        let sum = (0..=bounces as i32 + 1).map(|power| share.as_dvec3().powf(power.into())).sum::<DVec3>();
        let expected = over_wall(|_| emission.as_dvec3() * sum);
        let found = traced(&scene, bounces, 2, SOURCE);
        let worst = differences(&found, &expected, ROUNDING).unwrap_or_else(|said| panic!("{bounces}: {said}"));
        println!("{bounces} bounces: {worst} errors apart at most");
        assert!(differences(&found, &over_wall(|_| 1.005 * emission.as_dvec3() * sum), ROUNDING).is_err());
    }
}

/// The specular lobe as bright as without a sheen on top.
const UNWEAKENED: (&str, &str) = ("Lobe(ggx.m_inv, below_sheen * specular)", "Lobe(ggx.m_inv, specular)");

/// Under light from everywhere a surface shows the albedos of its layers, which the tables give.
#[test]
fn a_furnace_shows_the_albedo_of_all_layers() {
    let (color, weight, alpha, roughness) = (Vec3::new(0.9, 0.5, 0.2), 0.7, 0.9, 0.4);
    let base = Material { specular: 0.8, roughness, metallic: 0.25, ..velvet(color.to_array(), alpha) };
    let emission = Vec3::splat(1.0);
    let scene = loaded(&furnace(&Material { emission, ..base.clone() }));
    let (sheen_table, ggx_table) = (SheenTable::embedded(), GgxTable::embedded());
    let albedo = |mu: f64, weight: f64| {
        let sheen = sheen_table.lookup(alpha.into(), mu)[2];
        let ggx = ggx_table.lookup(roughness.into(), mu);
        let (own, metallic) = (base.base_color.as_dvec3(), f64::from(base.metallic));
        let (f0, f90) = (DVec3::splat(0.04 * 0.8), 0.8);
        let specular = |f0: DVec3, f90: f64| {
            DVec3::from(Schlick::channels(f0, DVec3::splat(f90)).map(|schlick| schlick.albedo(ggx.albedo, ggx.fresnel)))
        };
        let diffuse = own * (1.0 - metallic) * (1.0 - specular(f0, f90).max_element());
        let below = diffuse + specular(f0.lerp(own, metallic), f90 + (1.0 - f90) * metallic);
        let color = weight * color.as_dvec3();
        color * sheen + (1.0 - color.max_element() * sheen) * below
    };
    let found = traced(&scene, 0, 4, SOURCE);
    let worst = differences(&found, &over_wall(|mu| 1.0 + albedo(mu, 1.0)), ROUNDING).unwrap();
    println!("{worst} errors apart at most");
    assert!(differences(&found, &over_wall(|mu| 1.0 + albedo(mu, weight)), ROUNDING).is_err());
    assert_eq!(SOURCE.matches(UNWEAKENED.0).count(), 1);
    let found = traced(&scene, 0, 4, &SOURCE.replace(UNWEAKENED.0, UNWEAKENED.1));
    assert!(differences(&found, &over_wall(|mu| 1.0 + albedo(mu, 1.0)), ROUNDING).is_err());
}

/// Velvet, a coloured metal, a lacquer and a two-sided lamp among others: lights of very different sizes and distances.
fn room() -> Scene {
    let lacquer = Material { base_color: Vec3::new(0.2, 0.5, 0.3), specular: 1.0, roughness: 0.25, ..plain() };
    let gold = Material { base_color: Vec3::new(0.9, 0.6, 0.2), metallic: 1.0, roughness: 0.35, ..lacquer.clone() };
    let curtain = Material { double_sided: true, ..velvet([0.9, 0.3, 0.4], 0.35) };
    let screen = Material { double_sided: true, ..glow([1.0, 2.0, 3.0]) };
    let thing = |half, material, at, target| Thing::rectangle(half, material).placed(facing(at, target));
    let things = vec![
        thing([1.5, 1.5], Material { base_color: Vec3::splat(0.02), ..velvet([0.9, 0.8, 0.9], 0.5) }, ORIGIN, UP),
        thing([1.5, 0.8], gold, [0.0, 0.8, -1.2], [0.0, 0.8, 0.0]),
        thing([0.4, 0.4], lacquer, [0.9, 0.4, -0.4], [0.0, 0.5, 1.0]),
        thing([0.3, 0.4], curtain, [-0.6, 0.45, 0.0], [0.6, 0.6, 1.0]),
        thing([0.4, 0.4], glow([6.0, 5.0, 4.0]), [-0.8, 1.8, 0.9], ORIGIN),
        thing([0.15, 0.1], screen, [0.1, 0.25, 0.1], [1.0, 0.3, 0.4]),
    ];
    loaded(&Stage::new(things, looking([0.3, 0.5, 2.6], [0.0, 0.3, 0.0])))
}

/// Velvet alone, seen at a slant, under a lamp low behind the eye: light goes back where it came from.
fn velvet_alone() -> Scene {
    let floor = Material { base_color: Vec3::ZERO, ..velvet([0.9, 0.8, 0.7], 0.4) };
    let floor = Thing::rectangle([1.5, 1.5], floor).placed(facing(ORIGIN, UP));
    let lamp = Thing::rectangle([1.0, 0.4], glow([4.0, 4.0, 4.0])).placed(facing([0.0, 0.8, 3.5], ORIGIN));
    loaded(&Stage::new(vec![floor, lamp], looking([0.0, 0.7, 2.2], ORIGIN)))
}

/// The sign of b in the sheen's density alone.
const MIRRORED: (&str, &str) =
    ("ltc_density(lobes.sheen.m_inv, wo)", "ltc_density(lobes.sheen.m_inv, wo * vec3f(-1.0, 1.0, 1.0))");

#[test]
fn the_sheen_leans_towards_the_eye() {
    let scene = velvet_alone();
    let expected = referenced(&scene, 0, 64);
    let worst = differences(&traced(&scene, 0, 2, SOURCE), &expected, ROUNDING).unwrap();
    println!("{worst} errors apart at most");
    assert_eq!(SOURCE.matches(MIRRORED.0).count(), 1);
    let mirrored = traced(&scene, 0, 2, &SOURCE.replace(MIRRORED.0, MIRRORED.1));
    println!("{}", differences(&mirrored, &expected, ROUNDING).unwrap_err());
}

/// Mistakes of the kind that pictures do not show at first sight: what to replace in the shader, and by what.
const MISTAKES: [(&str, &str); 3] = [
    // The other strategy's density missing from a weight.
    ("/ (pdf + scattered.pdf);", "/ pdf;"),
    ("scattered.pdf / (scattered.pdf + light_pdf(surface.emission, hit.distance, cosine))", "1.0"),
    // A light's density that forgets the cosine.
    ("max(cosine, 1e-10)", "1.0"),
];

#[test]
fn it_converges_to_the_reference_and_mistakes_do_not() {
    let scene = room();
    let expected = referenced(&scene, 3, 256);
    let found = traced(&scene, 3, 8, SOURCE);
    let worst = differences(&found, &expected, ROUNDING).unwrap();
    let [whole, known] = [&found, &expected].map(|all| all[all.len() - 2]);
    let relative = [whole.mean - known.mean, whole.error, known.error].map(|value| value / known.mean);
    println!("{worst} errors apart at most; the mean by {relative:?} of itself, with the errors of both");
    for (right, wrong) in MISTAKES {
        assert_eq!(SOURCE.matches(right).count(), 1, "{right}");
        let found = traced(&scene, 3, 2, &SOURCE.replace(right, wrong));
        let said = differences(&found, &expected, ROUNDING).expect_err(right);
        println!("{wrong}: {said}");
    }
}

/// Smooth normals, 50,000 triangles, shadows: as `velour reference` draws a file of ours.
#[test]
fn a_scene_from_a_file_converges_too() {
    let scene = DUST.load().unwrap();
    let worst = differences(&traced(&scene, 2, 2, SOURCE), &referenced(&scene, 2, 128), 1e-3).unwrap();
    println!("{worst} errors apart at most");
}

/// What makes a scene one that is not drawn.
type Change<'a> = &'a dyn Fn(&mut Scene);

/// What it does not draw it refuses, with a word for it.
#[test]
fn nothing_is_drawn_wrong_in_silence() {
    let refused = |change: &dyn Fn(&mut Scene)| {
        let mut scene = room();
        change(&mut scene);
        TracedScene::new(&Drawn::new(&scene, &Edits::default())).err().unwrap_or_default()
    };
    assert_eq!(refused(&|_| ()), "");
    let fuzz = Sheen { layering: Layering::OpenPbr, ..Sheen::new(Vec3::ONE, 0.5) };
    let lamp = PunctualLight {
        name: String::new(),
        kind: PunctualKind::Directional,
        intensity: Vec3::ONE,
        position: Vec3::ZERO,
        direction: Vec3::NEG_Y,
    };
    let cases: [(&str, Change<'_>); 6] = [
        ("opacity", &|scene| scene.materials[0].alpha_mode = AlphaMode::Blend),
        ("unlit", &|scene| scene.materials[1].unlit = true),
        ("layering", &|scene| scene.materials[1].sheen = Some(fuzz)),
        ("vertex colours", &|scene| scene.meshes[0].colors = vec![[0; 4]; scene.meshes[0].positions.len()]),
        ("without extent", &|scene| scene.punctual_lights.push(lamp.clone())),
        ("shines", &|scene| {
            scene.lights.clear();
            scene.materials.iter_mut().for_each(|material| material.emission = Vec3::ZERO);
        }),
    ];
    for (word, change) in cases {
        let said = refused(change);
        assert!(said.contains(word) && !said.contains('\n'), "{word}: {said}");
    }
}
