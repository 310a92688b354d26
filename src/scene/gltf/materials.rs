//! Materials: the factors that are drawn, with their ranges checked.

use std::ops::RangeInclusive;

use glam::Vec3;
use gltf::json::material::AlphaMode;
use gltf::json::texture::{Info, Texture};
use gltf::json::validation::Checked;
use gltf::json::{self, Index, Root};
use serde::Deserialize;
use serde_json::Value;

use super::Fault;
use crate::scene::error::label;
use crate::scene::notices::Notices;
use crate::scene::{Material, Sheen};

const SHEEN: &str = "KHR_materials_sheen";
const SHEEN_TEXTURES: [&str; 2] = ["sheenColorTexture", "sheenRoughnessTexture"];

/// In the order of `Scene::materials`: the file's own.
pub fn read(root: &Root, notices: &mut Notices) -> Result<Vec<Material>, Fault> {
    let read = |(index, material): (usize, &json::Material)| {
        let place = || label("material", index, material.name.as_deref());
        note(material, &place, notices);
        read_one(material).map_err(|what| Fault::at(place(), what))
    };
    root.materials.iter().enumerate().map(read).collect()
}

/// What a primitive without a material is made of, by glTF.
pub fn default_material() -> Material {
    Material { metallic: 1.0, specular: 1.0, ..Material::matte("default", Vec3::ONE) }
}

fn read_one(material: &json::Material) -> Result<Material, String> {
    let pbr = &material.pbr_metallic_roughness;
    let base_color = in_unit("baseColorFactor", pbr.base_color_factor.0)?;
    in_unit("metallicFactor", [pbr.metallic_factor.0])?;
    in_unit("roughnessFactor", [pbr.roughness_factor.0])?;
    in_range("alphaCutoff", [material.alpha_cutoff.unwrap_or_default().0], 0.0..=f32::MAX)?;
    if material.alpha_mode == Checked::Invalid {
        return Err("alphaMode is none of OPAQUE, MASK, BLEND; give one of them".to_owned());
    }
    let emissive = Vec3::from(in_unit("emissiveFactor", material.emissive_factor.0)?);
    let extensions = material.extensions.as_ref();
    let strength = extensions.and_then(|extensions| extensions.emissive_strength.as_ref());
    let strength = strength.map_or(1.0, |strength| strength.emissive_strength.0);
    let [strength] = in_range("emissiveStrength", [strength], 0.0..=f32::MAX)?;
    Ok(Material {
        name: super::cut(material.name.as_deref().unwrap_or_default()),
        base_color: Vec3::new(base_color[0], base_color[1], base_color[2]),
        sheen: extensions.and_then(|extensions| extensions.others.get(SHEEN)).map(read_sheen).transpose()?,
        emission: emissive * strength,
        double_sided: material.double_sided,
        ..Material::matte("", Vec3::ONE)
    })
}

fn read_sheen(value: &Value) -> Result<Sheen, String> {
    let wrong = || format!("{SHEEN} must be an object of numbers; correct it");
    let members = value.as_object().ok_or_else(wrong)?;
    let number = |value: &Value| value.as_f64().map(|number| number as f32);
    let color = match members.get("sheenColorFactor") {
        None => [0.0; 3],
        Some(value) => {
            let color = value.as_array().and_then(|color| color.iter().map(number).collect::<Option<Vec<f32>>>());
            let color = color.and_then(|color| <[f32; 3]>::try_from(color).ok());
            color.ok_or_else(|| format!("sheenColorFactor is {}, not three numbers; correct it", brief(value)))?
        }
    };
    let roughness = match members.get("sheenRoughnessFactor") {
        None => 0.0,
        Some(value) => {
            number(value).ok_or_else(|| format!("sheenRoughnessFactor is {}, no number; correct it", brief(value)))?
        }
    };
    for name in SHEEN_TEXTURES {
        let broken = |error| format!("{name} is broken ({error}); correct it");
        members.get(name).map(texture).transpose().map_err(broken)?;
    }
    let color = Vec3::from(in_unit("sheenColorFactor", color)?);
    let [roughness] = in_unit("sheenRoughnessFactor", [roughness])?;
    Ok(Sheen::new(color, roughness))
}

/// JSON as it can stand in a line.
fn brief(value: &Value) -> String {
    let text = value.to_string();
    if text.chars().count() > 40 { text.chars().take(37).chain("...".chars()).collect() } else { text }
}

fn in_unit<const N: usize>(name: &str, values: [f32; N]) -> Result<[f32; N], String> {
    in_range(name, values, 0.0..=1.0)
}

fn in_range<const N: usize>(name: &str, values: [f32; N], range: RangeInclusive<f32>) -> Result<[f32; N], String> {
    match values.iter().find(|value| !range.contains(value)) {
        None => Ok(values),
        Some(value) if *range.end() == f32::MAX => Err(format!("{name} is {value}; give a finite number from 0 up")),
        Some(value) => Err(format!("{name} is {value}; give a number in [{}, {}]", range.start(), range.end())),
    }
}

/// The textures of a material by their members' names.
pub fn textures(material: &json::Material) -> Vec<(&'static str, Index<Texture>)> {
    let pbr = &material.pbr_metallic_roughness;
    let sheen = material.extensions.as_ref().and_then(|extensions| extensions.others.get(SHEEN));
    let of_sheen = |name| sheen.and_then(|sheen| texture(sheen.get(name)?).ok());
    let textures = [
        ("baseColorTexture", pbr.base_color_texture.as_ref().map(|texture| texture.index)),
        ("metallicRoughnessTexture", pbr.metallic_roughness_texture.as_ref().map(|texture| texture.index)),
        ("normalTexture", material.normal_texture.as_ref().map(|texture| texture.index)),
        ("occlusionTexture", material.occlusion_texture.as_ref().map(|texture| texture.index)),
        ("emissiveTexture", material.emissive_texture.as_ref().map(|texture| texture.index)),
        (SHEEN_TEXTURES[0], of_sheen(SHEEN_TEXTURES[0])),
        (SHEEN_TEXTURES[1], of_sheen(SHEEN_TEXTURES[1])),
    ];
    textures.into_iter().filter_map(|(name, texture)| Some((name, texture?))).collect()
}

fn texture(value: &Value) -> Result<Index<Texture>, serde_json::Error> {
    Info::deserialize(value).map(|info| info.index)
}

/// Notes what of a material is not drawn.
fn note(material: &json::Material, place: &dyn Fn() -> String, notices: &mut Notices) {
    for (texture, _) in textures(material) {
        notices.add("textures are not drawn yet, only the factors beside them", || format!("{texture} of {}", place()));
    }
    if material.pbr_metallic_roughness.metallic_factor.0 > 0.0 {
        notices.add("metals are drawn with their base color as a diffuse one", place);
    }
    if !matches!(material.alpha_mode, Checked::Valid(AlphaMode::Opaque)) {
        notices.add("transparent materials are drawn opaque", place);
    }
    for name in material.extensions.iter().flat_map(|extensions| extensions.others.keys()) {
        if name != SHEEN {
            notices.add("material extensions that are not drawn", || format!("{name} of {}", place()));
        }
    }
}
