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

use super::ggx_report::GgxReport;
use super::nodes;
use crate::math::{simplex, sine};
use crate::physics::microfacet::{Ggx, Node, Reflected};
use crate::table::ggx::GRAZING_MU;
use crate::table::{GgxTable, Ltc, centres, node};
use nalgebra::DMatrix;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Nodes a side of the shipped table.
pub const RESOLUTION: usize = 32;

/// Numbers of nodes of the quadrature, enough that no sharp density hides between them.
pub const QUADRATURE: [usize; 2] = [40, 40];

/// Points per cell and axis that the interpolated albedos are fitted to.
const PER_CELL: usize = 4;

/// Sides of the first and the last simplex, in logarithms of the lobe's width and height.
const STEP: f64 = 0.1;
const TOLERANCE: f64 = 1e-7;

/// The cosine mu at t = sqrt(1 - mu).
pub fn cosine(t: f64) -> f64 {
    1.0 - t * t
}

/// Fits the table with `resolution` >= 2 nodes a side; the result is the same on any number of threads.
///
/// `progress` is called with the numbers of steps (done, all), from any of the working threads.
pub fn ggx(resolution: usize, progress: impl Fn(usize, usize) + Sync) -> (GgxTable, GgxReport) {
    let points = (resolution - 1) * PER_CELL;
    let (done, all) = (AtomicUsize::new(0), resolution + points + GgxReport::STEPS);
    let step = || progress(done.fetch_add(1, Ordering::Relaxed) + 1, all);
    let columns: Vec<Vec<Fit>> = (0..resolution)
        .into_par_iter()
        .map(|j| {
            let column = column(resolution, cosine(node(j, resolution)).max(GRAZING_MU));
            step();
            column
        })
        .collect();
    let [albedo, fresnel] = albedos(resolution, step);
    let cell = |(i, j): (usize, usize)| {
        let mu = cosine(node(j, resolution)).max(GRAZING_MU);
        let Ltc { a, b, c } = columns[j][i].ltc;
        let albedo = places(albedo[(i, j)].min(1.0));
        let fresnel = places(fresnel[(i, j)].max(0.0)).min(albedo);
        [places(a / c - mu * mu), places(b / c - mu * sine(mu)), places(1.0 / c.sqrt()), albedo, fresnel]
    };
    let nodes = (0..resolution).flat_map(|i| (0..resolution).map(move |j| (i, j)));
    let table = GgxTable::new([resolution; 2], nodes.map(cell).collect());
    let report = GgxReport::new(&table, columns.iter().flatten(), step);
    (table, report)
}

/// The fit of one node.
#[derive(Clone, Copy, Debug)]
pub struct Fit {
    /// The inverse matrix that was found.
    pub ltc: Ltc,
    /// R.
    pub albedo: f64,
    /// L1 distance between the lobe over its albedo and the density, in \[0, 2\].
    pub distance: f64,
}

/// The fits for one `mu` > 0, at the nodes of roughness, ascending.
fn column(resolution: usize, mu: f64) -> Vec<Fit> {
    let mut column: Vec<Fit> = Vec::with_capacity(resolution);
    let mut above: Option<(Ggx, Ltc)> = None;
    for i in (0..resolution).rev() {
        let ggx = Ggx::from_roughness(node(i, resolution));
        // The one before, made sharper by as much as the surface is smoother; at first a round one.
        let start = above.map_or(Ltc { a: 1.0, b: 0.0, c: 1.0 }, |(rougher, Ltc { a, b, c })| {
            let sharper = rougher.alpha() / ggx.alpha();
            Ltc { a: a * sharper, b: b * sharper, c: c * sharper }
        });
        let found = fit(ggx, mu, [start, mirror(ggx, mu)]);
        above = Some((ggx, found.ltc));
        column.push(found);
    }
    column.reverse();
    column
}

/// A sharp lobe's matrix: it points in the mirrored direction, and is twice as wide as the facets' slopes are.
fn mirror(ggx: Ggx, mu: f64) -> Ltc {
    let c = 0.5 / ggx.alpha();
    Ltc { a: c * mu * mu, b: c * mu * sine(mu), c }
}

/// The matrix of the density nearest to the lobe for `wi` of cosine `mu` in (0, 1\], the best of the minima reached from `starts`.
///
/// At mu = 1 the lobe is round: a = c, b = 0.
pub fn fit(ggx: Ggx, mu: f64, starts: [Ltc; 2]) -> Fit {
    let nodes = ggx.quadrature(mu, QUADRATURE);
    let albedo = albedo(&nodes);
    let search = |start: Ltc| {
        let value = |ltc| distance(&nodes, albedo, ltc);
        if mu == 1.0 {
            let at = |[x]: [f64; 1]| Ltc { a: start.c * x.exp(), b: 0.0, c: start.c * x.exp() };
            let (x, distance) = simplex::minimum(|x| value(at(x)), [0.0], STEP, TOLERANCE);
            return Fit { ltc: at(x), albedo, distance };
        }
        // b / a is the tangent of the lobe's direction; it moves in units of the lobe's length, 1 / a.
        let at = |[length, turn, width]: [f64; 3]| {
            let a = start.a * length.exp();
            Ltc { a, b: a * (start.b + turn) / start.a, c: start.c * width.exp() }
        };
        let (x, distance) = simplex::minimum(|x| value(at(x)), [0.0; 3], STEP, TOLERANCE);
        Fit { ltc: at(x), albedo, distance }
    };
    let [one, other] = starts.map(search);
    if other.distance < one.distance { other } else { one }
}

/// R, integrated on a quadrature.
pub fn albedo(nodes: &[Node]) -> f64 {
    nodes.iter().map(|node| node.weight * node.lobe).sum()
}

/// The integral over the hemisphere of |lobe / albedo - density|.
pub fn distance(nodes: &[Node], albedo: f64, ltc: Ltc) -> f64 {
    nodes.iter().map(|node| node.weight * (node.lobe / albedo - ltc.density(node.wo)).abs()).sum()
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
