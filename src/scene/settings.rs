use glam::Vec3;

use crate::picture::ToneCurve;

/// What a picture is made with besides what is in its scene, shared by every way of rendering it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Which lobes are summed.
    pub lobes: Lobes,
    /// Whether lamps are drawn: emitters that light the scene, and of whose seen surface at least half glows.
    pub lights_visible: bool,
    /// Whether surfaces stand in the way of light.
    pub shadows: bool,
    /// Radiance that arrives from everywhere, linear Rec. 709, >= 0.
    pub ambient: Vec3,
    /// Exposure value: radiance is multiplied by `2^exposure` on its way into a .png. Linear pictures do not depend on
    /// it. Where edits want it metered, 0 until it is.
    pub exposure: f32,
    /// The tone curve of a .png.
    pub tone: ToneCurve,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            lobes: Lobes::default(),
            lights_visible: true,
            shadows: true,
            ambient: Vec3::ZERO,
            exposure: 0.0,
            tone: ToneCurve::default(),
        }
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

impl Lobes {
    /// No lobe at all.
    pub const NONE: Self = Self { sheen: false, diffuse: false, specular: false, emission: false };

    /// Each lobe's name in flags and files, and its switch.
    pub fn switches(&mut self) -> [(&'static str, &mut bool); 4] {
        [
            ("sheen", &mut self.sheen),
            ("diffuse", &mut self.diffuse),
            ("specular", &mut self.specular),
            ("emission", &mut self.emission),
        ]
    }
}

impl Default for Lobes {
    fn default() -> Self {
        Self { sheen: true, diffuse: true, specular: true, emission: true }
    }
}
