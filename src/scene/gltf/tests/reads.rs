//! What is read of a file.

use std::f32::consts::FRAC_1_SQRT_2;

use glam::{Mat4, Quat, Vec3};
use serde_json::{Value, json};

use super::builder::{Builder, read};
use crate::scene::{Mesh, Projection, Scene};

/// Reads one primitive with `indices` of a component type, or none, over corners of a regular hexagon.
fn hexagon(mode: u32, indices: Option<(&[u8], usize, u32)>, normals: bool) -> Option<Mesh> {
    let corner = |i: u8| Quat::from_rotation_z(f32::from(i) * std::f32::consts::FRAC_PI_3) * Vec3::X;
    let positions: Vec<Vec3> = (0..6).map(corner).collect();
    let mut file = Builder::square();
    let mut primitive = json!({ "mode": mode, "attributes": { "POSITION": file.vectors(&positions) } });
    if normals {
        primitive["attributes"]["NORMAL"] = json!(file.vectors(&[2.0 * Vec3::Z; 6]));
    }
    if let Some((bytes, count, component)) = indices {
        primitive["indices"] = json!(file.accessor(bytes, count, component, "SCALAR"));
    }
    let mesh = file.push("meshes", json!({ "name": "hexagon", "primitives": [primitive] }));
    file.push("nodes", json!({ "mesh": mesh }));
    file.read().meshes.into_iter().find(|mesh| mesh.name.contains("hexagon"))
}

/// The corners of each triangle, in sixths of a turn.
fn sixths(mesh: &Mesh) -> Vec<[u32; 3]> {
    let sixth = |&index: &u32| {
        let position = mesh.positions[index as usize];
        (position.y.atan2(position.x) / std::f32::consts::FRAC_PI_3).round().rem_euclid(6.0) as u32
    };
    mesh.indices.chunks_exact(3).map(|triangle| [0, 1, 2].map(|i| sixth(&triangle[i]))).collect()
}

#[test]
fn a_square_is_read_framed_and_lit() {
    let file = Builder::square();
    for bytes in [file.glb(), file.gltf()] {
        let scene = read(&bytes).unwrap();
        assert_eq!(scene.instances[0].name, "square");
        assert_eq!(scene.meshes[0].name, "mesh 0 primitive 0");
        assert_eq!(scene.meshes[0].indices, [0, 1, 2, 0, 2, 3]);
        assert_eq!(scene.materials[0].name, "felt");
        assert_eq!((scene.cameras.len(), scene.lights.len()), (1, 3));
        let [camera, light] = &scene.notices[..] else { panic!("{:?}", scene.notices) };
        assert!(camera.starts_with("no camera") && light.starts_with("no light"));
    }
}

#[test]
fn every_mode_and_index_type_gives_its_triangles() {
    let whole = [[0, 1, 2], [3, 4, 5]];
    let strip = [[0, 1, 2], [1, 3, 2], [2, 3, 4], [3, 5, 4]];
    let fan = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]];
    for normals in [false, true] {
        for (mode, expected) in [(4, &whole[..]), (5, &strip), (6, &fan)] {
            let bytes = [0u8, 1, 2, 3, 4, 5];
            let shorts = bytes.map(u16::from);
            let words = bytes.map(u32::from);
            let all = [
                None,
                Some((&bytes[..], 6, 5121)),
                Some((bytemuck::cast_slice(&shorts), 6, 5123)),
                Some((bytemuck::cast_slice(&words), 6, 5125)),
            ];
            for indices in all {
                let mesh = hexagon(mode, indices, normals).unwrap();
                assert_eq!(sixths(&mesh), expected);
                // Normals of the file, made unit, or flat ones, which follow the winding.
                let flat = expected.iter().flat_map(|&[a, b, c]| [if (a < b) == (b < c) { 1.0 } else { -1.0 }; 3]);
                let expected_normals = if normals { vec![1.0; 6] } else { flat.collect() };
                assert_eq!(mesh.normals, expected_normals.iter().map(|&z| z * Vec3::Z).collect::<Vec<_>>());
            }
        }
    }
    assert!((0..4).all(|mode| hexagon(mode, None, true).is_none()));
}

