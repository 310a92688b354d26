//! What becomes of lights that are added, turned, made larger, or turned off: by closed forms.

use std::f32::consts::{FRAC_PI_2, PI};

use glam::{Mat4, Quat, Vec2, Vec3};

use super::shapes::{grid, scene};
use crate::scene::notices::Notices;
use crate::scene::{
    Added, AddedLight, Camera, Drawn, Edits, Light, LightEdits, LightShape, Projection, PunctualEdits, PunctualKind,
    PunctualShape, Scene, black_body, lights, rig,
};

const NONE: LightEdits = LightEdits {
    radiance: None,
    strength: None,
    temperature: None,
    power: None,
    position: None,
    rotation: None,
    size: None,
    two_sided: None,
    on: None,
    solo: None,
    removed: None,
};

/// Two emitters side by side: squares of two metres in the plane z = 0.
fn pair() -> Scene {
    let mut scene = scene(grid(1, |_, _| true, |_, _| 0.0), Mat4::from_scale(Vec3::new(2.0, 2.0, 1.0)));
    let mut other = scene.instances[0].clone();
    other.world_from_mesh = Mat4::from_translation(5.0 * Vec3::X) * other.world_from_mesh;
    scene.instances.push(other);
    scene.materials[0].emission = Vec3::new(4.0, 2.0, 1.0);
    lights::add_lights(&mut scene, 0, &mut Notices::default());
    scene
}

fn added(shape: LightShape, changes: LightEdits) -> AddedLight {
    Added { name: "new".to_owned(), shape, changes }
}

fn with(added_lights: Vec<AddedLight>) -> Edits {
    Edits { added_lights, ..Edits::default() }
}

fn outline(light: &Light) -> &[Vec3] {
    &light.polygons[0].contours[0]
}

/// The corners of what is drawn for a light are its outline's, and its front is where it shines.
fn check_emitter(drawn: &Drawn, light: usize) {
    let (light, emitter) = (&drawn.lights[light], drawn.lights[light].instance);
    let instance = &drawn.instances[emitter];
    let place = |corner: &Vec3| instance.world_from_mesh.transform_point3(*corner);
    let mesh = drawn.mesh_of(emitter);
    let corners: Vec<Vec3> = mesh.positions.iter().map(place).collect();
    let size = corners.iter().chain(outline(light)).map(|corner| corner.abs().max_element()).fold(1.0, f32::max);
    for vertex in outline(light) {
        assert!(corners.iter().any(|corner| corner.distance(*vertex) < 1e-5 * size), "{vertex} of {corners:?}");
    }
    let [a, b, c] = [0, 1, 2].map(|at| corners[mesh.indices[at] as usize]);
    assert!((b - a).cross(c - a).normalize().dot(light.polygons[0].normal) > 0.9999);
}

#[test]
fn shapes_are_placed_turned_and_scaled() {
    let scene = pair();
    // A quarter of a turn about y takes +z to +x, and x to -z.
    let changes = LightEdits {
        position: Some(Vec3::new(1.0, 2.0, 3.0)),
        rotation: Some(Quat::from_rotation_y(FRAC_PI_2)),
        size: Some(Vec2::new(4.0, 2.0)),
        ..NONE
    };
    let shapes = [LightShape::Rectangle, LightShape::Disk, LightShape::Polygon(5), LightShape::Polygon(3)];
    let edits = with(shapes.map(|shape| added(shape, changes)).to_vec());
    let drawn = Drawn::new(&scene, &edits);
    let corners = [[2.0, -1.0], [-2.0, -1.0], [-2.0, 1.0], [2.0, 1.0]];
    let expected = corners.map(|[along, up]| Vec3::new(1.0, 2.0 + up, 3.0 + along));
    for (found, expected) in outline(&drawn.lights[2]).iter().zip(expected) {
        assert!(found.distance(expected) < 1e-6, "{found}, not {expected}");
    }
    for (light, area) in [(2, 8.0), (3, PI * 2.0), (4, 2.5 * (0.4 * PI).sin() * 2.0), (5, 1.5 * (PI / 1.5).sin() * 2.0)]
    {
        check_emitter(&drawn, light);
        let found = &drawn.lights[light];
        assert!(found.polygons[0].normal.distance(Vec3::X) < 1e-6 && !found.two_sided);
        assert!((found.polygons[0].area() as f32 - area).abs() < 1e-5 * area, "{light}: {area}");
        assert!(found.position().distance(Vec3::new(1.0, 2.0, 3.0)) < 1e-5);
        assert!(drawn.is_drawn(found.instance) && drawn.emission(found.instance) == Vec3::ONE);
    }
    assert_eq!(drawn.instances.len(), 6);
}

