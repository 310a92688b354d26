//! Files that break the specification where what was meant is plain: drawn, with one notice a kind.

use glam::Vec3;
use image::ImageFormat;
use serde_json::{Value, json};

use super::builder::{Builder, picture, read};
use crate::scene::{PunctualKind, Scene};

/// The studio with `value` at `pointer`, and the one notice about it.
fn mended(pointer: &str, value: Value) -> (Scene, String) {
    let mut file = Builder::studio();
    file.set(pointer, value);
    let scene = file.read();
    let [notice] = &scene.notices[..] else { panic!("{pointer}: {:?}", scene.notices) };
    let notice = notice.clone();
    (scene, notice)
}

#[test]
fn factors_past_their_range_are_the_nearest_in_it() {
    let sheen = "/materials/0/extensions/KHR_materials_sheen";
    let (scene, notice) = mended(&format!("{sheen}/sheenRoughnessFactor"), json!(1.0000001));
    assert_eq!(scene.materials[0].sheen.unwrap().roughness, 1.0);
    let kind = "factors past their range are taken as the nearest in it";
    assert_eq!(notice, format!("{kind}: sheenRoughnessFactor 1.0000001 of material 0 \"felt\""));
    let (scene, notice) = mended(&format!("{sheen}/sheenColorFactor"), json!([-0.5, 1e39, 0.25]));
    assert_eq!(scene.materials[0].sheen.unwrap().color, Vec3::new(0.0, 1.0, 0.25));
    assert!(notice.starts_with(kind), "{notice}");
    let pbr = "/materials/0/pbrMetallicRoughness";
    let material = |pointer: &str, value| mended(pointer, value).0.materials.swap_remove(0);
    assert_eq!(material(&format!("{pbr}/roughnessFactor"), json!(1.5)).roughness, 1.0);
    assert_eq!(material(&format!("{pbr}/metallicFactor"), json!(-3)).metallic, 0.0);
    let colored = material(&format!("{pbr}/baseColorFactor"), json!([2, 0.5, -1, 1.5]));
    assert_eq!((colored.base_color, colored.opacity), (Vec3::new(1.0, 0.5, 0.0), 1.0));
    let specular = "/materials/0/extensions/KHR_materials_specular";
    assert_eq!(material(specular, json!({ "specularFactor": 4 })).specular, 1.0);
    let tinted = material(specular, json!({ "specularColorFactor": [-1, 2, 0] }));
    assert_eq!(tinted.specular_color, Vec3::new(0.0, 2.0, 0.0));
    let fuzz = json!({ "fuzzFactor": 2, "fuzzColorFactor": [2, 0, 0], "fuzzRoughnessFactor": -1 });
    let (scene, notice) = mended("/materials/0/extensions/KHR_materials_fuzz", fuzz);
    let fuzz = scene.materials[0].sheen.unwrap();
    assert_eq!((fuzz.weight, fuzz.color, fuzz.roughness), (1.0, Vec3::X, 0.0));
    assert!(notice.ends_with("and 2 more"), "{notice}");
}

#[test]
fn a_strong_emissive_factor_is_a_strength() {
    let (scene, notice) = mended("/materials/1/emissiveFactor", json!([5, 2.5, 0]));
    assert_eq!(notice, "an emissiveFactor past 1 is taken as a strength: material 1 \"glow\"");
    let mut file = Builder::studio();
    file.set("/materials/1/emissiveFactor", json!([1, 0.5, 0]));
    let usual = file.read();
    assert!(scene.lights[0].radiance.distance(5.0 * usual.lights[0].radiance) < 1e-5);
    let strength = "/materials/1/extensions/KHR_materials_emissive_strength/emissiveStrength";
    let mut dark = Builder::studio();
    dark.set(strength, json!(-1));
    assert_eq!(dark.read().materials[1].emission, Vec3::ZERO);
}

#[test]
fn lights_of_range_0_and_of_equal_cones() {
    let with = |light: Value| {
        let mut file = Builder::studio();
        file.json["extensions"] = json!({ "KHR_lights_punctual": { "lights": [light] } });
        file.json["nodes"][2] = json!({ "extensions": { "KHR_lights_punctual": { "light": 0 } } });
        let scene = file.read();
        assert_eq!(scene.notices.len(), 1, "{:?}", scene.notices);
        (scene.punctual_lights[0].kind, scene.notices[0].clone())
    };
    let (kind, notice) = with(json!({ "type": "point", "range": 0 }));
    assert_eq!(kind, PunctualKind::Point { range: f32::INFINITY });
    assert!(notice.starts_with("a light's range of 0 is taken as none: "), "{notice}");
    let (kind, notice) = with(json!({ "type": "spot", "spot": { "innerConeAngle": 0.5, "outerConeAngle": 0.5 } }));
    assert_eq!(kind, PunctualKind::Spot { range: f32::INFINITY, inner: 0.5, outer: 0.5 });
    assert!(notice.starts_with("a spot whose cones are equal has a hard edge: "), "{notice}");
}

#[test]
fn a_scene_that_lists_a_child_or_a_node_twice() {
    let mut file = Builder::studio();
    let plain = file.read();
    // Below a node that is not in the scene; below one that is, before it or after it.
    file.push("nodes", json!({ "name": "group", "children": [2] }));
    for nodes in [json!([0, 1, 2]), json!([0, 1, 3, 2]), json!([2, 0, 1, 3])] {
        file.json["scenes"] = json!([{ "nodes": nodes }]);
        let scene = file.read();
        let kind = "nodes that a scene lists and that stand below others are drawn where they stand";
        assert_eq!(scene.notices, [format!("{kind}: node 2 \"lamp\" of scene 0")]);
        assert_eq!((scene.instances.len(), scene.lights.len()), (2, 1));
        let place =
            |scene: &Scene| scene.instances.iter().find(|instance| instance.name == "lamp").unwrap().world_from_mesh;
        assert_eq!(place(&scene), place(&plain));
    }
    // Where the node stands, its parents count, in the scene or not.
    file.json["nodes"][3]["translation"] = json!([1, 0, 0]);
    for nodes in [json!([0, 1, 2]), json!([2, 0, 1, 3])] {
        file.json["scenes"] = json!([{ "nodes": nodes }]);
        let moved = file.read();
        assert_eq!(moved.lights[0].position() - plain.lights[0].position(), Vec3::X);
    }
    file.json["scenes"] = json!([{ "nodes": [0, 1, 3, 0] }]);
    let scene = file.read();
    assert_eq!(scene.notices, ["nodes that a scene lists twice are drawn once: node 0 \"square\" of scene 0"]);
    assert_eq!(scene.instances.len(), 2);
    // What is in no scene, or in another, is checked as well.
    file.json["scenes"] = json!([{ "nodes": [0] }, { "nodes": [99] }]);
    assert!(read(&file.glb()).unwrap_err().contains("scene 1: there is no node 99"));
}

#[test]
fn texture_coordinates_of_three_components() {
    let mut file = Builder::textured_studio();
    file.texture(&picture(ImageFormat::Png, 2, 2));
    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = json!({ "index": 0 });
    let plain = file.read();
    let wide = plain.meshes[0].tex_coords[0].iter().map(|coords| coords.extend(7.0));
    let wide = file.vectors(&wide.collect::<Vec<_>>());
    file.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(wide);
    let scene = file.read();
    let kind = "the third component of texture coordinates is left out";
    assert_eq!(scene.notices, [format!("{kind}: mesh 0 primitive 0")]);
    assert_eq!(scene.meshes[0].tex_coords, plain.meshes[0].tex_coords);
}
