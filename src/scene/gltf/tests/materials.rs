//! What is read of materials, and which values of theirs are refused.

use glam::{Affine2, Vec2, Vec3};
use image::ImageFormat;
use serde_json::{Value, json};

use super::builder::{Builder, picture, read};
use crate::scene::{AlphaMode, Material, Sheen, TextureSlot, TextureUse};

/// The first material of the studio when it reads so, with four textures in the file.
fn try_material(json: &Value) -> Result<(Material, Vec<String>), String> {
    let mut file = Builder::textured_studio();
    for _ in 0..4 {
        file.texture(&picture(ImageFormat::Png, 1, 1));
    }
    // Else the four are one.
    file.json["samplers"] = json!([{ "wrapS": 33071 }, { "wrapS": 33648 }, { "wrapT": 33071 }, {}]);
    (0..4).for_each(|index| file.json["textures"][index]["sampler"] = json!(index));
    file.json["materials"][0] = json.clone();
    read(&file.glb()).map(|scene| (scene.materials[0].clone(), scene.notices))
}

fn material(json: Value) -> Material {
    let (material, notices) = try_material(&json).unwrap();
    assert!(notices.is_empty(), "{notices:?}");
    material
}

fn plain_use(texture: usize) -> Option<TextureUse> {
    Some(TextureUse { texture, tex_coord: 0, uv_from_tex_coord: Affine2::IDENTITY })
}

#[test]
fn defaults_are_the_specifications() {
    let read = material(json!({}));
    let expected = Material { metallic: 1.0, specular: 1.0, ..Material::matte("", Vec3::ONE) };
    assert_eq!(read, expected);
    assert_eq!((read.ior, read.roughness, read.specular_color), (1.5, 1.0, Vec3::ONE));
    // Of the extensions too.
    let extensions = json!({ "KHR_materials_sheen": {}, "KHR_materials_specular": {}, "KHR_materials_ior": {} });
    let read = material(json!({ "extensions": extensions }));
    assert_eq!(read, Material { sheen: Some(Sheen::new(Vec3::ZERO, 0.0)), ..expected.clone() });
    let read = material(json!({ "extensions": { "KHR_materials_fuzz": {} } }));
    let fuzz = Sheen { weight: 0.0, ..Sheen::new(Vec3::ONE, 0.5) };
    assert_eq!(read, Material { sheen: Some(fuzz), ..expected });
    assert_eq!(material(json!({ "alphaMode": "MASK" })).alpha_mode, AlphaMode::Mask { cutoff: 0.5 });
}

#[test]
fn every_factor_is_read() {
    let texture = json!({ "index": 0 });
    let read = material(json!({
        "name": "velvet",
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.6, "roughnessFactor": 0.7,
            "baseColorTexture": texture,
        },
        "alphaMode": "MASK",
        "alphaCutoff": 0.25,
        "doubleSided": true,
        "normalTexture": { "index": 1, "scale": -2.0 },
        "occlusionTexture": { "index": 2, "strength": 0.5, "texCoord": 1 },
        "emissiveFactor": [0.5, 0.0, 1.0],
        "extensions": {
            "KHR_materials_emissive_strength": { "emissiveStrength": 3.0 },
            "KHR_materials_ior": { "ior": 0.0 },
            "KHR_materials_sheen": { "sheenColorFactor": [0.5, 0.6, 0.7], "sheenRoughnessFactor": 0.8 },
            "KHR_materials_specular": { "specularFactor": 0.9, "specularColorFactor": [1.0, 2.0, 0.5] },
        },
    }));
    let mut expected = Material {
        opacity: 0.4,
        alpha_mode: AlphaMode::Mask { cutoff: 0.25 },
        metallic: 0.6,
        roughness: 0.7,
        specular: 0.9,
        specular_color: Vec3::new(1.0, 2.0, 0.5),
        ior: 0.0,
        sheen: Some(Sheen::new(Vec3::new(0.5, 0.6, 0.7), 0.8)),
        emission: Vec3::new(1.5, 0.0, 3.0),
        double_sided: true,
        normal_scale: -2.0,
        occlusion_strength: 0.5,
        ..Material::matte("velvet", Vec3::new(0.1, 0.2, 0.3))
    };
    expected.textures[TextureSlot::BaseColor as usize] = plain_use(0);
    expected.textures[TextureSlot::Normal as usize] = plain_use(1);
    expected.textures[TextureSlot::Occlusion as usize] = Some(TextureUse { tex_coord: 1, ..plain_use(2).unwrap() });
    assert_eq!(read, expected);
    assert_eq!(material(json!({ "alphaMode": "BLEND" })).alpha_mode, AlphaMode::Blend);
}

