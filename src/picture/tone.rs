/// How radiance is brought into the range of a screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToneCurve {
    /// Clamped to [0, 1].
    None,
    /// Khronos PBR Neutral: base colours in neutral light come out unchanged, highlights are compressed.
    #[default]
    Neutral,
    /// AgX (T. Sobotka 2022) as in Blender 4: the contrast is that of film, and bright colours go towards white.
    Agx,
}

impl ToneCurve {
    /// Each with the name that flags and files give it.
    pub const NAMES: [(&'static str, Self); 3] = [("none", Self::None), ("neutral", Self::Neutral), ("agx", Self::Agx)];

    /// The name that flags and files give it.
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, curve)| *curve == self).map_or("", |(name, _)| name)
    }

    /// Takes linear Rec. 709 in [0, infinity) to linear Rec. 709 in [0, 1].
    pub fn apply(self, color: [f32; 3]) -> [f32; 3] {
        match self {
            Self::None => color.map(|channel| channel.clamp(0.0, 1.0)),
            Self::Neutral => neutral(color),
            Self::Agx => agx(color),
        }
    }
}

/// The Khronos PBR Neutral tone mapper (specification of 2024): subtracts the Fresnel reflection that a dielectric's
/// surface adds to its base colour, 0.04 head on, compresses peaks above 0.8 hyperbolically, and desaturates these as
/// it does.
fn neutral(color: [f32; 3]) -> [f32; 3] {
    const FRESNEL: f32 = 0.04;
    const START_COMPRESSION: f32 = 0.8 - FRESNEL;
    const DESATURATION: f32 = 0.15;
    // Above this, a picture is white to the last bit. The limit also keeps infinities out of the quotients.
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

/// Rows of the matrices of AgX. The first takes linear Rec. 709 to Rec. 2020 (ITU-R BT.2087) and moves the primaries
/// inwards, so that bright colours meet white; the second moves them out again, in the picture's encoding; the third
/// takes linear Rec. 2020 back. Insets and outsets are those of Blender 4's OCIO configuration (as in Filament's
/// ToneMapper and three.js).
const AGX_INSET: [[f32; 3]; 3] =
    [[0.544_815, 0.373_787, 0.081_398], [0.140_417, 0.754_138, 0.105_445], [0.088_81, 0.178_872, 0.732_318]];
const AGX_OUTSET: [[f32; 3]; 3] = [
    [1.127_100_6, -0.110_606_64, -0.016_493_94],
    [-0.141_329_76, 1.157_823_7, -0.016_493_94],
    [-0.141_329_76, -0.110_606_64, 1.251_936_4],
];
const REC709_FROM_REC2020: [[f32; 3]; 3] =
    [[1.660_491, -0.587_641, -0.072_85], [-0.124_55, 1.132_899, -0.008_349], [-0.018_151, -0.100_579, 1.118_73]];

/// AgX's default look: log2 of the radiance from 12.47393 stops below 1 to 4.026069 above, a sigmoid curve (B.
/// Wrensch's fit of sixth degree, whose mean squared error is 3.7e-6), which gives a picture encoded by a power of 2.2.
fn agx(color: [f32; 3]) -> [f32; 3] {
    const LOWEST: f32 = -12.473_93;
    const HIGHEST: f32 = 4.026_069;
    let color = times(&AGX_INSET, color.map(|channel| channel.clamp(0.0, 1e6)));
    let curve = |channel: f32| {
        // Zero has no logarithm; anything below 2^-20 is at the lowest end anyway.
        let x = (channel.max(1e-6).log2().clamp(LOWEST, HIGHEST) - LOWEST) / (HIGHEST - LOWEST);
        let polynomial = [-0.00232, 0.1191, 0.4298, -6.868, 31.96, -40.14, 15.5];
        polynomial.into_iter().rev().fold(0.0, |sum, coefficient| sum * x + coefficient)
    };
    let encoded = times(&AGX_OUTSET, color.map(curve));
    times(&REC709_FROM_REC2020, encoded.map(|channel| channel.max(0.0).powf(2.2)))
        .map(|channel| channel.clamp(0.0, 1.0))
}

fn times(rows: &[[f32; 3]; 3], [x, y, z]: [f32; 3]) -> [f32; 3] {
    rows.map(|row| row[0] * x + row[1] * y + row[2] * z)
}

/// The sRGB transfer function (IEC 61966-2-1): takes linear light to its encoded value, both in [0, 1]. What is outside
/// is clamped.
pub fn srgb_from_linear(linear: f32) -> f32 {
    let linear = linear.clamp(0.0, 1.0);
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The specification's promise: a base colour of at least 0.04 + F0's share, lit to 1, comes out as the base
    /// colour.
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
            // 1e-6: a few roundings of f32 where the pieces of the curve meet. Its steepest slope is 1, so a step is
            // 1e-4.
            assert!(shown > last - 1e-6 && shown - last < 1.1e-4 && shown <= 1.0, "{x}: {last} {shown}");
            last = shown;
        }
        for extreme in [f32::INFINITY, 1e30, 1e6] {
            assert!(neutral([extreme, 0.5, 0.0]).iter().all(|channel| (0.0..=1.0).contains(channel)));
        }
        assert!(neutral([f32::INFINITY; 3]).iter().all(|channel| *channel > 0.99));
    }

    #[test]
    fn agx_is_monotone_bounded_and_keeps_grey() {
        let mut last = 0.0;
        for step in 0..=200_000 {
            let x = 2f32.powf(step as f32 * 1e-4 - 14.0);
            let shown = agx([x; 3]);
            // The matrices' rows sum to 1 within 2e-6, which the curve's steepest slope makes 1e-5.
            assert!(shown.iter().all(|channel| (channel - shown[0]).abs() < 2e-5), "{x}: {shown:?}");
            assert!(shown[0] > last - 1e-6 && shown[0] <= 1.0, "{x}: {last} {shown:?}");
            last = shown[0];
        }
        for extreme in [0.0, 1e-30, 1e6, 1e30, f32::INFINITY] {
            for color in [[extreme, 0.5, 0.0], [0.0, 0.0, extreme], [extreme; 3]] {
                assert!(agx(color).iter().all(|channel| (0.0..=1.0).contains(channel)), "{color:?}");
            }
        }
        assert_eq!(agx([0.0; 3]), [0.0; 3]);
        assert!(agx([f32::INFINITY; 3]).iter().all(|channel| *channel > 0.99));
    }

    #[test]
    fn agx_at_known_points() {
        // The curve's pivot: 0.18, ten stops above the lowest end, is the middle of the screen's scale. A bright
        // saturated red goes towards white.
        let [grey, ..] = agx([0.18; 3]).map(srgb_from_linear);
        assert!((grey - 0.5).abs() < 2e-3, "{grey}");
        let [red, green, blue] = agx([50.0, 0.0, 0.0]);
        assert!(red > 0.9 && green > 0.3 && blue > 0.3, "{red} {green} {blue}");
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
