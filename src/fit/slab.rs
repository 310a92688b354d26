//! From the slab's solution to its table for path tracers.
//!
//! What a node holds is not the solution there but what interpolates best: in mu, linear interpolation is fitted by
//! least squares to values at 4 x 4 points per cell. With P the pseudo-inverse of the matrix that interpolates from
//! nodes to points, and G the values at pairs of points, the nodes hold P G P^T, which leaves half the error that the
//! solution at the nodes would. In alpha, values are those at the nodes.

use super::errors::{DIM, Errors};
use super::lobe::Lobes;
use super::nodes;
use crate::math::sine;
use crate::physics::modes::Elevation;
use crate::physics::slab::Slab;
use crate::physics::transport::{Resolution, Transport};
use crate::table::{SLAB_SIDE, SlabTable, SlabWarp, centres, slab_alpha};
use glam::DVec3;
use nalgebra::DMatrix;
use rayon::prelude::*;
use std::fmt;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Points per cell and axis of mu.
const PER_CELL: usize = 4;

/// The modes that the table holds.
const MODES: usize = 3;

/// How finely the nodes are solved: at 1 the table's errors are the same to 1%; at .5 the greatest are 4% larger.
const NODES: Resolution = Resolution { modes: MODES, refinement: 0.7, ridge: None };

/// Number of alphas in the report; each is in the middle of a cell.
const REPORT_ALPHAS: usize = 12;

/// Number of cosines in the report for each alpha, in the middles of cells.
const REPORT_MUS: usize = 24;

/// Least alpha of the report, below which the truth is known less well.
const REPORT_LEAST_ALPHA: f64 = 1.0 / 31.0;

/// How good the slab's table is, with single scattering added: relative errors between its nodes where R > 1e-3 and
/// alpha >= 1/31.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Relative L2 error of the lobe f_r mu_o over the hemisphere.
    pub lobe: Errors,
    /// Relative error of its integral against R.
    pub albedo: Errors,
    /// Number of lobes that were compared.
    pub cells: usize,
}

/// Solves the slab at all alphas of the table; the result is the same on any number of threads.
///
/// `progress` is called with the numbers of steps (done, all), from any of the working threads.
pub fn fit(progress: impl Fn(usize, usize) + Sync) -> (SlabTable, Report) {
    let (done, all) = (AtomicUsize::new(0), SLAB_SIDE + REPORT_ALPHAS);
    let step = || progress(done.fetch_add(1, Ordering::Relaxed) + 1, all);
    let solve = |k: usize| {
        let layer = layer(slab_alpha(k as f64));
        step();
        layer
    };
    let layers: Vec<Vec<[f64; 3]>> = (0..SLAB_SIDE).into_par_iter().map(solve).collect();
    let table = SlabTable::new(&layers.concat());
    let report = report(&table, step);
    (table, report)
}

/// The table's `[v0, v1, v2]` at the pairs of mu nodes for one `alpha` in (0, 1\], not rounded to halves.
pub fn layer(alpha: f64) -> Vec<[f64; 3]> {
    let solution = Transport::new(Slab::new(alpha), NODES);
    let warp = SlabWarp::new(alpha);
    let points = (SLAB_SIDE - 1) * PER_CELL;
    let at = centres(points);
    let mus: Vec<f64> = at.iter().map(|&t| warp.mu(SlabWarp::root_from_place(t))).collect();
    let mut values = [(); MODES].map(|()| DMatrix::zeros(points, points));
    for i in 0..points {
        for j in 0..=i {
            for (matrix, value) in values.iter_mut().zip(stored(&solution, mus[i], mus[j])) {
                (matrix[(i, j)], matrix[(j, i)]) = (value, value);
            }
        }
    }
    let fit = nodes::nearest(&at, SLAB_SIDE);
    let fitted = values.map(|matrix| &fit * matrix * fit.transpose());
    // Sums in another order differ in their last bit: of the two equal values of a pair, one is taken for both.
    let pairs = (0..SLAB_SIDE).flat_map(|i| (0..SLAB_SIDE).map(move |j| (i.max(j), i.min(j))));
    pairs.map(|pair| std::array::from_fn(|m| fitted[m][pair])).collect()
}

