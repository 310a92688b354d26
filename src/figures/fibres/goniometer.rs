//! A goniometer: where a patch of fibres sends light.

use super::patch::{Passage, Patch};
use super::planting::in_box;
use crate::math::frame::AzimuthFrame;
use crate::math::{sine, warp};
use crate::physics::walk::{Counts, stream};
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// A measurement to be made: how many paths are sent at a patch, and from where.
#[derive(Clone, Copy, Debug)]
pub struct Goniometer {
    /// Cosine of `wi` to the normal, in (0, 1\].
    pub mu: f64,
    /// Number of paths, >= 1.
    pub paths: u64,
    /// Equal seeds give equal counts, on any number of threads.
    pub seed: u64,
}

/// Where paths left.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Measured {
    /// Paths by how they left the layer. Below it is black: what is transmitted is absorbed there.
    pub counts: Counts,
    /// Paths that were given up: 0 unless something is broken.
    pub interrupted: u64,
    /// Number of reflections, of all paths together.
    pub scatterings: u64,
}

/// Paths that share a stream of random numbers.
const CHUNK: u64 = 1 << 10;

impl Goniometer {
    /// Sends all paths at a patch, on the threads of the current rayon pool: they enter anywhere, from any azimuth.
    /// Panics unless `mu` is in (0, 1\] and there is a path.
    pub fn measure(&self, patch: &Patch) -> Measured {
        assert!(self.mu > 0.0 && self.mu <= 1.0, "mu is in (0, 1]: {}", self.mu);
        assert!(self.paths >= 1, "a measurement has paths: {}", self.paths);
        let chunk = |index: u64| self.chunk(patch, index, CHUNK.min(self.paths - index * CHUNK));
        let add = |sum: Measured, measured: Measured| Measured {
            counts: sum.counts.plus(&measured.counts),
            interrupted: sum.interrupted + measured.interrupted,
            scatterings: sum.scatterings + measured.scatterings,
        };
        (0..self.paths.div_ceil(CHUNK)).into_par_iter().map(chunk).reduce(Measured::default, add)
    }

    fn chunk(&self, patch: &Patch, index: u64, paths: u64) -> Measured {
        let mut rng = stream(self.seed, index);
        let mut measured = Measured::default();
        for _ in 0..paths {
            let entry = in_box(DVec3::new(patch.period(), patch.period(), 0.0), &mut rng) + DVec3::Z;
            let (sin, cos) = (TAU * warp::uniform(&mut rng)).sin_cos();
            let wi = DVec3::new(sine(self.mu) * cos, sine(self.mu) * sin, self.mu);
            match patch.trace(entry, -wi) {
                Passage::Left { direction, scatterings } => {
                    measured.counts.count(scatterings, AzimuthFrame::of(wi).local(direction));
                    measured.scatterings += scatterings;
                }
                Passage::Interrupted => measured.interrupted += 1,
            }
        }
        measured
    }
}

impl Measured {
    /// The number of all paths.
    pub fn paths(&self) -> u64 {
        self.counts.paths() + self.interrupted
    }

    /// The share of light that left by the top, and its standard error.
    pub fn albedo(&self) -> [f64; 2] {
        let paths = self.paths() as f64;
        let share = self.counts.reflected() as f64 / paths;
        [share, (share * (1.0 - share) / paths).sqrt()]
    }
}
