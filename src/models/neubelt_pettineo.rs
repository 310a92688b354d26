//! The cloth of The Order: 1886.

use super::directions::{Directions, LEAST_ALPHA, Lobe};
use super::half_vector::HalfVector;
use super::{Bsdf, Sample, check_alpha};
use glam::DVec3;
use std::f64::consts::PI;

/// Height of the distribution's peak over its ground.
const AMPLITUDE: f64 = 4.0;

/// Neubelt and Pettineo 2013, "Crafting a Next-Gen Material Pipeline for The Order: 1886" (SIGGRAPH course): the cloth,
/// without Fresnel's reflectance.
///
/// An inverted Gaussian on a constant ground, after Ashikhmin, Premoze and Shirley 2000, "A Microfacet-based BRDF Generator", and the denominator
/// of Ashikhmin and Premoze 2007, "Distribution-based BRDFs", in place of shadowing:
///
/// ```text
/// D(h) = (1 + 4 exp(-cot^2(theta_h) / alpha^2) / sin^4(theta_h)) / (pi (1 + 4 alpha^2)),   f_r = D(h) / (4 (mu_i + mu_o - mu_i mu_o))
/// ```
///
/// Reciprocal. Albedos are at most 0.868, for alpha = 0.33 at the horizon, and equal the integrals of
/// [`Bsdf::evaluate`] to a relative 1e-3. Weights are at most 3.
#[derive(Clone, Debug)]
pub struct NeubeltPettineo {
    lobe: InvertedGaussian,
    directions: Directions,
}

impl NeubeltPettineo {
    /// The cloth of the paper's `alpha` in \[0, 1\]; below [`LEAST_ALPHA`], the cloth of that alpha is used. Towards 0 the peak
    /// vanishes into the horizon, and D tends to 1 / pi.
    pub fn new(alpha: f64) -> Self {
        check_alpha(alpha);
        let lobe = InvertedGaussian { alpha_square: alpha.max(LEAST_ALPHA).powi(2) };
        Self { lobe, directions: Directions::new(&lobe) }
    }
}

impl Bsdf for NeubeltPettineo {
    fn evaluate(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.lobe.evaluate(wi, wo)
    }

    fn sample(&self, wi: DVec3, uniforms: [f64; 2]) -> Option<Sample> {
        self.directions.sample(&self.lobe, wi, uniforms)
    }

    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.directions.pdf(wi, wo)
    }

    fn albedo(&self, mu: f64) -> f64 {
        self.directions.albedo(mu)
    }
}

#[derive(Clone, Copy, Debug)]
struct InvertedGaussian {
    alpha_square: f64,
}

impl Lobe for InvertedGaussian {
    fn of_cosines(&self, mu_i: f64, mu_o: f64) -> f64 {
        mu_o / (4.0 * (mu_i * (1.0 - mu_o) + mu_o))
    }

    /// D(h).
    fn of_directions(&self, wi: DVec3, wo: DVec3) -> f64 {
        let HalfVector { cosine_square, sine_square, .. } = HalfVector::of(wi, wo);
        // Towards the normal the exponential falls faster than any power of the sine: the peak is taken for 0 before
        // the sine is 0.
        let exponent = cosine_square / (sine_square * self.alpha_square);
        let peak = if exponent < 500.0 { (-exponent).exp() / (sine_square * sine_square) } else { 0.0 };
        (1.0 + AMPLITUDE * peak) / (PI * (1.0 + AMPLITUDE * self.alpha_square))
    }
}
