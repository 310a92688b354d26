use glam::Vec3;

use super::{Material, Sheen};

/// What a picture is made with beside its scene: shared by every way of rendering it.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    pub lobes: Lobes,
    /// Emitters that light the scene are drawn.
    pub lights_visible: bool,
    /// Exposure value: a .png's radiance is multiplied by `2^exposure`. No part of a linear picture.
    pub exposure: f32,
    /// Gives every material a sheen of this roughness in [0, 1].
    pub alpha: Option<f32>,
    /// Gives every material a sheen of this colour, linear Rec. 709 in [0, 1].
    pub sheen_color: Option<Vec3>,
}

impl Default for Settings {
    fn default() -> Self {
        Self { lobes: Lobes::default(), lights_visible: true, exposure: 0.0, alpha: None, sheen_color: None }
    }
}

impl Settings {
    /// The sheen that `material` is drawn with. What `alpha` and `sheen_color` leave open is the material's own; a material
    /// without a sheen, or with a black one, is given a white one of roughness 0.5 where either is set.
    pub fn sheen_of(&self, material: &Material) -> Option<Sheen> {
        let own = material.sheen.filter(|sheen| sheen.color != Vec3::ZERO);
        if self.alpha.is_none() && self.sheen_color.is_none() {
            return own;
        }
        let base = own.unwrap_or(Sheen { color: Vec3::ONE, roughness: 0.5 });
        Some(Sheen { color: self.sheen_color.unwrap_or(base.color), roughness: self.alpha.unwrap_or(base.roughness) })
    }
}

/// Which parts of the surfaces' radiance are summed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lobes {
    pub sheen: bool,
    pub diffuse: bool,
    pub emission: bool,
}

impl Default for Lobes {
    fn default() -> Self {
        Self { sheen: true, diffuse: true, emission: true }
    }
}
