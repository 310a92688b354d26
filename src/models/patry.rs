//! The fuzz of Ghost of Tsushima.

use super::directions::{Directions, LEAST_ALPHA, Lobe};
use super::{Bsdf, Sample, check_alpha, cosine};
use crate::math::one_minus_exp;
use crate::physics::sggx::Sggx;
use crate::physics::slab::sigma_from_alpha;
use glam::DVec3;

/// Patry 2020, "Samurai Shading in Ghost of Tsushima" (SIGGRAPH course): asperity scattering with the phase function of SGGX microflakes, here
/// with fibres along the normal.
///
/// The light that a layer of optical depth 1 scatters once, where the medium's extinction is the same in all directions
/// (Koenderink and Pont 2003, "The secret of velvety skin"):
///
/// ```text
/// f_r = p(wi, wo) (1 - exp(-(mu_i + mu_o) / (mu_i mu_o))) / (mu_i + mu_o),   p(wi, wo) = D(h) / (4 extinction(wi))
/// ```
///
/// This is the form with which the supplement of Zeltner, Burley and Chiang 2022 compares. It says that the product in
/// the exponent is Koenderink and Pont's, and differs from the talk's slides. The talk's base layer and approximations
/// for real time are left out. In the medium of [`super::SlabSheen`] extinction is larger across the fibres than along
/// them. In this one it is not, so that it is f_r times extinction(wi) that is reciprocal, not f_r.
///
/// Albedos are at most 0.5, at the horizon, and equal the integrals of [`Bsdf::evaluate`] to a relative 3e-3. Of the
/// light from one `wo`, at most 0.55 comes back. Weights are at most 5.
#[derive(Clone, Debug)]
pub struct Patry {
    layer: Layer,
    directions: Directions,
}

impl Patry {
    /// The fuzz of the slab's `alpha` in \[0, 1\], whose square is the fibres' cross-section; below [`LEAST_ALPHA`],
    /// the fuzz of that alpha is used. Towards 0 the fibres do not change the elevation of light: nothing comes back.
    pub fn new(alpha: f64) -> Self {
        check_alpha(alpha);
        let layer = Layer { medium: Sggx::new(sigma_from_alpha(alpha.max(LEAST_ALPHA))) };
        Self { layer, directions: Directions::new(&layer) }
    }

    fn extinction(&self, wi: DVec3) -> f64 {
        self.layer.medium.extinction(cosine(wi).abs())
    }
}

impl Bsdf for Patry {
    fn evaluate(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.layer.evaluate(wi, wo) / self.extinction(wi)
    }

    fn sample(&self, wi: DVec3, uniforms: [f64; 2]) -> Option<Sample> {
        let Sample { wo, weight, pdf } = self.directions.sample(&self.layer, wi, uniforms)?;
        Some(Sample { wo, weight: weight / self.extinction(wi), pdf })
    }

    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.directions.pdf(wi, wo)
    }

    fn albedo(&self, mu: f64) -> f64 {
        self.directions.albedo(mu) / self.layer.medium.extinction(mu)
    }
}

/// The lobe times extinction(wi), which is smooth at the normal.
#[derive(Clone, Copy, Debug)]
struct Layer {
    medium: Sggx,
}

impl Lobe for Layer {
    fn of_cosines(&self, mu_i: f64, mu_o: f64) -> f64 {
        let sum = mu_i + mu_o;
        // The exponent is infinite where wi is on the horizon: its light is certain to meet the layer.
        one_minus_exp(sum / (mu_i * mu_o)) * (mu_o / sum)
    }

    fn of_directions(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.medium.kernel(wi, wo)
    }
}
