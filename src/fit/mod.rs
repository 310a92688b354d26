//! From lobes to the table: at each node the slab's reflected lobe is solved and a transformed cosine is fitted to it.
//!
//! Node k of n sits at k/(n-1) in alpha and in mu. Three kinds of node are no plain fit:
//!
//! * mu = 0 is a limit that is reached steeply; its row is computed at [`GRAZING_MU`].
//! * alpha = 0 has no lobe (sigma = 0): its column serves interpolation alone. a and b are those of the next column, r is 0.
//! * Where too few paths come back (below [`LEAST_EVIDENCE`]; R is then below 1e-3), the walk does not tell the lobe's
//!   shape. The neighbours of larger alpha stand in: a follows the power of alpha (in \[0, 1\]) that leads through the nearest fitted one
//!   and the one two nodes on, b is the nearest one's. Below [`LEAST_ALBEDO_EVIDENCE`], r is single scattering's albedo, which
//!   is known in closed form, times the nearest one's ratio of r to it, which changes slowly.

pub mod hemisphere;
pub mod least_squares;
pub mod lobe;
pub mod ltc;
mod report;

pub use report::Report;

use hemisphere::Hemisphere;
use least_squares::{Free, LEAST_A, fit, squared_error};
use lobe::{Lobe, LobeSolver, WalkSolver};
use ltc::Ltc;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::physics::slab::Slab;
use crate::table::LtcTable;

/// The cosine at which the row mu = 0 is computed.
pub const GRAZING_MU: f64 = 1e-3;

/// Reflected paths of two or more scatterings below which neighbours stand in for the lobe's shape. What is left of the noise is
/// about 3% of a, and 0.02 in b.
pub const LEAST_EVIDENCE: f64 = 1000.0;

/// The same for the albedo: 300 paths leave 6% of noise.
pub const LEAST_ALBEDO_EVIDENCE: f64 = 300.0;

/// What the sheen's table is made with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SheenOptions {
    /// Nodes along alpha and along mu, in \[4, 256\].
    pub resolution: usize,
    /// Random paths of a lobe of middling brightness; see [`WalkSolver`].
    pub paths: u64,
    /// Equal seeds give equal tables, whatever the number of threads.
    pub seed: u64,
}

impl Default for SheenOptions {
    /// The shipped table's.
    fn default() -> Self {
        Self { resolution: 32, paths: 1_000_000, seed: 1 }
    }
}

/// A node's fit.
#[derive(Clone, Copy, Debug)]
struct Cell {
    alpha: f64,
    ltc: Ltc,
    /// The power of alpha by which `a` goes on to smaller alpha.
    power: f64,
    albedo: f64,
    /// Single scattering's part of `albedo`.
    albedo_single: f64,
    /// Standard error of `albedo` over `albedo`.
    albedo_error: f64,
    /// Relative L2 error of the lobe, its noise left out; none where neighbours stand in.
    error: Option<f64>,
}

/// Makes the sheen's table and the report of its errors.
///
/// `progress` is told, from any thread, how many of how many lobes are done.
pub fn sheen(options: &SheenOptions, progress: impl Fn(usize, usize) + Sync) -> (LtcTable, Report) {
    let solver = WalkSolver { paths: options.paths, seed: options.seed };
    sheen_by(&solver, options.resolution, progress)
}

/// [`sheen`] by any solver of the slab.
pub fn sheen_by(
    solver: &impl LobeSolver,
    resolution: usize,
    progress: impl Fn(usize, usize) + Sync,
) -> (LtcTable, Report) {
    assert!((4..=256).contains(&resolution), "a table's resolution is in [4, 256]: {resolution}");
    let hemisphere = Hemisphere::default();
    let (done, columns) = (AtomicUsize::new(0), resolution - 1);
    // A row is one mu, from alpha = 1 down to the node before 0.
    let row = |j: usize| {
        let mu = if j == 0 { GRAZING_MU } else { node(j, resolution) };
        let solve = |step: usize| {
            let slab = Slab::new(node(columns - step, resolution));
            let lobe = solver.solve(slab, mu, &hemisphere);
            progress(done.fetch_add(1, Ordering::Relaxed) + 1, resolution * columns);
            lobe
        };
        let lobes: Vec<Lobe> = (0..columns).into_par_iter().map(solve).collect();
        let alphas = (0..columns).map(|step| node(columns - step, resolution));
        fit_row(alphas.zip(&lobes), mu, &hemisphere)
    };
    let rows: Vec<Vec<Cell>> = (0..resolution).into_par_iter().map(row).collect();
    (table(&rows), Report::new(&rows))
}

