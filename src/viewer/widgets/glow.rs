use glam::Vec3;

/// A radiance as users set it: its greatest channel, and its hue. The hue stays when the radiance goes to 0 and back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glow {
    pub strength: f32,
    /// The greatest channel is 1.
    pub hue: Vec3,
}

impl Glow {
    /// Of the radiance `strength` times `radiance`. The hue of black is white.
    pub fn new(radiance: Vec3, strength: Option<f32>) -> Self {
        let greatest = radiance.max_element();
        let hue = if greatest > 0.0 { radiance / greatest } else { Vec3::ONE };
        Self { strength: strength.unwrap_or(1.0) * greatest, hue }
    }

    /// With the hue of a colour, which may be darker. Black has none.
    pub fn with_color(self, color: Vec3) -> Self {
        if color == Vec3::ZERO { self } else { Self { hue: Self::new(color, None).hue, ..self } }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_glow_is_its_radiance_and_black_keeps_its_hue() {
        let radiance = Vec3::new(0.5, 2.0, 1.0);
        let glow = Glow::new(radiance, None);
        assert_eq!((glow.strength, glow.strength * glow.hue), (2.0, radiance));
        // As edits keep it: the hue, and its strength.
        let dark = Glow::new(glow.hue, Some(0.0));
        assert_eq!((dark.strength, dark.hue), (0.0, glow.hue));
        assert_eq!(Glow::new(dark.hue, Some(3.3)), Glow { strength: 3.3, hue: glow.hue });
        assert_eq!(Glow::new(Vec3::ZERO, None), Glow { strength: 0.0, hue: Vec3::ONE });
        assert_eq!(glow.with_color(Vec3::ZERO), glow);
        assert_eq!(glow.with_color(Vec3::new(0.0, 0.5, 0.25)), Glow { hue: Vec3::new(0.0, 1.0, 0.5), ..glow });
    }
}
