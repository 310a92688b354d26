//! The slab solved by an analog random walk: every order of scattering, no bias, only noise.
//!
//! A path ends only where it leaves the slab, after as many scatterings as that takes. It does leave: nowhere is the phase
//! function below sigma^3 / (4 pi), so that from any depth and direction, the next scattering turns a path to within 60
//! degrees of the normal, and the flight after that takes it out, with a chance above a number that depends on sigma
//! alone; thus the number of scatterings is bounded by a geometric variable. Its mean stays under 100 down to alpha =
//! 1/31, and under a thousand down to 1/127. Nor can NaN keep a path inside: a depth that is not in (0, 1) ends it.
//!
//! All scores are integers, so that sums do not depend on the order of threads: a seed gives the same counts on any
//! number of them.

use super::slab::Slab;
use crate::math::{sine, warp};
use glam::DVec3;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Paths that share a stream of random numbers.
const CHUNK: u64 = 1 << 14;

/// Distance between the streams: odd, and near 2^128 divided by the golden ratio, so that they lie far apart and do not
/// share their low bits.
const STREAM_STRIDE: u128 = 0x9e37_79b9_7f4a_7c15_f39c_c060_5ced_c835;

/// The random numbers of a chunk of paths.
pub fn stream(seed: u64, index: u64) -> Pcg64 {
    let mut rng = Pcg64::seed_from_u64(seed);
    rng.advance(STREAM_STRIDE.wrapping_mul(u128::from(index) + 1));
    rng
}

/// How often a path's first flight ends in the slab.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FirstFlight {
    /// As in nature: some paths pass unscattered.
    Analog,
    /// Always: each path stands for the share of light that is scattered at all, so that none is spent on the rest.
    Scattered,
}

/// What to walk: how many paths, from where, through which slab.
#[derive(Clone, Copy, Debug)]
pub struct Walk {
    /// The slab through which paths go.
    pub slab: Slab,
    /// Cosine of `wi` to the normal, in (0, 1\].
    pub mu: f64,
    /// How the first flight of each path is sampled.
    pub first_flight: FirstFlight,
    /// Number of paths, >= 1.
    pub paths: u64,
    /// Equal seeds give equal counts.
    pub seed: u64,
}

/// Numbers of paths by where and how they left the slab. Every path is counted once.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Left below without a scattering.
    pub unscattered: u64,
    /// Left below after one scattering, by direction.
    pub transmitted_once: Histogram,
    /// Left below after two or more scatterings, by direction.
    pub transmitted_more: Histogram,
    /// Left above after one scattering, by direction.
    pub reflected_once: Histogram,
    /// Left above after two or more scatterings, by direction.
    pub reflected_more: Histogram,
}

impl Counts {
    /// The number of all paths.
    pub fn paths(&self) -> u64 {
        self.unscattered + self.transmitted() + self.reflected()
    }

    /// Paths that left below after one or more scatterings.
    pub fn transmitted(&self) -> u64 {
        self.transmitted_once.total() + self.transmitted_more.total()
    }

    /// Paths that left above.
    pub fn reflected(&self) -> u64 {
        self.reflected_once.total() + self.reflected_more.total()
    }

    /// Counts a path that left along `out` after `scatterings`.
    #[inline]
    pub fn count(&mut self, scatterings: u64, out: DVec3) {
        match (scatterings, out.z > 0.0) {
            (0, _) => self.unscattered += 1,
            (1, true) => self.reflected_once.count(out),
            (_, true) => self.reflected_more.count(out),
            (1, false) => self.transmitted_once.count(out),
            (_, false) => self.transmitted_more.count(out),
        }
    }

    /// The counts of these paths and those of `other` together.
    #[must_use]
    pub fn plus(mut self, other: &Self) -> Self {
        self.unscattered += other.unscattered;
        self.transmitted_once.add(&other.transmitted_once);
        self.transmitted_more.add(&other.transmitted_more);
        self.reflected_once.add(&other.reflected_once);
        self.reflected_more.add(&other.reflected_more);
        self
    }
}

/// Counts over the upper or lower hemisphere, in bins of the magnitude of the cosine `mu_o` and of the azimuth from
/// `wi`; the two sides of the plane of incidence are counted together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Histogram {
    /// At the cosine's bin times [`Histogram::PHI_BINS`] plus the azimuth's bin.
    bins: Vec<u64>,
}

impl Default for Histogram {
    fn default() -> Self {
        Self { bins: vec![0; Self::MU_BINS * Self::PHI_BINS] }
    }
}

