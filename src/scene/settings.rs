use glam::Vec3;

use super::{Material, Sheen};

/// What a picture is made with beside its scene: shared by every way of rendering it.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Which parts of the surfaces' radiance are summed.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_win_over_materials() {
        let own = Sheen { color: Vec3::X, roughness: 0.2 };
        let black = Sheen { color: Vec3::ZERO, roughness: 0.2 };
        let sheen = |alpha, sheen_color, sheen| {
            Settings { alpha, sheen_color, ..Settings::default() }.sheen_of(&Material { sheen, ..Material::default() })
        };
        assert_eq!(sheen(None, None, Some(own)), Some(own));
        assert_eq!(sheen(None, None, Some(black)), None);
        assert_eq!(sheen(None, None, None), None);
        assert_eq!(sheen(Some(0.7), None, Some(own)), Some(Sheen { roughness: 0.7, ..own }));
        assert_eq!(sheen(None, Some(Vec3::Y), Some(own)), Some(Sheen { color: Vec3::Y, ..own }));
        for without in [None, Some(black)] {
            assert_eq!(sheen(Some(0.7), None, without), Some(Sheen { color: Vec3::ONE, roughness: 0.7 }));
            assert_eq!(sheen(None, Some(Vec3::Y), without), Some(Sheen { color: Vec3::Y, roughness: 0.5 }));
        }
        assert_eq!(sheen(Some(0.1), Some(Vec3::Y), Some(own)), Some(Sheen { color: Vec3::Y, roughness: 0.1 }));
    }
}
