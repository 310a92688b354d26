use glam::Vec3;

use super::TextureUse;

/// How a surface scatters and emits: glTF's metallic-roughness base, a layer of fibres on it, and the textures of both.
///
/// Each factor is multiplied by its texture where there is one ([`TextureSlot`]).
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    pub name: String,
    /// Linear Rec. 709, each in [0, 1]: albedo of a dielectric's diffuse base, reflectance of a metal facing the view.
    pub base_color: Vec3,
    /// The base colour's fourth number, in [0, 1].
    pub opacity: f32,
    pub alpha_mode: AlphaMode,
    /// From dielectric (0) to metal (1).
    pub metallic: f32,
    /// The user's roughness of the base in [0, 1].
    pub roughness: f32,
    /// KHR_materials_specular: strength of a dielectric's specular reflection in [0, 1].
    pub specular: f32,
    /// KHR_materials_specular: tint of it where it faces the view, linear Rec. 709, >= 0.
    pub specular_color: Vec3,
    /// KHR_materials_ior: refractive index of a dielectric, >= 1, or 0: all light is reflected.
    pub ior: f32,
    /// The layer of fibres on top, if there is one.
    pub sheen: Option<Sheen>,
    /// Emitted radiance (glTF's emissiveFactor times its emissive strength), linear Rec. 709, >= 0.
    pub emission: Vec3,
    /// KHR_materials_unlit: the base colour is shown as it is, whatever lights it; it counts as emission.
    pub unlit: bool,
    /// Back faces are drawn and lit with the normal turned; otherwise they are culled.
    pub double_sided: bool,
    /// Scale of the normal texture's x and y.
    pub normal_scale: f32,
    /// How much of the occlusion texture counts, in [0, 1].
    pub occlusion_strength: f32,
    /// By [`TextureSlot`].
    pub textures: [Option<TextureUse>; TextureSlot::COUNT],
}

impl Material {
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

    /// The texture in a slot.
    pub fn texture(&self, slot: TextureSlot) -> Option<TextureUse> {
        self.textures[slot as usize]
    }

    /// Reflectance of a dielectric along the normal: Fresnel's ((n - 1) / (n + 1))^2, tinted and weakened. With its textures' share it
    /// is cut at `specular`'s, which a tint may pass.
    pub fn dielectric_f0(&self) -> Vec3 {
        let normal = ((self.ior - 1.0) / (self.ior + 1.0)).powi(2);
        normal * self.specular_color * self.specular
    }
}

/// What becomes of the opacity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum AlphaMode {
    /// Not looked at.
    #[default]
    Opaque,
    /// Nothing is there where it is less than the cutoff, >= 0.
    Mask { cutoff: f32 },
    /// What lies behind shows through.
    Blend,
}

/// The parameters of the sheen (KHR_materials_sheen's or KHR_materials_fuzz's factors).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sheen {
    /// `C_sheen` of a layer of full weight, linear Rec. 709, each in [0, 1].
    pub color: Vec3,
    /// The user's roughness in [0, 1].
    pub roughness: f32,
    /// How much of the surface the layer covers, in [0, 1]: 1 for KHR_materials_sheen, fuzzFactor for KHR_materials_fuzz.
    pub weight: f32,
}

impl Sheen {
    /// A layer that covers all of the surface, as in KHR_materials_sheen.
    pub fn new(color: Vec3, roughness: f32) -> Self {
        Self { color, roughness, weight: 1.0 }
    }
}

/// What a texture stands for, and so which of its channels are read and how they are encoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextureSlot {
    /// rgb, sRGB; a is the opacity.
    BaseColor,
    /// g: roughness; b: metallic.
    MetallicRoughness,
    /// rgb: the normal in the tangent frame, from [0, 1] to [-1, 1].
    Normal,
    /// r.
    Occlusion,
    /// rgb, sRGB.
    Emission,
    /// a.
    Specular,
    /// rgb, sRGB.
    SpecularColor,
    /// rgb, sRGB.
    SheenColor,
    /// a.
    SheenRoughness,
    /// r.
    SheenWeight,
}

impl TextureSlot {
    pub const COUNT: usize = 10;

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