impl Histogram {
    /// Bins of sqrt(mu_o), of equal width: fine at the horizon, where lobes of small alpha lie.
    pub const MU_BINS: usize = 64;
    /// Bins of |phi| in \[0, pi\], of equal width.
    pub const PHI_BINS: usize = 32;

    /// For each bin of the cosine, the counts in the azimuth's bins.
    pub fn bins(&self) -> impl Iterator<Item = &[u64]> {
        self.bins.chunks_exact(Self::PHI_BINS)
    }

    /// All counts.
    pub fn total(&self) -> u64 {
        self.bins.iter().sum()
    }

    /// The cosines between which bin `k` in \[0, MU_BINS) of the cosine lies.
    pub fn mu_range(k: usize) -> [f64; 2] {
        [k, k + 1].map(|edge| (edge as f64 / Self::MU_BINS as f64).powi(2))
    }

    /// The azimuths between which bin `k` in \[0, PHI_BINS) of the azimuth lies.
    pub fn phi_range(k: usize) -> [f64; 2] {
        [k, k + 1].map(|edge| PI * edge as f64 / Self::PHI_BINS as f64)
    }

    fn count(&mut self, wo: DVec3) {
        let bin = |x: f64, bins: usize| ((x * bins as f64) as usize).min(bins - 1);
        let mu_bin = bin(wo.z.abs().sqrt(), Self::MU_BINS);
        let phi_bin = bin(wo.y.abs().atan2(wo.x) / PI, Self::PHI_BINS);
        self.bins[mu_bin * Self::PHI_BINS + phi_bin] += 1;
    }

    fn add(&mut self, other: &Self) {
        for (sum, count) in self.bins.iter_mut().zip(&other.bins) {
            *sum += count;
        }
    }
}

impl Walk {
    /// Walks all paths, on the threads of the current rayon pool. Panics unless `mu` is in (0, 1\] and there is a path.
    pub fn run(&self) -> Counts {
        assert!(self.mu > 0.0 && self.mu <= 1.0, "mu is in (0, 1]: {}", self.mu);
        assert!(self.paths >= 1, "a walk has paths: {}", self.paths);
        let chunk = |index: u64| self.chunk(index, CHUNK.min(self.paths - index * CHUNK));
        let add = |sum: Counts, counts: Counts| sum.plus(&counts);
        (0..self.paths.div_ceil(CHUNK)).into_par_iter().map(chunk).reduce(Counts::default, add)
    }

    /// The share of light that a path stands for.
    pub fn share(&self) -> f64 {
        let scattered = match self.first_flight {
            FirstFlight::Analog => 1.0,
            FirstFlight::Scattered => self.slab.scattered(self.mu),
        };
        scattered / self.paths as f64
    }

    fn chunk(&self, index: u64, paths: u64) -> Counts {
        let mut rng = stream(self.seed, index);
        let mut counts = Counts::default();
        let depth = self.slab.depth(self.mu);
        for _ in 0..paths {
            // In units of the slab's optical depth along the path.
            let flight = match self.first_flight {
                FirstFlight::Analog => warp::exponential(&mut rng),
                FirstFlight::Scattered => -(warp::uniform(&mut rng) * (-depth).exp_m1()).ln_1p(),
            } / depth;
            if flight < 1.0 || self.first_flight == FirstFlight::Scattered {
                self.path(flight, &mut rng, &mut counts);
            } else {
                counts.unscattered += 1;
            }
        }
        counts
    }

    /// Follows a path from its first scattering, at `depth` below the top in units of the thickness, until it leaves.
    fn path(&self, mut depth: f64, rng: &mut Pcg64, counts: &mut Counts) {
        let medium = self.slab.medium();
        // Light comes from wi, which therefore points back along the first flight.
        let mut back = DVec3::new(sine(self.mu), 0.0, self.mu);
        let mut seen = medium.stretched(back).normalize();
        let mut orders = 0_u64;
        let thickness = self.slab.thickness();
        loop {
            let out = medium.sample_seen(back, seen, rng);
            orders += 1;
            let stretched = medium.stretched(out);
            let inverse_extinction = 1.0 / stretched.length();
            depth -= out.z * warp::exponential(rng) * inverse_extinction / thickness;
            if depth <= 0.0 {
                let histogram = if orders == 1 { &mut counts.reflected_once } else { &mut counts.reflected_more };
                return histogram.count(out);
            }
            if depth < 1.0 {
                back = -out;
                seen = stretched * -inverse_extinction;
            } else {
                // Below, or not a number.
                let histogram = if orders == 1 { &mut counts.transmitted_once } else { &mut counts.transmitted_more };
                return histogram.count(out);
            }
        }
    }
}
