//! Morph targets at the weights in the file.

use glam::{Mat4, Vec2, Vec3, Vec4};
use serde_json::{Value, json};

use super::attributes::{shaped, textured};
use super::builder::{Builder, read};
use crate::scene::{Mesh, TextureSlot};

/// The square, whose corners the targets move by the deltas, at these weights.
fn morphed(deltas: &[[Vec3; 4]], weights: Value) -> Builder {
    let mut file = Builder::studio();
    let targets: Vec<Value> = deltas.iter().map(|deltas| json!({ "POSITION": file.vectors(deltas) })).collect();
    file.json["meshes"][0]["primitives"][0]["targets"] = json!(targets);
    file.json["meshes"][0]["weights"] = weights;
    file
}

/// The corners of the square.
const CORNERS: [Vec3; 4] =
    [Vec3::new(-1.0, -1.0, 0.0), Vec3::new(1.0, -1.0, 0.0), Vec3::new(1.0, 1.0, 0.0), Vec3::new(-1.0, 1.0, 0.0)];

/// Raises the corners by their index.
const STEPS: [Vec3; 4] = [Vec3::ZERO, Vec3::new(0.0, 0.0, 1.0), Vec3::new(0.0, 0.0, 2.0), Vec3::new(0.0, 0.0, 3.0)];

#[test]
fn positions_are_sums_of_deltas_by_the_meshs_weights_or_the_nodes() {
    let file = morphed(&[STEPS, [Vec3::X; 4]], json!([0.5, -2.0]));
    let at = |file: &Builder, weights: [f32; 2]| {
        let scene = file.read();
        assert!(scene.notices.is_empty(), "{:?}", scene.notices);
        for (corner, base) in CORNERS.into_iter().enumerate() {
            let expected = base + Vec3::new(weights[1], 0.0, weights[0] * corner as f32);
            assert_eq!(scene.meshes[0].positions[corner], expected, "{weights:?}");
        }
    };
    at(&file, [0.5, -2.0]);
    let mut of_node = morphed(&[STEPS, [Vec3::X; 4]], json!([0.5, -2.0]));
    of_node.json["nodes"][0]["weights"] = json!([1, 0]);
    at(&of_node, [1.0, 0.0]);
    of_node.json["nodes"][0]["weights"] = json!([0, 0]);
    at(&of_node, [0.0, 0.0]);
    let mut of_nobody = morphed(&[STEPS, [Vec3::X; 4]], json!([]));
    of_nobody.json["meshes"][0].as_object_mut().unwrap().remove("weights");
    at(&of_nobody, [0.0, 0.0]);
}

#[test]
fn the_same_weights_are_read_once() {
    let mut file = morphed(&[STEPS], json!([0.5]));
    for weights in [json!([0.25]), json!([0.5]), json!([0]), json!([-0.0])] {
        file.push("nodes", json!({ "mesh": 0, "weights": weights }));
    }
    file.json["scenes"][0]["nodes"] = json!([0, 1, 2, 3, 4, 5, 6]);
    let scene = file.read();
    let heights: Vec<f32> = scene.instances.iter().map(|instance| scene.meshes[instance.mesh].positions[3].z).collect();
    assert_eq!(heights, [1.5, 3.0, 0.75, 1.5, 0.0, 0.0]);
    assert_eq!(scene.meshes.len(), 4);
}

#[test]
fn flat_normals_are_those_of_the_morphed_faces_and_others_are_morphed_too() {
    // The far edge is raised by 2 over 2: a slope of 1.
    let slope = [Vec3::ZERO, Vec3::ZERO, Vec3::Z, Vec3::Z];
    let tilted = Vec3::new(0.0, -1.0, 1.0).normalize();
    let mut file = morphed(&[slope], json!([2]));
    file.json["meshes"][0]["primitives"][0]["attributes"].as_object_mut().unwrap().remove("NORMAL");
    // A delta without a normal to add it to.
    file.json["meshes"][0]["primitives"][0]["targets"][0]["NORMAL"] = json!(0);
    let normals = file.read().meshes[0].normals.clone();
    assert!(normals.iter().all(|normal| normal.abs_diff_eq(tilted, 1e-6)), "{normals:?}");
    let mut file = morphed(&[slope], json!([2]));
    let deltas = file.vectors(&[Vec3::new(0.0, -0.5, 0.0); 4]);
    file.json["meshes"][0]["primitives"][0]["targets"][0]["NORMAL"] = json!(deltas);
    let normals = file.read().meshes[0].normals.clone();
    assert!(normals.iter().all(|normal| normal.abs_diff_eq(tilted, 1e-6)), "{normals:?}");
}

