//! One value of a good file made bad: the error names the place and what is wrong there.

use serde_json::{Value, json};

use super::builder::{Builder, read};

/// The one line that is said of the studio with `value` at `pointer`.
fn error_with(pointer: &str, value: Value) -> String {
    let mut file = Builder::studio();
    file.set(pointer, value);
    let error = read(&file.glb())
        .err()
        .unwrap_or_else(|| panic!("{pointer} = {} is read", file.json.pointer(pointer).unwrap()));
    assert_eq!(error.lines().count(), 1, "{error}");
    assert!(error.starts_with("test.glb: "), "{error}");
    error
}

fn expect(cases: &[(&str, Value, &str, &str)]) {
    for (pointer, value, place, what) in cases {
        let error = error_with(pointer, value.clone());
        assert!(error.contains(place) && error.contains(what), "{pointer} = {value}: {error}");
    }
}

#[test]
fn the_studio_itself_is_read() {
    let scene = Builder::studio().read();
    assert!(scene.notices.is_empty(), "{:?}", scene.notices);
    assert_eq!((scene.cameras.len(), scene.lights.len(), scene.instances.len()), (1, 1, 2));
    assert_eq!(scene.lights[0].polygons[0].normal, -glam::Vec3::Z);
}

#[test]
fn indices_out_of_range() {
    let (position, indices) = ("/meshes/0/primitives/0/attributes/POSITION", "/meshes/1/primitives/0/indices");
    expect(&[
        (position, json!(99), "mesh 0 primitive 0", "no accessor 99"),
        (position, json!(-1), "meshes[0].primitives[0].attributes", "-1"),
        (position, json!(1.5), "meshes[0].primitives[0].attributes", "1.5"),
        (position, json!(4294967296_u64), "index", "4294967296"),
        (indices, json!(99), "mesh 1 \"bulb\" primitive 0", "no accessor 99"),
        ("/meshes/0/primitives/0/attributes/TEXCOORD_0", json!(99), "mesh 0 primitive 0", "no accessor 99"),
        ("/meshes/0/primitives/0/targets", json!([{ "POSITION": 99 }]), "mesh 0 primitive 0", "no accessor 99"),
        ("/meshes/0/primitives/0/material", json!(99), "mesh 0 primitive 0", "no material 99"),
        ("/accessors/1/bufferView", json!(99), "accessor 1", "no bufferView 99"),
        ("/bufferViews/2/buffer", json!(1), "bufferView 2", "no buffer 1"),
        ("/nodes/0/mesh", json!(99), "node 0 \"square\"", "no mesh 99"),
        ("/nodes/1/camera", json!(99), "node 1 \"tripod\"", "no camera 99"),
        ("/nodes/0/skin", json!(0), "node 0 \"square\"", "no skin 0"),
        ("/nodes/0/children", json!([99]), "node 0 \"square\"", "no node 99"),
        ("/scenes/0/nodes", json!([0, 99]), "scene 0", "no node 99"),
        ("/scene", json!(1), "scene", "no scene 1"),
        ("/skins", json!([{ "joints": [99] }]), "skin 0", "no node 99"),
        ("/textures", json!([{ "source": 0 }]), "texture 0", "no image 0"),
        ("/images", json!([{ "bufferView": 99, "mimeType": "image/png" }]), "image 0", "no bufferView 99"),
        ("/materials/0/normalTexture", json!({ "index": 7 }), "material 0 \"felt\"", "no texture 7"),
        (
            "/materials/0/extensions/KHR_materials_sheen/sheenColorTexture",
            json!({ "index": 7 }),
            "material 0 \"felt\"",
            "no texture 7",
        ),
    ]);
}

#[test]
fn trees_that_are_none() {
    expect(&[
        ("/nodes/0/children", json!([0]), "node 0 \"square\"", "cycle"),
        ("/nodes/0/children", json!([2, 2]), "node 2 \"lamp\"", "child of node 0"),
        ("/scenes/0/nodes", json!([]), "test.glb", "no triangles"),
        ("/scenes/0/nodes", json!([1]), "test.glb", "no triangles"),
        ("/scenes", json!([{}]), "test.glb", "no triangles"),
    ]);
    let mut file = Builder::studio();
    file.json["nodes"][0]["children"] = json!([1]);
    file.json["nodes"][1]["children"] = json!([2]);
    file.json["nodes"][2]["children"] = json!([0]);
    assert!(read(&file.glb()).unwrap_err().contains("its own ancestor (a cycle of nodes)"));
    file.json["nodes"][2] = json!({});
    file.json["nodes"][0]["children"] = json!([1, 2]);
    assert!(read(&file.glb()).unwrap_err().contains("node 2: is a child of node 0 and of node 1"));
}

