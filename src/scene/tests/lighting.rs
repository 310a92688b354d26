//! What is too faint to see the subject by.

use glam::{Mat4, Quat, Vec3};

use super::shapes::{cube, grid, scene};
use crate::scene::notices::Notices;
use crate::scene::{Instance, Material, Mesh, Scene, lighting, lights};

/// A grey floor of side `size` about the origin, and a square lamp of side 1 that shines towards its z.
fn stage(size: f32, world_from_lamp: Mat4, radiance: f32) -> Scene {
    let place = Mat4::from_scale(Vec3::splat(size)) * Mat4::from_translation(Vec3::new(-0.5, -0.5, 0.0));
    let mut stage = scene(grid(1, |_, _| true, |_, _| 0.0), place);
    stage.meshes.push(Mesh { material: 1, ..stage.meshes[0].clone() });
    stage.materials.push(Material { emission: Vec3::splat(radiance), ..Material::matte("lamp", Vec3::ZERO) });
    stage.instances.push(Instance { name: "lamp".to_owned(), mesh: 1, world_from_mesh: world_from_lamp });
    lights::add_lights(&mut stage, 0, &mut Notices::default());
    stage
}

/// A lamp so high above the floor that shines down on it.
fn above(height: f32) -> Mat4 {
    Mat4::from_translation(Vec3::new(-0.5, 0.5, height)) * Mat4::from_quat(Quat::from_rotation_x(std::f32::consts::PI))
}

/// 2 m above, the middle of the floor has the radiance 0.0735 for each unit.
#[test]
fn lamps_show_what_they_light_and_faint_ones_do_not() {
    for (size, radiance, shows) in [(4.0, 1.0, true), (4.0, 0.03, true), (4.0, 0.005, false), (400.0, 1.0, true)] {
        assert_eq!(lighting::shows_subject(&stage(size, above(2.0), radiance)), shows, "{size} {radiance}");
    }
    // On a floor of 10 km no point is near it, but it shines straight at one.
    assert!(lighting::shows_subject(&stage(1e4, above(2.0), 1.0)));
    assert!(!lighting::shows_subject(&stage(1e4, above(2.0), 0.01)));
}

/// A lamp that is turned away is dark by intent, not for being faint.
#[test]
fn lamps_that_are_turned_away_are_no_labels() {
    let up = Mat4::from_translation(Vec3::new(-0.5, -0.5, 2.0));
    assert!(lighting::shows_subject(&stage(4.0, up, 1.0)));
    assert!(!lighting::shows_subject(&stage(4.0, up, 0.02)));
}

/// A square of a hundredth of a box's size on its top, which lights the box nowhere.
#[test]
fn an_indicator_on_a_box_does_not_show_the_box() {
    let mut stage =
        stage(1.0, Mat4::from_translation(Vec3::new(0.0, 0.0, 1.001)) * Mat4::from_scale(Vec3::splat(0.02)), 1.0);
    stage.meshes[0] = Mesh { material: 0, ..cube() };
    stage.instances[0].world_from_mesh = Mat4::IDENTITY;
    assert!(!lighting::shows_subject(&stage));
    // One that is as bright as a lamp does count.
    stage.lights[0].radiance = Vec3::splat(100.0);
    assert!(lighting::shows_subject(&stage));
}

#[test]
fn where_there_is_nothing_but_lamps_they_are_what_is_seen() {
    let mut stage = stage(1.0, above(2.0), 1e-3);
    stage.instances.remove(0);
    stage.lights[0].instance = 0;
    assert!(lighting::shows_subject(&stage));
}
