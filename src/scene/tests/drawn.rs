//! Which instances are drawn, and what they emit.

use glam::{Mat4, Vec3};

use super::shapes::{grid, scene};
use crate::scene::notices::Notices;
use crate::scene::{Drawn, Edits, Scene, lights};

/// The same square at three places, glowing with (4, 2, 1): a light of it twice, and once none, as past the limits.
fn glowing() -> Scene {
    let mut scene = scene(grid(1, |_, _| true, |_, _| 0.0), Mat4::IDENTITY);
    scene.instances = vec![scene.instances[0].clone(); 3];
    for (index, instance) in scene.instances.iter_mut().enumerate() {
        instance.world_from_mesh = Mat4::from_translation(2.0 * index as f32 * Vec3::X);
    }
    scene.materials[0].emission = Vec3::new(4.0, 2.0, 1.0);
    lights::add_lights(&mut scene, 0, &mut Notices::default());
    scene.lights.remove(1);
    scene
}

fn visible(lights_visible: bool) -> Edits {
    Edits { lights_visible: Some(lights_visible), ..Edits::default() }
}

#[test]
fn lights_that_are_not_visible_are_not_drawn_and_what_only_glows_is() {
    let scene = glowing();
    for (lights_visible, expected) in [(true, [true; 3]), (false, [false, true, false])] {
        let drawn = Drawn::new(&scene, &visible(lights_visible));
        assert_eq!([0, 1, 2].map(|instance| drawn.is_drawn(instance)), expected);
        assert_eq!([0, 1, 2].map(|instance| drawn.light(instance).is_some()), [true, false, true]);
    }
}

#[test]
fn a_channel_that_did_not_glow_may_be_lit_up() {
    let mut scene = scene(grid(1, |_, _| true, |_, _| 0.0), Mat4::IDENTITY);
    scene.materials[0].emission = Vec3::X;
    lights::add_lights(&mut scene, 0, &mut Notices::default());
    assert_eq!((scene.lights[0].radiance, scene.lights[0].seen_share), (Vec3::X, Vec3::ONE));
    scene.lights[0].radiance = Vec3::new(1.0, 2.0, 3.0);
    let drawn = Drawn::new(&scene, &Edits::default());
    assert_eq!(drawn.emission(0), Vec3::new(1.0, 2.0, 3.0));
}

#[test]
fn an_emitter_glows_as_its_light_and_other_things_as_their_material() {
    let mut scene = glowing();
    // The second light, of the third instance, as edited: half of its texture's red is seen, and nothing of its blue.
    scene.lights[1].radiance = Vec3::new(3.0, 8.0, 5.0);
    scene.lights[1].seen_share = Vec3::new(0.5, 1.0, 0.0);
    for lights_visible in [true, false] {
        let drawn = Drawn::new(&scene, &visible(lights_visible));
        let own = Vec3::new(4.0, 2.0, 1.0);
        assert_eq!([0, 1, 2].map(|instance| drawn.emission(instance)), [own, own, Vec3::new(6.0, 8.0, 0.0)]);
    }
}
