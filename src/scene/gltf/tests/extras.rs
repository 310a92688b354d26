//! Skins, morph targets, variants and instances.

use glam::{Mat4, Vec3};
use serde_json::json;

use super::builder::{Builder, read};

/// The studio's square on a skin of two joints, bound where the matrices say.
fn skinned(bound: [Mat4; 2]) -> Builder {
    let mut file = Builder::studio();
    let matrices = bound.map(|matrix| matrix.to_cols_array());
    let matrices = file.accessor(bytemuck::cast_slice(matrices.as_flattened()), 2, 5126, "MAT4");
    let joints = [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0]].map(|at| file.push("nodes", json!({ "translation": at })));
    file.json["skins"] = json!([{ "joints": joints, "inverseBindMatrices": matrices }]);
    file.json["nodes"][0]["skin"] = json!(0);
    file.json["nodes"][0]["translation"] = json!([7, 7, 7]);
    file.json["scenes"][0]["nodes"].as_array_mut().unwrap().extend(joints.map(|joint| json!(joint)));
    file
}

#[test]
fn a_skin_in_its_bind_pose_is_where_its_joints_put_it() {
    let raised = Mat4::from_translation(Vec3::Z);
    let bound = [Vec3::X, 2.0 * Vec3::Y].map(|joint| raised * Mat4::from_translation(-joint));
    let scene = skinned(bound).read();
    assert!(scene.notices.is_empty(), "{:?}", scene.notices);
    assert_eq!(scene.instances[0].world_from_mesh, raised);
    // A skin without matrices is bound at the joints themselves, which stand apart here.
    let mut file = skinned(bound);
    file.json["skins"][0].as_object_mut().unwrap().remove("inverseBindMatrices");
    for file in [file, skinned([Mat4::IDENTITY; 2])] {
        let scene = file.read();
        let kind = "skins whose joints stand in another pose than they were bound in are not applied";
        assert_eq!(scene.notices, [format!("{kind}: node 0 \"square\"")]);
        assert_eq!(scene.instances[0].world_from_mesh, Mat4::from_translation(Vec3::splat(7.0)));
    }
}

#[test]
fn joints_may_be_off_their_pose_by_rounding_and_no_more() {
    for (off, said) in [(2e-5, 0), (2e-3, 1)] {
        let bound = [Vec3::X, Vec3::new(off, 2.0, 0.0)].map(|joint| Mat4::from_translation(-joint));
        assert_eq!(skinned(bound).read().notices.len(), said, "{off}");
    }
}

#[test]
fn bad_skins() {
    for (pointer, value, what) in [
        ("/accessors/5/count", json!(1), "skin 0: has 2 joints and fewer inverseBindMatrices"),
        ("/accessors/5/type", json!("VEC4"), "skin 0: accessor 5: must be Mat4"),
        ("/skins/0/inverseBindMatrices", json!(99), "skin 0: there is no accessor 99"),
    ] {
        let mut file = skinned([Mat4::IDENTITY; 2]);
        file.set(pointer, value);
        let error = read(&file.glb()).unwrap_err();
        assert!(error.contains(what), "{error}");
    }
}

#[test]
fn what_is_not_applied_is_said() {
    let mut file = Builder::studio();
    file.json["meshes"][0]["weights"] = json!([0.5]);
    file.json["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": 0 }]);
    file.json["nodes"][0]["extensions"] = json!({ "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": 0 } } });
    file.json["extensionsUsed"] = json!(["EXT_mesh_gpu_instancing", "KHR_materials_variants"]);
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
            "node extensions that are passed over: EXT_mesh_gpu_instancing of node 0 \"square\"",
            "morph targets are not applied: mesh 0 primitive 0",
        ]
    );
    assert_eq!(scene.materials[scene.meshes[0].material].name, "felt");
}
