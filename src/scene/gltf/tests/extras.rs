//! Variants, animations and compressed data.

use serde_json::json;

use super::builder::{Builder, read};

#[test]
fn what_is_not_applied_is_said() {
    let mut file = Builder::studio();
    file.json["nodes"][0]["extensions"] = json!({ "EXT_vendor_thing": {} });
    file.json["extensionsUsed"] = json!(["EXT_vendor_thing", "KHR_materials_variants"]);
    // What they hold is not looked at.
    file.json["animations"] = json!([{}, 7, { "channels": [{ "sampler": -1 }] }]);
    file.json["extensionsRequired"] = json!(["KHR_materials_variants", "KHR_mesh_quantization"]);
    file.json["extensions"] = json!({ "KHR_materials_variants": { "variants": [{ "name": "red" }] } });
    // Mappings are not followed, and need not lead anywhere.
    let variants = json!({ "mappings": [{ "material": 99, "variants": [7, -1] }, 3] });
    file.json["meshes"][0]["primitives"][0]["extensions"] = json!({ "KHR_materials_variants": variants });
    let scene = file.read();
    assert_eq!(
        scene.notices,
        [
            "material variants: the default one is drawn: KHR_materials_variants",
            "node extensions that are passed over: EXT_vendor_thing of node 0 \"square\"",
            "animations are not played; nodes stand where the file puts them: animation 0 and 2 more",
        ]
    );
    assert_eq!(scene.materials[scene.meshes[0].material].name, "felt");
}

#[test]
fn compressed_data_is_named_and_what_stands_beside_it_is_read() {
    let mut file = Builder::studio();
    let draco = json!({ "KHR_draco_mesh_compression": { "bufferView": 0, "attributes": { "POSITION": 0 } } });
    file.json["meshes"][0]["primitives"][0]["extensions"] = draco;
    assert_eq!(file.read().notices, [""; 0]);
    file.json["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    let error = read(&file.glb()).unwrap_err();
    assert!(error.contains("mesh 0 primitive 0: is compressed by KHR_draco_mesh_compression"), "{error}");
    // The fallback of meshopt is a buffer without data, or with it.
    let mut file = Builder::studio();
    let meshopt = json!({ "EXT_meshopt_compression": { "buffer": 0, "byteLength": 4, "byteStride": 4, "count": 1 } });
    file.json["bufferViews"][0]["extensions"] = meshopt;
    assert_eq!(file.read().notices, [""; 0]);
    let fallback = json!({ "byteLength": 48, "extensions": { "EXT_meshopt_compression": { "fallback": true } } });
    file.push("buffers", fallback);
    file.json["bufferViews"][0]["buffer"] = json!(1);
    let error = read(&file.glb()).unwrap_err();
    assert!(error.contains("buffer 1: has no data (EXT_meshopt_compression)"), "{error}");
    for name in ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "EXT_vendor_thing"] {
        let mut file = Builder::studio();
        file.json["extensionsRequired"] = json!([name]);
        assert!(read(&file.glb()).unwrap_err().contains(&format!("requires {name}")));
    }
}
