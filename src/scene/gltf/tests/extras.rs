//! Variants and animations.

use serde_json::json;

use super::builder::Builder;

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
