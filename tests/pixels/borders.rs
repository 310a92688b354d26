//! Bounds on which pictures stand, from both sides: what lies a little within is drawn in full.

use glam::Vec3;
use velour::scene::{Edits, Layering, Lobes, Material, MaterialEdits, Projection, PunctualKind, PunctualLight, Sheen};
use velour::table::SheenTable;

use super::compare::{SIZE, differences, hold, linear};
use super::stage::{Stage, Thing, facing, glow, looking, plain, velvet};
use super::truth::Truth;

const UP: [f32; 3] = [0.0, 1.0, 0.0];
const ORIGIN: [f32; 3] = [0.0; 3];
/// Of a picture with a pixel in its very middle.
const ODD: [u32; 2] = [65, 65];

fn diffuse_alone() -> Edits {
    let lobes = Lobes { sheen: false, diffuse: true, specular: false, emission: false };
    Edits { lobes: Some(lobes), lights_visible: Some(false), ..Edits::default() }
}

fn point_light(position: Vec3) -> PunctualLight {
    PunctualLight {
        name: String::new(),
        kind: PunctualKind::Point { range: f32::INFINITY },
        intensity: Vec3::ONE,
        position,
        direction: Vec3::NEG_Y,
    }
}

/// Red of the pixel in the middle, seen from straight above.
fn middle(stage: Stage, edits: &Edits) -> f32 {
    let projection = Projection::Orthographic { ymag: 0.1, near: 0.1, far: 10.0 };
    let stage = Stage { projection, world_from_camera: looking([0.0, 1.0, 0.0], ORIGIN), ..stage };
    let picture = linear(&stage.scene(), &SheenTable::embedded(), edits, ODD);
    picture.pixels[picture.pixels.len() / 2][0]
}

#[test]
fn a_floor_a_hair_below_a_light_is_lit_in_full() {
    // 2e-5 of its half side below: a few times what f32 loses of the coordinates.
    let floor = Thing::rectangle([0.2, 0.2], plain()).placed(facing([0.0, -2e-5, 0.0], UP));
    let light = Thing::rectangle([1.0, 1.0], glow([3.0; 3])).placed(facing(ORIGIN, [0.0, -1.0, 0.0]));
    let lit = middle(Stage::new(vec![floor, light], looking(UP, ORIGIN)), &diffuse_alone());
    assert!((lit - 3.0).abs() < 3e-3, "{lit}");
}

#[test]
fn a_point_light_a_millimetre_away_is_as_bright_as_its_distance_says() {
    let mut stage =
        Stage::new(vec![Thing::rectangle([1.0, 1.0], plain()).placed(facing(ORIGIN, UP))], looking(UP, ORIGIN));
    stage.punctual.push(point_light(Vec3::new(0.0, 1e-3, 0.0)));
    let lit = middle(stage, &diffuse_alone());
    let expected = 1e6 / std::f32::consts::PI;
    assert!((lit / expected - 1.0).abs() < 0.01, "{lit} for {expected}");
}

/// The cone's edge passes a little beside the middle of the picture: within it, all light arrives, and past it none.
#[test]
fn a_spot_whose_cones_are_equal_has_a_hard_edge() {
    let angles = [0.1f32, 1e-2, 1e-3, 1e-4].into_iter();
    for (angle, off, share) in angles.flat_map(|angle| [(angle, 0.0, 1.0), (angle, 0.99, 1.0), (angle, 1.01, 0.0)]) {
        let off_axis = angle * off;
        let floor = Thing::rectangle([1.0, 1.0], plain()).placed(facing(ORIGIN, UP));
        let mut stage = Stage::new(vec![floor], looking(UP, ORIGIN));
        let kind = PunctualKind::Spot { range: f32::INFINITY, inner: angle, outer: angle };
        let direction = Vec3::new(off_axis.sin(), -off_axis.cos(), 0.0);
        stage.punctual.push(PunctualLight { kind, direction, ..point_light(2.0 * Vec3::Y) });
        let expected = share * 0.25 / std::f32::consts::PI;
        let lit = middle(stage, &diffuse_alone());
        assert!((lit - expected).abs() < 1e-5, "{off_axis} rad off the axis of {angle}: {lit} for {expected}");
    }
}

