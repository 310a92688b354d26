//! The base under the sheen: specular and diffuse, and how they are layered.

use glam::Vec3;
use velour::scene::{Edits, Layering, Lobes, Material, MaterialEdits, Projection, RoughnessMap, Sheen};
use velour::table::SheenTable;

use super::compare::{SIZE, hold, linear};
use super::stage::{Stage, Thing, facing, glow, looking, plain, velvet};
use super::truth::Truth;

const UP: [f32; 3] = [0.0, 1.0, 0.0];
const ORIGIN: [f32; 3] = [0.0; 3];

/// A dielectric or metal, with a sheen on it or not.
fn coated(metallic: f32, roughness: f32, sheen: Option<Sheen>) -> Material {
    let base_color = Vec3::new(0.8, 0.5, 0.3);
    Material {
        base_color,
        metallic,
        roughness,
        specular: 0.9,
        specular_color: Vec3::new(1.0, 0.8, 0.9),
        sheen,
        ..plain()
    }
}

fn fuzz() -> Option<Sheen> {
    Some(Sheen { weight: 0.8, ..Sheen::new(Vec3::new(0.9, 0.6, 0.4), 0.4) })
}

/// A floor of this material under a window.
fn stage(material: Material) -> Stage {
    let floor = Thing::rectangle([1.5, 1.5], material).placed(facing(ORIGIN, UP));
    let window = Thing::rectangle([0.6, 0.4], glow([4.0, 3.0, 2.0])).placed(facing([0.7, 0.8, -1.3], ORIGIN));
    Stage::new(vec![floor, window], looking([0.2, 0.9, 2.4], ORIGIN))
}

/// All lobes, but no emission.
fn reflected() -> Edits {
    let lobes = Lobes { emission: false, ..Lobes::default() };
    Edits { lobes: Some(lobes), lights_visible: Some(false), ..Edits::default() }
}

fn layered(layering: Layering) -> Edits {
    Edits { every_material: MaterialEdits { layering: Some(layering), ..MaterialEdits::default() }, ..reflected() }
}

#[test]
fn metals_and_dielectrics_shine_at_any_roughness() {
    let specular = Lobes { sheen: false, diffuse: false, specular: true, emission: false };
    for (metallic, roughness) in [(1.0, 0.1), (1.0, 0.4), (0.0, 0.3), (0.5, 0.7), (1.0, 1.0)] {
        hold(&stage(coated(metallic, roughness, None)), &Edits { lobes: Some(specular), ..reflected() });
        hold(&stage(coated(metallic, roughness, None)), &reflected());
    }
}

#[test]
fn an_index_of_refraction_is_fresnels() {
    for ior in [1.0, 1.33, 2.4, 0.0] {
        hold(&stage(Material { ior, ..coated(0.0, 0.4, None) }), &reflected());
    }
}

#[test]
fn the_sheen_takes_from_the_base_by_the_rule_that_is_named() {
    for layering in [Layering::Gltf, Layering::OpenPbr, Layering::Manual(0.37), Layering::None] {
        hold(&stage(coated(0.3, 0.5, fuzz())), &layered(layering));
    }
}

#[test]
fn the_roughness_is_mapped_as_asked() {
    for map in [RoughnessMap::Square, RoughnessMap::Sqrt] {
        let overrides = MaterialEdits { roughness_map: Some(map), ..MaterialEdits::default() };
        hold(&stage(velvet([0.9, 0.5, 0.2], 0.4)), &Edits { every_material: overrides, ..reflected() });
    }
}

#[test]
fn a_uniform_environment_is_exact() {
    let ambient = Vec3::new(0.5, 1.0, 2.0);
    for layering in [Layering::Gltf, Layering::OpenPbr, Layering::Manual(0.37), Layering::None] {
        hold(&stage(coated(0.3, 0.5, fuzz())), &Edits { ambient: Some(ambient), ..layered(layering) });
    }
}

/// Radiance of a floor in strips of these materials, under a ceiling of radiance 1 that covers the hemisphere.
fn furnace(materials: Vec<Material>, edits: &Edits) -> Vec<Vec3> {
    let count = materials.len();
    let mut things: Vec<Thing> = Vec::new();
    for (index, material) in materials.into_iter().enumerate() {
        let x = (index as f32 + 0.5) / count as f32 * 4.0 - 2.0;
        things
            .push(Thing::rectangle([2.0 / count as f32, 50.0], material).placed(facing([x, 0.0, 0.0], [x, 1.0, 0.0])));
    }
    things.push(Thing::rectangle([1e4, 1e4], glow([1.0; 3])).placed(facing([0.0, 1.0, 0.0], ORIGIN)));
    let mut stage = Stage::new(things, looking([0.0, 0.9, 0.0], [0.0, 0.0, -1.2]));
    stage.projection = Projection::Perspective { yfov: 2.2, near: 0.01, far: 1e3 };
    let picture = linear(&stage.scene(), &SheenTable::embedded(), edits, [64, 96]);
    picture.pixels.into_iter().map(Vec3::from).collect()
}