#[test]
fn values_of_the_wrong_type() {
    expect(&[
        (
            "/materials/0/pbrMetallicRoughness/roughnessFactor",
            json!("rough"),
            "materials[0].pbrMetallicRoughness",
            "\"rough\"",
        ),
        (
            "/materials/0/pbrMetallicRoughness/baseColorFactor",
            json!([1, 1]),
            "materials[0].pbrMetallicRoughness",
            "length 2",
        ),
        ("/materials/0/extensions/KHR_materials_sheen", json!(3), "material 0 \"felt\"", "must be an object"),
        (
            "/materials/0/extensions/KHR_materials_sheen/sheenRoughnessFactor",
            json!("rough"),
            "material 0 \"felt\"",
            "KHR_materials_sheen: sheenRoughnessFactor: invalid type: string \"rough\"",
        ),
        (
            "/materials/0/extensions/KHR_materials_sheen/sheenColorFactor",
            json!([1, 1]),
            "material 0 \"felt\"",
            "KHR_materials_sheen: sheenColorFactor",
        ),
        (
            "/materials/0/extensions/KHR_materials_sheen/sheenColorTexture",
            json!(1),
            "material 0 \"felt\"",
            "sheenColorTexture",
        ),
        (
            "/materials/1/extensions/KHR_materials_emissive_strength/emissiveStrength",
            json!("hot"),
            "materials[1]",
            "\"hot\"",
        ),
        ("/materials/1/emissiveFactor", json!("white"), "materials[1].emissiveFactor", "\"white\""),
        ("/materials/0/doubleSided", json!(1), "materials[0].doubleSided", "boolean"),
        ("/materials/0/alphaMode", json!("GLASS"), "material 0 \"felt\"", "alphaMode"),
        ("/cameras/0/perspective/yfov", json!("wide"), "cameras[0].perspective", "\"wide\""),
        ("/cameras/0/perspective", json!(null), "camera 0 \"eye\"", "no such projection"),
        ("/cameras/0/type", json!("fisheye"), "camera 0 \"eye\"", "type"),
        ("/nodes/0/translation", json!([0, 0]), "nodes[0].translation", "length 2"),
        ("/nodes/2/rotation", json!("none"), "nodes[2].rotation", "\"none\""),
        ("/nodes/0/matrix", json!([1, 0]), "nodes[0].matrix", "length"),
        ("/nodes", json!({}), "nodes", "map"),
        ("/meshes/0/primitives", json!(3), "meshes[0].primitives", "3"),
        ("/meshes/0/primitives/0/mode", json!(7), "mesh 0 primitive 0", "mode"),
        ("/accessors/0/type", json!("VEC5"), "accessor 0", "type"),
        ("/accessors/0/componentType", json!(5124), "accessor 0", "componentType"),
        ("/accessors/0/count", json!("four"), "accessors[0].count", "\"four\""),
        ("/asset", json!(3), "asset.version", "missing"),
        ("/asset/version", json!("1.0"), "asset.version", "glTF 1.0"),
        ("/asset/version", json!(2.0), "asset.version", "no text"),
        ("/asset/minVersion", json!("2.1"), "asset.minVersion", "2.1"),
        ("/extensionsRequired", json!(["EXT_vendor_thing"]), "extensionsRequired", "EXT_vendor_thing"),
        ("/extensionsRequired", json!(["KHR_materials_sheen", "X\ny"]), "extensionsRequired", "X\\ny"),
    ]);
}

#[test]
fn values_out_of_range() {
    expect(&[
        ("/materials/1/emissiveFactor", json!([0, 0, 1e39]), "material 1 \"glow\"", "emissiveFactor is inf"),
        (
            "/materials/1/extensions/KHR_materials_emissive_strength/emissiveStrength",
            json!(1e39),
            "material 1 \"glow\"",
            "emissiveStrength is inf",
        ),
        ("/cameras/0/perspective/yfov", json!(-0.5), "camera 0 \"eye\"", "yfov is -0.5"),
        ("/cameras/0/perspective/yfov", json!(0), "camera 0 \"eye\"", "yfov is 0"),
        ("/cameras/0/perspective/yfov", json!(3.15), "camera 0 \"eye\"", "yfov is 3.15"),
        ("/cameras/0/perspective/znear", json!(0), "camera 0 \"eye\"", "znear is 0"),
        ("/cameras/0/perspective/zfar", json!(0.1), "camera 0 \"eye\"", "zfar is 0.1"),
        ("/cameras/0/perspective/aspectRatio", json!(-1), "camera 0 \"eye\"", "aspectRatio is -1"),
        ("/nodes/0/translation", json!([0, 1e39, 0]), "node 0 \"square\"", "reaches 1.00e39 m"),
        ("/nodes/0/scale", json!([1, 1, -1e39]), "node 0 \"square\"", "reaches -1.00e39 m"),
        ("/nodes/0/translation", json!([0, 1e38, 0]), "node 0 \"square\"", "reaches 1.00e38 m"),
        ("/nodes/1/translation", json!([0, 0, 1e30]), "node 1 \"tripod\"", "reaches 1.00e30 m"),
        ("/nodes/2/translation", json!([0, 0, 1e38]), "node 2 \"lamp\"", "reaches"),
        ("/nodes/0/rotation", json!([0, 0, 0, 0]), "node 0 \"square\"", "rotation"),
        ("/nodes/0/rotation", json!([0, 0, 0, 1e39]), "node 0 \"square\"", "rotation"),
        (
            "/nodes/0/matrix",
            json!([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1e39, 0, 1]),
            "node 0 \"square\"",
            "reaches 1.00e39 m",
        ),
        ("/nodes/0/matrix", json!([1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]), "node 0 \"square\"", "last row"),
        (
            "/nodes/2/matrix",
            json!([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]),
            "node 2 \"lamp\"",
            "both a matrix",
        ),
    ]);
}