/// Where node `k` of `n` sits.
fn node(k: usize, n: usize) -> f64 {
    k as f64 / (n - 1) as f64
}

/// Fits the lobes of one mu, in the order of falling alpha; each starts from the one before.
fn fit_row<'a>(lobes: impl Iterator<Item = (f64, &'a Lobe)>, mu: f64, hemisphere: &Hemisphere) -> Vec<Cell> {
    // Where wi is the normal the lobe is round.
    let free = if mu == 1.0 { Free::OnlyA } else { Free::Both };
    let mut row: Vec<Cell> = Vec::new();
    for (alpha, lobe) in lobes {
        let albedo_single = Slab::new(alpha).single_scattering_albedo(mu);
        let mut cell = Cell {
            alpha,
            ltc: Ltc { a: alpha, b: 0.0 },
            power: 1.0,
            albedo: lobe.albedo,
            albedo_single,
            albedo_error: lobe.albedo_error / lobe.albedo,
            error: None,
        };
        match row.last() {
            Some(nearest) if lobe.evidence < LEAST_EVIDENCE => stand_in(&mut cell, nearest),
            nearest => {
                (cell.ltc, cell.error) = fit_shape(lobe, hemisphere, free, nearest.map(|cell| cell.ltc));
                cell.power = row.len().checked_sub(2).map_or(1.0, |index| power(&row[index], &cell));
            }
        }
        if let Some(nearest) = row.last().filter(|_| lobe.evidence < LEAST_ALBEDO_EVIDENCE) {
            cell.albedo = albedo_single * nearest.albedo / nearest.albedo_single;
        }
        row.push(cell);
    }
    row
}

/// The best transformed cosine, and its relative L2 error without the share that noise has in it.
fn fit_shape(lobe: &Lobe, hemisphere: &Hemisphere, free: Free, nearest: Option<Ltc>) -> (Ltc, Option<f64>) {
    let shape: Vec<f64> = lobe.values.iter().map(|value| value / lobe.albedo).collect();
    // A minimum at b = 0 may hide a better one: a tilted start as well.
    let tilted = Ltc { a: nearest.map_or(0.8, |ltc| ltc.a), b: if free == Free::Both { -0.1 } else { 0.0 } };
    let [first, second] = [nearest.unwrap_or(tilted), tilted].map(|start| {
        let ltc = fit(&shape, hemisphere, start, free);
        (squared_error(&shape, hemisphere, ltc), ltc)
    });
    let (error, ltc) = if first.0 <= second.0 { first } else { second };
    let noise = lobe.noise / (lobe.albedo * lobe.albedo);
    let square = hemisphere.integral(|index| shape[index] * shape[index]);
    (ltc, Some(((error - noise).max(0.0) / (square - noise)).sqrt()))
}

/// The power of alpha that `a` follows between two cells, in \[0, 1\]: a wider lobe for a smaller alpha would be noise.
fn power(far: &Cell, near: &Cell) -> f64 {
    ((near.ltc.a / far.ltc.a).ln() / (near.alpha / far.alpha).ln()).clamp(0.0, 1.0)
}

fn stand_in(cell: &mut Cell, nearest: &Cell) {
    let a = nearest.ltc.a * (cell.alpha / nearest.alpha).powf(nearest.power);
    cell.ltc = Ltc { a: a.max(LEAST_A), b: nearest.ltc.b };
    cell.power = nearest.power;
}

/// The nodes, alpha-major, rounded to what is written: seven digits after the point.
fn table(rows: &[Vec<Cell>]) -> LtcTable {
    let resolution = rows.len();
    let round = |value: f64| (value * 1e7).round() / 1e7;
    let cell = |i: usize, j: usize| {
        let Cell { ltc, albedo, .. } = rows[j][resolution - 1 - i.max(1)];
        // + 0 turns a rounded -0 into 0.
        [round(ltc.a), round(ltc.b) + 0.0, if i == 0 { 0.0 } else { round(albedo) }]
    };
    let cells = (0..resolution).flat_map(|i| (0..resolution).map(move |j| (i, j))).map(|(i, j)| cell(i, j));
    LtcTable::new([resolution; 2], cells.collect())
}
