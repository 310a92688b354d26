//! Cameras and lights that are added, and what moves.

use std::f32::consts::PI;

use glam::{Affine2, Mat4, Quat, Vec3};

use super::shapes::{cube, grid, scene, sphere};
use crate::scene::notices::Notices;
use crate::scene::{
    Camera, Drawn, Edits, Instance, Light, LightEdits, Projection, Scene, TextureSlot, TextureUse, framing, lights, rig,
};

/// A mesh in all kinds of sizes, with a camera and lights.
fn sets() -> Vec<Scene> {
    let scales = [
        Vec3::ONE,
        Vec3::splat(1e-4),
        Vec3::splat(1e5),
        Vec3::new(10.0, 1.0, 1.0),
        Vec3::new(1.0, 10.0, 1.0),
        Vec3::new(3.0, 3.0, 0.001),
        Vec3::new(5.0, 1e-6, 5.0),
        Vec3::new(1e-4, 1e-4, 10.0),
    ];
    let place =
        |scale: Vec3| Mat4::from_scale_rotation_translation(scale, Quat::IDENTITY, scale * Vec3::new(3.0, -2.0, 5.0));
    scales.map(|scale| added(scene(cube(), place(scale)))).into()
}

fn added(mut scene: Scene) -> Scene {
    let mut notices = Notices::default();
    framing::add_camera(&mut scene, &mut notices);
    rig::add_where_dark(&mut scene, &mut notices);
    scene.notices = notices.into_lines().collect();
    scene
}

/// The place in a frame of `aspect` from -1 to 1, and the distance along the view.
fn seen(camera: &Camera, aspect: f32, point: Vec3) -> Vec3 {
    let point = camera.world_from_camera.inverse().transform_point3(point);
    let half_height = match camera.projection {
        Projection::Perspective { yfov, .. } => -point.z * (0.5 * yfov).tan(),
        Projection::Orthographic { ymag, .. } => ymag,
    };
    Vec3::new(point.x / (aspect * half_height), point.y / half_height, -point.z)
}

#[test]
fn what_the_eye_stands_in_is_no_foreground() {
    let eye = |scene: &Scene| scene.cameras[0].world_from_camera.w_axis.truncate();
    for mut scene in sets() {
        assert_eq!(scene.foreground(eye(&scene)), scene.subject());
        let subject = scene.subject();
        // A room around all of it and the eye.
        let half = 2.0 * eye(&scene).distance(subject.center());
        let room = Mat4::from_translation(subject.center()) * Mat4::from_scale(Vec3::splat(half));
        scene.instances.push(Instance { name: "room".to_owned(), mesh: 0, world_from_mesh: room });
        assert_eq!(scene.foreground(eye(&scene)), subject);
        assert_ne!(scene.subject(), subject);
        // From beside it, it is one thing of two; where there is nothing else, it is what is looked at.
        assert_eq!(scene.foreground(subject.center() + 4.0 * half), scene.subject());
        scene.instances.remove(0);
        scene.lights.clear();
        assert_eq!(scene.foreground(eye(&scene)), scene.subject());
    }
}

#[test]
fn a_framed_subject_is_wholly_in_the_frame_and_fills_it() {
    for scene in sets() {
        let camera = &scene.cameras[0];
        let Projection::Perspective { near, far, .. } = camera.projection else { panic!("{camera:?}") };
        for aspect in [1.0, 16.0 / 9.0] {
            let corners = scene.subject().corners().map(|corner| seen(camera, aspect, corner));
            for corner in corners {
                assert!(corner.x.abs() < 1.0 && corner.y.abs() < 1.0, "{corner} {:?}", scene.subject());
                // With room to come nearer.
                assert!(near < 0.05 * corner.z && corner.z < far);
            }
            let reach = corners.iter().map(|corner| corner.x.abs().max(corner.y.abs())).fold(0.0, f32::max);
            assert!(reach > 0.8 / aspect, "{reach} {:?}", scene.subject());
        }
    }
}

