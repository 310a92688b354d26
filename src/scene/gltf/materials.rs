//! Materials: the factors that are drawn, with their ranges checked.

use std::collections::BTreeSet;
use std::ops::RangeInclusive;

use glam::Vec3;
use gltf::json::material::AlphaMode;
use gltf::json::validation::Checked;
use gltf::json::{self, Root};
use serde_json::Value;

use super::Fault;
use crate::scene::error::{cut, label};
use crate::scene::notices::Notices;
use crate::scene::{Material, Sheen};

const SHEEN: &str = "KHR_materials_sheen";
const TEXTURES: &str = "textures are not drawn yet, only the factors beside them";
const EXTENSIONS_SHOWN: usize = 20;

/// In the order of `Scene::materials`: the file's own.
pub fn read(root: &Root, notices: &mut Notices) -> Result<Vec<Material>, Fault> {
    let read = |(index, material): (usize, &json::Material)| {
        let place = || label("material", index, material.name.as_deref());
        note(material, &place, notices);
        read_one(material).map_err(|what| Fault::at(place(), what))
    };
    let materials = root.materials.iter().enumerate().map(read).collect::<Result<_, _>>()?;
    note_extensions(root, notices);
    Ok(materials)
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
        name: super::name(material.name.as_deref()),
        base_color: Vec3::new(base_color[0], base_color[1], base_color[2]),
        sheen: extensions.and_then(|extensions| extensions.others.get(SHEEN)).map(read_sheen).transpose()?,
        emission: emissive * strength,
        double_sided: material.double_sided,
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
            color.ok_or_else(|| {
                format!("sheenColorFactor is {}, not three numbers; correct it", cut(&value.to_string(), 40))
            })?
        }
    };
    let roughness = match members.get("sheenRoughnessFactor") {
        None => 0.0,
        Some(value) => number(value)
            .ok_or_else(|| format!("sheenRoughnessFactor is {}, no number; correct it", cut(&value.to_string(), 40)))?,
    };
    let color = Vec3::from(in_unit("sheenColorFactor", color)?);
    let [roughness] = in_unit("sheenRoughnessFactor", [roughness])?;
    Ok(Sheen { color, roughness })
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

/// Notes what of a material is not drawn.
fn note(material: &json::Material, place: &dyn Fn() -> String, notices: &mut Notices) {
    let pbr = &material.pbr_metallic_roughness;
    let extensions = material.extensions.as_ref();
    let textures = [
        ("baseColorTexture", pbr.base_color_texture.is_some()),
        ("metallicRoughnessTexture", pbr.metallic_roughness_texture.is_some()),
        ("normalTexture", material.normal_texture.is_some()),
        ("occlusionTexture", material.occlusion_texture.is_some()),
        ("emissiveTexture", material.emissive_texture.is_some()),
    ];
    for (texture, _) in textures.iter().filter(|(_, there)| *there) {
        notices.add(TEXTURES, || format!("{texture} of {}", place()));
    }
    if pbr.metallic_factor.0 > 0.0 {
        notices.add("metals are drawn with their base color as a diffuse one", place);
    }
    if !matches!(material.alpha_mode, Checked::Valid(AlphaMode::Opaque)) {
        notices.add("transparent materials are drawn opaque", place);
    }
    let sheen = extensions.and_then(|extensions| extensions.others.get(SHEEN));
    if sheen
        .is_some_and(|sheen| ["sheenColorTexture", "sheenRoughnessTexture"].iter().any(|key| sheen.get(key).is_some()))
    {
        notices.add(TEXTURES, || format!("{SHEEN}'s of {}", place()));
    }
}

/// Notes the extensions that are not served, all in one line.
fn note_extensions(root: &Root, notices: &mut Notices) {
    let of_materials = root.materials.iter().filter_map(|material| material.extensions.as_ref());
    let of_materials = of_materials.flat_map(|extensions| extensions.others.keys());
    let names: BTreeSet<&String> = root.extensions_used.iter().chain(of_materials).collect();
    let names = names.into_iter().filter(|name| !super::SERVED.contains(&name.as_str())).map(|name| cut(name, 60));
    let names: Vec<String> = names.take(EXTENSIONS_SHOWN).collect();
    if !names.is_empty() {
        notices.add("extensions that are not served are passed over", || names.join(", "));
    }
}
