//! The layer of fibres along its normal z, of thickness 1 unless stated otherwise, with what is known of it in closed
//! form.

use super::modes::Elevation;
use super::sggx::Sggx;
use crate::math::quadrature::gauss_legendre;
use crate::math::{check_cosine, one_minus_exp};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::LazyLock;

/// The slab of fibres of one roughness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slab {
    medium: Sggx,
    thickness: f64,
}

impl Slab {
    /// The slab of roughness `alpha` in (0, 1] and thickness 1: small is fuzz, large is dust.
    pub fn new(alpha: f64) -> Self {
        assert!(alpha > 0.0 && alpha <= 1.0, "alpha is in (0, 1]: {alpha}");
        Self { medium: Sggx::new(sigma_from_alpha(alpha)), thickness: 1.0 }
    }

    /// The same fibres in a slab of another thickness, in units of the mean free path across them, in \[1e-12, 1e6\].
    /// The tables are made for a thickness of 1.
    pub fn with_thickness(self, thickness: f64) -> Self {
        assert!((1e-12..=1e6).contains(&thickness), "a thickness is in [1e-12, 1e6]: {thickness}");
        Self { thickness, ..self }
    }

    /// The slab's thickness, in units of the mean free path across the fibres.
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// The fibres that fill the slab.
    #[inline]
    pub fn medium(&self) -> &Sggx {
        &self.medium
    }

    /// The share of light that passes from top to bottom unscattered, at cosine `mu` in \[0, 1\]; 0 at `mu` = 0.
    pub fn unscattered(&self, mu: f64) -> f64 {
        (-self.depth(mu)).exp()
    }

    /// The share of light that is scattered at all: what [`Self::unscattered`] leaves, without cancellation.
    pub fn scattered(&self, mu: f64) -> f64 {
        -(-self.depth(mu)).exp_m1()
    }

    /// Optical depth of the slab at cosine `mu` in \[0, 1\]: extinction x thickness / mu, infinite at 0.
    pub fn depth(&self, mu: f64) -> f64 {
        check_cosine(mu);
        self.medium.extinction(mu) * self.thickness / mu
    }

    /// Single scattering's part of the reflected lobe f_r(wi, wo) mu_o, per steradian; exact.
    ///
    /// `wi` and `wo` are unit, in the upper hemisphere (z >= 0), pointing away. At depth t, a share exp(-A_i t) of the light
    /// arrives, K dt / mu_i of it scatters into wo, and exp(-A_o t) of that leaves, with A = extinction / mu. This is
    /// integrated over t in \[0, 1\] (for thickness 1), in a form in which either cosine may be 0. If both are 0 (no
    /// light enters, none leaves), so is it.
    pub fn single_scattering(&self, wi: DVec3, wo: DVec3) -> f64 {
        let (mu_i, mu_o) = (wi.z, wo.z);
        check_cosine(mu_i);
        check_cosine(mu_o);
        if mu_o == 0.0 {
            return 0.0;
        }
        let [one, other] = [mu_i, mu_o].map(Elevation::from_cosine);
        self.medium.kernel(wi, wo) * self.reflected_once(one, other) * mu_o
    }

    /// Single scattering's part of the transmitted lobe, per steradian; exact. `wi` has z >= 0, `wo` z <= 0; both point away.
    ///
    /// The integral over t of exp(-A_i t) K / mu_i exp(-A_o (1 - t)); 0 where one of the cosines is 0.
    pub fn single_transmission(&self, wi: DVec3, wo: DVec3) -> f64 {
        let (mu_i, mu_o) = (wi.z, -wo.z);
        check_cosine(mu_i);
        check_cosine(mu_o);
        let [one, other] = [mu_i, mu_o].map(Elevation::from_cosine);
        if mu_i == 0.0 || mu_o == 0.0 {
            return 0.0;
        }
        self.medium.kernel(wi, wo) * self.transmitted_once(one, other) * other.mu
    }

    /// The factor by which the kernel is multiplied to give single scattering's f_r: (1 - exp(-A_i - A_o)) / ((A_i +
    /// A_o) mu_i mu_o), where the A in the denominator are those of thickness 1. Infinite where both cosines are 0.
    #[inline]
    pub fn reflected_once(&self, one: Elevation, other: Elevation) -> f64 {
        let (here, there) = (self.medium.extinction_at(one), self.medium.extinction_at(other));
        let sum = here * other.mu + there * one.mu;
        // The minimum turns 0 / 0 into infinity.
        let depth = (sum / (one.mu * other.mu)).min(f64::INFINITY) * self.thickness;
        one_minus_exp(depth) / sum
    }

    /// Mode 0, the mean over azimuths, of single scattering's f_r between two elevations in \[0, 1\]; exact, symmetric. Infinite where both
    /// cosines are 0.
    pub fn single_scattering_mode_0(&self, one: Elevation, other: Elevation) -> f64 {
        check_cosine(one.mu);
        check_cosine(other.mu);
        let mut mode = [0.0];
        self.medium.kernel_modes(one, other.opposite(), &mut mode);
        mode[0] * self.reflected_once(one, other)
    }

    /// The factor by which the kernel is multiplied to give single scattering's transmitted radiance per unit of flux:
    /// (exp(-A_o) - exp(-A_i)) / ((A_i - A_o) mu_i mu_o) for thickness 1.
    pub fn transmitted_once(&self, one: Elevation, other: Elevation) -> f64 {
        let (depth, other_depth) = (self.depth(one.mu), self.depth(other.mu));
        let difference = (depth - other_depth).abs();
        let mean = if difference > 0.0 { -(-difference).exp_m1() / difference } else { 1.0 };
        (-depth.min(other_depth)).exp() * mean * self.thickness / (one.mu * other.mu)
    }

    /// Single scattering's part of the albedo R at cosine `mu` in \[0, 1\]: the integral of [`Self::single_scattering`] over the
    /// upper hemisphere, to a relative 1e-6 for alpha >= .01 (1e-4 at .005 and mu < 1e-6).
    pub fn single_scattering_albedo(&self, mu: f64) -> f64 {
        static RULE: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| gauss_legendre(SINGLE_NODES, 0.0, 1.0));
        check_cosine(mu);
        let from = Elevation::from_cosine(mu);
        // The angle is warped towards the horizon, as t^3: whatever is narrow lies there.
        let term = |(t, weight): &(f64, f64)| {
            let to = Elevation::from_angle(FRAC_PI_2 * t * t * t);
            let measure = 2.0 * PI * to.s * to.mu * FRAC_PI_2 * 3.0 * t * t * weight;
            measure * self.single_scattering_mode_0(from, to)
        };
        RULE.iter().map(term).sum()
    }
}

/// Gauss nodes of [`Slab::single_scattering_albedo`].
const SINGLE_NODES: usize = 64;

/// The fibres' cross-section sigma of the paper's roughness alpha.
pub fn sigma_from_alpha(alpha: f64) -> f64 {
    alpha * alpha
}
