//! Broken files: each gives an error in one line that names the place.

use std::time::{Duration, Instant};

use glam::Vec3;
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;
use serde_json::{Value, json};

use super::builder::{Builder, glb, read};

/// A square with a camera beside it and a light of its own.
fn full() -> Builder {
    let mut file = Builder::square();
    let perspective = json!({ "yfov": 0.5, "znear": 0.1, "zfar": 100.0, "aspectRatio": 1.5 });
    let camera = file.push("cameras", json!({ "type": "perspective", "perspective": perspective }));
    file.push("nodes", json!({ "camera": camera, "translation": [0.0, 0.0, 3.0], "rotation": [0.0, 0.0, 0.0, 1.0] }));
    file.push("nodes", json!({ "children": [0, 1], "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] }));
    let sheen = json!({ "sheenColorFactor": [0.5, 0.2, 0.1], "sheenRoughnessFactor": 0.4 });
    file.json["materials"][0]["extensions"] = json!({ "KHR_materials_sheen": sheen });
    let strength = json!({ "KHR_materials_emissive_strength": { "emissiveStrength": 2.5 } });
    let material =
        file.push("materials", json!({ "name": "glow", "emissiveFactor": [1, 1, 1], "extensions": strength }));
    let mesh = file.mesh(&[Vec3::Z, Vec3::X, Vec3::Y], None, &[0, 1, 2], Some(material));
    file.push("nodes", json!({ "name": "lamp", "mesh": mesh }));
    file.json["extensionsRequired"] = json!(["KHR_materials_sheen", "KHR_materials_emissive_strength"]);
    file.json["scenes"] = json!([{ "nodes": [2, 3] }]);
    file.json["scene"] = json!(0);
    file
}

/// The error of a file, which must be one line that begins with the file's name.
fn error(bytes: &[u8], case: &str) -> String {
    let error = match read(bytes) {
        Ok(_) => panic!("{case}: read without an error"),
        Err(error) => error,
    };
    assert!(error.starts_with("test.glb: ") && error.lines().count() == 1, "{error}");
    assert!(error.len() < 400, "{error}");
    error
}

#[test]
fn the_full_file_is_good() {
    let scene = full().read();
    assert_eq!((scene.instances.len(), scene.lights.len(), scene.cameras.len()), (2, 1, 1));
    assert_eq!(scene.notices.len(), 1, "{:?}", scene.notices);
}

/// A value put at a place of the full file, and what its error says.
#[test]
fn broken_values_are_named() {
    #[rustfmt::skip]
    let cases = [
        ("/asset/version", json!("1.0"), "glTF 1.0"),
        ("/asset/version", json!(2.0), "asset.version"),
        ("/asset", Value::Null, "asset"),
        ("/asset/minVersion", json!("2.9"), "needs glTF 2.9"),
        ("/extensionsRequired/0", json!("KHR_materials_unlit"), "KHR_materials_unlit"),
        ("/extensionsRequired/0", json!("KHR_draco_mesh_compression"), "KHR_draco_mesh_compression"),
        ("/scene", json!(1), "scene: index 1 is out of range"),
        ("/scene", json!(-1), "scene: "),
        ("/scenes/0/nodes/0", json!(9), "scenes[0].nodes[0]: index 9 is out of range"),
        ("/scenes/0/nodes/1", json!(2), "lists node 2 twice"),
        ("/scenes/0/nodes/0", json!(1), "node 1 is no root"),
        ("/nodes", json!({}), "nodes"),
        ("/nodes/0/mesh", json!(7), "nodes[0].mesh: index 7 is out of range"),
        ("/nodes/0/mesh", json!(4294967296u64), "nodes[0].mesh: index 4294967296 is out of range"),
        ("/nodes/0/mesh", json!("square"), "nodes[0].mesh: invalid type"),
        ("/nodes/0/mesh", json!(0.5), "nodes[0].mesh: invalid type"),
        ("/nodes/0/skin", json!(0), "nodes[0].skin: index 0 is out of range"),
        ("/nodes/0/name", json!(["a"]), "nodes[0].name"),
        ("/nodes/0/mesh", json!("a".repeat(100_000)), "nodes[0].mesh: invalid type: string \"aaaa"),
        ("/nodes/1/camera", json!(1), "nodes[1].camera: index 1 is out of range"),
        ("/nodes/2/children/1", json!(70), "nodes[2].children[1]: index 70 is out of range"),
        ("/nodes/2/children/1", json!(2), "node 2: is its own ancestor"),
        ("/nodes/2/children/1", json!(0), "node 0 \"square\": is a child of node 2 and of node 2"),
        ("/nodes/2/matrix/5", json!("x"), "nodes[2].matrix[5]"),
        ("/nodes/2/matrix/5", json!(1e39), "node 2: its matrix holds inf"),
        ("/nodes/2/matrix/3", json!(0.5), "node 2: the last row"),
        ("/nodes/2/matrix", json!([1, 2, 3]), "nodes[2].matrix"),
        ("/nodes/2/matrix/12", json!(1e30), "node 1: reaches"),
        ("/nodes/2/matrix/0", json!(1e20), "reaches"),
        ("/nodes/2/translation", json!([0, 0, 0]), "node 2: has both"),
        ("/nodes/1/translation/0", json!(1e39), "node 1: translation is"),
        ("/nodes/1/translation", json!([1e13, 0, 0]), "node 1: reaches"),
        ("/nodes/1/rotation/3", json!(0), "node 1: rotation is a quaternion of length 0"),
        ("/nodes/1/rotation/3", json!(2), "node 1: rotation is a quaternion of length 2"),
        ("/nodes/1/rotation/3", json!(1e39), "node 1: rotation"),
        ("/cameras/0/type", json!("orthographic"), "camera 0: is of type Orthographic"),
        ("/cameras/0/type", json!("fisheye"), "camera 0: its type"),
        ("/cameras/0/perspective/yfov", json!(-0.5), "camera 0: yfov is -0.5"),
        ("/cameras/0/perspective/yfov", json!(0), "camera 0: yfov is 0"),
        ("/cameras/0/perspective/yfov", json!(3.2), "camera 0: yfov is 3.2"),
        ("/cameras/0/perspective/yfov", json!("wide"), "cameras[0].perspective.yfov: invalid type: string \"wide\""),
        ("/cameras/0/perspective/znear", json!(-1), "camera 0: znear is -1"),
        ("/cameras/0/perspective/znear", json!(0), "camera 0: znear is 0"),
        ("/cameras/0/perspective/zfar", json!(0.1), "camera 0: zfar is 0.1"),
        ("/cameras/0/perspective/zfar", json!(1e39), "camera 0: zfar is inf"),
        ("/cameras/0/perspective/aspectRatio", json!(0), "camera 0: aspectRatio"),
        ("/cameras/0/perspective", Value::Null, "camera 0: is of type Perspective"),
        ("/materials/0/pbrMetallicRoughness/roughnessFactor", json!("rough"),
            "materials[0].pbrMetallicRoughness.roughnessFactor: invalid type: string \"rough\""),
        ("/materials/0/pbrMetallicRoughness/roughnessFactor", json!(1.5), "material 0 \"felt\": roughnessFactor is 1.5"),
        ("/materials/0/pbrMetallicRoughness/metallicFactor", json!(-0.1), "material 0 \"felt\": metallicFactor is -0.1"),
        ("/materials/0/pbrMetallicRoughness/baseColorFactor", json!([1, 1, 1.01, 1]), "baseColorFactor is 1.01"),
        ("/materials/0/pbrMetallicRoughness/baseColorFactor", json!([1, 1, 1]), "materials[0].pbrMetallicRoughness.base"),
        ("/materials/0/pbrMetallicRoughness/baseColorTexture", json!({ "index": 3 }), "baseColorTexture.index: index 3"),
        ("/materials/0/alphaMode", json!("GHOST"), "material 0 \"felt\": alphaMode"),
        ("/materials/0/alphaCutoff", json!(-1), "material 0 \"felt\": alphaCutoff is -1"),
        ("/materials/0/doubleSided", json!("yes"), "materials[0].doubleSided"),
        ("/materials/0/extensions/KHR_materials_sheen", json!(3), "KHR_materials_sheen must be an object"),
        ("/materials/0/extensions/KHR_materials_sheen/sheenColorFactor", json!([0.1, 0.2]), "sheenColorFactor is [0.1,0.2]"),
        ("/materials/0/extensions/KHR_materials_sheen/sheenColorFactor/1", json!(1.5), "sheenColorFactor is 1.5"),
        ("/materials/0/extensions/KHR_materials_sheen/sheenRoughnessFactor", json!("x"), "sheenRoughnessFactor is \"x\""),
        ("/materials/0/extensions/KHR_materials_sheen/sheenRoughnessFactor", json!(-0.1), "sheenRoughnessFactor is -0.1"),
        ("/materials/1/emissiveFactor/0", json!(-1), "material 1 \"glow\": emissiveFactor is -1"),
        ("/materials/1/emissiveFactor/0", json!(1.5), "material 1 \"glow\": emissiveFactor is 1.5"),
        ("/materials/1/extensions/KHR_materials_emissive_strength/emissiveStrength", json!(-2), "emissiveStrength is -2"),
        ("/materials/1/extensions/KHR_materials_emissive_strength/emissiveStrength", json!(1e39), "emissiveStrength is inf"),
        ("/materials/1/extensions/KHR_materials_emissive_strength/emissiveStrength", json!("x"), "materials[1].extensions"),
        ("/meshes/0/primitives", Value::Null, "meshes[0]"),
        ("/meshes/0/primitives/0/mode", json!(9), "mesh 0 primitive 0: its mode"),
        ("/meshes/0/primitives/0/mode", json!(4294967300u64), "meshes[0].primitives[0].mode: 4294967300"),
        ("/meshes/0/primitives/0/material", json!(5), "meshes[0].primitives[0].material: index 5"),
        ("/meshes/0/primitives/0/indices", json!(50), "meshes[0].primitives[0].indices: index 50"),
        ("/meshes/0/primitives/0/indices", json!(0), "mesh 0 primitive 0: accessor 0: must be Scalar"),
        ("/meshes/0/primitives/0/attributes/POSITION", json!(99), "meshes[0].primitives[0].attributes.POSITION: index 99"),
        ("/meshes/0/primitives/0/attributes/POSITION", json!(2), "mesh 0 primitive 0: "),
        ("/meshes/0/primitives/0/attributes/NORMAL", json!(3), "mesh 0 primitive 0: has 4 positions and 3 normals"),
        ("/meshes/0/primitives/0/attributes/POSITION", json!(3), "has 3 positions and 4 normals"),
        ("/meshes/0/primitives/0/targets", json!([{ "POSITION": 77 }]), "primitives[0].targets[0].POSITION: index 77"),
        ("/accessors/0/bufferView", json!(9), "accessors[0].bufferView: index 9"),
        ("/accessors/0/bufferView", Value::Null, "accessor 0: has no bufferView"),
        ("/accessors/0/byteOffset", json!(4), "accessor 0: 4 elements from 4 do not lie in bufferView 0's 48 bytes"),
        ("/accessors/0/byteOffset", json!(u64::MAX), "accessor 0: 4 elements from 18446744073709551615"),
        ("/accessors/0/count", json!(5), "accessor 0: 5 elements"),
        ("/accessors/0/count", json!(0), "accessor 0: count is 0"),
        ("/accessors/0/count", json!(-4), "accessors[0].count"),
        ("/accessors/0/count", json!(u64::MAX), "accessor 0: 18446744073709551615 elements"),
        ("/accessors/0/count", json!(1u64 << 60), "accessor 0: 1152921504606846976 elements"),
        ("/accessors/0/type", json!("VEC5"), "accessor 0: its type"),
        ("/accessors/0/type", json!("VEC2"), "accessor 0: must be Vec3"),
        ("/accessors/0/componentType", json!(5124), "accessor 0: its type"),
        ("/accessors/0/componentType", json!(5121), "accessor 0: must be Vec3 of component type 5126"),
        ("/accessors/0/componentType", json!(4294972422u64), "accessors[0].componentType"),
        ("/accessors/0/sparse", json!({ "count": 1, "indices": { "bufferView": 0, "componentType": 5121 },
            "values": { "bufferView": 0 } }), "accessor 0: is sparse"),
        ("/accessors/2/componentType", json!(5126), "accessor 2: must be Scalar of component type 5121, 5123, 5125"),
        ("/bufferViews/0/buffer", json!(1), "bufferViews[0].buffer: index 1"),
        ("/bufferViews/0/byteLength", json!(0), "bufferView 0: 0 bytes"),
        ("/bufferViews/0/byteLength", json!(47), "accessor 0: 4 elements"),
        ("/bufferViews/0/byteLength", json!(u64::MAX), "bufferView 0: 18446744073709551615 bytes"),
        ("/bufferViews/0/byteOffset", json!(u64::MAX), "bufferView 0: 48 bytes from 18446744073709551615"),
        ("/bufferViews/0/byteOffset", json!(1000), "bufferView 0: 48 bytes from 1000"),
        ("/bufferViews/0/byteStride", json!(8), "accessor 0: byteStride 8 is less"),
        ("/bufferViews/0/byteStride", json!(13), "bufferView 0: byteStride 13"),
        ("/bufferViews/0/byteStride", json!(256), "bufferView 0: byteStride 256"),
        ("/bufferViews/0/byteStride", json!(0), "bufferView 0: byteStride 0"),
        ("/bufferViews/0/byteStride", json!(16), "accessor 0: 4 elements"),
        ("/buffers/0/byteLength", json!(1 << 20), "buffer 0: byteLength is 1048576"),
        ("/buffers/0/byteLength", json!(u64::MAX), "buffer 0: byteLength is 18446744073709551615"),
        ("/buffers/0/byteLength", json!(0), "buffer 0: byteLength is 0"),
        ("/buffers/0/uri", json!("data:application/octet-stream;base64,AAA*"), "buffer 0: its data URI is broken"),
        ("/buffers/0/uri", json!("data:text/plain,hello"), "buffer 0: its data URI is not base64"),
        ("/buffers/0/uri", json!("data:nothing"), "buffer 0: its data URI is not base64"),
        ("/buffers/0/uri", json!("data:;base64,AAAA"), "its data is 3 bytes long"),
        ("/buffers/0/uri", json!("square.bin"), "names a file, and this scene has no folder"),
        ("/buffers/1", json!({ "byteLength": 4 }), "buffer 1: has no data"),
    ];
    for (place, value, expected) in cases {
        let mut file = full();
        let (parent, key) = place.rsplit_once('/').unwrap();
        match file.json.pointer_mut(parent).unwrap() {
            Value::Array(list) if key.parse::<usize>().unwrap() == list.len() => list.push(value.clone()),
            Value::Array(list) => list[key.parse::<usize>().unwrap()] = value.clone(),
            parent => parent[key] = value.clone(),
        }
        let error = error(&file.glb(), place);
        assert!(error.contains(expected), "{place} = {value}: {error}");
    }
}

#[test]
fn broken_containers_are_named() {
    let good = full().glb();
    let with = |at: usize, number: u32| {
        let mut bytes = good.clone();
        bytes[at..at + 4].copy_from_slice(&number.to_le_bytes());
        bytes
    };
    let json = u32::from_le_bytes(good[12..16].try_into().unwrap());
    let cases: Vec<(Vec<u8>, &str)> = vec![
        (Vec::new(), "the file is empty"),
        (b"glTF".to_vec(), "cut short (4 bytes of 12)"),
        (b"PNG or something".to_vec(), "not a glTF file"),
        (vec![0xff; 64], "not a glTF file"),
        (b"{".to_vec(), "not a glTF file"),
        (b"[]".to_vec(), "not a glTF file"),
        (b"null".to_vec(), "not a glTF file"),
        (b"{}".to_vec(), "not a glTF file"),
        (b"{\"asset\": 2}".to_vec(), "asset.version"),
        (br#"{"asset":{"version":"2.0"}}"#.to_vec(), "no triangles"),
        (vec![b'['; 1_000_000], "not a glTF file"),
        ([br#"{"asset":{"version":"2.0","#.to_vec(), b"\"x\":[".repeat(10_000)].concat(), "not a glTF file"),
        (with(4, 1), "version 1"),
        (with(8, 0), "says that it is 0 bytes long"),
        (with(8, u32::MAX), "cut short"),
        (with(8, good.len() as u32 + 1), "cut short"),
        (with(12, u32::MAX), "'JSON' chunk is cut short"),
        (with(12, json - 5), "holds a chunk"),
        (with(16, 0x1234_5678), "holds a chunk"),
        (with(20 + json as usize, u32::MAX), "chunk is cut short"),
        (with(24 + json as usize, 0), "holds a chunk"),
        (good[..good.len() / 2].to_vec(), "cut short"),
        (glb(b"", b""), "not a glTF file"),
    ];
    for (bytes, expected) in cases {
        let error = error(&bytes, expected);
        assert!(error.contains(expected), "{expected}: {error}");
    }
    for length in 0..good.len() {
        error(&good[..length], "cut");
    }
}

#[test]
fn broken_geometry_is_named() {
    let triangle = [Vec3::ZERO, Vec3::X, Vec3::Y];
    let geometry = |positions: &[Vec3], normals: &[Vec3], indices: &[u32], emission: f32| {
        let mut file = Builder::new();
        let material = file.push("materials", json!({ "emissiveFactor": [emission, 0, 0] }));
        let mesh = file.mesh(positions, Some(normals), indices, Some(material));
        file.push("nodes", json!({ "mesh": mesh }));
        read(&file.glb()).map(|_| ())
    };
    for emission in [0.0, 1.0] {
        assert!(geometry(&triangle, &[Vec3::Z; 3], &[0, 1, 2], emission).is_ok());
        for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let broken = [Vec3::ZERO, Vec3::X, Vec3::new(0.0, value, 0.0)];
            let error = geometry(&broken, &[Vec3::Z; 3], &[0, 1, 2], emission).unwrap_err();
            assert!(error.contains("mesh 0 primitive 0: accessor 0: element 2 is"), "{error}");
            let error = geometry(&triangle, &broken, &[0, 1, 2], emission).unwrap_err();
            assert!(error.contains("mesh 0 primitive 0: accessor 1: element 2 is"), "{error}");
        }
        let error = geometry(&triangle, &[Vec3::Z; 3], &[0, 1, 3], emission).unwrap_err();
        assert!(error.contains("mesh 0 primitive 0: index 2 is 3, past its 3 vertices"), "{error}");
        assert!(geometry(&triangle, &[Vec3::Z; 3], &[0, 1, u32::MAX], emission).is_err());
        let error = geometry(&triangle.map(|p| 1e20 * p), &[Vec3::Z; 3], &[0, 1, 2], emission).unwrap_err();
        assert!(error.contains("node 0: reaches"), "{error}");
        // On one line, and on one point: nothing to draw.
        for flat in [[Vec3::ZERO, Vec3::X, 2.0 * Vec3::X], [Vec3::ONE; 3]] {
            assert!(geometry(&flat, &[Vec3::Z; 3], &[0, 1, 2], emission).unwrap_err().contains("no triangles"));
        }
        assert!(geometry(&triangle, &[Vec3::Z; 3], &[0, 1], emission).unwrap_err().contains("no triangles"));
    }
}

#[test]
fn chains_and_cycles_of_nodes_end() {
    let chain = |count: usize, last: Value, scale: f32| {
        let mut file = Builder::square();
        let mut nodes: Vec<Value> =
            (1..count).map(|child| json!({ "children": [child], "scale": [scale, 1, 1] })).collect();
        nodes.push(last);
        file.json["nodes"] = Value::Array(nodes);
        file
    };
    let start = Instant::now();
    let deep = 1_000_000;
    assert_eq!(chain(deep, json!({ "mesh": 0 }), 1.0).read().instances[0].name, "");
    let round = chain(100_000, json!({ "mesh": 0, "children": [0] }), 1.0);
    assert!(error(&round.glb(), "bounds").contains("node 0: is its own ancestor"));
    // Their transforms overflow or vanish.
    assert!(error(&chain(1000, json!({ "mesh": 0 }), 10.0).glb(), "chain").contains("node 999: reaches"));
    assert!(error(&chain(1000, json!({ "mesh": 0 }), 0.1).glb(), "chain").contains("no triangles"));
    // More than is served, and with each node at every place of a binary tree of 2^100 leaves.
    assert!(error(&chain((1 << 20) + 1, json!({ "mesh": 0 }), 1.0).glb(), "chain").contains("at most 1048576"));
    let mut tree = Builder::square();
    tree.json["nodes"] = (1..100).map(|child| json!({ "children": [child, child], "mesh": 0 })).collect();
    tree.push("nodes", json!({ "mesh": 0 }));
    assert!(error(&tree.glb(), "bounds").contains("nodes must make trees"));
    assert!(start.elapsed() < Duration::from_secs(120), "{:?}", start.elapsed());
}

#[test]
fn a_few_bytes_do_not_ask_for_much_memory() {
    // A grid that a thousand primitives draw.
    let positions: Vec<Vec3> = (0..3 << 16).map(|i| Vec3::new(i as f32, (i % 7) as f32, 0.0)).collect();
    let indices: Vec<u32> = (0..positions.len() as u32).collect();
    let mut file = Builder::new();
    let mesh = file.mesh(&positions, None, &indices, None);
    let primitive = file.json["meshes"][mesh]["primitives"][0].clone();
    file.json["meshes"][mesh]["primitives"] = vec![primitive; 1000].into();
    file.push("nodes", json!({ "mesh": mesh }));
    assert!(error(&file.glb(), "bounds").contains("share the same accessors"));
    // And a mesh of a thousand primitives at thousands of nodes.
    let mut file = Builder::square();
    let primitive = file.json["meshes"][0]["primitives"][0].clone();
    file.json["meshes"][0]["primitives"] = vec![primitive; 2000].into();
    file.json["nodes"] = vec![json!({ "mesh": 0 }); 1000].into();
    assert!(error(&file.glb(), "bounds").contains("more than 1048576 primitives at nodes"));
}

#[test]
fn compression_is_named_where_there_is_nothing_else() {
    let mut file = full();
    file.json["meshes"][0]["primitives"][0]["extensions"] = json!({ "KHR_draco_mesh_compression": {} });
    assert!(read(&file.glb()).is_ok());
    file.json["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    assert!(error(&file.glb(), "draco").contains("compressed by KHR_draco_mesh_compression"));
}

#[test]
fn names_cannot_break_the_line() {
    let mut file = full();
    file.json["materials"][0]["name"] = json!("two\nlines \u{2028}\u{1b}[31m".repeat(100));
    file.json["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = json!(2);
    let error = error(&file.glb(), "bounds");
    assert!(!error.contains(char::is_control) && error.contains("roughnessFactor is 2"), "{error}");
    file.json["materials"][0]["pbrMetallicRoughness"] = json!({ "metallicFactor": 1 });
    assert!(file.read().notices.iter().all(|notice| !notice.contains(char::is_control)));
}

/// Every mutation of a good file is read or refused; what is read is whole (`read` checks it).
#[test]
fn mutated_files_are_read_or_refused() {
    let good = full();
    let bytes = good.glb();
    let mut random = Pcg64::seed_from_u64(3);
    let start = Instant::now();
    let mut refused = 0;
    for _ in 0..3000 {
        let mut mutated = bytes.clone();
        for _ in 0..random.random_range(1..4) {
            let at = random.random_range(0..mutated.len());
            mutated[at] = match random.random_range(0..3) {
                0 => mutated[at] ^ 1 << random.random_range(0..8),
                1 => random.random(),
                _ => b"0123456789-.eE\"{}[],"[random.random_range(0..20)],
            };
        }
        refused += usize::from(read(&mutated).is_err());
    }
    for _ in 0..3000 {
        let mut file = full();
        for _ in 0..random.random_range(1..3) {
            mutate(&mut file.json, &mut random);
        }
        refused += usize::from(read(&file.glb()).is_err());
    }
    // Neither all nor none: the mutations are neither too coarse nor too fine.
    assert!((1000..5800).contains(&refused), "{refused} of 6000 refused");
    assert!(start.elapsed() < Duration::from_secs(120), "{:?}", start.elapsed());
}

/// Changes one value somewhere in the tree.
fn mutate(value: &mut Value, random: &mut impl Rng) {
    match value {
        Value::Object(members) if !members.is_empty() && random.random_bool(0.95) => {
            let at = random.random_range(0..members.len());
            mutate(members.values_mut().nth(at).unwrap(), random);
        }
        Value::Array(elements) if !elements.is_empty() && random.random_bool(0.95) => {
            let at = random.random_range(0..elements.len());
            mutate(&mut elements[at], random);
        }
        value => {
            let odd = [
                json!(0),
                json!(-1),
                json!(1),
                json!(2),
                json!(3),
                json!(0.5),
                json!(-1e-30),
                json!(1e30),
                json!(1e39),
                json!(5),
                json!(5121),
                json!(5123),
                json!(5126),
                json!(u32::MAX),
                json!(u64::MAX),
                json!(i64::MIN),
                json!("x"),
                json!(""),
                json!(true),
                json!(null),
                json!([]),
                json!({}),
                json!([[[]]]),
                json!("VEC3"),
            ];
            *value = odd[random.random_range(0..odd.len())].clone();
        }
    }
}