/// v0, v1, v2 from the solution.
fn stored(solution: &Transport, mu_i: f64, mu_o: f64) -> [f64; 3] {
    let mut modes = [0.0; MODES];
    solution.multiple_modes(mu_i, mu_o, &mut modes);
    let [one, other] = [mu_i, mu_o].map(Elevation::from_cosine);
    let single = solution.slab().single_scattering_mode_0(one, other);
    let across = one.s * other.s;
    let [rho_0, rho_1, rho_2] = modes.map(|mode| mode / single);
    [rho_0.max(0.0).ln_1p(), rho_1 / across, rho_2 / (across * across)]
}

fn report(table: &SlabTable, step: impl Fn() + Sync) -> Report {
    // From the first cell whose middle is not below the least alpha to the last one, evenly spread; in the middles of
    // cells.
    let first = (0..SLAB_SIDE).find(|k| slab_alpha(*k as f64 + 0.5) >= REPORT_LEAST_ALPHA).unwrap_or_default();
    let alphas = (0..REPORT_ALPHAS).map(|k| first + k * (SLAB_SIDE - 2 - first) / (REPORT_ALPHAS - 1));
    let alphas: Vec<f64> = alphas.map(|k| slab_alpha(k as f64 + 0.5)).collect();
    let errors: Vec<Vec<[f64; 2]>> = alphas
        .par_iter()
        .map(|&alpha| {
            let errors = errors(table, alpha);
            step();
            errors
        })
        .collect();
    let errors = errors.concat();
    let [lobe, albedo] = [0, 1].map(|which| Errors::new(errors.iter().map(|error| error[which]).collect()));
    Report { lobe, albedo, cells: errors.len() }
}

/// Relative errors of lobe and R at one alpha, for the bright ones of [`REPORT_MUS`] cosines.
fn errors(table: &SlabTable, alpha: f64) -> Vec<[f64; 2]> {
    let lobes = Lobes::new(Transport::new(Slab::new(alpha), Resolution::default()));
    let Lobes { transport: truth, hemisphere } = &lobes;
    let slice = table.slice(alpha);
    let cell = |k: usize| (k * (SLAB_SIDE - 2) / (REPORT_MUS - 1)) as f64 + 0.5;
    let mus = (0..REPORT_MUS).map(|k| slice.warp().mu(SlabWarp::root_from_place(cell(k) / (SLAB_SIDE - 1) as f64)));
    mus.filter(|mu| truth.albedo(*mu) > DIM)
        .map(|mu| {
            let (wi, r, shape) = (DVec3::new(sine(mu), 0.0, mu), truth.albedo(mu), lobes.shape(mu));
            // Divided by R, as the shape is.
            let found = |wo: DVec3| {
                let [one, other] = [mu, wo.z].map(Elevation::from_cosine);
                let modes = slice.lookup(mu, wo.z);
                let over = modes.over_single(mu * wo.z - wi.dot(wo), (one.s * other.s).powi(2));
                let multiple = truth.slab().single_scattering_mode_0(one, other) * over * wo.z;
                (truth.slab().single_scattering(wi, wo) + multiple) / r
            };
            let found: Vec<f64> = hemisphere.nodes.iter().map(|&wo| found(wo)).collect();
            let square = hemisphere.integral(|node| (found[node] - shape[node]).powi(2));
            let norm = hemisphere.integral(|node| shape[node] * shape[node]);
            [(square / norm).sqrt(), (hemisphere.integral(|node| found[node]) - 1.0).abs()]
        })
        .collect()
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { lobe, albedo, cells } = self;
        write!(
            f,
            "Slab, {cells} lobes between the nodes with R > {DIM}, alpha >= 1/31: relative L2 error mean {:.4}, median {:.4}, max {:.4};\n\
             relative error of R mean {:.4}, median {:.4}, max {:.4}.",
            lobe.mean, lobe.median, lobe.max, albedo.mean, albedo.median, albedo.max
        )
    }
}
