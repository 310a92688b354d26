use glam::Vec3;

/// How a surface scatters and emits.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    pub name: String,
    /// Albedo of the diffuse base, linear Rec. 709, each in [0, 1].
    pub base_color: Vec3,
    /// The layer of fibres on top, if there is one.
    pub sheen: Option<Sheen>,
    /// Emitted radiance (glTF's emissiveFactor times its emissive strength), linear Rec. 709, >= 0.
    pub emission: Vec3,
    /// Back faces are drawn and lit with the normal turned; otherwise they are culled.
    pub double_sided: bool,
}

/// The parameters of the sheen (KHR_materials_sheen's factors).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sheen {
    /// `C_sheen`, linear Rec. 709, each in [0, 1].
    pub color: Vec3,
    /// The user's roughness in [0, 1].
    pub roughness: f32,
}

/// The paper's alpha for the user's roughness: the same number, as in OpenPBR and MaterialX.
pub fn alpha_from_roughness(roughness: f32) -> f32 {
    roughness
}
