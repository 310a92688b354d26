//! Extensions of materials as the JSON holds them, with the specifications' defaults.

use gltf::json::Material;
use gltf::json::texture::Info;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use crate::scene::notices::Notices;

/// KHR_materials_unlit has no members.
pub const UNLIT: &str = "KHR_materials_unlit";

/// An extension of materials.
pub trait Extension: DeserializeOwned {
    /// As files name it.
    const NAME: &'static str;
}

/// KHR_materials_sheen.
#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct Sheen {
    pub sheen_color_factor: [f32; 3],
    pub sheen_color_texture: Option<Info>,
    pub sheen_roughness_factor: f32,
    pub sheen_roughness_texture: Option<Info>,
}

/// KHR_materials_fuzz, the draft of 2026.
#[derive(Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct Fuzz {
    pub fuzz_factor: f32,
    pub fuzz_texture: Option<Info>,
    pub fuzz_color_factor: [f32; 3],
    pub fuzz_color_texture: Option<Info>,
    pub fuzz_roughness_factor: f32,
    pub fuzz_roughness_texture: Option<Info>,
}

/// KHR_materials_specular.
#[derive(Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct Specular {
    pub specular_factor: f32,
    pub specular_texture: Option<Info>,
    pub specular_color_factor: [f32; 3],
    pub specular_color_texture: Option<Info>,
}

/// KHR_materials_ior.
#[derive(Deserialize)]
#[serde(default)]
pub struct Ior {
    pub ior: f64,
}

impl Extension for Sheen {
    const NAME: &'static str = "KHR_materials_sheen";
}

impl Extension for Fuzz {
    const NAME: &'static str = "KHR_materials_fuzz";
}

impl Extension for Specular {
    const NAME: &'static str = "KHR_materials_specular";
}

impl Extension for Ior {
    const NAME: &'static str = "KHR_materials_ior";
}

impl Default for Fuzz {
    fn default() -> Self {
        Self {
            fuzz_factor: 0.0,
            fuzz_texture: None,
            fuzz_color_factor: [1.0; 3],
            fuzz_color_texture: None,
            fuzz_roughness_factor: 0.5,
            fuzz_roughness_texture: None,
        }
    }
}

impl Default for Specular {
    fn default() -> Self {
        Self {
            specular_factor: 1.0,
            specular_texture: None,
            specular_color_factor: [1.0; 3],
            specular_color_texture: None,
        }
    }
}

impl Default for Ior {
    fn default() -> Self {
        Self { ior: 1.5 }
    }
}

/// An extension, where it is among `others`; or what is wrong with it.
pub fn extension<T: Extension>(others: &Map<String, Value>) -> Result<Option<T>, String> {
    others.get(T::NAME).map(|value| object(T::NAME, value)).transpose()
}

/// The values of the JSON object that bears `name`, or what is wrong with it.
pub fn object<T: DeserializeOwned>(name: &str, value: &Value) -> Result<T, String> {
    if !value.is_object() {
        return Err(format!("{name} must be an object; correct it"));
    }
    serde_path_to_error::deserialize(value)
        .map_err(|error| format!("{name}: {}; correct it", super::cut(&error.to_string())))
}

/// The notices about well-known extensions that are not drawn, a kind of notice for each.
const NOT_DRAWN: [&str; 11] = [
    "KHR_materials_anisotropy is not drawn",
    "KHR_materials_clearcoat is not drawn",
    "KHR_materials_coat is not drawn",
    "KHR_materials_diffuse_roughness is not drawn",
    "KHR_materials_diffuse_transmission is not drawn",
    "KHR_materials_dispersion is not drawn",
    "KHR_materials_iridescence is not drawn",
    "KHR_materials_pbrSpecularGlossiness is not drawn",
    "KHR_materials_transmission is not drawn",
    "KHR_materials_volume is not drawn",
    "KHR_materials_volume_scatter is not drawn",
];

/// Notes what is not drawn of a material.
pub fn note(material: &Material, place: &dyn Fn() -> String, notices: &mut Notices) {
    const DRAWN: [&str; 5] = [Sheen::NAME, Fuzz::NAME, Specular::NAME, Ior::NAME, UNLIT];
    let names = material.extensions.iter().flat_map(|extensions| extensions.others.keys());
    for name in names.filter(|name| !DRAWN.contains(&name.as_str())) {
        match NOT_DRAWN.iter().find(|said| said.split(' ').next() == Some(name)) {
            Some(said) => notices.add(said, place),
            None => {
                notices.add("material extensions that are not drawn", || format!("{} of {}", super::cut(name), place()))
            }
        }
    }
}
