use glam::Vec3;

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