#[test]
fn lights_of_the_file_turn_with_their_emitters() {
    let scene = pair();
    let frame = scene.base_frame(&Edits::default(), 1);
    assert!((frame.size - 2.0).abs().max_element() < 1e-6 && frame.is_flat && frame.normal() == Vec3::Z);
    let rotation = Quat::from_axis_angle(Vec3::new(1.0, 2.0, 3.0).normalize(), 0.7);
    let changes = LightEdits { rotation: Some(rotation), size: Some(Vec2::new(1.0, 3.0)), ..NONE };
    let edits = Edits { lights: [(1, changes)].into(), ..Edits::default() };
    let drawn = Drawn::new(&scene, &edits);
    check_emitter(&drawn, 1);
    let (light, after) = (&drawn.lights[1], frame.with(None, changes.rotation, changes.size));
    assert!(light.position().distance(frame.position) < 1e-6);
    assert!(light.polygons[0].normal.distance(rotation * Vec3::Z) < 1e-6);
    assert!((light.polygons[0].area() - 3.0).abs() < 1e-5);
    // What it measures now, found anew from its outline.
    let found = light.frame();
    let mut sizes = [found.size.to_array(), after.size.to_array()];
    sizes.iter_mut().for_each(|size| size.sort_by(f32::total_cmp));
    assert!((sizes[0][0] - sizes[1][0]).abs() < 1e-5 && (sizes[0][1] - sizes[1][1]).abs() < 1e-5, "{sizes:?}");
    assert!(found.normal().distance(after.normal()) < 1e-6);
}

#[test]
fn what_is_not_flat_keeps_its_shape() {
    // A roof of two slopes.
    let mut scene = scene(grid(2, |_, _| true, |x, _| 0.5 - (x - 0.5).abs()), Mat4::IDENTITY);
    scene.materials[0].emission = Vec3::ONE;
    lights::add_lights(&mut scene, 0, &mut Notices::default());
    let frame = scene.base_frame(&Edits::default(), 0);
    assert!(scene.lights[0].polygons.len() == 2 && !frame.is_flat);
    let changes = LightEdits { size: Some(frame.size * Vec2::new(4.0, 1.0)), ..NONE };
    let edits = Edits { lights: [(0, changes)].into(), ..Edits::default() };
    let drawn = Drawn::new(&scene, &edits);
    check_emitter(&drawn, 0);
    for (before, after) in scene.lights[0].polygons.iter().zip(&drawn.lights[0].polygons) {
        assert!((after.area() / before.area() - 4.0).abs() < 1e-5 && after.normal.distance(before.normal) < 1e-6);
    }
    assert_eq!(frame.with(None, None, changes.size).size, 2.0 * frame.size);
}

#[test]
fn power_is_that_of_all_that_is_sent_out() {
    let scene = pair();
    let of = |changes: LightEdits| {
        let edits = with(vec![added(LightShape::Rectangle, LightEdits { size: Some(Vec2::new(2.0, 3.0)), ..changes })]);
        Drawn::new(&scene, &edits).lights[2].radiance
    };
    let power = Some(60.0);
    assert!((of(LightEdits { power, ..NONE }) - 10.0 / PI).abs().max_element() < 1e-5);
    assert!((of(LightEdits { power, two_sided: Some(true), ..NONE }) - 5.0 / PI).abs().max_element() < 1e-5);
    // It goes before strength, and the hue stays.
    let red = LightEdits { power, strength: Some(7.0), radiance: Some(Vec3::new(0.5, 0.25, 0.0)), ..NONE };
    assert!((of(red) - 10.0 / PI * Vec3::new(1.0, 0.5, 0.0)).abs().max_element() < 1e-5);
    assert_eq!(of(LightEdits { power: Some(0.0), ..NONE }), Vec3::ZERO);
    let warm = LightEdits { radiance: Some(Vec3::new(0.0, 8.0, 2.0)), temperature: Some(2700.0), ..NONE };
    assert_eq!(of(warm), 8.0 * black_body::color(2700.0));
    assert_eq!(of(LightEdits { strength: Some(0.25), ..warm }), 2.0 * black_body::color(2700.0));
    let black = LightEdits { radiance: Some(Vec3::ZERO), temperature: Some(2700.0), power: Some(6.0 * PI), ..NONE };
    assert!(of(black).distance(black_body::color(2700.0)) < 1e-6);
}

