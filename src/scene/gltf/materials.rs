//! Materials: their factors, which are in their ranges already, and which textures they use.

use glam::Vec3;
use gltf::json::material::AlphaMode as JsonAlphaMode;
use gltf::json::validation::Checked::{Invalid, Valid};
use gltf::json::{self, Root};
use serde_json::Value;

use super::Fault;
use super::material_extensions::{self as extensions, Fuzz, Ior, Sheen as SheenExtension, Specular, extension};
use super::texture_uses::{Uses, tex_coord_limit};
use crate::scene::error::label;
use crate::scene::notices::Notices;
use crate::scene::{AlphaMode, Material, Sheen, TextureSlot};

/// The file's materials, in its order. The textures that they name are still the file's, not the scene's.
pub fn read(root: &Root, notices: &mut Notices) -> Result<Vec<Material>, Fault> {
    let read = |(index, material): (usize, &json::Material)| {
        let place = || label("material", index, material.name.as_deref());
        extensions::note(material, &place, notices);
        let mut read = read_one(material, root.textures.len()).map_err(|what| Fault::at(place(), what))?;
        tex_coord_limit(&mut read, &place, notices);
        Ok(read)
    };
    root.materials.iter().enumerate().map(read).collect()
}

/// What glTF says a primitive without a material is made of.
pub fn default_material() -> Material {
    Material { metallic: 1.0, specular: 1.0, ..Material::matte("default", Vec3::ONE) }
}

fn read_one(material: &json::Material, textures: usize) -> Result<Material, String> {
    let none = serde_json::Map::new();
    let others = material.extensions.as_ref().map_or(&none, |extensions| &extensions.others);
    let mut uses = Uses::new(textures);
    let mut read = read_core(material, &mut uses)?;
    read_layers(others, &mut read, &mut uses)?;
    let emission = read.emission * emissive_strength(material)?;
    read.emission = finite("emissiveFactor x emissiveStrength", emission.into())?.into();
    read.textures = uses.slots;
    if others.contains_key(extensions::UNLIT) {
        // Nothing but the base colour counts.
        let base_color = read.texture(TextureSlot::BaseColor);
        (read.unlit, read.emission, read.sheen) = (true, Vec3::ZERO, None);
        read.textures = [None; TextureSlot::COUNT];
        read.textures[TextureSlot::BaseColor as usize] = base_color;
    }
    Ok(read)
}

/// What glTF has in its core, without extensions.
fn read_core(material: &json::Material, uses: &mut Uses) -> Result<Material, String> {
    let pbr = &material.pbr_metallic_roughness;
    let [red, green, blue, opacity] = pbr.base_color_factor.0;
    let emission = finite("emissiveFactor", material.emissive_factor.0)?.into();
    uses.add("baseColorTexture", TextureSlot::BaseColor, &pbr.base_color_texture)?;
    uses.add("metallicRoughnessTexture", TextureSlot::MetallicRoughness, &pbr.metallic_roughness_texture)?;
    uses.add("emissiveTexture", TextureSlot::Emission, &material.emissive_texture)?;
    let mut read = Material {
        name: super::cut(material.name.as_deref().unwrap_or_default()),
        opacity,
        alpha_mode: alpha_mode(material)?,
        metallic: pbr.metallic_factor.0,
        roughness: pbr.roughness_factor.0,
        emission,
        double_sided: material.double_sided,
        ..Material::matte("", Vec3::new(red, green, blue))
    };
    if let Some(normal) = &material.normal_texture {
        [read.normal_scale] = finite("normalTexture.scale", [normal.scale])?;
        let others = normal.extensions.as_ref().map(|extensions| &extensions.others);
        uses.add_parts("normalTexture", TextureSlot::Normal, (normal.index, normal.tex_coord, others))?;
    }
    if let Some(occlusion) = &material.occlusion_texture {
        read.occlusion_strength = occlusion.strength.0;
        let others = occlusion.extensions.as_ref().map(|extensions| &extensions.others);
        uses.add_parts("occlusionTexture", TextureSlot::Occlusion, (occlusion.index, occlusion.tex_coord, others))?;
    }
    Ok(read)
}

