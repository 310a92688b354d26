//! From GGX microfacets to the specular base's table.
//!
//! At each node the transformed cosine is found that has the least L1 distance to the lobe over its albedo, the integral of
//! |f_r mu_o / R - density| over the hemisphere: half of it is the share of light that falls elsewhere. Nodes of one mu
//! are fitted from roughness 1 down, each starting from the one before and from a mirror's matrix. Special cases:
//!
//! - The third row of the inverse matrix is (0, 0, 1), so that a polygon clipped at the horizon for one lobe is clipped
//!   for all.
//! - mu = 0 has the shapes of mu = [`GRAZING_MU`].
//! - roughness = 0 is fitted at alpha = [`LEAST_ALPHA`](crate::physics::microfacet::LEAST_ALPHA).
//! - The albedo and the Fresnel share are not those at the nodes but what interpolates best: see [`nodes`].

mod report;
pub mod row;

pub use report::Report;

use super::nodes;
use crate::math::sine;
use crate::physics::microfacet::{Ggx, Reflected};
use crate::table::ggx::{GRAZING_MU, cosine};
use crate::table::{GgxTable, Ltc, centres, node};
use nalgebra::DMatrix;
use rayon::prelude::*;
use row::{Fit, row};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Points per cell and axis that the interpolated albedos are fitted to.
const PER_CELL: usize = 4;

/// Fits the table with `resolution` >= 2 nodes a side; the result is the same on any number of threads.
///
/// `progress` is called with the numbers of steps (done, all), from any of the working threads.
pub fn fit(resolution: usize, progress: impl Fn(usize, usize) + Sync) -> (GgxTable, Report) {
    let points = (resolution - 1) * PER_CELL;
    let (done, all) = (AtomicUsize::new(0), resolution + points + Report::STEPS);
    let step = || progress(done.fetch_add(1, Ordering::Relaxed) + 1, all);
    let rows: Vec<Vec<Fit>> = (0..resolution)
        .into_par_iter()
        .map(|j| {
            let row = row(resolution, cosine(node(j, resolution)).max(GRAZING_MU));
            step();
            row
        })
        .collect();
    let [albedo, fresnel] = albedos(resolution, step);
    let cell = |(i, j): (usize, usize)| {
        let mu = cosine(node(j, resolution)).max(GRAZING_MU);
        let Ltc { a, b, c } = rows[j][i].ltc;
        let albedo = places(albedo[(i, j)].min(1.0));
        let fresnel = places(fresnel[(i, j)].max(0.0)).min(albedo);
        [places(a / c - mu * mu), places(b / c - mu * sine(mu)), places(1.0 / c.sqrt()), albedo, fresnel]
    };
    let nodes = (0..resolution).flat_map(|i| (0..resolution).map(move |j| (i, j)));
    let table = GgxTable::new([resolution; 2], nodes.map(cell).collect());
    let report = Report::new(&table, rows.iter().flatten(), step);
    (table, report)
}

/// R and the Fresnel share at nodes (roughness, t), such that their interpolation is nearest to what they are at
/// [`PER_CELL`] points per cell and axis.
fn albedos(resolution: usize, step: impl Fn() + Sync) -> [DMatrix<f64>; 2] {
    let at = centres((resolution - 1) * PER_CELL);
    let row = |&roughness: &f64| -> Vec<Reflected> {
        let ggx = Ggx::from_roughness(roughness);
        let row = at.iter().map(|t| ggx.reflected(cosine(*t))).collect();
        step();
        row
    };
    let rows: Vec<Vec<Reflected>> = at.par_iter().map(row).collect();
    let fit = nodes::nearest(&at, resolution);
    [|reflected: &Reflected| reflected.albedo, |reflected: &Reflected| reflected.fresnel]
        .map(|value| &fit * DMatrix::from_fn(at.len(), at.len(), |i, j| value(&rows[i][j])) * fit.transpose())
}

/// The nearest number of six decimal places, finer than the fit is known: thus a table and its files hold the same
/// numbers.
fn places(value: f64) -> f64 {
    // Adding 0 turns -0 into 0.
    (value * 1e6).round() / 1e6 + 0.0
}