#[test]
fn lights_that_are_off_are_dark_and_not_drawn() {
    let scene = pair();
    let lit = |edits: &Edits| {
        let drawn = Drawn::new(&scene, edits);
        let lights = drawn.lights.iter().map(|light| (light.radiance != Vec3::ZERO, drawn.is_drawn(light.instance)));
        assert!(lights.clone().all(|(lit, drawn)| lit == drawn));
        lights.map(|(lit, _)| lit).collect::<Vec<_>>()
    };
    let edits = |first: LightEdits, new: LightEdits| Edits {
        lights: [(0, first)].into(),
        ..with(vec![added(LightShape::Disk, new)])
    };
    let (off, solo) = (LightEdits { on: Some(false), ..NONE }, LightEdits { solo: Some(true), ..NONE });
    let removed = LightEdits { removed: Some(true), ..NONE };
    assert_eq!(lit(&edits(NONE, NONE)), [true; 3]);
    assert_eq!(lit(&edits(off, NONE)), [false, true, true]);
    assert_eq!(lit(&edits(NONE, solo)), [false, false, true]);
    assert_eq!(lit(&edits(solo, solo)), [true, false, true]);
    assert_eq!(lit(&edits(solo, off)), [true, false, false]);
    assert_eq!(lit(&edits(removed, NONE)), [false, true, true]);
    // One that is away takes no light from the others.
    assert_eq!(lit(&edits(LightEdits { solo: Some(true), ..removed }, NONE)), [false, true, true]);
    assert_eq!(lit(&edits(LightEdits { on: Some(false), ..solo }, NONE)), [false; 3]);
}

#[test]
fn copies_are_what_they_are_copies_of() {
    let scene = pair();
    let moved = LightEdits { position: Some(Vec3::new(0.0, 0.0, 9.0)), ..NONE };
    let edits = with(vec![added(LightShape::Copy(1), NONE), added(LightShape::Copy(1), moved)]);
    let drawn = Drawn::new(&scene, &edits);
    assert_eq!(outline(&drawn.lights[2]), outline(&scene.lights[1]));
    assert_eq!(
        (drawn.lights[2].radiance, drawn.lights[3].position()),
        (scene.lights[1].radiance, Vec3::new(0.0, 0.0, 9.0))
    );
    for light in [2, 3] {
        check_emitter(&drawn, light);
        let emitter = drawn.lights[light].instance;
        assert_eq!((drawn.loaded_light(light), drawn.loaded_instance(emitter)), (Some(1), Some(1)));
        assert_eq!(drawn.light_index(emitter), Some(light));
    }
    assert_eq!(drawn.loaded_light(0), Some(0));
}

#[test]
fn both_faces_shine_where_that_is_asked_for() {
    let scene = pair();
    let two_sided = LightEdits { two_sided: Some(true), ..NONE };
    let edits = Edits { lights: [(0, two_sided)].into(), ..with(vec![added(LightShape::Disk, two_sided)]) };
    let drawn = Drawn::new(&scene, &edits);
    assert_eq!([0, 1, 2].map(|light: usize| drawn.lights[light].two_sided), [true, false, true]);
    assert_eq!([0, 1, 2].map(|instance| drawn.is_double_sided(instance)), [true, false, true]);
}

