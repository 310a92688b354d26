/// How radiance is brought into the range of a screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToneCurve {
    /// Clamped to [0, 1].
    None,
    /// Khronos PBR Neutral: base colours under neutral light come out as they are, highlights are compressed.
    #[default]
    Neutral,
}

impl ToneCurve {
    /// Linear Rec. 709 in [0, infinity) to linear Rec. 709 in [0, 1].
    pub fn apply(self, color: [f32; 3]) -> [f32; 3] {
        match self {
            Self::None => color.map(|channel| channel.clamp(0.0, 1.0)),
            Self::Neutral => neutral(color),
        }
    }
}

/// Khronos PBR Neutral Tone Mapper, specification of 2024: subtract Fresnel's F90 - F0 that a lit grey would carry,
/// compress peaks above 0.8 hyperbolically, and desaturate them on the way.
fn neutral(color: [f32; 3]) -> [f32; 3] {
    const FRESNEL: f32 = 0.04;
    const START_COMPRESSION: f32 = 0.8 - FRESNEL;
    const DESATURATION: f32 = 0.15;
    // Past this a picture is white to the last bit; it also keeps infinities out of the quotients.
    let color = color.map(|channel| channel.clamp(0.0, 1e6));
    let least = color[0].min(color[1]).min(color[2]);
    let offset = if least < 2.0 * FRESNEL { least - least * least / (4.0 * FRESNEL) } else { FRESNEL };
    let color = color.map(|channel| channel - offset);
    let peak = color[0].max(color[1]).max(color[2]);
    if peak < START_COMPRESSION {
        return color;
    }
    let room = 1.0 - START_COMPRESSION;
    let new_peak = 1.0 - room * room / (peak + room - START_COMPRESSION);
    let white = 1.0 - 1.0 / (DESATURATION * (peak - new_peak) + 1.0);
    color.map(|channel| channel * (new_peak / peak) * (1.0 - white) + new_peak * white)
}

/// The sRGB transfer function (IEC 61966-2-1) on [0, 1]; what lies outside is clamped.
pub fn srgb_from_linear(linear: f32) -> f32 {
    let linear = linear.clamp(0.0, 1.0);
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The specification's promise: a base colour of at least 0.04 + F0's share, lit to 1, comes out as the base colour.
    #[test]
    fn neutral_keeps_colours_below_the_shoulder() {
        for base in [0.1_f32, 0.3, 0.5, 0.7] {
            let shown = neutral([base + 0.04; 3]);
            assert!(shown.iter().all(|channel| (channel - base).abs() < 1e-6), "{base}: {shown:?}");
        }
    }

    #[test]
    fn neutral_is_continuous_monotone_and_bounded() {
        let mut last = 0.0;
        for step in 0..200_000 {
            let x = step as f32 * 1e-4;
            let [shown, ..] = neutral([x, x, x]);
            // 1e-6: a few roundings of f32 where the pieces of the curve meet. Its steepest slope is 1, so a step is 1e-4.
            assert!(shown > last - 1e-6 && shown - last < 1.1e-4 && shown <= 1.0, "{x}: {last} {shown}");
            last = shown;
        }
        for extreme in [f32::INFINITY, 1e30, 1e6] {
            assert!(neutral([extreme, 0.5, 0.0]).iter().all(|channel| (0.0..=1.0).contains(channel)));
        }
        assert!(neutral([f32::INFINITY; 3]).iter().all(|channel| *channel > 0.99));
    }

    #[test]
    fn srgb_at_known_points() {
        // 0.5 encodes to 188 and 0.2140 to 127.5 of 255 (IEC 61966-2-1's curve, by hand).
        assert_eq!((srgb_from_linear(0.5) * 255.0).round(), 188.0);
        assert!((srgb_from_linear(0.214_041) - 0.5).abs() < 1e-5);
        assert!((srgb_from_linear(0.003_130_8) - srgb_from_linear(0.003_130_9)).abs() < 1e-5);
        assert_eq!(srgb_from_linear(-1.0), 0.0);
        assert!((srgb_from_linear(2.0) - 1.0).abs() < 1e-6);
    }
}