#[test]
fn what_glows_is_no_subject() {
    let mut two = scene(cube(), Mat4::IDENTITY);
    let lamp = two.clone();
    two.meshes.extend(lamp.meshes);
    two.materials.extend(lamp.materials);
    two.meshes[1].material = 1;
    two.materials[1].emission = Vec3::ONE;
    two.instances.push(lamp.instances[0].clone());
    two.instances[1].mesh = 1;
    two.instances[1].world_from_mesh = Mat4::from_translation(Vec3::new(0.0, 50.0, 0.0));
    assert_eq!((two.subject().min, two.subject().max), (Vec3::NEG_ONE, Vec3::ONE));
    assert_eq!(two.bounds().max, Vec3::new(1.0, 51.0, 1.0));
    // Where all glows all is the subject. Without a light, as past the limits, it gets the rig; with its own it does
    // not.
    two.materials[0].emission = Vec3::ONE;
    assert_eq!(two.subject(), two.bounds());
    assert_eq!(added(two.clone()).lights.len(), 3);
    lights::add_lights(&mut two, 0, &mut Notices::default());
    let two = added(two);
    assert_eq!(two.lights.len(), 2);
    assert_eq!(two.notices, ["no camera in the file: the whole scene is framed"]);
    // Of a textured thing only a part may glow: it is to be seen.
    let mut textured = two.clone();
    let texture = TextureUse { texture: 0, tex_coord: 0, uv_from_tex_coord: Affine2::IDENTITY };
    textured.materials[1].textures[TextureSlot::Emission as usize] = Some(texture);
    textured.materials[0].emission = Vec3::ZERO;
    assert_eq!(textured.subject(), textured.bounds());
    let Projection::Perspective { far, .. } = two.cameras[0].projection else { panic!("{:?}", two.cameras[0]) };
    assert!(two.bounds().corners().into_iter().all(|corner| seen(&two.cameras[0], 1.0, corner).z < far));
}

#[test]
fn the_rig_faces_the_subject_from_out_of_the_frame() {
    for scene in sets() {
        assert_eq!((scene.lights.len(), scene.notices.len()), (3, 2));
        out_of_frame(&scene);
        for light in &scene.lights {
            let way = (scene.subject().center() - light.position()).normalize();
            assert!(light.polygons[0].normal.dot(way) > 0.999);
        }
    }
}

/// No light's face is to be seen in frames of usual aspects.
fn out_of_frame(scene: &Scene) {
    let camera = &scene.cameras[0];
    let to_camera = |point: Vec3| match camera.projection {
        Projection::Perspective { .. } => camera.world_from_camera.w_axis.truncate() - point,
        Projection::Orthographic { .. } => camera.world_from_camera.z_axis.truncate(),
    };
    for polygon in scene.lights.iter().flat_map(|light| &light.polygons) {
        if polygon.normal.dot(to_camera(polygon.contours[0][0])) <= 0.0 {
            continue;
        }
        let [a, b, c] = [0, 1, 3].map(|corner| polygon.contours[0][corner]);
        for (u, v) in (0..=20).flat_map(|u| (0..=20).map(move |v| (u as f32 / 20.0, v as f32 / 20.0))) {
            let seen = seen(camera, 16.0 / 9.0, a + u * (b - a) + v * (c - a));
            assert!(seen.z < 0.0 || seen.x.abs() > 1.0 || seen.y.abs() > 1.0, "{camera:?} {seen}");
        }
    }
}

#[test]
fn the_rig_leaves_the_frames_of_the_files_cameras() {
    let projections = [
        Projection::Perspective { yfov: 0.3, near: 0.1, far: 1000.0 },
        Projection::Perspective { yfov: 1.5, near: 0.1, far: 1000.0 },
        Projection::Orthographic { ymag: 1.5, near: 0.1, far: 1000.0 },
        // Where the fill light would be between the edges of a square picture and of a wide one.
        Projection::Orthographic { ymag: 4.0, near: 0.1, far: 1000.0 },
        Projection::Orthographic { ymag: 12.0, near: 0.1, far: 1000.0 },
    ];
    for projection in projections {
        for distance in [4.0, 10.0, 40.0] {
            let mut scene = scene(cube(), Mat4::IDENTITY);
            let rotation = Quat::from_rotation_y(0.8) * Quat::from_rotation_x(-0.3);
            let world_from_camera = Mat4::from_rotation_translation(rotation, rotation * Vec3::new(0.3, 0.2, distance));
            scene.cameras.push(Camera { name: String::new(), world_from_camera, projection });
            out_of_frame(&added(scene));
        }
    }
}

#[test]
fn the_rig_is_no_farther_than_it_must_be() {
    // The rim light is in the frame up to twice the rig's first size. At four times it is not, and the key light, which still
    // is in it, is behind a near camera, and shows a far one its back.
    let projection = Projection::Orthographic { ymag: 12.0, near: 0.1, far: 1000.0 };
    for distance in [4.0, 60.0] {
        let mut scene = scene(cube(), Mat4::IDENTITY);
        let world_from_camera = Mat4::from_translation(Vec3::new(0.0, 0.0, distance));
        scene.cameras.push(Camera { name: String::new(), world_from_camera, projection });
        let scene = added(scene);
        for light in &scene.lights {
            let size = light.position().length() / (3.5 * 3.0f32.sqrt());
            assert!((size - 4.0).abs() < 1e-3, "{distance}: {} {size}", light.name);
        }
    }
}

#[test]
fn what_is_next_to_nothing_is_seen_from_without() {
    let place = Mat4::from_scale_rotation_translation(Vec3::splat(1e-9), Quat::IDENTITY, Vec3::new(300.0, 0.0, 0.0));
    let scene = added(scene(cube(), place));
    let eye = scene.cameras[0].world_from_camera.w_axis.truncate();
    assert!(eye.distance(scene.subject().center()) > 1e-4, "{eye}");
    for light in &scene.lights {
        assert!(light.position().distance(scene.subject().center()) > 1e-4 && light.position().is_finite());
    }
}