#[test]
fn lights_without_extent_are_changed_and_added() {
    let spot = Added {
        name: String::new(),
        shape: PunctualShape::Spot,
        changes: PunctualEdits {
            power: Some(100.0),
            direction: Some(Vec3::new(0.0, -5.0, 0.0)),
            outer: Some(FRAC_PI_2),
            inner: Some(FRAC_PI_2),
            ..PunctualEdits::default()
        },
    };
    let point = |changes| Added { shape: PunctualShape::Point, changes, ..spot.clone() };
    let off = PunctualEdits { on: Some(false), ..PunctualEdits::default() };
    let bright = PunctualEdits { power: Some(4.0 * PI), position: Some(Vec3::X), ..PunctualEdits::default() };
    let edits = Edits { added_punctual: vec![spot.clone(), point(bright), point(off)], ..Edits::default() };
    let (scene, empty) = (pair(), Edits::default());
    assert!(Drawn::new(&scene, &empty).punctual_lights.is_empty());
    let drawn = Drawn::new(&scene, &edits);
    let [spot, bright, off] = &*drawn.punctual_lights else { panic!("there are three") };
    // Half of all directions.
    assert!((spot.intensity.x - 100.0 / (2.0 * PI)).abs() < 1e-4 && spot.direction == Vec3::NEG_Y);
    assert!(matches!(spot.kind, PunctualKind::Spot { inner, outer, .. } if inner == FRAC_PI_2 && outer == FRAC_PI_2));
    assert!((bright.intensity - 1.0).abs().max_element() < 1e-6 && bright.position == Vec3::X);
    assert_eq!(off.intensity, Vec3::ZERO);
    // Its falloff summed by steps of the angle.
    let kind = PunctualKind::Spot { range: f32::INFINITY, inner: 0.3, outer: 0.8 };
    let sum: f64 = (0..100_000)
        .map(|step| (f64::from(step) + 0.5) * 0.8e-5)
        .map(|angle| {
            let share = ((angle.cos() - 0.8f64.cos()) / (0.3f64.cos() - 0.8f64.cos())).clamp(0.0, 1.0);
            share * share * 2.0 * std::f64::consts::PI * angle.sin() * 0.8e-5
        })
        .sum();
    let light = crate::scene::PunctualLight { kind, ..spot.clone() };
    assert!((f64::from(light.power(1.0).unwrap()) / sum - 1.0).abs() < 1e-5);
}

#[test]
fn what_is_taken_away_moves_up_what_was_added_later() {
    let scene = pair();
    let mut edits = with([3, 4, 5].map(|corners| added(LightShape::Polygon(corners), NONE)).to_vec());
    assert_eq!((edits.light_count(&scene), edits.corner_count(&scene)), (5, 8 + 12));
    edits.remove_light(&scene, 3);
    edits.remove_light(&scene, 0);
    assert_eq!(
        edits.added_lights.iter().map(|light| light.shape).collect::<Vec<_>>(),
        [LightShape::Polygon(3), LightShape::Polygon(5)]
    );
    assert_eq!(edits.of_light(&scene, 0).removed, Some(true));
    edits.set_light(&scene, 3, LightEdits { strength: Some(2.0), ..NONE });
    assert_eq!(edits.of_light(&scene, 3).strength, Some(2.0));
    edits.set_light(&scene, 0, NONE);
    assert!(edits.lights.is_empty());
}

/// The rig that a file without lights gets, and the one that is added to it: each corner and each radiance the same.
#[test]
fn the_rig_is_the_same_whether_loaded_or_added() {
    let mut without = scene(grid(1, |_, _| true, |_, _| 0.0), Mat4::from_rotation_x(0.3));
    let world_from_camera = Mat4::from_rotation_translation(Quat::from_rotation_x(-0.4), Vec3::new(0.5, 2.0, 4.0));
    let projection = Projection::Perspective { yfov: 0.7, near: 0.1, far: 100.0 };
    without.cameras = vec![Camera { name: String::new(), world_from_camera, projection }];
    let mut with_rig = without.clone();
    rig::add(&mut with_rig, &mut Notices::default());
    assert_eq!((with_rig.rig.clone(), without.rig.len()), (0..3, 0));
    let edits = with(without.studio_rig());
    let drawn = Drawn::new(&without, &edits);
    for (index, loaded) in with_rig.lights.iter().enumerate() {
        check_emitter(&drawn, index);
        let added = &drawn.lights[index];
        assert!((added.radiance / loaded.radiance - 1.0).abs().max_element() < 1e-6);
        for vertex in outline(loaded) {
            let size = vertex.length();
            assert!(outline(added).iter().any(|other| other.distance(*vertex) < 1e-5 * size), "{}", loaded.name);
        }
        assert!(added.polygons[0].normal.distance(loaded.polygons[0].normal) < 1e-5);
    }
}
