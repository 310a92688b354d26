use std::collections::BTreeMap;

use glam::Vec3;

use super::{Material, Sheen};

/// What a picture is made with besides its scene, shared by every way of rendering it.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Which lobes are summed.
    pub lobes: Lobes,
    /// Whether emitters that light the scene are drawn.
    pub lights_visible: bool,
    /// Exposure value: radiance is multiplied by `2^exposure` on its way into a .png. Linear pictures do not depend on
    /// it.
    pub exposure: f32,
    /// Radiance that arrives from everywhere, linear Rec. 709, >= 0.
    pub ambient: Vec3,
    /// What is changed in every material.
    pub overrides: Overrides,
    /// What is changed in single materials, by their index into `Scene::materials`; it takes precedence over
    /// `overrides`.
    pub material_overrides: BTreeMap<usize, Overrides>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            lobes: Lobes::default(),
            lights_visible: true,
            exposure: 0.0,
            ambient: Vec3::ZERO,
            overrides: Overrides::default(),
            material_overrides: BTreeMap::new(),
        }
    }
}

/// What is changed in a material; what is `None` stays as it is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Overrides {
    /// Gives a sheen of this roughness in [0, 1], whatever the textures.
    pub alpha: Option<f32>,
    /// Gives a sheen of this colour, linear Rec. 709 in [0, 1], whatever the textures.
    pub sheen_color: Option<Vec3>,
    /// How alpha follows from the sheen's roughness.
    pub roughness_map: Option<RoughnessMap>,
    /// What the sheen's lobe is.
    pub sheen_model: Option<SheenModel>,
    /// What is left of the base under the sheen.
    pub layering: Option<Layering>,
}

impl Overrides {
    /// These, and `others` where these are `None`.
    pub fn or(self, others: Self) -> Self {
        Self {
            alpha: self.alpha.or(others.alpha),
            sheen_color: self.sheen_color.or(others.sheen_color),
            roughness_map: self.roughness_map.or(others.roughness_map),
            sheen_model: self.sheen_model.or(others.sheen_model),
            layering: self.layering.or(others.layering),
        }
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
    /// The exponent e in alpha = roughness^e.
    pub fn exponent(self) -> f32 {
        match self {
            Self::Identity => 1.0,
            Self::Square => 2.0,
            Self::Sqrt => 0.5,
        }
    }

    /// The paper's alpha for the user's roughness in [0, 1].
    pub fn alpha_from_roughness(self, roughness: f32) -> f32 {
        roughness.powf(self.exponent())
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
    /// Each with the name that flags give it.
    pub const NAMES: [(&'static str, Self); 7] = [
        ("ltc", Self::Ltc),
        ("slab", Self::Slab),
        ("walk", Self::Walk),
        ("burley", Self::Burley),
        ("conty-kulla", Self::ContyKulla),
        ("neubelt-pettineo", Self::NeubeltPettineo),
        ("patry", Self::Patry),
    ];

    /// The name that flags give it.
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, model)| *model == self).map_or("", |(name, _)| name)
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

/// The sheen that a material is drawn with, overrides applied.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SheenLook {
    /// Its factors.
    pub sheen: Sheen,
    /// How alpha follows from its roughness.
    pub roughness_map: RoughnessMap,
    /// What its lobe is.
    pub model: SheenModel,
    /// Whether the material's textures of the sheen's colour and weight still count.
    pub color_is_textured: bool,
    /// Whether the material's texture of the sheen's roughness still counts.
    pub roughness_is_textured: bool,
}

impl Settings {
    /// What is changed in the material of this index: its own overrides, and where they are `None` those of all
    /// materials.
    pub fn overrides_of(&self, index: usize) -> Overrides {
        self.material_overrides.get(&index).copied().unwrap_or_default().or(self.overrides)
    }

    /// The sheen with which `material`, of this index, is drawn; `None` where it has none. What the overrides' `alpha`
    /// and `sheen_color` leave open is the material's own. Where either is set, a material without a sheen, or with a
    /// black one, gets a white sheen of roughness 0.5 to start from.
    pub fn sheen_of(&self, index: usize, material: &Material) -> Option<SheenLook> {
        let overrides = self.overrides_of(index);
        let covers = material.sheen.filter(|sheen| sheen.weight > 0.0);
        let own = covers.filter(|sheen| sheen.color != Vec3::ZERO);
        let given = overrides.alpha.is_some() || overrides.sheen_color.is_some();
        // Black fibres scatter nothing. They still hide the base under a rule by which their colour does not count.
        let hiding = covers.filter(|_| self.layering_of(index) == Layering::OpenPbr);
        let base = own.or_else(|| given.then(|| Sheen::new(Vec3::ONE, 0.5))).or(hiding)?;
        let own = own.or(hiding.filter(|_| !given));
        Some(SheenLook {
            sheen: Sheen {
                color: overrides.sheen_color.unwrap_or(base.color),
                roughness: overrides.alpha.unwrap_or(base.roughness),
                weight: if overrides.sheen_color.is_some() { 1.0 } else { base.weight },
            },
            roughness_map: overrides.roughness_map.unwrap_or_default(),
            model: overrides.sheen_model.unwrap_or_default(),
            color_is_textured: own.is_some() && overrides.sheen_color.is_none(),
            roughness_is_textured: own.is_some() && overrides.alpha.is_none(),
        })
    }

    /// How the sheen and the base of the material of this index are layered.
    pub fn layering_of(&self, index: usize) -> Layering {
        self.overrides_of(index).layering.unwrap_or_default()
    }
}

/// Which parts of the surfaces' radiance are summed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lobes {
    /// Light scattered by the layer of fibres.
    pub sheen: bool,
    /// Light scattered by the base.
    pub diffuse: bool,
    /// Light reflected at the base's surface.
    pub specular: bool,
    /// What surfaces emit themselves.
    pub emission: bool,
}

impl Default for Lobes {
    fn default() -> Self {
        Self { sheen: true, diffuse: true, specular: true, emission: true }
    }
}
