//! From random bits to distributions.

use glam::DVec3;
use rand::Rng;
use std::f64::consts::TAU;

/// Uniform in \[0, 1), a multiple of 2^-53.
pub fn uniform(rng: &mut impl Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
}

/// Exponentially distributed with mean 1, finite.
pub fn exponential(rng: &mut impl Rng) -> f64 {
    -(1.0 - uniform(rng)).ln()
}

/// Uniform on the unit sphere (Marsaglia 1972): without trigonometry, from 32-bit coordinates.
///
/// A point of the unit disc, found by rejection (1.27 tries on average), is lifted so that areas are kept.
pub fn unit_sphere(rng: &mut impl Rng) -> DVec3 {
    loop {
        let bits = rng.next_u64();
        // Centres of 2^32 cells of [-1, 1]: symmetric about 0.
        let coordinate = |bits: u32| (f64::from(bits) + 0.5) * (2.0 / (1_u64 << 32) as f64) - 1.0;
        let (x, y) = (coordinate(bits as u32), coordinate((bits >> 32) as u32));
        let square = x * x + y * y;
        if square < 1.0 {
            let scale = 2.0 * (1.0 - square).sqrt();
            return DVec3::new(x * scale, y * scale, 1.0 - 2.0 * square);
        }
    }
}

/// A direction of the upper hemisphere with density z / pi from two uniform numbers in \[0, 1): the unit disc by polar coordinates,
/// lifted (Malley's method; Pharr, Jakob, Humphreys 2023, A.5.3).
pub fn cosine_hemisphere([height, turn]: [f64; 2]) -> DVec3 {
    let across = height.sqrt();
    let (sin_phi, cos_phi) = (TAU * turn).sin_cos();
    DVec3::new(across * cos_phi, across * sin_phi, (1.0 - height).sqrt())
}
