//! The sheen's table on other nodes.

use nalgebra::DMatrix;

use super::difference::Difference;
use super::source::LICENCE;
use super::texture::Texture;
use crate::table::{SheenTable, cell, node};

/// The numbers of nodes a side that a table may be resampled to.
pub const SIDES: std::ops::RangeInclusive<usize> = 2..=128;

/// Samples along an axis to each cell of the finer table.
const PER_CELL: usize = 6;

/// Steps to 1, in which the numbers are rounded: finer than anything here is known.
const STEPS: f64 = 1e7;

/// The table with `side` nodes a side whose lookups are nearest to those of `table`: the sum of their squared differences
/// over a regular grid is least, but for numbers that this takes out of their ranges, which are put back to the end.
///
/// At 16 nodes a side it is nearer than what is looked up at them (mean differences of r 0.0015 and 0.0026), and than a fit
/// from nothing (0.0021), which meets a and b at its own nodes alone.
pub fn resample(table: &SheenTable, side: usize) -> SheenTable {
    assert!(SIDES.contains(&side), "a table has {SIDES:?} nodes a side: {side}");
    let samples = PER_CELL * (side.max(table.size()[0]) - 1) + 1;
    let solve = solver(samples, side);
    let nodes: [DMatrix<f64>; 3] = std::array::from_fn(|column| {
        let values =
            DMatrix::from_fn(samples, samples, |i, j| table.lookup(node(i, samples), node(j, samples))[column]);
        &solve * values * solve.transpose()
    });
    // An a of 0 would have no inverse, where the table has one.
    let least_a = table.cells().iter().map(|[a, ..]| *a).fold(f64::MAX, f64::min);
    let within = [(least_a, f64::MAX), (f64::MIN, 0.0), (0.0, 1.0)];
    let number = |column: usize, i, j| {
        let (least, most) = within[column];
        // Adding 0 turns -0 into 0.
        (nodes[column][(i, j)].clamp(least, most) * STEPS).round() / STEPS + 0.0
    };
    let cells = (0..side * side).map(|at| std::array::from_fn(|column| number(column, at / side, at % side)));
    SheenTable::new([side; 2], cells.collect())
}

/// The matrix that gives the values at `side` nodes whose linear interpolation is nearest to given values at `samples`
/// places: (H^T H)^-1 H^T, with H the weights of the nodes at those places.
fn solver(samples: usize, side: usize) -> DMatrix<f64> {
    let mut weights = DMatrix::zeros(samples, side);
    for sample in 0..samples {
        let (below, above) = cell(node(sample, samples), side);
        weights[(sample, below)] += 1.0 - above;
        weights[(sample, below + 1)] += above;
    }
    let normal = (weights.transpose() * &weights).cholesky().expect("every node has samples on both sides");
    normal.solve(&weights.transpose())
}

/// The shipped table of the sheen on `side` nodes a side, named `sheen_ltc_SIDE`, and how far it is from that.
pub fn resampled(side: usize) -> (Texture, Difference) {
    let shipped = SheenTable::embedded();
    let table = resample(&shipped, side);
    let difference = Difference::between(&table, &shipped);
    let head = format!(
        "SPDX-License-Identifier: {LICENCE}
SPDX-FileCopyrightText: 2026 The Velour authors
The sheen's table on {side} x {side} nodes: the one whose lookups are nearest to those of tables/sheen_ltc.csv, by least squares.
alpha: roughness, small is fuzz, large is dust. mu: cosine of wi (the view in rendering) to the normal. Node k sits at k/{}.
a, b: inverse matrix by rows (a,0,b), (0,a,0), (0,0,1) in the frame z = normal, x = wi projected on the surface; b <= 0.
r: albedo of the lobe, all colours 1, for interpolated lookups. Lookup: bilinear.
{difference}
Made by: velour export tables --size {side}",
        side - 1
    );
    let head: Vec<String> = head.lines().map(str::to_owned).collect();
    let mut texture = Texture::sheen(&table, table.to_csv(&head));
    texture.stem = resampled_stem(side);
    texture.meaning += "; resampled from the shipped table";
    (texture, difference)
}

/// The name of the table on `side` nodes a side: another one than the shipped table's, which it does not replace.
pub fn resampled_stem(side: usize) -> String {
    format!("sheen_ltc_{side}")
}
