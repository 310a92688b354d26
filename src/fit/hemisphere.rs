//! Quadrature over the upper hemisphere, half of it: lobes are mirrored in the plane of incidence.

use crate::math::quadrature::gauss_legendre;
use crate::physics::walk::Histogram;
use glam::DVec3;

/// Gauss nodes a side within each bin of the walk's histogram: a lobe's part that is known by bins, and one that is known
/// everywhere, share them.
const NODES: usize = 2;

/// Nodes over the upper hemisphere, those of a bin in a row, bins in the order of [`Histogram::bins`].
pub struct Hemisphere {
    /// Directions with azimuths in (0, pi).
    pub nodes: Vec<DVec3>,
    /// Solid angles, for both mirrored halves; their sum is 2 pi.
    pub weights: Vec<f64>,
}

impl Hemisphere {
    /// Nodes in a bin.
    pub const PER_BIN: usize = NODES * NODES;

    pub fn new() -> Self {
        let (mut nodes, mut weights) = (Vec::new(), Vec::new());
        for mu_bin in 0..Histogram::MU_BINS {
            let [low, high] = Histogram::mu_range(mu_bin).map(f64::sqrt);
            for phi_bin in 0..Histogram::PHI_BINS {
                let [first, last] = Histogram::phi_range(phi_bin);
                for (t, t_weight) in gauss_legendre(NODES, low, high) {
                    for (phi, phi_weight) in gauss_legendre(NODES, first, last) {
                        // mu = t^2, d mu = 2 t dt; twice for the other half.
                        let mu = t * t;
                        let s = ((1.0 - mu) * (1.0 + mu)).sqrt();
                        nodes.push(DVec3::new(s * phi.cos(), s * phi.sin(), mu));
                        weights.push(4.0 * t * t_weight * phi_weight);
                    }
                }
            }
        }
        Self { nodes, weights }
    }

    /// Solid angle of each bin.
    pub fn bins(&self) -> impl Iterator<Item = f64> {
        self.weights.chunks_exact(Self::PER_BIN).map(|weights| weights.iter().sum())
    }
}
