//! How far real time is from the layer that it stands for: the fit from the slab, and the layering rules from light
//! that goes through both layers. docs/accuracy.md quotes the figures.

use glam::{Mat4, Vec3};
use velour::reference::{Effort, Filter, Options, Picture, Reference, SpecularModel};
use velour::scene::{Drawn, Edits, Layering, Lobes, Material, MaterialEdits, Sheen, SheenModel};
use velour::table::SheenTable;

use super::stage::{Stage, Thing, facing, glow, looking, plain};

const SIZE: [u32; 2] = [48, 48];

/// Of radius 1, smooth.
pub fn ball(material: Material, columns: u32) -> Thing {
    let rows = columns / 2;
    let at = |row: u32, column: u32| {
        let polar = std::f32::consts::PI * row as f32 / rows as f32;
        let azimuth = std::f32::consts::TAU * column as f32 / columns as f32;
        Vec3::new(polar.sin() * azimuth.sin(), polar.cos(), polar.sin() * azimuth.cos())
    };
    let positions: Vec<Vec3> = (0..=rows).flat_map(|row| (0..=columns).map(move |column| at(row, column))).collect();
    let cell = |row: u32, column: u32| {
        let (a, b) = (row * (columns + 1) + column, (row + 1) * (columns + 1) + column);
        [[a, b, b + 1], [a, b + 1, a + 1]]
    };
    Thing {
        normals: positions.clone(),
        positions,
        triangles: (0..rows).flat_map(|row| (0..columns).flat_map(move |column| cell(row, column))).collect(),
        contours: Vec::new(),
        world_from_mesh: Mat4::IDENTITY,
        material,
    }
}

/// A ball under a window, 60 degrees from the view.
fn pictured(base: &Material, alpha: f32, overrides: MaterialEdits, lobes: Lobes, samples: u64) -> Picture {
    let material = Material { sheen: Some(Sheen::new(Vec3::ONE, alpha)), ..base.clone() };
    let window = Thing::rectangle([1.2, 1.2], glow([4.0; 3])).placed(facing([3.46, 0.0, 2.0], [0.0; 3]));
    let scene = Stage::new(vec![ball(material, 64), window], looking([0.0, 0.0, 3.5], [0.0; 3])).scene();
    let edits =
        Edits { every_material: overrides, lobes: Some(lobes), lights_visible: Some(false), ..Edits::default() };
    let options = Options { max_bounces: 0, shadows: false, filter: Filter::Centre, specular: SpecularModel::Ggx };
    let drawn = Drawn::new(&scene, &edits);
    let reference = Reference::new(&drawn, &SheenTable::embedded(), options).unwrap();
    reference.render(&scene.cameras[0], SIZE, Effort { samples, seed: 1 }, |_, _| true).unwrap()
}

/// The mean absolute error and the mean error of the first picture, each over the mean of the second.
fn apart(found: &Picture, truth: &Picture) -> [f64; 2] {
    let (mut off, mut more, mut all) = (0.0, 0.0, 0.0);
    for (found, truth) in found.radiance.pixels.iter().zip(&truth.radiance.pixels) {
        let difference = f64::from(found[1]) - f64::from(truth[1]);
        (off, more, all) = (off + difference.abs(), more + difference, all + f64::from(truth[1]));
    }
    [off / all, more / all]
}

/// The relative mean absolute error of the fit, by alpha.
const FIT: [(f32, f64); 5] = [(0.1, 0.145), (0.25, 0.121), (0.5, 0.041), (0.75, 0.027), (1.0, 0.020)];

