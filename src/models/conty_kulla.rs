//! The sheen of Imageworks, which others call Charlie.

use super::directions::{Directions, LEAST_ALPHA, Lobe};
use super::half_vector::HalfVector;
use super::{Bsdf, Sample, check_alpha};
use glam::DVec3;
use std::f64::consts::TAU;

/// The fit's parameters a to e, for r = 0 (section 3 of the source).
const SMOOTH: [f64; 5] = [25.3245, 3.32435, 0.16801, -1.27393, -4.85967];

/// The parameters for r = 1.
const ROUGH: [f64; 5] = [21.5473, 3.82987, 0.19823, -1.97760, -4.32054];

/// How the light's side fades out towards grazing light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Terminator {
    /// By the shadowing that goes with the distribution: reciprocal. This is what Zeltner, Burley and Chiang compare
    /// with.
    Physical,
    /// Softened for artists (section 4 of the source): Lambda of `wo` to the power 1 + 2 (1 - mu_o)^8, while that of `wi` stays. Not
    /// reciprocal.
    Soft,
}

/// Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF" (SIGGRAPH course), without Fresnel's reflectance.
///
/// ```text
/// D(h) = (2 + 1/r) sin^(1/r)(theta_h) / (2 pi)             eq. 2
/// G    = 1 / (1 + Lambda_i + Lambda_o)                     section 3
/// Lambda(mu) = exp(L(mu)) for mu < 0.5, exp(2 L(0.5) - L(1 - mu)) beyond,   L(x) = a / (1 + b x^c) + d x + e     eq. 3
/// f_r  = D G / (4 mu_i mu_o)                               eq. 1
/// ```
///
/// where a to e go from those for r = 1 to those for r = 0 with (1 - r)^2. Towards the horizon Lambda mu should tend to
/// a limit. The fit's is largest at a cosine between 4e-5 and 9e-5 and then falls to 0, which would make f_r infinite.
/// Here it keeps its largest value from there on.
///
/// Reciprocal with [`Terminator::Physical`]. The fit creates light where alpha is small: albedos pass 1 below alpha = 0.07 (soft: 0.045) at
/// grazing angles, up to 1.34 (soft: 1.15). They equal the integrals of [`Bsdf::evaluate`] to a relative 5e-3, mostly
/// 1e-3. Weights are at most 6.
#[derive(Clone, Debug)]
pub struct ContyKulla {
    lobe: FittedFibres,
    directions: Directions,
}

impl ContyKulla {
    /// The sheen of r = `alpha` in \[0, 1\]; below [`LEAST_ALPHA`], the sheen of that alpha is used. Towards 0 the half vectors
    /// gather at the horizon.
    pub fn new(alpha: f64, terminator: Terminator) -> Self {
        check_alpha(alpha);
        let lobe = FittedFibres::new(alpha.max(LEAST_ALPHA), terminator);
        Self { lobe, directions: Directions::new(&lobe) }
    }
}

impl Bsdf for ContyKulla {
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
struct FittedFibres {
    inverse_r: f64,
    /// a to e.
    fit: [f64; 5],
    /// 2 L(0.5).
    twice_middle: f64,
    /// Where the fit's Lambda mu is largest.
    turning_point: f64,
    /// That largest value.
    limit: f64,
    terminator: Terminator,
}

impl FittedFibres {
    fn new(r: f64, terminator: Terminator) -> Self {
        let smooth = (1.0 - r) * (1.0 - r);
        let fit: [f64; 5] = std::array::from_fn(|k| smooth * SMOOTH[k] + (1.0 - smooth) * ROUGH[k]);
        // The solution of 1 + x L'(x) = 0 without the term d x, which is 1e-4 there: with u = b x^c, the lesser root of
        // a c u = (1 + u)^2.
        let [a, b, c, ..] = fit;
        let half = 0.5 * a * c - 1.0;
        let u = half - (half * half - 1.0).sqrt();
        let turning_point = (u / b).powf(1.0 / c);
        let limit = exponent(&fit, turning_point).exp() * turning_point;
        Self { inverse_r: 1.0 / r, fit, twice_middle: 2.0 * exponent(&fit, 0.5), turning_point, limit, terminator }
    }

    /// Lambda(mu) for `mu` past the turning point.
    fn lambda(&self, mu: f64) -> f64 {
        let log = if mu < 0.5 { exponent(&self.fit, mu) } else { self.twice_middle - exponent(&self.fit, 1.0 - mu) };
        log.exp()
    }
}

impl Lobe for FittedFibres {
    /// G / (4 mu_i) = 1 / (4 (Lambda_i mu_i + mu_i (1 + Lambda_o))).
    fn of_cosines(&self, mu_i: f64, mu_o: f64) -> f64 {
        let here = if mu_i < self.turning_point { self.limit } else { mu_i * self.lambda(mu_i) };
        let mut there = if mu_o < self.turning_point { self.limit / mu_o } else { self.lambda(mu_o) };
        if self.terminator == Terminator::Soft {
            there = there.powf(1.0 + 2.0 * (1.0 - mu_o).powi(8));
        }
        // Infinity would give NaN where mu_i is 0.
        1.0 / (4.0 * (here + mu_i * (1.0 + there.min(f64::MAX))))
    }

    /// D(h).
    fn of_directions(&self, wi: DVec3, wo: DVec3) -> f64 {
        let sine_square = HalfVector::of(wi, wo).sine_square;
        (2.0 + self.inverse_r) * sine_square.powf(0.5 * self.inverse_r) / TAU
    }
}

/// L(x).
fn exponent(&[a, b, c, d, e]: &[f64; 5], x: f64) -> f64 {
    a / (1.0 + b * x.powf(c)) + d * x + e
}
