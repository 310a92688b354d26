//! How far fibres are from the slab.

use super::goniometer::{Goniometer, Measured};
use super::patch::Patch;
use crate::math::quadrature::gauss_legendre;
use crate::math::sine;
use crate::physics::transport::Transport;
use crate::physics::walk::Histogram;
use glam::DVec3;

/// A patch of fibres and the solved slab under light from one elevation.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// The slab's R.
    pub solved: f64,
    /// The fibres' R, and its standard error.
    pub albedo: [f64; 2],
    /// The relative distance of the fibres' lobe from the slab's: the root of the integral of the squared difference
    /// over that of the slab's square, both from means over 16 bins of sqrt(mu_o) by 8 of |phi|. What counting noise
    /// adds on average is subtracted; 0 where nothing is left.
    pub distance: f64,
    /// What was subtracted for noise, as such a distance.
    pub noise: f64,
    /// The measurement itself.
    pub measured: Measured,
}

/// Bins of sqrt(mu_o) and of |phi| in which lobes are compared.
pub const ROWS: usize = 16;
pub const COLUMNS: usize = 8;

impl Comparison {
    /// Measures a patch and compares it with the slab; panics as [`Goniometer::measure`] does.
    pub fn new(transport: &Transport, patch: &Patch, goniometer: &Goniometer) -> Self {
        let measured = goniometer.measure(patch);
        let (paths, mu) = (measured.paths() as f64, goniometer.mu);
        let wi = DVec3::new(sine(mu), 0.0, mu);
        let counts = coarse_counts(&measured);
        let (mut off, mut noise, mut whole) = (0.0, 0.0, 0.0);
        for (index, count) in counts.into_iter().enumerate() {
            let [share, found] = [share(transport, wi, index), count as f64 / paths];
            let solid_angle = solid_angle(index);
            off += (found - share).powi(2) / solid_angle;
            noise += found / paths / solid_angle;
            whole += share * share / solid_angle;
        }
        Self {
            solved: transport.albedo(mu),
            albedo: measured.albedo(),
            distance: ((off - noise).max(0.0) / whole).sqrt(),
            noise: (noise / whole).sqrt(),
            measured,
        }
    }
}

/// Numbers of reflected paths in the bins, elevation-major.
fn coarse_counts(measured: &Measured) -> Vec<u64> {
    let mut counts = vec![0; ROWS * COLUMNS];
    for histogram in [&measured.counts.reflected_once, &measured.counts.reflected_more] {
        for (row, bins) in histogram.bins().enumerate() {
            for (column, count) in bins.iter().enumerate() {
                let [row, column] = [row * ROWS / Histogram::MU_BINS, column * COLUMNS / Histogram::PHI_BINS];
                counts[row * COLUMNS + column] += count;
            }
        }
    }
    counts
}

/// The cosines and the azimuths between which a bin lies.
fn ranges(index: usize) -> [[f64; 2]; 2] {
    let first = |bin: usize, all: usize, bins: usize| [bin * all / bins, (bin + 1) * all / bins - 1];
    let [low, high] = first(index / COLUMNS, Histogram::MU_BINS, ROWS).map(Histogram::mu_range);
    let [from, to] = first(index % COLUMNS, Histogram::PHI_BINS, COLUMNS).map(Histogram::phi_range);
    [[low[0], high[1]], [from[0], to[1]]]
}

/// The solid angle of a bin, on both sides of the plane of incidence.
fn solid_angle(index: usize) -> f64 {
    let [[low, high], [from, to]] = ranges(index);
    2.0 * (high - low) * (to - from)
}

/// The share of light that the slab sends into a bin.
fn share(transport: &Transport, wi: DVec3, index: usize) -> f64 {
    let [[low, high], [from, to]] = ranges(index);
    let mut share = 0.0;
    // Nodes in sqrt(mu_o), in which all bins have the same width.
    for (root, root_weight) in gauss_legendre(NODES, low.sqrt(), high.sqrt()) {
        let mu_o = root * root;
        for (phi, phi_weight) in gauss_legendre(NODES, from, to) {
            let wo = DVec3::new(sine(mu_o) * phi.cos(), sine(mu_o) * phi.sin(), mu_o);
            share += 4.0 * root * root_weight * phi_weight * transport.reflected(wi, wo);
        }
    }
    share
}

/// Nodes per axis of a bin, enough for the sum of all [`share`]s to be R to 1e-3 (alpha >= .2, mu >= .2).
const NODES: usize = 6;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::slab::Slab;
    use crate::physics::transport::Resolution;
    use std::f64::consts::PI;

    #[test]
    fn bins_hold_the_whole_lobe() {
        let angles: f64 = (0..ROWS * COLUMNS).map(solid_angle).sum();
        assert!((angles - 2.0 * PI).abs() < 1e-12, "{angles}");
        for (alpha, mu) in [(0.2, 0.2), (0.4, 0.5), (1.0, 0.9)] {
            let transport = Transport::new(Slab::new(alpha), Resolution::default());
            let wi = DVec3::new(sine(mu), 0.0, mu);
            let sum: f64 = (0..ROWS * COLUMNS).map(|index| share(&transport, wi, index)).sum();
            assert!((sum / transport.albedo(mu) - 1.0).abs() < 1e-3, "alpha {alpha}, mu {mu}: {sum}");
        }
    }
}
