//! From lobes to the table.
//!
//! At each node the slab is solved for one `wi` ([`lobe`]), and the transformed cosine nearest to the lobe is found by
//! least squares over the hemisphere ([`least_squares`]); its albedo is R itself. Rows of constant mu run from alpha = 1
//! down, each fit starting from the one before.
//!
//! Nodes that cannot be taken as they are:
//!
//! - mu = 0 is a limit that is reached steeply: its row is computed at mu = [`GRAZING_MU`].
//! - alpha = 0 has no lobe (sigma = 0) and serves interpolation only: r = 0, and a, b are those of the next alpha.
//! - mu = 1: the lobe is round, b = 0.
//! - Where the walk says too little, at R below 3e-4 by the shipped table's paths: with fewer than [`SHAPE_EVIDENCE`]
//!   paths reflected after two or more scatterings, a and b are those of the next larger alpha; with fewer than
//!   [`ALBEDO_EVIDENCE`], r is single scattering's share (exact) times the ratio of R to it at the next larger alpha. For
//!   small sigma the lobe falls as sigma^3 while its form and that ratio hold still, so that both copies lead to
//!   the limit. Long walks found, from node to node of alpha, the ratio within 3% and a within 6% at mu = 1 below 6/31, and
//!   within 30% and 20% at mu = 10/31 below 5/31.

pub mod hemisphere;
pub mod least_squares;
pub mod lobe;
pub mod ltc;
mod report;

pub use report::Report;

use crate::physics::slab::Slab;
use crate::table::{LtcTable, node};
use hemisphere::Hemisphere;
use least_squares::Free;
use lobe::{Lobe, LobeSolver, WalkSolver};
use ltc::Ltc;
use rayon::prelude::*;
use std::ops::RangeInclusive;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The cosine at which the table's row mu = 0 is computed.
pub const GRAZING_MU: f64 = 1e-3;

/// Reflected paths below which a lobe's form is not fitted: at 3000, a is known to some 2% and b to some 0.02.
pub const SHAPE_EVIDENCE: f64 = 3000.0;

/// Reflected paths below which they do not give r: at 100, it is known to 10%.
pub const ALBEDO_EVIDENCE: f64 = 100.0;

/// What is fitted, and how long it may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Nodes a side, in [`Options::RESOLUTIONS`].
    pub resolution: usize,
    /// Paths of each lobe's walk, >= 1; dim lobes get more ([`WalkSolver`]).
    pub paths: u64,
    /// Equal seeds give equal tables, whatever the number of threads.
    pub seed: u64,
}

impl Options {
    /// At 128, the smallest alpha is 1/127, where grazing light scatters hundreds of times.
    pub const RESOLUTIONS: RangeInclusive<usize> = 2..=128;
}

impl Default for Options {
    /// The shipped table: some four minutes on two cores.
    fn default() -> Self {
        Self { resolution: 32, paths: 1_200_000, seed: 1 }
    }
}

/// Fits the sheen's table by random walk. `progress` is told (done, all) lobes, from any of the working threads.
pub fn sheen(options: Options, progress: impl Fn(usize, usize) + Sync) -> (LtcTable, Report) {
    let Options { resolution, paths, seed } = options;
    assert!(Options::RESOLUTIONS.contains(&resolution), "a table has {:?} nodes: {resolution}", Options::RESOLUTIONS);
    let solver = WalkSolver { paths, seed };
    let rows = rows(resolution, &solver, progress);
    let fits: Vec<&Fit> = rows.iter().flatten().collect();
    let report = Report::new(options, &fits);
    let mut cells = Vec::with_capacity(resolution * resolution);
    for row in &rows {
        let Ltc { a, b } = row[0].ltc;
        cells.push([a, b, 0.0].map(seven_digits));
    }
    for i in 0..resolution - 1 {
        cells.extend(rows.iter().map(|row| [row[i].ltc.a, row[i].ltc.b, row[i].albedo].map(seven_digits)));
    }
    (LtcTable::new([resolution; 2], cells), report)
}

/// One node of the table.
struct Fit {
    ltc: Ltc,
    albedo: f64,
    /// Standard error of `albedo`.
    albedo_error: f64,
    /// Relative L2 distance of lobe and transformed cosine, freed of the lobe's noise.
    distance: f64,
    shape_copied: bool,
    albedo_copied: bool,
}

/// For each mu, the nodes with alpha > 0, ascending.
fn rows(resolution: usize, solver: &impl LobeSolver, progress: impl Fn(usize, usize) + Sync) -> Vec<Vec<Fit>> {
    let hemisphere = Hemisphere::default();
    let (done, all) = (AtomicUsize::new(0), resolution * (resolution - 1));
    let node = |k: usize| node(k, resolution);
    let row = |j: usize| {
        let mut row: Vec<Fit> = Vec::new();
        for i in (1..resolution).rev() {
            let (slab, mu) = (Slab::new(node(i)), node(j).max(GRAZING_MU));
            let larger = row.last().map_or((Ltc { a: 1.0, b: 0.0 }, 1.0), |fit| {
                let larger = Slab::new(node(i + 1));
                (fit.ltc, fit.albedo / larger.single_scattering_albedo(mu))
            });
            row.push(fit(slab, mu, &solver.solve(slab, mu, &hemisphere), &hemisphere, larger));
            progress(done.fetch_add(1, Ordering::Relaxed) + 1, all);
        }
        row.reverse();
        row
    };
    (0..resolution).into_par_iter().map(row).collect()
}

/// Fits `lobe`; `larger` holds the next larger alpha's matrix and its ratio of R to single scattering's share.
fn fit(slab: Slab, mu: f64, lobe: &Lobe, hemisphere: &Hemisphere, larger: (Ltc, f64)) -> Fit {
    let (shape_copied, albedo_copied) = (lobe.evidence < SHAPE_EVIDENCE, lobe.evidence < ALBEDO_EVIDENCE);
    let shape: Vec<f64> = lobe.values.iter().map(|value| value / lobe.albedo).collect();
    let ltc = if shape_copied {
        larger.0
    } else {
        let free = if mu == 1.0 { Free::OnlyA } else { Free::Both };
        least_squares::fit(&shape, hemisphere, larger.0, free)
    };
    let albedo = if albedo_copied { slab.single_scattering_albedo(mu) * larger.1 } else { lobe.albedo };
    let noise = lobe.noise / (lobe.albedo * lobe.albedo);
    let square = least_squares::squared_error(&shape, hemisphere, ltc) - noise;
    let norm = hemisphere.integral(|node| shape[node] * shape[node]) - noise;
    let distance = (square / norm).max(0.0).sqrt();
    Fit { ltc, albedo, albedo_error: lobe.albedo_error, distance, shape_copied, albedo_copied }
}

/// The nearest number of seven decimal digits, finer than anything here is known: what a table holds, its files hold too.
fn seven_digits(value: f64) -> f64 {
    // Adding 0 turns -0 into 0.
    format!("{value:.6e}").parse::<f64>().expect("a formatted number is one") + 0.0
}
