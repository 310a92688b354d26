//! What is read of a file.

use glam::{Mat4, Vec3, Vec4Swizzles};
use serde_json::json;

use super::builder::{Builder, read};
use crate::scene::{Projection, Sheen};

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

#[test]
fn cameras_keep_no_scale_and_no_mirroring() {
    let mut file = Builder::square();
    let orthographic = json!({ "xmag": 3, "ymag": 2, "znear": 0, "zfar": 9 });
    file.push("cameras", json!({ "type": "orthographic", "orthographic": orthographic }));
    let scales = [[1.0, 1.0, 1.0], [3.0, 0.5, 7.0], [-1.0, 1.0, 1.0], [1e-6, 1e-6, 1e-6]];
    for scale in scales {
        // Turned a quarter about x: looks down.
        let half = 0.5f32.sqrt();
        let node = json!({ "name": "plan", "camera": 0, "rotation": [-half, 0, 0, half], "translation": [0, 4, 0] });
        let mut file = Builder { json: file.json.clone(), bytes: file.bytes.clone() };
        let parent = json!({ "scale": scale, "children": [file.push("nodes", node)] });
        file.push("nodes", parent);
        let scene = file.read();
        let camera = scene.camera("plan").unwrap();
        assert_eq!(camera.projection, Projection::Orthographic { ymag: 2.0, near: 0.0, far: 9.0 });
        assert!((camera.world_from_camera.z_axis.xyz() - Vec3::Y).length() < 1e-6);
        assert!((camera.world_from_camera.w_axis.xyz() - Vec3::Y * 4.0 * scale[1]).length() < 1e-5);
    }
}

#[test]
fn cameras_keep_no_shear() {
    let mut file = Builder::square();
    file.push("cameras", json!({ "type": "perspective", "perspective": { "yfov": 0.5, "znear": 0.1 } }));
    // Its y leans by half towards its back.
    file.push("nodes", json!({ "camera": 0, "matrix": [1, 0, 0, 0, 0, 1, 0.5, 0, 0, 0, 1, 0, 0, 0, 4, 1] }));
    let world_from_camera = file.read().cameras[0].world_from_camera;
    assert!(world_from_camera.abs_diff_eq(Mat4::from_translation(4.0 * Vec3::Z), 1e-6), "{world_from_camera}");
}