#[test]
fn the_fit_is_as_far_from_the_slab_as_is_said() {
    let sheen = Lobes { sheen: true, diffuse: false, specular: false, emission: false };
    let of = |alpha, model| {
        let overrides = MaterialEdits { sheen_model: Some(model), ..MaterialEdits::default() };
        pictured(&plain(), alpha, overrides, sheen, 256)
    };
    let found = FIT.map(|(alpha, _)| apart(&of(alpha, SheenModel::Ltc), &of(alpha, SheenModel::Slab)));
    for ((alpha, _), [off, more]) in FIT.iter().zip(found) {
        println!("alpha {alpha}: {:.1}% of the light is elsewhere, {:+.1}% more", 100.0 * off, 100.0 * more);
    }
    let page = include_str!("../../docs/accuracy.md");
    for ((alpha, said), [off, _]) in FIT.iter().zip(found) {
        // How far noise leaves the figure uncertain.
        assert!((off / said - 1.0).abs() < 0.1, "alpha {alpha}: {off} is not {said}");
        let quoted = format!("alpha {alpha}: {:.1}%", 100.0 * said);
        assert!(page.contains(&quoted), "docs/accuracy.md does not say '{quoted}'");
    }
}

/// What the rules `gltf`, `reciprocal` and `none` change of a picture's total light over a base, at each of three alphas.
const RULES: [(&str, [[f64; 3]; 3]); 3] = [
    ("grey 0.5, diffuse", [[0.011, 0.064, 0.128], [-0.010, -0.006, 0.082], [0.04, 0.20, 0.49]]),
    ("white 0.9, diffuse", [[0.002, 0.024, 0.051], [-0.019, -0.050, -0.009], [0.03, 0.16, 0.51]]),
    ("metal 0.9, roughness 0.5", [[0.066, 0.033, 0.028], [0.059, -0.002, -0.004], [0.08, 0.12, 0.42]]),
];

/// A row of the table on the page; the last rule's figures are whole per cents.
fn row(base: &str, rules: &[[f64; 3]; 3]) -> String {
    let percents =
        |figures: &[f64; 3], digits| figures.map(|figure| format!("{:+.digits$}%", 100.0 * figure)).join(", ");
    let [gltf, reciprocal, none] = rules;
    let cells = [percents(gltf, 1), percents(reciprocal, 1), percents(none, 0)];
    format!("| {base} | 0.25, 0.5, 1 | {} |", cells.join(" | "))
}

#[test]
fn layering_rules_are_as_far_from_the_walk_as_is_said() {
    let grey = Material { base_color: Vec3::splat(0.5), ..plain() };
    let white = Material { base_color: Vec3::splat(0.9), ..plain() };
    let metal = Material { metallic: 1.0, roughness: 0.5, base_color: Vec3::splat(0.9), ..plain() };
    let page = include_str!("../../docs/accuracy.md");
    let mut wrong = Vec::new();
    for ((name, said), base) in RULES.iter().zip([grey, white, metal]) {
        let row = row(name, said);
        assert!(page.contains(&row), "docs/accuracy.md does not say '{row}'");
        for (column, alpha) in [0.25, 0.5, 1.0].into_iter().enumerate() {
            let of = |layering, samples| {
                let overrides = MaterialEdits {
                    sheen_model: Some(SheenModel::Slab),
                    layering: Some(layering),
                    ..MaterialEdits::default()
                };
                pictured(&base, alpha, overrides, Lobes::default(), samples)
            };
            let truth = of(Layering::Walk, 2048);
            let rules = [Layering::Gltf, Layering::Reciprocal, Layering::None, Layering::OpenPbr];
            let [gltf, reciprocal, none, openpbr] = rules.map(|rule| apart(&of(rule, 256), &truth)[1]);
            println!("{name}, alpha {alpha}: gltf {gltf:+.4}, reciprocal {reciprocal:+.4}, none {none:+.4}");
            // With one colour and full weight the rules are the same.
            assert!((gltf - openpbr).abs() < 1e-3, "{gltf} {openpbr}");
            // Half of the last digit that is quoted, and as much again for sines that differ between machines.
            for ((found, said), allowed) in [gltf, reciprocal, none].into_iter().zip(said).zip([1e-3, 1e-3, 1e-2]) {
                let said = said[column];
                if (found - said).abs() > allowed {
                    wrong.push(format!("{name}, alpha {alpha}: {found:+.4} is not {said}"));
                }
            }
            assert!(reciprocal < none && gltf < none, "{name}, alpha {alpha}: {gltf} {reciprocal} {none}");
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
