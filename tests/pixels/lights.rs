//! Lights of all kinds: many, without extent, and those that are skipped.

use glam::Vec3;
use velour::scene::{Edits, Light, LightEdits, Material, Projection, PunctualKind, PunctualLight};
use velour::table::SheenTable;

use super::compare::{GPU, SIZE, differences, hold, linear, sheen_alone};
use super::run::unshadowed;
use super::stage::{Stage, Thing, facing, glow, looking, velvet};
use super::truth::Truth;

const UP: [f32; 3] = [0.0, 1.0, 0.0];
const ORIGIN: [f32; 3] = [0.0; 3];

fn cloth() -> Material {
    Material { specular: 1.0, roughness: 0.5, ..velvet([0.9, 0.5, 0.2], 0.4) }
}

fn floor() -> Thing {
    Thing::rectangle([1.5, 1.5], cloth()).placed(facing(ORIGIN, UP))
}

fn unseen() -> Edits {
    Edits { lights_visible: Some(false), ..Edits::default() }
}

#[test]
fn lights_without_extent_shine_through_the_same_lobes() {
    let light = |kind| PunctualLight {
        name: String::new(),
        kind,
        intensity: Vec3::new(3.0, 2.0, 1.0),
        position: Vec3::new(0.5, 1.0, -0.6),
        direction: Vec3::new(-0.3, -0.9, 0.3).normalize(),
    };
    for kind in [
        PunctualKind::Point { range: f32::INFINITY },
        PunctualKind::Point { range: 1.8 },
        PunctualKind::Spot { range: f32::INFINITY, inner: 0.3, outer: 0.6 },
        PunctualKind::Spot { range: 3.0, inner: 0.0, outer: 0.8 },
        PunctualKind::Directional,
    ] {
        let mut stage = Stage::new(vec![floor()], looking([0.4, 1.1, 2.6], ORIGIN));
        stage.punctual.push(light(kind));
        let (table, edits) = (SheenTable::embedded(), unseen());
        let picture = linear(&stage.scene(), &table, &edits, SIZE);
        differences(&picture, &Truth::new(&stage, &table, &edits, SIZE))
            .unwrap_or_else(|said| panic!("{kind:?}: {said}"));
    }
}

/// A ring of small panels about the floor, some of them turned away, some below it.
fn panels(count: usize) -> Vec<Thing> {
    let panel = |k: usize| {
        let angle = k as f32 * 2.4;
        let eye = [1.7 * angle.cos(), 0.9 - 1.5 * k as f32 / count as f32, 1.7 * angle.sin()];
        let target = if k.is_multiple_of(3) { eye.map(|at| 2.0 * at) } else { ORIGIN };
        let color = [1.0 + (k % 5) as f32, 1.0 + (k % 3) as f32, 2.0].map(|radiance| 8.0 * radiance / count as f32);
        let mut panel = Thing::rectangle([0.2, 0.1], glow(color)).placed(facing(eye, target));
        panel.material.double_sided = k.is_multiple_of(7);
        panel
    };
    (0..count).map(panel).collect()
}

#[test]
fn hundreds_of_lights_add_up_and_none_is_skipped_that_shines() {
    for count in [16, 256] {
        let things = [vec![floor()], panels(count)].concat();
        hold(&Stage::new(things, looking([0.4, 1.1, 2.6], ORIGIN)), &sheen_alone());
    }
}

#[test]
fn moved_added_and_dimmed_lights_are_as_new_ones() {
    use velour::renderer::Offscreen;
    let stage = |count: usize| {
        let things = [vec![floor()], panels(count)].concat();
        Stage::new(things, looking([0.4, 1.1, 2.6], ORIGIN)).scene()
    };
    let table = SheenTable::embedded();
    let mut scene = stage(12);
    let mut offscreen = Offscreen::for_linear(&GPU, 1, &table, &unshadowed(&scene, &unseen())).unwrap();
    let picture = |offscreen: &mut Offscreen, scene: &velour::scene::Scene| {
        GPU.block_on(offscreen.linear(&GPU, &scene.cameras[0], SIZE, &unseen().settings())).unwrap()
    };
    let before = picture(&mut offscreen, &scene);
    let moved = |light: &Light| LightEdits {
        position: Some(light.position() + Vec3::new(0.1, 0.2, -0.1)),
        strength: Some(0.5),
        ..LightEdits::default()
    };
    let lights = scene.lights.iter().map(moved).enumerate().collect();
    let edits = Edits { lights, ..unseen() };
    scene.punctual_lights.push(PunctualLight {
        name: String::new(),
        kind: PunctualKind::Directional,
        intensity: Vec3::ONE,
        position: Vec3::ZERO,
        direction: Vec3::NEG_Y,
    });
    offscreen.update(&GPU, &unshadowed(&scene, &edits)).unwrap();
    let after = picture(&mut offscreen, &scene);
    assert_ne!(before, after);
    let mut anew = Offscreen::for_linear(&GPU, 1, &table, &unshadowed(&scene, &edits)).unwrap();
    assert_eq!(after, picture(&mut anew, &scene));
}

#[test]
fn lights_at_the_very_point_that_they_light_give_numbers() {
    let mut stage = Stage::new(vec![floor()], looking([0.0, 3.0, 0.0], ORIGIN));
    stage.things[0].material.roughness = 0.0;
    stage.projection = Projection::Orthographic { ymag: 1.0, near: 0.1, far: 10.0 };
    for (x, z) in (0..64).flat_map(|x| (0..64).map(move |z| (x, z))).filter(|(x, z)| x % 8 == 0 && z % 8 == 0) {
        stage.punctual.push(PunctualLight {
            name: String::new(),
            kind: PunctualKind::Point { range: f32::INFINITY },
            intensity: Vec3::splat(1e-4),
            position: Vec3::new((x as f32 + 0.5) / 32.0 - 1.0, 0.0, (z as f32 + 0.5) / 32.0 - 1.0),
            direction: Vec3::NEG_Y,
        });
    }
    let picture = linear(&stage.scene(), &SheenTable::embedded(), &unseen(), [64, 64]);
    assert!(picture.pixels.iter().flatten().all(|channel| channel.is_finite() && *channel >= 0.0));
}