fn alpha_mode(material: &json::Material) -> Result<AlphaMode, String> {
    // Past 1 nothing is seen, however far.
    let cutoff = material.alpha_cutoff.unwrap_or_default().0.min(f32::MAX);
    match material.alpha_mode {
        Valid(JsonAlphaMode::Opaque) => Ok(AlphaMode::Opaque),
        Valid(JsonAlphaMode::Mask) => Ok(AlphaMode::Mask { cutoff }),
        Valid(JsonAlphaMode::Blend) => Ok(AlphaMode::Blend),
        Invalid => Err("alphaMode is none of OPAQUE, MASK, BLEND; give one of them".to_owned()),
    }
}

fn emissive_strength(material: &json::Material) -> Result<f32, String> {
    let strength = material.extensions.as_ref().and_then(|extensions| extensions.emissive_strength.as_ref());
    let strength = strength.map_or(1.0, |strength| strength.emissive_strength.0);
    let [strength] = finite("emissiveStrength", [strength])?;
    Ok(strength)
}

/// The specular reflection of dielectrics, and the sheen.
fn read_layers(others: &serde_json::Map<String, Value>, read: &mut Material, uses: &mut Uses) -> Result<(), String> {
    let specular: Specular = extension(others)?.unwrap_or_default();
    read.specular = specular.specular_factor;
    read.specular_color = finite("specularColorFactor", specular.specular_color_factor)?.into();
    uses.add("specularTexture", TextureSlot::Specular, &specular.specular_texture)?;
    uses.add("specularColorTexture", TextureSlot::SpecularColor, &specular.specular_color_texture)?;
    let ior = extension::<Ior>(others)?.unwrap_or_default().ior;
    if ior != 0.0 && !(1.0..=f64::from(f32::MAX)).contains(&ior) {
        return Err(format!("ior is {ior}; give 0 or a finite number from 1 up"));
    }
    read.ior = ior as f32;
    let sheen = extension::<SheenExtension>(others)?;
    read.sheen = sheen.map(|sheen| read_sheen(&sheen, uses)).transpose()?;
    if let Some(fuzz) = extension::<Fuzz>(others)? {
        // It replaces the sheen, whatever its factor: a sheen beside it is for readers that do not know fuzz.
        read.sheen = Some(read_fuzz(&fuzz, uses)?);
    }
    Ok(())
}

fn read_sheen(sheen: &SheenExtension, uses: &mut Uses) -> Result<Sheen, String> {
    uses.add("sheenColorTexture", TextureSlot::SheenColor, &sheen.sheen_color_texture)?;
    uses.add("sheenRoughnessTexture", TextureSlot::SheenRoughness, &sheen.sheen_roughness_texture)?;
    Ok(Sheen::new(sheen.sheen_color_factor.into(), sheen.sheen_roughness_factor))
}

fn read_fuzz(fuzz: &Fuzz, uses: &mut Uses) -> Result<Sheen, String> {
    (uses.slots[TextureSlot::SheenColor as usize], uses.slots[TextureSlot::SheenRoughness as usize]) = (None, None);
    uses.add("fuzzTexture", TextureSlot::SheenWeight, &fuzz.fuzz_texture)?;
    uses.add("fuzzColorTexture", TextureSlot::SheenColor, &fuzz.fuzz_color_texture)?;
    uses.add("fuzzRoughnessTexture", TextureSlot::SheenRoughness, &fuzz.fuzz_roughness_texture)?;
    Ok(Sheen { weight: fuzz.fuzz_factor, ..Sheen::new(fuzz.fuzz_color_factor.into(), fuzz.fuzz_roughness_factor) })
}

/// Numbers that the file has are finite, but 32 bits may not hold them.
fn finite<const N: usize>(name: &str, values: [f32; N]) -> Result<[f32; N], String> {
    match values.iter().find(|value| !value.is_finite()) {
        None => Ok(values),
        Some(value) => Err(format!("{name} is {value}; give a number that 32-bit floats can hold")),
    }
}
