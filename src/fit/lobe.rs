//! The lobes that are fitted, and the one interface by which they are had.

use super::hemisphere::Hemisphere;
use crate::math::sine;
use crate::physics::slab::Slab;
use crate::physics::walk::{FirstFlight, Walk};
use glam::DVec3;

/// The reflected lobe f_r(wi, wo) mu_o of a slab for one `wi`, as far as a solver knows it.
#[derive(Clone, Debug)]
pub struct Lobe {
    /// The share R of light that is reflected: the lobe's integral.
    pub albedo: f64,
    /// Standard error of `albedo`; 0 for a solver without noise.
    pub albedo_error: f64,
    /// The lobe at the nodes of [`Hemisphere`], per steradian.
    pub values: Vec<f64>,
    /// Expected square of the noise in `values`, integrated over the hemisphere.
    pub noise: f64,
    /// Reflected paths that all but the exact part comes from; infinite for a solver without noise.
    pub evidence: f64,
}

/// Whoever solves the slab.
pub trait LobeSolver: Sync {
    /// The lobe of a slab for `wi` of cosine `mu` in (0, 1\].
    fn solve(&self, slab: Slab, mu: f64, hemisphere: &Hemisphere) -> Lobe;
}

/// Single scattering in closed form at the nodes, per steradian.
pub fn single_scattering(slab: Slab, mu: f64, hemisphere: &Hemisphere) -> Vec<f64> {
    let wi = DVec3::new(sine(mu), 0.0, mu);
    hemisphere.nodes.iter().map(|&wo| slab.single_scattering(wi, wo)).collect()
}

/// Single scattering in closed form, and the random walk for all other orders.
#[derive(Clone, Copy, Debug)]
pub struct WalkSolver {
    /// Paths of a lobe of middling brightness; a dim one that can still be seen gets eight times as many.
    pub paths: u64,
    /// Equal seeds give equal lobes.
    pub seed: u64,
}

impl WalkSolver {
    /// How many times more paths a dim lobe gets: enough for 1% in r at R = 1e-3.
    const EXTRA: u64 = 8;
    /// Albedos between which a lobe is dim; below, nobody sees it.
    const DIM: [f64; 2] = [2e-4, 2e-2];
    /// The share of the paths that is spent beforehand on finding how dim a lobe is, and then left out: what stops on its
    /// own results is biased.
    const PILOT: u64 = 16;
}

impl LobeSolver for WalkSolver {
    fn solve(&self, slab: Slab, mu: f64, hemisphere: &Hemisphere) -> Lobe {
        // Each lobe walks on streams of its own.
        let seed = self.seed ^ slab.medium().sigma().to_bits() ^ mu.to_bits().rotate_left(23);
        let paths = self.paths.div_ceil(Self::PILOT);
        let pilot = Walk { slab, mu, first_flight: FirstFlight::Scattered, paths, seed: !seed };
        let albedo = pilot.run().reflected() as f64 * pilot.share();
        let dim = (Self::DIM[0]..Self::DIM[1]).contains(&albedo);
        let walk = Walk { paths: if dim { self.paths * Self::EXTRA } else { self.paths }, seed, ..pilot };
        let (counts, share) = (walk.run().reflected_more, walk.share());
        let mut values = single_scattering(slab, mu, hemisphere);
        let mut noise = 0.0;
        let bins = hemisphere.bins().zip(counts.bins().flatten());
        for (nodes, (solid_angle, &count)) in values.chunks_exact_mut(Hemisphere::PER_BIN).zip(bins) {
            let density = share * count as f64 / solid_angle;
            nodes.iter_mut().for_each(|value| *value += density);
            noise += density * share;
        }
        let evidence = counts.total() as f64;
        let albedo = slab.single_scattering_albedo(mu) + share * evidence;
        // A binomial's.
        let albedo_error = share * (evidence * (1.0 - evidence / walk.paths as f64)).sqrt();
        Lobe { albedo, albedo_error, values, noise, evidence }
    }
}