#[test]
fn deltas_may_be_sparse_or_zero_and_need_not_be_floats() {
    let mut file = morphed(&[STEPS], json!([1, 1, 1]));
    // Corner 2 alone.
    let replaced = [file.view(&[2]), file.view(bytemuck::bytes_of(&(5.0 * Vec3::X)))];
    let sparse = json!({
        "count": 1,
        "indices": { "bufferView": replaced[0], "componentType": 5121 },
        "values": { "bufferView": replaced[1] },
    });
    let sparse = file.push("accessors", json!({ "count": 4, "componentType": 5126, "type": "VEC3", "sparse": sparse }));
    let zeros = file.push("accessors", json!({ "count": 4, "componentType": 5126, "type": "VEC3" }));
    let targets = &mut file.json["meshes"][0]["primitives"][0]["targets"];
    *targets = json!([{ "POSITION": sparse }, { "POSITION": zeros, "_HEAT": zeros }, {}]);
    let positions = &file.read().meshes[0].positions;
    assert_eq!(positions[..], [CORNERS[0], CORNERS[1], CORNERS[2] + 5.0 * Vec3::X, CORNERS[3]]);
    let mut file = morphed(&[STEPS], json!([2]));
    let bytes: Vec<u8> = [[0i8, 0, 0, 0], [0, 0, 127, 0], [0, 0, -127, 0], [0; 4]]
        .as_flattened()
        .iter()
        .map(|part| part.cast_unsigned())
        .collect();
    let quantized = file.accessor(&bytes, 4, 5120, "VEC3");
    file.json["accessors"][quantized]["normalized"] = json!(true);
    let view = file.json["accessors"][quantized]["bufferView"].as_u64().unwrap() as usize;
    file.json["bufferViews"][view]["byteStride"] = json!(4);
    file.json["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": quantized }]);
    let heights: Vec<f32> = file.read().meshes[0].positions.iter().map(|position| position.z).collect();
    assert_eq!(heights, [0.0, 2.0, -2.0, 0.0]);
}

/// One triangle with all attributes, morphed by a target of all of them at weight one half.
fn half_of_everything() -> (Mesh, Vec<String>) {
    let mut file = Builder::new();
    file.mesh(&[Vec3::ZERO, Vec3::X, Vec3::Y], Some(&[Vec3::Z; 3]), &[0, 1, 2], None);
    let floats =
        |file: &mut Builder, values: &[f32], kind: &str| file.accessor(bytemuck::cast_slice(values), 3, 5126, kind);
    let tangents = floats(&mut file, Vec4::new(1.0, 0.0, 0.0, -1.0).to_array().repeat(3).as_slice(), "VEC4");
    let coords = floats(&mut file, &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0], "VEC2");
    let colors = floats(&mut file, &[1.0, 0.5, 0.25].repeat(3), "VEC3");
    for (name, accessor) in [("TANGENT", tangents), ("TEXCOORD_0", coords), ("COLOR_0", colors)] {
        file.attribute(0, name, accessor);
    }
    let target = json!({
        "POSITION": file.vectors(&[Vec3::Z; 3]),
        "NORMAL": file.vectors(&[2.0 * Vec3::X; 3]),
        "TANGENT": file.vectors(&[Vec3::new(0.0, 2.0, -2.0); 3]),
        "TEXCOORD_0": floats(&mut file, &[0.5; 6], "VEC2"),
        "COLOR_0": floats(&mut file, &[1.0, -0.5, -9.0].repeat(3), "VEC3"),
    });
    file.json["meshes"][0]["primitives"][0]["targets"] = json!([target]);
    shaped(&file, &textured(&[(TextureSlot::Normal, 0)]), &[0.5]).unwrap()
}