#[test]
fn vertices_that_nothing_uses_are_left_out() {
    let mesh = hexagon(4, Some((&[5, 1, 3], 3, 5121)), true).unwrap();
    assert_eq!((mesh.positions.len(), &mesh.indices[..]), (3, &[2, 0, 1][..]));
    assert_eq!(sixths(&mesh), [[5, 1, 3]]);
    // An incomplete triangle at the end, and one without an area.
    let mesh = hexagon(4, Some((&[0, 1, 2, 3, 3, 4, 5, 0], 8, 5121)), true).unwrap();
    assert_eq!(sixths(&mesh), [[0, 1, 2]]);
}

#[test]
fn normals_of_no_length_are_replaced() {
    let mut file = Builder::new();
    let mesh = file.mesh(&[Vec3::ZERO, Vec3::Y, Vec3::Z], Some(&[Vec3::ZERO, -Vec3::X, Vec3::ZERO]), &[0, 1, 2], None);
    file.push("nodes", json!({ "mesh": mesh }));
    let scene = file.read();
    assert_eq!(scene.meshes[0].normals, [Vec3::X, -Vec3::X, Vec3::X]);
    assert!(scene.notices.iter().any(|notice| notice.starts_with("normals of no length")), "{:?}", scene.notices);
}

#[test]
fn nodes_place_meshes() {
    let mut file = Builder::square();
    file.json["nodes"] = json!([
        { "children": [1], "translation": [1, 2, 3], "rotation": [0, 0, FRAC_1_SQRT_2, FRAC_1_SQRT_2], "scale": [2, 1, 1] },
        { "mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 0, 0, 1] },
        { "mesh": 0, "scale": [-1, 1, 1] },
        { "mesh": 0, "scale": [1, 0, 1] },
    ]);
    let scene = file.read();
    assert_eq!(scene.meshes.len(), 1 + 3, "one mesh, whatever its nodes, and the rig's");
    let place = |index: usize, point: Vec3| scene.instances[index].world_from_mesh.transform_point3(point);
    // (x + 10, y) doubled in x, turned by a quarter, moved.
    assert!(place(0, Vec3::new(1.0, 5.0, 7.0)).abs_diff_eq(Vec3::new(1.0 - 5.0, 2.0 + 22.0, 10.0), 1e-5));
    assert_eq!(scene.instances[1].world_from_mesh, Mat4::from_scale(Vec3::new(-1.0, 1.0, 1.0)));
    assert!(!scene.instances[0].mirrors() && scene.instances[1].mirrors());
    // What is scaled to nothing draws nothing.
    assert_eq!(scene.instances.iter().filter(|instance| instance.mesh == 0).count(), 2);
}

#[test]
fn normals_follow_any_scale() {
    let mut file = Builder::square();
    let scales = [[1.0, 1.0, 1.0], [2.0, 1.0, 0.25], [1e-12, 1e-12, 1e-12], [-1.0, 1.0, 1e9], [1e-9, 1e9, 1.0]];
    file.json["nodes"] = scales.iter().map(|scale| json!({ "mesh": 0, "scale": scale })).collect();
    let scene = file.read();
    for (instance, [x, y, z]) in scene.instances.iter().zip(scales) {
        let normal = Vec3::new(1.0, 2.0, 3.0).normalize();
        let found = (instance.world_from_normal() * normal).as_dvec3().normalize();
        let expected = (normal.as_dvec3() / glam::Vec3::new(x, y, z).as_dvec3()).normalize();
        // Entries far below the largest one may be rounded to nothing.
        assert!(found.abs_diff_eq(expected, 1e-6), "{found} for {expected}");
    }
}

#[test]
fn the_default_scene_is_drawn() {
    let drawn = |scenes: Value, scene: Value| {
        let mut file = Builder::square();
        file.push("nodes", json!({ "name": "other", "mesh": 0 }));
        for (key, value) in [("scenes", scenes), ("scene", scene)] {
            if !value.is_null() {
                file.json[key] = value;
            }
        }
        let names = |scene: Scene| scene.instances.into_iter().map(|instance| instance.name);
        names(file.read()).filter(|name| !name.contains("light")).collect::<Vec<_>>()
    };
    let scenes = json!([{ "nodes": [0] }, { "nodes": [1] }]);
    assert_eq!(drawn(scenes.clone(), json!(1)), ["other"]);
    assert_eq!(drawn(scenes, Value::Null), ["square"]);
    assert_eq!(drawn(Value::Null, Value::Null), ["square", "other"]);
    assert_eq!(drawn(json!([{ "nodes": [1, 0] }, {}]), Value::Null), ["other", "square"]);
}

#[test]
fn materials_have_gltf_s_defaults() {
    let mut file = Builder::square();
    let sheen = json!({ "KHR_materials_sheen": { "sheenColorFactor": [0.1, 0.2, 0.3], "sheenRoughnessFactor": 0.25 } });
    let pbr = json!({ "baseColorFactor": [0.5, 0.25, 0.75, 1], "metallicFactor": 0 });
    file.push("materials", json!({ "pbrMetallicRoughness": pbr, "extensions": sheen, "doubleSided": true }));
    file.push("materials", json!({ "extensions": { "KHR_materials_sheen": {} } }));
    file.json["meshes"][0]["primitives"][0].as_object_mut().unwrap().remove("material");
    let scene = file.read();
    let full = &scene.materials[1];
    assert_eq!((full.base_color, full.double_sided), (Vec3::new(0.5, 0.25, 0.75), true));
    let sheen = full.sheen.unwrap();
    assert_eq!((sheen.color, sheen.roughness), (Vec3::new(0.1, 0.2, 0.3), 0.25));
    let sheen = scene.materials[2].sheen.unwrap();
    assert_eq!((sheen.color, sheen.roughness), (Vec3::ZERO, 0.0));
    let default = &scene.materials[scene.meshes[0].material];
    assert_eq!((default.base_color, default.sheen, default.double_sided), (Vec3::ONE, None, false));
    assert_eq!((default.emission, &default.name[..]), (Vec3::ZERO, "default"));
}

#[test]
fn emission_makes_a_light() {
    let mut file = Builder::square();
    file.json["materials"][0]["emissiveFactor"] = json!([1.0, 0.5, 0.0]);
    file.json["materials"][0]["extensions"] = json!({ "KHR_materials_emissive_strength": { "emissiveStrength": 8.0 } });
    file.json["nodes"][0]["scale"] = json!([1, 1, -3]);
    let scene = file.read();
    let [light] = &scene.lights[..] else { panic!("{:?}", scene.lights) };
    assert_eq!((light.radiance, light.two_sided, light.instance), (Vec3::new(8.0, 4.0, 0.0), false, 0));
    assert_eq!(light.name, "square");
    let [polygon] = &light.polygons[..] else { panic!("{:?}", light.polygons) };
    // Mirrored: the front looks the other way.
    assert_eq!((polygon.normal, polygon.contours.len(), polygon.contours[0].len()), (-Vec3::Z, 1, 4));
    // A factor or a strength of zero is no light, and leaves the file without any.
    file.json["materials"][0]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = json!(0.0);
    assert_eq!(file.read().lights.len(), 3);
}

#[test]
fn an_emitter_of_many_parts_glows_but_lights_nothing() {
    let lights = |count: u16| {
        let mut file = Builder::new();
        let material = file.push("materials", json!({ "emissiveFactor": [1, 1, 1], "doubleSided": true }));
        let shift = |i: u16| Vec3::new(2.0 * f32::from(i), 0.0, 0.0);
        let triangle = |i| [shift(i), shift(i) + Vec3::X, shift(i) + Vec3::Y];
        let positions: Vec<Vec3> = (0..count).flat_map(triangle).collect();
        let indices: Vec<u32> = (0..positions.len() as u32).collect();
        let mesh = file.mesh(&positions, None, &indices, Some(material));
        file.push("nodes", json!({ "mesh": mesh }));
        file.read()
    };
    let scene = lights(256);
    assert_eq!((scene.lights.len(), scene.lights[0].polygons.len(), scene.lights[0].two_sided), (1, 256, true));
    let scene = lights(257);
    assert!(scene.lights.is_empty());
    assert!(scene.notices.iter().any(|notice| notice.contains("glow but light nothing")), "{:?}", scene.notices);
}

#[test]
fn cameras_keep_the_order_of_the_file() {
    let mut file = Builder::square();
    let near = json!({ "name": "near", "type": "perspective", "perspective": { "yfov": 0.5, "znear": 0.1 } });
    let flat = json!({ "xmag": 2.0, "ymag": 1.5, "znear": 0.0, "zfar": 9.0 });
    file.push("cameras", near);
    file.push("cameras", json!({ "type": "orthographic", "orthographic": flat }));
    file.push("nodes", json!({ "name": "1", "camera": 1, "rotation": [0.0, 1.0, 0.0, 0.0] }));
    // Scaled, sheared and mirrored: looks along its -z nevertheless.
    let matrix = [2.0, 1.0, 0.0, 0.0, 0.5, 3.0, 0.0, 0.0, 0.0, 0.0, -4.0, 0.0, 0.0, 0.0, 3.0, 1.0];
    file.push("nodes", json!({ "name": "node", "camera": 0, "matrix": matrix }));
    file.push("nodes", json!({ "name": "hidden", "camera": 0, "scale": [0, 0, 0] }));
    let scene = file.read();
    assert_eq!(scene.cameras.len(), 2);
    let near = scene.camera("near").unwrap();
    assert_eq!(near.projection, Projection::Perspective { yfov: 0.5, near: 0.1, far: f32::INFINITY });
    let axes = near.world_from_camera;
    assert_eq!((axes.z_axis.truncate(), axes.w_axis.truncate()), (-Vec3::Z, Vec3::new(0.0, 0.0, 3.0)));
    assert!(axes.y_axis.truncate().abs_diff_eq(Vec3::new(0.5, 3.0, 0.0).normalize(), 1e-6));
    // By name before by index.
    let flat = scene.camera("1").unwrap();
    assert_eq!(flat.projection, Projection::Orthographic { ymag: 1.5, near: 0.0, far: 9.0 });
    assert_eq!(scene.camera("0").unwrap().name, "near");
    assert!(["2", "far", "-1", ""].iter().all(|wanted| scene.camera(wanted).is_none()));
    assert!(scene.notices.iter().any(|notice| notice.starts_with("cameras without a direction")));
}

#[test]
fn what_is_not_drawn_is_noted_once_a_kind() {
    let mut file = Builder::square();
    file.json["images"] = json!([{ "uri": "missing.png" }]);
    file.json["textures"] = json!([{ "source": 0 }]);
    file.json["skins"] = json!([{ "joints": [0] }]);
    file.json["nodes"][0]["skin"] = json!(0);
    file.json["extensionsUsed"] = json!(["KHR_lights_punctual", "KHR_materials_sheen"]);
    let texture = json!({ "index": 0 });
    file.json["materials"][0] = json!({
        "name": "felt", "pbrMetallicRoughness": { "baseColorTexture": texture }, "normalTexture": texture,
        "alphaMode": "BLEND", "extensions": { "KHR_materials_clearcoat": { "clearcoatFactor": 1 } },
    });
    file.json["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": 0 }]);
    let notices = file.read().notices;
    for expected in [
        "textures are not drawn yet, only the factors beside them: baseColorTexture of material 0 \"felt\" and 1 more",
        "metals are drawn with their base color as a diffuse one: material 0 \"felt\"",
        "transparent materials are drawn opaque: material 0 \"felt\"",
        "extensions that are not served are passed over: KHR_lights_punctual, KHR_materials_clearcoat",
        "morph targets are not applied: mesh 0 primitive 0",
        "skins are not applied: node 0 \"square\"",
    ] {
        assert_eq!(notices.iter().filter(|notice| *notice == expected).count(), 1, "{expected}: {notices:?}");
    }
    assert_eq!(notices.len(), 6 + 2, "{notices:?}");
}