#[test]
fn orthographic_cameras_out_of_range() {
    let good = json!({ "xmag": 1, "ymag": 1, "znear": 0, "zfar": 10 });
    for (key, value) in [("ymag", 0.0), ("ymag", -1.0), ("xmag", 0.0), ("znear", -1.0), ("zfar", 0.0)] {
        let mut orthographic = good.clone();
        orthographic[key] = json!(value);
        let camera = json!({ "name": "plan", "type": "orthographic", "orthographic": orthographic });
        let error = error_with("/cameras/0", camera);
        assert!(error.contains("camera 0 \"plan\"") && error.contains(&format!("{key} is")), "{error}");
    }
}

#[test]
fn accessors_past_their_bytes() {
    expect(&[
        ("/accessors/0/count", json!(5), "accessor 0", "5 elements"),
        ("/accessors/0/count", json!(u64::MAX), "accessor 0", "elements"),
        ("/accessors/0/count", json!(0), "accessor 0", "count is 0"),
        ("/accessors/0/byteOffset", json!(4), "accessor 0", "4 elements from 4"),
        ("/accessors/0/byteOffset", json!(u64::MAX), "accessor 0", "do not lie"),
        ("/bufferViews/0/byteOffset", json!(u64::MAX), "bufferView 0", "do not lie"),
        ("/bufferViews/0/byteLength", json!(u64::MAX), "bufferView 0", "do not lie"),
        ("/bufferViews/0/byteLength", json!(0), "bufferView 0", "0 bytes"),
        ("/bufferViews/0/byteLength", json!(44), "accessor 0", "bufferView 0's 44 bytes"),
        ("/bufferViews/0/byteStride", json!(8), "accessor 0", "byteStride 8"),
        ("/bufferViews/0/byteStride", json!(16), "accessor 0", "do not lie"),
        ("/bufferViews/0/byteStride", json!(13), "bufferView 0", "byteStride 13"),
        ("/bufferViews/0/byteStride", json!(256), "bufferView 0", "byteStride 256"),
        ("/buffers/0/byteLength", json!(1_u64 << 40), "buffer 0", "byteLength is 1099511627776"),
        ("/buffers/0/byteLength", json!(0), "buffer 0", "byteLength is 0"),
        ("/buffers/0/byteLength", json!(8), "bufferView 0", "buffer 0's 8"),
    ]);
}

#[test]
fn accessors_of_the_wrong_kind() {
    let (indices, values) = (json!({ "bufferView": 0, "componentType": 5125 }), json!({ "bufferView": 0 }));
    let sparse = json!({ "count": 4_000_000_000_u32, "indices": indices, "values": values });
    expect(&[
        ("/accessors/0/type", json!("SCALAR"), "accessor 0", "must be Vec3"),
        ("/accessors/0/componentType", json!(5125), "accessor 0", "must be Vec3 of component type 5126, 5120"),
        ("/accessors/1/type", json!("VEC2"), "accessor 1", "must be Vec3"),
        ("/accessors/2/type", json!("VEC2"), "accessor 2", "do not lie"),
        ("/accessors/2/componentType", json!(5126), "accessor 2", "must be Scalar"),
        ("/accessors/1/count", json!(3), "mesh 0 primitive 0", "4 positions and 3 normals"),
        ("/accessors/0/sparse", sparse, "accessor 0", "sparse"),
        (
            "/accessors/0",
            json!({ "count": 4_000_000_000_u32, "componentType": 5126, "type": "VEC3" }),
            "mesh 0 primitive 0",
            "4000000000 positions and 4 normals",
        ),
        (
            "/accessors/2",
            json!({ "count": 4_000_000_000_u32, "componentType": 5125, "type": "SCALAR" }),
            "mesh 0 primitive 0",
            "share the same accessors",
        ),
    ]);
}

#[test]
fn extensions_that_are_not_served_have_a_way_without_them() {
    for (name, way) in [
        ("EXT_texture_avif", "gltf-transform png --formats avif IN.glb OUT.glb"),
        ("KHR_materials_pbrSpecularGlossiness", "gltf-transform metalrough IN.glb OUT.glb"),
        ("VENDOR_thing", "export the file without it"),
    ] {
        let mut file = Builder::studio();
        file.json["extensionsRequired"] = json!([name]);
        let error = read(&file.glb()).unwrap_err();
        assert!(error.contains(&format!("requires {name}, which is not served; ")) && error.ends_with(way), "{error}");
    }
}