#[test]
fn every_attribute_may_be_morphed() {
    let (mesh, notices) = half_of_everything();
    assert_eq!(notices, [""; 0]);
    assert_eq!(mesh.positions[1], Vec3::new(1.0, 0.0, 0.5));
    let normal = Vec3::new(1.0, 0.0, 1.0).normalize();
    assert!(mesh.normals.iter().all(|own| own.abs_diff_eq(normal, 1e-6)), "{:?}", mesh.normals);
    // (1, 1, -1) is perpendicular to the normal already.
    let tangent = Vec3::new(1.0, 1.0, -1.0).normalize().extend(-1.0);
    assert!(mesh.tangents.iter().all(|own| own.abs_diff_eq(tangent, 1e-6)), "{:?}", mesh.tangents);
    assert_eq!(mesh.tex_coords[0], [Vec2::splat(0.25), Vec2::new(1.25, 0.25), Vec2::new(0.25, 1.25)]);
    // Clamped once they are summed; .25 is 16384 of 65535, to the nearest.
    assert_eq!(mesh.colors, [[65535, 16384, 0, 65535]; 3]);
}

#[test]
fn morphing_comes_before_skinning() {
    let mut file = morphed(&[[Vec3::X; 4]], json!([1]));
    file.bind(0, &[[0, 1, 0, 0]; 4], &[[0.5, 0.5, 0.0, 0.0]; 4]);
    let joints = [json!({ "scale": [2, 2, 2] }), json!({ "translation": [0, 0, 4] })];
    let joints = joints.map(|joint| file.push("nodes", joint));
    let skin = file.skin(&joints, &[Mat4::IDENTITY; 2]);
    file.json["nodes"][0]["skin"] = json!(skin);
    let scene = file.read();
    let instance = &scene.instances[0];
    for (corner, base) in CORNERS.into_iter().enumerate() {
        // Half of twice the place, and half of it raised by 4.
        let expected = 1.5 * (base + Vec3::X) + 2.0 * Vec3::Z;
        let found = instance.world_from_mesh.transform_point3(scene.meshes[instance.mesh].positions[corner]);
        assert!(found.abs_diff_eq(expected, 1e-6), "{found} {expected}");
    }
}

#[test]
fn weights_of_another_number_than_targets_go_as_far_as_they_go() {
    let kind = "weights and morph targets of different numbers are paired as far as they go";
    for (weights, height) in [(json!([1]), 3.0), (json!([1, 1, 5]), 6.0), (json!([]), 0.0)] {
        let count = weights.as_array().unwrap().len();
        let scene = morphed(&[STEPS, STEPS], weights).read();
        assert_eq!(scene.meshes[0].positions[3].z, height);
        assert_eq!(scene.notices, [format!("{kind}: {count} and 2 of node 0 \"square\"")]);
    }
    let mut file = Builder::studio();
    file.json["meshes"][0]["weights"] = json!([0.5]);
    assert_eq!(file.read().notices, [format!("{kind}: 1 and 0 of node 0 \"square\"")]);
}

#[test]
fn bad_targets() {
    for (pointer, value, what) in [
        ("/meshes/0/weights", json!([1e39]), "node 0 \"square\": weights holds inf; give finite numbers"),
        ("/meshes/0/primitives/0/targets", json!({}), "mesh 0 primitive 0: targets: invalid type"),
        ("/meshes/0/primitives/0/targets/0", json!([]), "mesh 0 primitive 0: targets: [0]: invalid type"),
        ("/meshes/0/primitives/0/targets/0/POSITION", json!(-1), "targets: [0].POSITION: invalid value"),
        ("/meshes/0/primitives/0/targets/0/POSITION", json!(999), "there is no accessor 999"),
        ("/meshes/0/primitives/0/targets/0/_HEAT", json!(u64::MAX), "there is no accessor 18446744073709551615"),
        ("/meshes/0/primitives/0/targets/0/POSITION", json!(2), "has 4 vertices and 6 POSITION in a morph target"),
        ("/accessors/5/type", json!("VEC4"), "accessor 5: must be Vec3"),
        ("/accessors/5/componentType", json!(5125), "accessor 5: must be Vec3"),
    ] {
        let mut file = morphed(&[[Vec3::X; 4]], json!([1]));
        // Long enough for whatever it is said to be.
        file.view(&[0; 64]);
        file.json["accessors"][5]["bufferView"] = json!(file.json["bufferViews"].as_array().unwrap().len() - 1);
        file.set(pointer, value);
        let error = file.error();
        assert!(error.contains(what), "{error}");
    }
    let mut file = morphed(&[[Vec3::X; 4]], json!([3e38]));
    file.poke(5, 0, &3e38f32.to_le_bytes());
    assert!(file.error().contains("mesh 0 primitive 0: POSITION 0 is morphed past all numbers"));
    let mut file = morphed(&[[Vec3::X; 4]], json!([1]));
    file.poke(5, 16, &f32::NAN.to_le_bytes());
    assert!(file.error().contains("accessor 5: element 1"));
}