#[test]
fn thin_and_sheared_things_are_drawn_and_rotations_do_not_scale() {
    let mut file = Builder::square();
    // Its y leans so far over that its axes span a thousandth of a cube.
    file.json["nodes"][0]["matrix"] = json!([1, 0, 0, 0, 1, 1e-3, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
    file.push("nodes", json!({ "mesh": 0, "rotation": [0, 0, 0, 1.005] }));
    let scene = file.read();
    let drawn: Vec<Mat4> = scene.instances.iter().map(|instance| instance.world_from_mesh).take(2).collect();
    assert_eq!((drawn[0].y_axis.y, drawn[1]), (1e-3, Mat4::IDENTITY));
}

#[test]
fn cameras_come_in_the_order_of_the_files_list() {
    let mut file = Builder::square();
    for name in ["left", "right"] {
        let perspective = json!({ "yfov": 0.5, "znear": 0.1 });
        file.push("cameras", json!({ "name": name, "type": "perspective", "perspective": perspective }));
    }
    file.push("nodes", json!({ "camera": 1 }));
    file.push("nodes", json!({ "camera": 0 }));
    let names: Vec<String> = file.read().cameras.into_iter().map(|camera| camera.name).collect();
    assert_eq!(names, ["left", "right"]);
}

#[test]
fn materials_have_gltfs_defaults() {
    let mut file = Builder::square();
    file.json["materials"] = json!([{ "extensions": { "KHR_materials_sheen": {} } }]);
    let scene = file.read();
    let material = &scene.materials[0];
    assert_eq!((material.base_color, material.emission, material.double_sided), (Vec3::ONE, Vec3::ZERO, false));
    assert_eq!(material.sheen, Some(Sheen::new(Vec3::ZERO, 0.0)));
    // A primitive without a material has one of its own.
    file.json["meshes"][0]["primitives"][0].as_object_mut().unwrap().remove("material");
    let scene = file.read();
    let material = &scene.materials[scene.meshes[0].material];
    assert_eq!((material.name.as_str(), material.sheen), ("default", None));
}

#[test]
fn transforms_go_down_the_tree_to_every_instance() {
    let mut file = Builder::square();
    file.json["nodes"] = json!([
        { "translation": [1, 0, 0], "children": [1, 2] },
        { "name": "left", "mesh": 0, "scale": [2, 2, 2] },
        { "name": "right", "mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 5, 6, 7, 1] },
    ]);
    let scene = file.read();
    let [left, right] = &scene.instances[..2] else { panic!("{:?}", scene.instances) };
    assert_eq!((left.name.as_str(), right.name.as_str(), left.mesh, right.mesh), ("left", "right", 0, 0));
    assert_eq!(left.world_from_mesh, Mat4::from_translation(Vec3::X) * Mat4::from_scale(Vec3::splat(2.0)));
    assert_eq!(right.world_from_mesh.w_axis.xyz(), Vec3::new(6.0, 6.0, 7.0));
    assert!(right.mirrors() && !left.mirrors());
}

#[test]
fn only_the_default_scene_is_read() {
    let mut file = Builder::square();
    file.push("nodes", json!({ "name": "other", "mesh": 0 }));
    for (scenes, wanted, names) in [
        (json!([{ "nodes": [1] }, { "nodes": [0] }]), json!(1), &["square"][..]),
        (json!([{ "nodes": [1] }, { "nodes": [0] }]), json!(null), &["other"]),
        (json!([]), json!(null), &["square", "other"]),
    ] {
        file.json["scenes"] = scenes;
        file.json["scene"] = wanted;
        let scene = file.read();
        let read: Vec<&str> = scene.instances[..names.len()].iter().map(|instance| instance.name.as_str()).collect();
        assert_eq!((read.as_slice(), scene.instances.len()), (names, names.len() + 3));
    }
}

#[test]
fn indices_of_every_width_and_primitives_of_every_kind() {
    let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, 0.0)];
    let kinds = [
        (4, vec![0u32, 1, 2, 1, 3, 2, 0], vec![0u32, 1, 2, 1, 3, 2]),
        (5, vec![0, 1, 2, 3], vec![0, 1, 2, 1, 3, 2]),
        (6, vec![0, 1, 3, 2], vec![0, 1, 3, 0, 3, 2]),
    ];
    for (mode, indices, expected) in kinds {
        let bytes: [(u32, Vec<u8>); 3] = [
            (5121, indices.iter().map(|&index| index as u8).collect()),
            (5123, indices.iter().flat_map(|&index| (index as u16).to_le_bytes()).collect()),
            (5125, indices.iter().flat_map(|&index| index.to_le_bytes()).collect()),
        ];
        for (component, bytes) in bytes {
            let mut file = Builder::new();
            file.mesh(&corners, Some(&[Vec3::Z; 4]), &[0], None);
            let accessor = file.accessor(&bytes, indices.len(), component, "SCALAR");
            file.set("/meshes/0/primitives/0/indices", json!(accessor));
            file.set("/meshes/0/primitives/0/mode", json!(mode));
            file.push("nodes", json!({ "mesh": 0 }));
            assert_eq!(file.read().meshes[0].indices, expected, "mode {mode}, component {component}");
        }
    }
}

#[test]
fn lines_and_points_are_left_out_with_one_notice() {
    let mut file = Builder::studio();
    let mut primitive = file.json["meshes"][0]["primitives"][0].clone();
    for mode in 0..4 {
        primitive["mode"] = json!(mode);
        file.json["meshes"][0]["primitives"].as_array_mut().unwrap().push(primitive.clone());
    }
    let scene = file.read();
    assert_eq!(scene.notices, ["points and lines are not drawn: mesh 0 primitive 1 and 3 more"]);
    assert_eq!(scene.meshes.len(), 2);
    let mut file = Builder::studio();
    file.json["meshes"][0]["primitives"][0]["attributes"].as_object_mut().unwrap().remove("POSITION");
    assert_eq!(file.read().notices, ["primitives without positions are not drawn: mesh 0 primitive 0"]);
}

#[test]
fn faces_without_normals_are_flat() {
    let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
    let mut file = Builder::new();
    file.mesh(&corners, None, &[0, 2, 1, 0, 1, 3], None);
    file.push("nodes", json!({ "mesh": 0 }));
    let scene = file.read();
    assert_eq!(scene.meshes[0].positions.len(), 6);
    assert_eq!(scene.meshes[0].normals, [[Vec3::NEG_Z; 3], [Vec3::NEG_Y; 3]].concat());
}

#[test]
fn vertices_in_strides_and_out_of_use() {
    // Each position is followed by its normal; of seven only the last three are used, and the first are not numbers.
    let mut vertices = vec![Vec3::NAN; 8];
    for corner in [Vec3::ZERO, Vec3::X, Vec3::Y] {
        vertices.extend([corner, 2.0 * Vec3::Z]);
    }
    let mut file = Builder::new();
    file.mesh(&vertices, None, &[4, 5, 6], None);
    file.set("/bufferViews/0/byteStride", json!(24));
    file.set("/accessors/0/count", json!(7));
    file.push(
        "accessors",
        json!({ "bufferView": 0, "byteOffset": 12, "count": 7, "componentType": 5126, "type": "VEC3" }),
    );
    file.set("/meshes/0/primitives/0/attributes/NORMAL", json!(2));
    file.push("nodes", json!({ "mesh": 0 }));
    let scene = file.read();
    assert_eq!(scene.meshes[0].positions, [Vec3::ZERO, Vec3::X, Vec3::Y]);
    assert_eq!(scene.meshes[0].normals, [Vec3::Z; 3]);
    assert_eq!(scene.meshes[0].indices, [0, 1, 2]);
}