/// The radiance of a white diffuse surface, by a sum over the lights' faces.
fn radiance(lights: &[Light], point: Vec3, normal: Vec3) -> f32 {
    const N: usize = 40;
    let mut sum = 0.0;
    for (light, polygon) in lights.iter().flat_map(|light| light.polygons.iter().map(move |polygon| (light, polygon))) {
        let [a, b, c] = [0, 1, 3].map(|corner| polygon.contours[0][corner]);
        let area = (b - a).cross(c - a).length() / (N * N) as f32;
        for (u, v) in (0..N).flat_map(|u| (0..N).map(move |v| (u as f32, v as f32))) {
            let arm = a + (u + 0.5) / N as f32 * (b - a) + (v + 0.5) / N as f32 * (c - a) - point;
            let way = arm.normalize();
            let cosines = way.dot(normal).max(0.0) * -way.dot(polygon.normal).min(0.0);
            sum += light.radiance.x * cosines * area / (PI * arm.length_squared());
        }
    }
    sum
}

#[test]
fn the_rig_lights_white_things_as_white() {
    for scale in [1e-4, 1.0, 1e5] {
        let scene = added(scene(sphere(24), Mat4::from_scale(Vec3::splat(scale))));
        let camera = &scene.cameras[0];
        let back = camera.world_from_camera.z_axis.truncate();
        let points = scene.meshes[0].positions.iter().filter(|normal| normal.dot(back) > 0.3);
        let lit: Vec<f32> = points.map(|&normal| radiance(&scene.lights, scale * normal, normal)).collect();
        let (least, most) = lit.iter().fold((f32::MAX, 0.0f32), |(least, most), &lit| (least.min(lit), most.max(lit)));
        let mean = lit.iter().sum::<f32>() / lit.len() as f32;
        assert!(most > 0.6 && most < 1.5 && mean > 0.2 && least >= 0.0, "{least} {mean} {most}");
    }
    for turn in [Quat::IDENTITY, Quat::from_rotation_x(-PI / 2.0)] {
        // A backdrop and a floor.
        let scene = added(scene(grid(1, |_, _| true, |_, _| 0.0), Mat4::from_quat(turn)));
        let lit = radiance(&scene.lights, scene.subject().center(), turn * Vec3::Z);
        assert!((0.4..1.5).contains(&lit), "{lit}");
    }
}

#[test]
fn cameras_are_found_by_name_and_number() {
    let mut scene = added(scene(cube(), Mat4::IDENTITY));
    let mut second = scene.cameras[0].clone();
    second.name = "0".to_owned();
    scene.cameras.push(second);
    assert_eq!(scene.camera("framing").unwrap().name, "framing");
    assert_eq!(scene.camera("1").unwrap().name, "0");
    // Names take precedence over numbers.
    assert_eq!(scene.camera("0").unwrap().name, "0");
    for missing in ["2", "-1", "", "Framing", "99999999999999999999"] {
        assert!(scene.camera(missing).is_none(), "{missing}");
    }
}

#[test]
fn a_light_moves_with_its_emitter() {
    let before = added(scene(cube(), Mat4::IDENTITY));
    let offset = Vec3::new(1.0, -2.0, 3.0);
    let moved = LightEdits { position: Some(before.lights[1].position() + offset), ..LightEdits::default() };
    let scene = Drawn::new(&before, &Edits { lights: [(1, moved)].into(), ..Edits::default() });
    assert!((scene.lights[1].position() - before.lights[1].position() - offset).length() < 1e-5);
    let (mesh, instance) = (&before.meshes[2], &scene.instances[2]);
    assert_eq!(scene.lights[1].instance, 2);
    for (corner, position) in scene.lights[1].polygons[0].contours[0].iter().zip(&mesh.positions) {
        let near = |corner: &Vec3| corner.distance(instance.world_from_mesh.transform_point3(*position)) < 1e-5;
        assert!(scene.lights[1].polygons[0].contours[0].iter().any(near), "{corner}");
    }
    assert_eq!(scene.lights[0].polygons[0].contours, before.lights[0].polygons[0].contours);
    assert_eq!(scene.lights[2].polygons[0].contours, before.lights[2].polygons[0].contours);
}

#[test]
fn notices_are_one_line_a_kind() {
    let mut notices = Notices::default();
    for place in ["mesh 0", "mesh\n1", "mesh 2"] {
        notices.add("points are not drawn", || place.to_owned());
    }
    notices.add("no light", || "a\nb".to_owned());
    let lines: Vec<String> = notices.into_lines().collect();
    assert_eq!(lines, ["points are not drawn: mesh 0 and 2 more", "no light: a\\nb"]);
}
