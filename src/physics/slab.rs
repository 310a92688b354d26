//! The layer: 0 <= z <= 1 of fibres along its normal z, with what is known of it in closed form.

use super::sggx::Sggx;
use crate::math::quadrature::gauss_legendre;
use crate::math::sine;
use glam::DVec3;
use std::f64::consts::PI;

/// The slab of fibres of one roughness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slab {
    medium: Sggx,
}

impl Slab {
    /// The slab of roughness `alpha` in (0, 1]: small is fuzz, large is dust.
    pub fn new(alpha: f64) -> Self {
        assert!(alpha > 0.0 && alpha <= 1.0, "alpha is in (0, 1]: {alpha}");
        Self { medium: Sggx::new(sigma_from_alpha(alpha)) }
    }

    pub fn medium(&self) -> &Sggx {
        &self.medium
    }

    /// The share of light that passes from top to bottom unscattered, at cosine `mu` in \[0, 1\]; 0 at `mu` = 0.
    pub fn unscattered(&self, mu: f64) -> f64 {
        (-self.depth(mu)).exp()
    }

    /// Optical depth of the slab at cosine `mu` in \[0, 1\]: extinction / mu, infinite at 0.
    pub fn depth(&self, mu: f64) -> f64 {
        assert!((0.0..=1.0).contains(&mu), "mu is in [0, 1]: {mu}");
        self.medium.extinction(mu) / mu
    }

    /// Single scattering's part of the reflected lobe f_r(wi, wo) mu_o, per steradian; exact.
    ///
    /// `wi` and `wo` are unit, in the upper hemisphere (z >= 0), pointing away. At depth t, a share exp(-A_i t) of the light
    /// arrives, K dt / mu_i of it scatters into wo, and exp(-A_o t) of that leaves, with A = extinction / mu; integrated over t
    /// in \[0, 1\], and written so that either cosine may be 0. Both 0 (no light enters, none leaves) gives 0.
    pub fn single_scattering(&self, wi: DVec3, wo: DVec3) -> f64 {
        let (mu_i, mu_o) = (wi.z, wo.z);
        assert!((0.0..=1.0).contains(&mu_i) && (0.0..=1.0).contains(&mu_o), "cosines {mu_i}, {mu_o} are in [0, 1]");
        if mu_o == 0.0 {
            return 0.0;
        }
        let attenuated = -(-self.depth(mu_i) - self.depth(mu_o)).exp_m1();
        let rate = self.medium.extinction(mu_i) * mu_o + self.medium.extinction(mu_o) * mu_i;
        self.medium.kernel(wi, wo) * attenuated * mu_o / rate
    }

    /// Single scattering's part of the albedo R at cosine `mu` in \[0, 1\]: the integral of [`Self::single_scattering`] over the
    /// upper hemisphere, to a relative 1e-5.
    pub fn single_scattering_albedo(&self, mu: f64) -> f64 {
        let wi = DVec3::new(sine(mu), 0.0, mu);
        // Both variables are warped to where a narrow feature may lie: mu_o = t^3 to the horizon, phi = pi (1 - u^2) to the
        // direction straight on, around which the flakes that would be needed are rare.
        let inner = gauss_legendre(SINGLE_NODES, 0.0, 1.0);
        let mut sum = 0.0;
        for &(t, t_weight) in &inner {
            let mu_o = t * t * t;
            for &(u, u_weight) in &inner {
                let (sin_phi, cos_phi) = (PI * (1.0 - u * u)).sin_cos();
                let wo = DVec3::new(sine(mu_o) * cos_phi, sine(mu_o) * sin_phi, mu_o);
                let measure = 3.0 * t * t * t_weight * 2.0 * (2.0 * PI * u * u_weight);
                sum += measure * self.single_scattering(wi, wo);
            }
        }
        sum
    }
}

/// Gauss nodes a side of [`Slab::single_scattering_albedo`].
const SINGLE_NODES: usize = 64;

/// The fibres' cross-section sigma of the paper's roughness alpha.
pub fn sigma_from_alpha(alpha: f64) -> f64 {
    alpha * alpha
}