#[test]
fn every_texture_stands_in_its_slot() {
    let members = [
        ("/pbrMetallicRoughness/baseColorTexture", TextureSlot::BaseColor),
        ("/pbrMetallicRoughness/metallicRoughnessTexture", TextureSlot::MetallicRoughness),
        ("/normalTexture", TextureSlot::Normal),
        ("/occlusionTexture", TextureSlot::Occlusion),
        ("/emissiveTexture", TextureSlot::Emission),
        ("/extensions/KHR_materials_specular/specularTexture", TextureSlot::Specular),
        ("/extensions/KHR_materials_specular/specularColorTexture", TextureSlot::SpecularColor),
        ("/extensions/KHR_materials_sheen/sheenColorTexture", TextureSlot::SheenColor),
        ("/extensions/KHR_materials_sheen/sheenRoughnessTexture", TextureSlot::SheenRoughness),
        ("/extensions/KHR_materials_fuzz/fuzzTexture", TextureSlot::SheenWeight),
        ("/extensions/KHR_materials_fuzz/fuzzColorTexture", TextureSlot::SheenColor),
        ("/extensions/KHR_materials_fuzz/fuzzRoughnessTexture", TextureSlot::SheenRoughness),
    ];
    for (member, slot) in members {
        let transform = json!({ "offset": [0.5, -1.0], "rotation": 0.5, "scale": [2.0, 3.0], "texCoord": 1 });
        let info = json!({ "index": 3, "texCoord": 7, "extensions": { "KHR_texture_transform": transform } });
        let mut file = Builder { json: json!({}), bytes: Vec::new() };
        file.set(member, info);
        let read = material(file.json.clone());
        for other in TextureSlot::ALL {
            assert_eq!(read.texture(other).is_some(), other == slot, "{member} {other:?}");
        }
        let texture = read.texture(slot).unwrap();
        // The only one that is used, whatever its place in the file.
        assert_eq!((texture.texture, texture.tex_coord), (0, 1), "{member}");
        let [sin, cos] = [0.5f32.sin(), 0.5f32.cos()];
        // scale, then rotation, then offset; (1, 0) turns towards (0, -1).
        let turned = |u: f32, v: f32| Vec2::new(cos * u + sin * v, -sin * u + cos * v) + Vec2::new(0.5, -1.0);
        for (u, v) in [(0.0, 0.0), (1.0, 0.0), (0.3, 0.7)] {
            let found = texture.uv_from_tex_coord.transform_point2(Vec2::new(u, v));
            assert!(found.abs_diff_eq(turned(2.0 * u, 3.0 * v), 1e-6), "{member}: {found}");
        }
        for index in [json!(4), json!(u32::MAX)] {
            file.set(&format!("{member}/index"), index);
            let error = try_material(&file.json).unwrap_err();
            let name = member.rsplit('/').next().unwrap();
            assert!(error.contains(&format!("{name}: there is no texture")), "{error}");
        }
    }
}

/// The specification's own example: the lower left quadrant, turned a quarter.
#[test]
fn the_transform_of_the_specifications_example() {
    let transform = json!({ "offset": [0, 1], "rotation": std::f32::consts::FRAC_PI_2, "scale": [0.5, 0.5] });
    let info = json!({ "index": 0, "extensions": { "KHR_texture_transform": transform } });
    let texture = material(json!({ "emissiveTexture": info })).texture(TextureSlot::Emission).unwrap();
    for (from, to) in
        [([0.0, 0.0], [0.0, 1.0]), ([1.0, 0.0], [0.0, 0.5]), ([0.0, 1.0], [0.5, 1.0]), ([1.0, 1.0], [0.5, 0.5])]
    {
        let found = texture.uv_from_tex_coord.transform_point2(from.into());
        assert!(found.abs_diff_eq(to.into(), 1e-6), "{from:?}: {found}");
    }
}

