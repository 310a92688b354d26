//! The lobes that are fitted, and the one interface by which they are had.

use super::hemisphere::Hemisphere;
use crate::physics::slab::Slab;
use crate::physics::walk::{Counts, FirstFlight, Walk};
use glam::DVec3;

/// The reflected lobe f_r(wi, wo) mu_o of the slab for one `wi`, as far as a solver knows it.
#[derive(Clone, Debug)]
pub struct Lobe {
    /// The share R of light that is reflected: the lobe's integral.
    pub albedo: f64,
    /// Standard error of `albedo`; 0 where the solver makes none.
    pub albedo_error: f64,
    /// The lobe at the nodes of [`Hemisphere`], per steradian.
    pub values: Vec<f64>,
    /// Expected square of the noise in `values`, integrated over the hemisphere.
    pub noise: f64,
    /// Single scattering's share of light, which is exact.
    pub albedo_once: f64,
    /// Paths behind all that is not exact: infinite for a solver without noise.
    pub evidence: f64,
}

/// Whoever solves the slab.
pub trait LobeSolver: Sync {
    /// The lobe at roughness `alpha` and cosine `mu`, both in (0, 1\].
    fn solve(&self, alpha: f64, mu: f64, hemisphere: &Hemisphere) -> Lobe;
}

/// Single scattering in closed form, and the random walk for all other orders.
pub struct WalkSolver {
    /// Paths of a lobe; a lobe with few reflected ones gets [`WalkSolver::EXTRA`] times as many.
    pub paths: u64,
    pub seed: u64,
}

impl WalkSolver {
    /// How many times more paths a dim lobe gets.
    pub const EXTRA: u64 = 4;
    /// Reflected paths below which a lobe is dim.
    pub const DIM: u64 = 20_000;

    fn walk(&self, slab: Slab, mu: f64) -> (Walk, Counts) {
        // Lobes share their random numbers: their errors are then alike where the lobes are, which keeps the table smooth.
        let first = Walk { slab, mu, first_flight: FirstFlight::Scattered, paths: self.paths, seed: self.seed };
        let counts = first.run();
        if counts.reflected() >= Self::DIM.min(self.paths / 16) {
            return (first, counts);
        }
        let more = Walk { paths: self.paths * Self::EXTRA, ..first };
        let counts = more.run();
        (more, counts)
    }
}

impl LobeSolver for WalkSolver {
    fn solve(&self, alpha: f64, mu: f64, hemisphere: &Hemisphere) -> Lobe {
        let slab = Slab::new(alpha);
        let (walk, counts) = self.walk(slab, mu);
        let wi = DVec3::new(((1.0 - mu) * (1.0 + mu)).sqrt(), 0.0, mu);
        let mut values: Vec<f64> = hemisphere.nodes.iter().map(|&wo| slab.single_scattering(wi, wo)).collect();
        let albedo_once: f64 = values.iter().zip(&hemisphere.weights).map(|(value, weight)| value * weight).sum();
        let share = walk.share();
        let mut noise = 0.0;
        let bins = hemisphere.bins().zip(counts.reflected_more.bins().flatten());
        for (nodes, (solid_angle, &count)) in values.chunks_exact_mut(Hemisphere::PER_BIN).zip(bins) {
            let density = share * count as f64 / solid_angle;
            nodes.iter_mut().for_each(|value| *value += density);
            noise += density * share;
        }
        let more = counts.reflected_more.total() as f64;
        // A binomial's variance.
        let albedo_error = share * (more * (1.0 - more / walk.paths as f64)).sqrt();
        Lobe { albedo: albedo_once + share * more, albedo_error, values, noise, albedo_once, evidence: more }
    }
}
