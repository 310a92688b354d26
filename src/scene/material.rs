use glam::Vec3;

use super::{Sheen, TextureUse};

/// How a surface scatters and emits: glTF's metallic-roughness base, a layer of fibres on it, and the textures of both.
///
/// Each factor is multiplied by its texture where there is one ([`TextureSlot`]).
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// What users call it; may be empty.
    pub name: String,
    /// Linear Rec. 709, each in [0, 1]: albedo of a dielectric's diffuse base, reflectance of a metal facing the view.
    pub base_color: Vec3,
    /// The fourth number of the file's base colour, in [0, 1].
    pub opacity: f32,
    /// What becomes of the opacity.
    pub alpha_mode: AlphaMode,
    /// From dielectric, 0, to metal, 1.
    pub metallic: f32,
    /// The user's roughness of the base in [0, 1].
    pub roughness: f32,
    /// KHR_materials_specular: strength of a dielectric's specular reflection in [0, 1].
    pub specular: f32,
    /// KHR_materials_specular: tint of that reflection where the surface faces the view, linear Rec. 709, >= 0.
    pub specular_color: Vec3,
    /// KHR_materials_ior: refractive index of a dielectric, >= 1; or 0, which stands for reflecting all light.
    pub ior: f32,
    /// The layer of fibres on top, where there is one.
    pub sheen: Option<Sheen>,
    /// Emitted radiance (glTF's emissiveFactor times its emissive strength), linear Rec. 709, >= 0.
    pub emission: Vec3,
    /// KHR_materials_unlit: the base colour is shown as it is, whatever lights it; it counts as emission.
    pub unlit: bool,
    /// Back faces are drawn, and lit with the normal turned round; otherwise they are culled.
    pub double_sided: bool,
    /// Factor of the normal texture's x and y; any finite number.
    pub normal_scale: f32,
    /// How far the occlusion texture counts, in [0, 1].
    pub occlusion_strength: f32,
    /// Indexed by [`TextureSlot`].
    pub textures: [Option<TextureUse>; TextureSlot::COUNT],
}

impl Material {
    /// Whether it glows all over. What has an emissive texture counts as lit, for perhaps only a small part of it
    /// glows.
    pub fn is_lamp(&self) -> bool {
        self.emission != Vec3::ZERO && self.texture(TextureSlot::Emission).is_none()
    }

    /// A diffuse surface: no specular reflection, no sheen, no light of its own.
    pub fn matte(name: impl Into<String>, base_color: Vec3) -> Self {
        Self {
            name: name.into(),
            base_color,
            opacity: 1.0,
            alpha_mode: AlphaMode::Opaque,
            metallic: 0.0,
            roughness: 1.0,
            specular: 0.0,
            specular_color: Vec3::ONE,
            ior: 1.5,
            sheen: None,
            emission: Vec3::ZERO,
            unlit: false,
            double_sided: false,
            normal_scale: 1.0,
            occlusion_strength: 1.0,
            textures: [None; TextureSlot::COUNT],
        }
    }

    /// The texture in a slot, if there is one.
    pub fn texture(&self, slot: TextureSlot) -> Option<TextureUse> {
        self.textures[slot as usize]
    }

    /// Reflectance of a dielectric along the normal, linear Rec. 709, >= 0: Fresnel's ((n - 1) / (n + 1))^2, tinted and
    /// weakened. A tint may take it above `specular`: whoever shades limits it to that, once both have been multiplied
    /// by their textures.
    pub fn dielectric_f0(&self) -> Vec3 {
        let normal = ((self.ior - 1.0) / (self.ior + 1.0)).powi(2);
        normal * self.specular_color * self.specular
    }
}

/// What becomes of the opacity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum AlphaMode {
    /// It is ignored.
    #[default]
    Opaque,
    /// Where it is less than the cutoff, nothing is there.
    Mask {
        /// >= 0; above 1 nothing is ever there.
        cutoff: f32,
    },
    /// What lies behind shows through by the rest.
    Blend,
}

/// What a texture stands for: which of its channels are read, and how they are encoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextureSlot {
    /// rgb: the base colour, sRGB; a: the opacity.
    BaseColor,
    /// g: roughness; b: metallic.
    MetallicRoughness,
    /// rgb: the normal in the tangent frame, from [0, 1] to [-1, 1].
    Normal,
    /// r: the share of light from the environment that arrives.
    Occlusion,
    /// rgb: emitted radiance, sRGB.
    Emission,
    /// a: strength of a dielectric's specular reflection.
    Specular,
    /// rgb: tint of that reflection, sRGB.
    SpecularColor,
    /// rgb: `C_sheen`, sRGB.
    SheenColor,
    /// a: roughness of the sheen.
    SheenRoughness,
    /// r: how much of the surface the sheen covers.
    SheenWeight,
}

impl TextureSlot {
    /// How many slots there are.
    pub const COUNT: usize = 10;

    /// All slots, in the order of their numbers.
    pub const ALL: [Self; Self::COUNT] = [
        Self::BaseColor,
        Self::MetallicRoughness,
        Self::Normal,
        Self::Occlusion,
        Self::Emission,
        Self::Specular,
        Self::SpecularColor,
        Self::SheenColor,
        Self::SheenRoughness,
        Self::SheenWeight,
    ];

    /// Whether r, g, b are sRGB-encoded colours; otherwise all channels are plain numbers.
    pub fn is_color(self) -> bool {
        matches!(self, Self::BaseColor | Self::Emission | Self::SpecularColor | Self::SheenColor)
    }
}
