//! The sheen of Disney's principled model.

use super::directions::{Directions, Lobe};
use super::half_vector::HalfVector;
use super::{Bsdf, Sample};
use glam::DVec3;

/// The sheen term of Burley 2012, "Physically Based Shading at Disney" (SIGGRAPH course): f_r = (1 - cos theta_d)^5, Schlick's
/// weight at the difference angle theta_d between `wi` and the half vector. It has no roughness, and is not divided by pi.
///
/// Reciprocal. Albedos are at most 0.0885, at the horizon, and equal the integrals of [`Bsdf::evaluate`] to a relative
/// 1e-3. Weights are at most 0.5.
#[derive(Clone, Debug)]
pub struct Burley {
    directions: Directions,
}

impl Burley {
    /// The model, which has no parameters; takes some milliseconds.
    pub fn new() -> Self {
        Self { directions: Directions::new(&SchlickWeight) }
    }
}

impl Default for Burley {
    fn default() -> Self {
        Self::new()
    }
}

impl Bsdf for Burley {
    fn evaluate(&self, wi: DVec3, wo: DVec3) -> f64 {
        SchlickWeight.evaluate(wi, wo)
    }

    fn sample(&self, wi: DVec3, uniforms: [f64; 2]) -> Option<Sample> {
        self.directions.sample(&SchlickWeight, wi, uniforms)
    }

    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.directions.pdf(wi, wo)
    }

    fn albedo(&self, mu: f64) -> f64 {
        self.directions.albedo(mu)
    }
}

struct SchlickWeight;

impl Lobe for SchlickWeight {
    fn of_cosines(&self, _: f64, mu_o: f64) -> f64 {
        mu_o
    }

    fn of_directions(&self, wi: DVec3, wo: DVec3) -> f64 {
        (1.0 - HalfVector::of(wi, wo).cosine_difference).powi(5)
    }
}
