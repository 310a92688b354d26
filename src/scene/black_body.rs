//! The colours of black bodies: what lamps are by their temperature.

use std::ops::RangeInclusive;

use glam::{DMat3, DVec3, Vec3};

/// Temperatures that have a colour here, kelvin: below, a lamp is hardly seen; beyond, hues hardly change.
pub const RANGE: RangeInclusive<f32> = 1000.0..=40000.0;

/// hc/k, metre kelvin (CODATA 2018).
const SECOND_RADIATION: f64 = 1.438_776_877e-2;

/// XYZ to linear Rec. 709 (ITU-R BT.709's primaries and D65, IEC 61966-2-1), by rows.
const RGB_FROM_XYZ: [[f64; 3]; 3] = [
    [3.240_969_94, -1.537_383_18, -0.498_610_76],
    [-0.969_243_64, 1.875_967_50, 0.041_555_06],
    [0.055_630_08, -0.203_976_96, 1.056_971_51],
];

/// The colour of a black body of this temperature in kelvin, linear Rec. 709: its strongest channel is 1. Below 1900 K it is
/// outside of what Rec. 709 shows, and has no blue.
///
/// Planck's law under the CIE's colour matching functions of 1931, in the closed form of Wyman, Sloan and Shirley 2013 (Simple
/// analytic approximations to the CIE XYZ color matching functions, multi-lobe fit): chromaticities are within 0.003 of those of
/// the tabulated functions.
pub fn color(kelvin: f32) -> Vec3 {
    let kelvin = f64::from(kelvin.clamp(*RANGE.start(), *RANGE.end()));
    let nanometres = (360..=830).map(f64::from);
    let xyz: DVec3 = nanometres.map(|wavelength| planck(wavelength, kelvin) * matching(wavelength)).sum();
    let rgb = (DMat3::from_cols_array_2d(&RGB_FROM_XYZ).transpose() * xyz).max(DVec3::ZERO);
    (rgb / rgb.max_element()).as_vec3()
}

/// Spectral radiance by Planck's law, up to a factor. Wavelengths in nanometres.
fn planck(wavelength: f64, kelvin: f64) -> f64 {
    let metres = 1e-9 * wavelength;
    (wavelength / 560.0).powi(-5) / (SECOND_RADIATION / (metres * kelvin)).exp_m1()
}

/// The CIE's colour matching functions of 1931 (Wyman et al., equation 4). Wavelengths in nanometres.
fn matching(wavelength: f64) -> DVec3 {
    let lobe = |height: f64, middle: f64, [below, above]: [f64; 2]| {
        let rate = if wavelength < middle { below } else { above };
        height * (-0.5 * ((wavelength - middle) * rate).powi(2)).exp()
    };
    DVec3::new(
        lobe(0.362, 442.0, [0.0624, 0.0374])
            + lobe(1.056, 599.8, [0.0264, 0.0323])
            + lobe(-0.065, 501.1, [0.0490, 0.0382]),
        lobe(0.821, 568.8, [0.0213, 0.0247]) + lobe(0.286, 530.9, [0.0613, 0.0322]),
        lobe(1.217, 437.0, [0.0845, 0.0278]) + lobe(0.681, 459.0, [0.0385, 0.0725]),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Chromaticity by the CIE's standard illuminant A (2856 K), and on the Planckian locus by Kim et al. 2002 (US patent 7024034: cubic
    /// in the inverse temperature): none of it goes by the functions above.
    #[test]
    fn hues_lie_on_the_planckian_locus() {
        let kim = |kelvin: f64| {
            let t = 1e3 / kelvin;
            let x = match kelvin < 4000.0 {
                true => -0.266_123_9 * t.powi(3) - 0.234_358_9 * t * t + 0.877_695_6 * t + 0.179_910,
                false => -3.025_846_9 * t.powi(3) + 2.107_037_9 * t * t + 0.222_634_7 * t + 0.240_390,
            };
            let y = match kelvin {
                _ if kelvin < 2222.0 => {
                    -1.106_381_4 * x.powi(3) - 1.348_110_2 * x * x + 2.185_558_32 * x - 0.202_196_83
                }
                _ if kelvin < 4000.0 => {
                    -0.954_947_6 * x.powi(3) - 1.374_185_93 * x * x + 2.091_370_15 * x - 0.167_488_67
                }
                _ => 3.081_758 * x.powi(3) - 5.873_386_7 * x * x + 3.751_129_97 * x - 0.370_014_83,
            };
            [x, y]
        };
        let xyz_from_rgb = DMat3::from_cols_array_2d(&RGB_FROM_XYZ).transpose().inverse();
        let found = |kelvin: f32| {
            let xyz = xyz_from_rgb * color(kelvin).as_dvec3();
            [xyz.x / xyz.element_sum(), xyz.y / xyz.element_sum()]
        };
        let locus = [2000.0, 2400.0, 3000.0, 4000.0, 5500.0, 6500.0, 10000.0, 25000.0];
        let expected = locus.into_iter().map(|kelvin| (kelvin, kim(kelvin))).chain([(2856.0, [0.44757, 0.40745])]);
        for (kelvin, [x, y]) in expected {
            let [at_x, at_y] = found(kelvin as f32);
            assert!((at_x - x).abs() < 0.003 && (at_y - y).abs() < 0.003, "{kelvin} K: {at_x}, {at_y}: {x}, {y}");
        }
    }

    #[test]
    fn the_strongest_channel_is_one() {
        for kelvin in [0.0, 1000.0, 1800.0, 6500.0, 40000.0, 1e9] {
            let color = color(kelvin);
            assert!((color.max_element() == 1.0 && color.min_element() >= 0.0), "{kelvin}: {color}");
        }
        // D65 is on the daylight locus, a little greener than a black body of its temperature.
        let white = color(6504.0);
        assert!(white.min_element() > 0.94, "{white}");
        assert!(color(1500.0).z == 0.0 && color(3000.0).x == 1.0 && color(20000.0).z == 1.0);
    }
}