#[test]
fn few_bytes_do_not_become_much_work() {
    // Sparse deltas of a few bytes, many of them, for as many vertices as the file has.
    let corners: Vec<Vec3> = (0..30_000).map(|at| Vec3::new((at % 2) as f32, (at % 3) as f32, at as f32)).collect();
    let mut file = Builder::new();
    let indices: Vec<u32> = (0..30_000).collect();
    let mesh = file.mesh(&corners, None, &indices, None);
    let replaced = [file.view(&[0; 4]), file.view(&[0; 12])];
    let sparse = json!({
        "count": 1,
        "indices": { "bufferView": replaced[0], "componentType": 5125 },
        "values": { "bufferView": replaced[1] },
    });
    let accessor = json!({ "count": 30_000, "componentType": 5126, "type": "VEC3", "sparse": sparse });
    let accessor = file.push("accessors", accessor);
    file.json["meshes"][mesh]["primitives"][0]["targets"] = json!(vec![json!({ "POSITION": accessor }); 100_000]);
    file.json["meshes"][mesh]["weights"] = json!(vec![1e-3; 100_000]);
    file.push("nodes", json!({ "mesh": mesh }));
    assert!(file.error().contains("share the same accessors"));
    // Many nodes, each with weights of its own: each is another mesh.
    file.json["meshes"][mesh]["primitives"][0]["targets"] = json!([{ "POSITION": accessor }]);
    let node = |at: usize| json!({ "mesh": mesh, "weights": [1.0 + at as f32] });
    file.json["nodes"] = json!((0..1000).map(node).collect::<Vec<_>>());
    assert!(file.error().contains("share the same accessors"));
    // The same of primitives that are not drawn, and of targets that have many names and no weight.
    let mut points = file.json["meshes"][mesh]["primitives"][0].clone();
    points["mode"] = json!(0);
    let mut undrawn = Builder { json: file.json.clone(), bytes: file.bytes.clone() };
    undrawn.json["meshes"][mesh]["primitives"] = json!(vec![points; 2000]);
    assert!(undrawn.error().contains("share the same accessors"));
    let names = (0..20_000).map(|at| (format!("_{at}"), json!(accessor))).collect::<serde_json::Map<_, _>>();
    undrawn.json["meshes"][mesh]["primitives"] = file.json["meshes"][mesh]["primitives"].clone();
    undrawn.json["meshes"][mesh]["primitives"][0]["targets"] = json!([names, { "POSITION": accessor }]);
    undrawn.json["nodes"] =
        json!((0..1000).map(|at| json!({ "mesh": mesh, "weights": [0.0, 1.0 + at as f32] })).collect::<Vec<_>>());
    assert!(undrawn.error().contains("share the same accessors"));
    // Many nodes share a mesh's long list of weights.
    let mut file = morphed(&[STEPS], json!(vec![1; 100_000]));
    file.json["nodes"] = json!(vec![json!({ "mesh": 0 }); 1000]);
    file.json["scenes"] = json!([]);
    file.json.as_object_mut().unwrap().remove("scene");
    assert!(read(&file.glb()).unwrap_err().contains("share the same accessors"));
}
