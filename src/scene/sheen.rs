//! The layer of fibres on a material: its parameters, and the rules by which it scatters light.

use glam::Vec3;

/// The layer of fibres on a material. A file gives colour, roughness and weight (KHR_materials_sheen's or
/// KHR_materials_fuzz's factors); the rest is what those leave open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sheen {
    /// `C_sheen` of a layer of full weight, linear Rec. 709, each in [0, 1].
    pub color: Vec3,
    /// The user's roughness in [0, 1].
    pub roughness: f32,
    /// How much of the surface the layer covers, in [0, 1]: 1 for KHR_materials_sheen, fuzzFactor for
    /// KHR_materials_fuzz.
    pub weight: f32,
    /// How the paper's alpha follows from the roughness.
    pub roughness_map: RoughnessMap,
    /// What its lobe is.
    pub model: SheenModel,
    /// What it leaves of the base.
    pub layering: Layering,
}

impl Sheen {
    /// A layer that covers all of the surface, as in KHR_materials_sheen; its alpha is its roughness.
    pub fn new(color: Vec3, roughness: f32) -> Self {
        Self {
            color,
            roughness,
            weight: 1.0,
            roughness_map: RoughnessMap::default(),
            model: SheenModel::default(),
            layering: Layering::default(),
        }
    }

    /// The paper's alpha in [0, 1], where no texture changes the roughness.
    pub fn alpha(&self) -> f32 {
        self.roughness_map.alpha_from_roughness(self.roughness.into()) as f32
    }
}

/// How the paper's alpha follows from the user's roughness.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RoughnessMap {
    /// alpha = roughness: OpenPBR, MaterialX, Cycles.
    #[default]
    Identity,
    /// alpha = roughness^2: glTF's Charlie.
    Square,
    /// alpha = roughness^(1/2): OSL, Babylon.
    Sqrt,
}

impl RoughnessMap {
    /// Each with the name that flags and files give it.
    pub const NAMES: [(&'static str, Self); 3] =
        [("identity", Self::Identity), ("square", Self::Square), ("sqrt", Self::Sqrt)];

    /// The exponent e in alpha = roughness^e.
    pub fn exponent(self) -> f32 {
        match self {
            Self::Identity => 1.0,
            Self::Square => 2.0,
            Self::Sqrt => 0.5,
        }
    }

    /// The paper's alpha in [0, 1] for the user's roughness in [0, 1]: `material_alpha_from_roughness` of the shaders.
    pub fn alpha_from_roughness(self, roughness: f64) -> f64 {
        roughness.powf(self.exponent().into()).clamp(0.0, 1.0)
    }

    /// The name that flags and files give it.
    pub fn name(self) -> &'static str {
        name_in(&Self::NAMES, self)
    }
}

/// What the sheen's lobe is. In real time the transformed cosine is integrated over lights in closed form. Models of
/// prior work have no closed form: for comparison, they are summed over 128 points or more on each polygon light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SheenModel {
    /// The fitted transformed cosine (Zeltner, Burley, Chiang 2022).
    #[default]
    Ltc,
    /// The slab of fibres to which that is fitted, tabulated.
    Slab,
    /// The same slab, walked through path by path.
    Walk,
    /// Burley 2012.
    Burley,
    /// Conty Estevez and Kulla 2017.
    ContyKulla,
    /// Neubelt and Pettineo 2013.
    NeubeltPettineo,
    /// Patry 2020.
    Patry,
}

impl SheenModel {
    /// Each with the name that flags and files give it.
    pub const NAMES: [(&'static str, Self); 7] = [
        ("ltc", Self::Ltc),
        ("slab", Self::Slab),
        ("walk", Self::Walk),
        ("burley", Self::Burley),
        ("conty-kulla", Self::ContyKulla),
        ("neubelt-pettineo", Self::NeubeltPettineo),
        ("patry", Self::Patry),
    ];

    /// The name that flags and files give it.
    pub fn name(self) -> &'static str {
        name_in(&Self::NAMES, self)
    }

    /// Whether it can be drawn in real time; otherwise it takes a path tracer.
    pub fn is_real_time(self) -> bool {
        !matches!(self, Self::Slab | Self::Walk)
    }
}

/// What is left of the base under a sheen of colour C and albedo r(mu).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Layering {
    /// 1 - max3(C) r(view): KHR_materials_sheen.
    #[default]
    Gltf,
    /// 1 - F r(view) with F the layer's weight, whatever its colour: OpenPBR, KHR_materials_fuzz.
    OpenPbr,
    /// The lesser of 1 - max3(C) r(view) and 1 - max3(C) r(light) (Conty Estevez and Kulla 2017).
    Reciprocal,
    /// This share in [0, 1], whatever the sheen.
    Manual(f32),
    /// All of it.
    None,
    /// Light is followed through the layer and the base in all orders of scattering, which the rules approximate. Not
    /// in real time.
    Walk,
}

impl Layering {
    /// The rules without a number, each with the name that flags and files give it.
    pub const NAMES: [(&'static str, Self); 5] = [
        ("gltf", Self::Gltf),
        ("openpbr", Self::OpenPbr),
        ("reciprocal", Self::Reciprocal),
        ("none", Self::None),
        ("walk", Self::Walk),
    ];

    /// The name that flags and files give it: of a manual share S, `manual=S`.
    pub fn name(self) -> String {
        match self {
            Self::Manual(share) => format!("manual={share:?}"),
            rule => name_in(&Self::NAMES, rule).to_owned(),
        }
    }
}

/// The name of a value in a list that has them all.
fn name_in<T: PartialEq>(names: &[(&'static str, T)], value: T) -> &'static str {
    names.iter().find(|(_, listed)| *listed == value).map_or("", |(name, _)| name)
}
