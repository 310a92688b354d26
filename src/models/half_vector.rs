//! Half vectors.

use glam::DVec3;

/// What microfacet models need of the half vector h of two directions above the horizon or on it.
pub struct HalfVector {
    /// Square of its cosine to the normal.
    pub cosine_square: f64,
    /// Square of its sine to the normal, without cancellation.
    pub sine_square: f64,
    /// Cosine of the difference angle, dot(wi, h) = dot(wo, h).
    pub cosine_difference: f64,
}

impl HalfVector {
    /// The half vector of two unit vectors. For opposite ones, both on the horizon, it is the normal.
    #[inline]
    pub fn of(wi: DVec3, wo: DVec3) -> Self {
        let sum = wi + wo;
        let (across, up) = (sum.x * sum.x + sum.y * sum.y, sum.z * sum.z);
        let square = across + up;
        if square == 0.0 {
            return Self { cosine_square: 1.0, sine_square: 0.0, cosine_difference: 0.0 };
        }
        Self {
            cosine_square: up / square,
            sine_square: across / square,
            cosine_difference: (0.5 * square.sqrt()).min(1.0),
        }
    }
}
