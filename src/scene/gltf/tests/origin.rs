//! Scenes far from the origin of their file.

use glam::{DVec3, Vec3};
use serde_json::json;

use super::builder::Builder;
use crate::scene::Scene;

/// The studio, with lights and a camera below a node that stands at `place`.
fn studio_at(place: [f64; 3]) -> Builder {
    let mut file = Builder::studio();
    let light = json!({ "extensions": { "KHR_lights_punctual": { "light": 0 } }, "translation": [0.5, 1, 2] });
    let punctual = file.push("nodes", light);
    let light = json!({ "extensions": { "EXT_lights_area": { "light": 0 } }, "translation": [-0.5, 1, 2] });
    let area = file.push("nodes", light);
    let site = file.push("nodes", json!({ "children": [0, 1, 2, punctual, area], "translation": place }));
    file.json["scenes"] = json!([{ "nodes": [site] }]);
    file.json["extensions"] = json!({
        "KHR_lights_punctual": { "lights": [{ "type": "point" }] },
        "EXT_lights_area": { "lights": [{ "type": "rect" }] },
    });
    file
}

/// Every place in a scene, in the file's space.
fn places(scene: &Scene) -> Vec<DVec3> {
    let of_file = |point: Vec3| scene.origin + point.as_dvec3();
    let instances = scene.instances.iter().flat_map(|instance| {
        let positions = &scene.meshes[instance.mesh].positions;
        positions.iter().map(|position| of_file(instance.world_from_mesh.transform_point3(*position)))
    });
    let lights = scene.lights.iter().flat_map(|light| &light.polygons).flat_map(|polygon| &polygon.contours).flatten();
    let cameras = scene.cameras.iter().map(|camera| of_file(camera.world_from_camera.w_axis.truncate()));
    let punctual = scene.punctual_lights.iter().map(|light| of_file(light.position));
    instances.chain(lights.map(|vertex| of_file(*vertex))).chain(cameras).chain(punctual).collect()
}

#[test]
fn everything_keeps_its_place_however_far_the_scene_stands() {
    let near = studio_at([0.0; 3]).read();
    assert_eq!((near.origin, near.notices.len()), (DVec3::ZERO, 0));
    for place in [[1e4, 0.0, -0.3], [500_000.25, 120.0, -4_649_776.5], [0.0, -6.4e6, 6.4e6]] {
        let far = studio_at(place).read();
        assert!(far.origin.distance(DVec3::from(place)) < 4.0, "{}", far.origin);
        assert_eq!(far.notices.len(), 1, "{:?}", far.notices);
        assert!(far.notices[0].starts_with("the scene stands far from the origin of its file"), "{:?}", far.notices);
        let (near, far) = (places(&near), places(&far));
        assert_eq!(near.len(), far.len());
        for (near, far) in near.into_iter().zip(far) {
            // Twice what 32-bit floats are apart at 8 metres.
            assert!((near + DVec3::from(place)).distance(far) < 1e-6, "{near} {far}");
        }
    }
    // Numbers that 32-bit floats do not hold.
    let finest = studio_at([1e8 + 0.015_625, 0.0, 0.0]).read();
    assert!(
        places(&finest).iter().zip(places(&near)).all(|(far, near)| (far.x - near.x - 1e8 - 0.015_625).abs() < 1e-6)
    );
}

#[test]
fn a_scene_a_few_sizes_away_keeps_its_origin() {
    // Its half diagonal is the root of 2.
    for (place, moves) in [(22.0, false), (23.0, true)] {
        let scene = studio_at([place, 0.0, 0.0]).read();
        assert_eq!(scene.origin != DVec3::ZERO, moves, "{place}: {}", scene.origin);
    }
}

/// Coordinates that stand in the vertices themselves: of what the file still tells apart, nothing is lost.
#[test]
fn a_mesh_far_from_its_own_origin() {
    let (base, turn) = (Vec3::new(500_000.0, 0.0, -4_649_776.0), [0.0, 0.6, 0.0, 0.8]);
    let corners = [Vec3::ZERO, Vec3::new(3.0, 0.0, 0.0), Vec3::new(0.0, 2.0, 1.5)].map(|corner| base + corner);
    let mut file = Builder::new();
    let mesh = file.mesh(&corners, None, &[0, 1, 2], None);
    file.push("nodes", json!({ "mesh": mesh, "rotation": turn }));
    let scene = file.read();
    // Turned about y by the angle whose half has the sine 0.6 and the cosine 0.8.
    let (sine, cosine) = (2.0 * 0.6 * 0.8, 0.8 * 0.8 - 0.6 * 0.6);
    let read = places(&scene);
    for (corner, read) in corners.iter().map(|corner| corner.as_dvec3()).zip(read) {
        let expected = DVec3::new(cosine * corner.x + sine * corner.z, corner.y, cosine * corner.z - sine * corner.x);
        assert!(read.distance(expected) < 1e-6, "{read} {expected}");
    }
    let camera = scene.cameras[0].world_from_camera.w_axis.truncate();
    assert!(camera.length() < 30.0, "it is framed as closely as anywhere: {camera}");
}
