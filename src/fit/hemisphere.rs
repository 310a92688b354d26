//! Quadrature over the upper hemisphere, on the cosines of a slab's solution.

use crate::math::quadrature::gauss_legendre;
use crate::math::sine;
use glam::DVec3;
use std::f64::consts::PI;

/// Number of azimuths over the half of the hemisphere on one side of the plane of incidence, about which lobes are
/// symmetric.
pub const AZIMUTHS: usize = 32;

/// Nodes over the half of the upper hemisphere on one side of the plane of incidence.
///
/// Cosines are given: those of [`Transport::cosines`](crate::physics::transport::Transport::cosines) are fine where a slab's
/// lobes are. Azimuths are Gauss nodes of u, phi = pi (1 - u^2), dense towards the direction straight on, around which single scattering
/// at the horizon has a notch. A lobe's integral is its albedo to 5e-5 for alpha >= 2/31, to 1e-4 at 1/31.
#[derive(Clone, Debug)]
pub struct Hemisphere {
    /// Directions; the [`AZIMUTHS`] of one cosine in a row.
    pub nodes: Vec<DVec3>,
    /// Solid angles, for both mirrored halves; their sum is 2 pi.
    pub weights: Vec<f64>,
}

impl Hemisphere {
    /// The hemisphere on the given nodes and weights for integrals over the cosine in \[0, 1\].
    pub fn new(cosines: impl Iterator<Item = (f64, f64)>) -> Self {
        let azimuths = gauss_legendre(AZIMUTHS, 0.0, 1.0);
        let (mut nodes, mut weights) = (Vec::new(), Vec::new());
        for (mu, mu_weight) in cosines {
            for (u, weight) in &azimuths {
                let (sin_phi, cos_phi) = (PI * (1.0 - u * u)).sin_cos();
                nodes.push(DVec3::new(sine(mu) * cos_phi, sine(mu) * sin_phi, mu));
                weights.push(mu_weight * 2.0 * (2.0 * PI * u * weight));
            }
        }
        Self { nodes, weights }
    }

    /// The integral over the hemisphere of a function of the node's index.
    pub fn integral(&self, value: impl Fn(usize) -> f64) -> f64 {
        self.weights.iter().enumerate().map(|(index, weight)| weight * value(index)).sum()
    }
}