#[test]
fn no_rule_gains_energy_in_a_furnace() {
    let edits = |layering| {
        let lobes = Lobes { emission: false, ..Lobes::default() };
        Edits { lobes: Some(lobes), lights_visible: Some(false), ..layered(layering) }
    };
    let white = |metallic: f32, roughness: f32, alpha: f32, color: f32, weight: f32| Material {
        base_color: Vec3::ONE,
        metallic,
        roughness,
        specular: 1.0,
        sheen: Some(Sheen { weight, ..Sheen::new(Vec3::splat(color), alpha) }),
        ..plain()
    };
    for layering in [Layering::Gltf, Layering::OpenPbr, Layering::Reciprocal] {
        for alpha in [0.0, 0.05, 0.1, 0.3, 0.6, 1.0] {
            for (color, weight) in [(1.0, 1.0), (0.5, 1.0), (1.0, 0.6), (0.2, 0.9)] {
                let roughnesses = [0.0, 0.1, 0.25, 0.5, 0.75, 1.0];
                let materials =
                    roughnesses.iter().flat_map(|&r| [0.0, 0.5, 1.0].map(|m| white(m, r, alpha, color, weight)));
                let pixels = furnace(materials.collect(), &edits(layering));
                let greatest = pixels.iter().map(|pixel| pixel.max_element()).fold(0.0, f32::max);
                assert!(greatest <= 1.01, "{layering:?}: {greatest} at alpha {alpha}, C {color}, weight {weight}");
                assert!(greatest > 0.5 && pixels.iter().all(|pixel| pixel.is_finite()), "{greatest}");
            }
        }
    }
    // The ruler itself: without a rule there is a gain.
    let pixels = furnace(vec![white(0.0, 0.5, 0.5, 1.0, 1.0); 3], &edits(Layering::None));
    assert!(pixels.iter().map(|pixel| pixel.max_element()).fold(0.0, f32::max) > 1.2);
}

/// The reciprocal rule takes the light's side at one cosine for each light: against the integral over the light.
#[test]
fn the_reciprocal_rule_is_near_the_integral_over_the_light() {
    let (table, edits) = (SheenTable::embedded(), layered(Layering::Reciprocal));
    let mut worst = 0.0_f64;
    for roughness in [0.15, 0.3, 0.6, 1.0] {
        let sheen = Some(Sheen::new(Vec3::ONE, roughness));
        let material = Material { base_color: Vec3::ONE, sheen, ..plain() };
        let lobes = Lobes { sheen: false, diffuse: true, specular: false, emission: false };
        let edits = Edits { lobes: Some(lobes), ..edits.clone() };
        // A window, a ceiling, and a wall that reaches below the horizon.
        let lights = [
            ([0.6, 0.4], facing([0.7, 0.8, -1.3], ORIGIN)),
            ([2.0, 2.0], facing([0.0, 0.9, 0.0], ORIGIN)),
            ([1.5, 0.7], facing([0.0, 0.2, -1.6], [0.0, 0.2, 0.0])),
        ];
        for (half, place) in lights {
            let floor = Thing::rectangle([1.5, 1.5], material.clone()).placed(facing(ORIGIN, UP));
            let light = Thing::rectangle(half, glow([4.0, 3.0, 2.0])).placed(place);
            let stage = Stage::new(vec![floor, light], looking([0.2, 0.5, 2.4], ORIGIN));
            let picture = linear(&stage.scene(), &table, &edits, SIZE);
            let truth = Truth::new(&stage, &table, &edits, SIZE);
            for (index, pixel) in picture.pixels.iter().enumerate() {
                let center = [index as u32 % SIZE[0], index as u32 / SIZE[0]].map(|at| f64::from(at) + 0.5);
                // Not at the floor's edges, which drivers shift.
                let inside = [[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]]
                    .iter()
                    .all(|[x, y]| truth.at([center[0] + x, center[1] + y]).is_some());
                if let Some(hit) = truth.at(center).filter(|hit| inside && hit.radiance.x > 1e-2) {
                    worst = worst.max((f64::from(pixel[0]) / hit.radiance.x - 1.0).abs());
                }
            }
        }
    }
    println!("reciprocal: within {worst:.3} of the integral");
    assert!(worst < 0.12, "{worst}");
    assert!(worst > 1e-4, "an approximation is no integral: nothing was tested");
}