#[test]
fn fuzz_wins_over_sheen() {
    for factor in [0.0, 0.5] {
        let fuzz = json!({ "fuzzFactor": factor, "fuzzColorFactor": [0, 0, 0], "fuzzTexture": { "index": 1 } });
        let texture = json!({ "index": 0 });
        let sheen =
            json!({ "sheenColorFactor": [1, 1, 1], "sheenColorTexture": texture, "sheenRoughnessTexture": texture });
        let read = material(json!({ "extensions": { "KHR_materials_fuzz": fuzz, "KHR_materials_sheen": sheen } }));
        assert_eq!(read.sheen, Some(Sheen { weight: factor, ..Sheen::new(Vec3::ZERO, 0.5) }));
        assert_eq!(read.texture(TextureSlot::SheenColor), None);
        assert_eq!(read.texture(TextureSlot::SheenRoughness), None);
        assert_eq!(read.texture(TextureSlot::SheenWeight), plain_use(0));
    }
}

#[test]
fn unlit_materials_have_a_base_color_and_no_more() {
    let texture = json!({ "index": 0 });
    let read = material(json!({
        "pbrMetallicRoughness": { "baseColorTexture": texture, "metallicRoughnessTexture": texture },
        "normalTexture": texture, "emissiveTexture": texture, "emissiveFactor": [1, 1, 1],
        "extensions": { "KHR_materials_unlit": {}, "KHR_materials_sheen": { "sheenColorFactor": [1, 1, 1] } },
    }));
    assert!(read.unlit && read.emission == Vec3::ZERO && read.sheen.is_none());
    assert_eq!(read.textures.iter().flatten().count(), 1);
    assert_eq!(read.texture(TextureSlot::BaseColor), plain_use(0));
}

#[test]
fn what_is_not_drawn_is_noted_once_a_kind() {
    let mut file = Builder::textured_studio();
    for material in 0..2 {
        file.json["materials"][material]["extensions"]["KHR_materials_clearcoat"] = json!({ "clearcoatFactor": 1 });
        file.json["materials"][material]["extensions"]["ACME_glitter"] = json!({});
    }
    file.json["materials"][0]["extensions"]["KHR_materials_transmission"] = json!({ "transmissionFactor": 1 });
    assert_eq!(
        file.read().notices,
        [
            "material extensions that are not drawn: ACME_glitter of material 0 \"felt\" and 1 more",
            "KHR_materials_clearcoat is not drawn: material 0 \"felt\" and 1 more",
            "KHR_materials_transmission is not drawn: material 0 \"felt\"",
        ]
    );
    let texture = json!({ "index": 0, "texCoord": 2 });
    let (read, notices) = try_material(&json!({ "name": "felt", "normalTexture": texture })).unwrap();
    assert_eq!(read.texture(TextureSlot::Normal), None);
    assert_eq!(notices, ["textures on a third or later set of texture coordinates are left out: material 0 \"felt\""]);
}

#[test]
fn values_out_of_range() {
    let transform = |transform: Value| json!({ "index": 0, "extensions": { "KHR_texture_transform": transform } });
    for (member, value, what) in [
        (
            "/normalTexture",
            json!({ "index": 0, "scale": 1e39 }),
            "normalTexture.scale is inf; give a number that 32-bit",
        ),
        ("/emissiveFactor", json!([0, 0, 1e39]), "emissiveFactor is inf"),
        ("/extensions/KHR_materials_ior", json!({ "ior": 0.5 }), "ior is 0.5; give 0 or a finite number from 1 up"),
        ("/extensions/KHR_materials_ior", json!({ "ior": "glass" }), "KHR_materials_ior: ior: invalid type"),
        ("/extensions/KHR_materials_ior", json!([]), "KHR_materials_ior must be an object"),
        (
            "/extensions/KHR_materials_specular",
            json!({ "specularColorFactor": [1e39, 0, 0] }),
            "specularColorFactor is inf",
        ),
        ("/extensions/KHR_materials_fuzz", json!({ "fuzzTexture": 1 }), "KHR_materials_fuzz: fuzzTexture"),
        ("/emissiveTexture", transform(json!({ "scale": [1] })), "emissiveTexture: KHR_texture_transform: scale"),
        ("/emissiveTexture", transform(json!({ "offset": [1e39, 0] })), "KHR_texture_transform is not finite"),
        ("/emissiveTexture", transform(json!({ "rotation": 1e300 })), "KHR_texture_transform is not finite"),
    ] {
        let mut file = Builder { json: json!({ "name": "felt" }), bytes: Vec::new() };
        file.set(member, value);
        let error = try_material(&file.json).unwrap_err();
        assert_eq!(error.lines().count(), 1, "{error}");
        assert!(error.starts_with("test.glb: material 0 \"felt\": ") && error.contains(what), "{member}: {error}");
    }
}