#[test]
fn back_faces_are_lit_by_lights_without_extent_behind_them() {
    let material = Material { specular: 1.0, roughness: 0.5, double_sided: true, ..velvet([0.9, 0.5, 0.2], 0.4) };
    let floor = Thing::rectangle([1.5, 1.5], material).placed(facing(ORIGIN, UP));
    let mut stage = Stage::new(vec![floor], looking([0.4, -1.1, 2.6], ORIGIN));
    stage.punctual.push(point_light(Vec3::new(0.5, -1.0, -0.6)));
    let (table, edits) = (SheenTable::embedded(), Edits::default());
    let picture = linear(&stage.scene(), &table, &edits, SIZE);
    assert!(picture.pixels.iter().any(|pixel| pixel[0] > 0.01), "nothing is lit");
    differences(&picture, &Truth::new(&stage, &table, &edits, SIZE)).unwrap_or_else(|said| panic!("{said}"));
}

/// By the reciprocal rule light comes from a whole hemisphere as from its mean cosine, 2/3.
#[test]
fn the_reciprocal_rule_takes_the_environment_at_two_thirds() {
    let table = SheenTable::embedded();
    for alpha in [0.3, 0.6] {
        let material = Material { sheen: Some(Sheen::new(Vec3::ONE, alpha)), ..plain() };
        let floor = Thing::rectangle([1.0, 1.0], material).placed(facing(ORIGIN, UP));
        let overrides = MaterialEdits { layering: Some(Layering::Reciprocal), ..MaterialEdits::default() };
        let edits = Edits { ambient: Some(Vec3::ONE), every_material: overrides, ..diffuse_alone() };
        let left = f64::from(middle(Stage::new(vec![floor], looking(UP, ORIGIN)), &edits));
        let r = |mu| table.lookup(f64::from(alpha), mu)[2];
        let expected = 1.0 - r(1.0).max(r(2.0 / 3.0));
        assert!((left - expected).abs() < 1e-5, "alpha {alpha}: {left} for {expected}");
        assert!(r(2.0 / 3.0) > r(1.0) + 1e-3, "the light's side counts");
    }
}

/// A dielectric reflects all head on at most, by its strength: f0 does not pass f90.
#[test]
fn a_tint_past_one_reflects_no_more_than_the_strength() {
    let material = Material { specular: 0.5, specular_color: Vec3::splat(60.0), roughness: 0.4, ..plain() };
    let floor = Thing::rectangle([1.5, 1.5], material).placed(facing(ORIGIN, UP));
    let window = Thing::rectangle([0.6, 0.4], glow([4.0, 3.0, 2.0])).placed(facing([0.7, 0.8, -1.3], ORIGIN));
    let edits = Edits { lights_visible: Some(false), ..Edits::default() };
    hold(&Stage::new(vec![floor, window], looking([0.2, 0.9, 2.4], ORIGIN)), &edits);
}

#[test]
fn instances_of_one_mesh_are_all_drawn() {
    let tile = |x: f32| Thing::rectangle([0.3, 0.3], plain()).placed(facing([x, 0.0, 0.0], [x, 1.0, 0.0]));
    let window = Thing::rectangle([0.6, 0.4], glow([4.0, 3.0, 2.0])).placed(facing([0.7, 0.8, -1.3], ORIGIN));
    let things = vec![tile(-0.7), tile(0.0), tile(0.7), window];
    let stage = Stage::new(things, looking([0.2, 0.9, 2.4], ORIGIN));
    let (table, edits) = (SheenTable::embedded(), Edits { lights_visible: Some(false), ..Edits::default() });
    let mut scene = stage.scene();
    scene.instances.iter_mut().take(3).for_each(|instance| instance.mesh = 0);
    let picture = linear(&scene, &table, &edits, SIZE);
    differences(&picture, &Truth::new(&stage, &table, &edits, SIZE)).unwrap_or_else(|said| panic!("{said}"));
}
