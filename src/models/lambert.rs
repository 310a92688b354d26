//! The diffuse base.

use super::{Bsdf, Sample, check_uniforms, cosine};
use crate::math::check_cosine;
use crate::math::warp::cosine_hemisphere;
use glam::DVec3;
use std::f64::consts::PI;

/// Scatters all light, with the same radiance in all directions: the base's colour multiplies it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lambert;

impl Bsdf for Lambert {
    fn evaluate(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.pdf(wi, wo)
    }

    fn sample(&self, wi: DVec3, uniforms: [f64; 2]) -> Option<Sample> {
        check_uniforms(uniforms);
        (cosine(wi) >= 0.0).then(|| {
            let wo = cosine_hemisphere(uniforms);
            Sample { wo, weight: 1.0, pdf: wo.z / PI }
        })
    }

    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        if cosine(wi) < 0.0 { 0.0 } else { cosine(wo).max(0.0) / PI }
    }

    fn albedo(&self, mu: f64) -> f64 {
        check_cosine(mu);
        1.0
    }
}
