//! What is read of a file.

use glam::Vec3;
use serde_json::json;

use super::builder::{Builder, read};
use crate::scene::Projection;

#[test]
fn a_square_is_read_framed_and_lit() {
    let file = Builder::square();
    for bytes in [file.glb(), file.gltf()] {
        let scene = read(&bytes).unwrap();
        assert_eq!(scene.instances[0].name, "square");
        assert_eq!(scene.meshes[0].indices, [0, 1, 2, 0, 2, 3]);
        assert_eq!(scene.materials[0].name, "felt");
        assert_eq!((scene.cameras.len(), scene.lights.len()), (1, 3));
        assert_eq!(scene.notices.len(), 2);
    }
}

#[test]
fn emission_makes_a_light() {
    let mut file = Builder::square();
    file.json["materials"][0]["emissiveFactor"] = json!([1.0, 0.5, 0.0]);
    file.json["materials"][0]["extensions"] = json!({ "KHR_materials_emissive_strength": { "emissiveStrength": 8.0 } });
    let scene = file.read();
    assert_eq!(scene.lights.len(), 1);
    assert_eq!(scene.lights[0].radiance, Vec3::new(8.0, 4.0, 0.0));
    assert_eq!(scene.lights[0].polygons.len(), 1);
    assert_eq!(scene.lights[0].polygons[0].contours.len(), 1);
    assert_eq!(scene.lights[0].polygons[0].contours[0].len(), 4);
    assert_eq!(scene.lights[0].polygons[0].normal, Vec3::Z);
}

#[test]
fn a_camera_is_read() {
    let mut file = Builder::square();
    let perspective = json!({ "yfov": 0.5, "znear": 0.1 });
    let camera = file.push("cameras", json!({ "name": "near", "type": "perspective", "perspective": perspective }));
    file.push("nodes", json!({ "camera": camera, "translation": [0, 0, 3], "scale": [2, 2, 2] }));
    let scene = file.read();
    assert_eq!(
        scene.camera("near").unwrap().projection,
        Projection::Perspective { yfov: 0.5, near: 0.1, far: f32::INFINITY }
    );
    assert_eq!(scene.camera("0").unwrap().world_from_camera.w_axis.truncate(), Vec3::new(0.0, 0.0, 3.0));
    assert!(scene.camera("1").is_none() && scene.camera("far").is_none());
}
