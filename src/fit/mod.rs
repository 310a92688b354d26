//! From lobes to the tables.
//!
//! The sheen's table. At each node the slab is solved, and the transformed cosine nearest to its lobe is found by least squares over
//! the hemisphere ([`least_squares`]). Nodes of one mu are fitted from alpha = 1 down, each from the one before. What is special:
//!
//! - mu = 0 is a limit that is reached steeply, and whose lobe is nothing like its neighbours': that row's a, b are those of
//!   mu = [`GRAZING_MU`], as in the table that the paper published.
//! - alpha = 0 has no lobe (sigma = 0) and serves interpolation only: its a, b are those of the next alpha.
//! - r is not R at the nodes but what interpolates to R between them: see [`albedo`]. Below alpha = 0.25, along the edge where R rises from
//!   nothing, it is 10 to 80% under R; at the corner of low alpha and grazing mu, where R falls from 0.9 to nothing within a cell, it
//!   leaves R by a lot either way, and should.

pub mod albedo;
pub mod ggx;
mod ggx_report;
pub mod hemisphere;
pub mod least_squares;
pub mod lobe;
pub mod nodes;
mod report;
pub mod slab;

pub use ggx_report::GgxReport;
pub use report::{DIM, Errors, Report};

use crate::physics::slab::Slab;
use crate::physics::transport::{Resolution, Transport};
use crate::table::{SheenLtc, SheenTable, node};
use albedo::Albedos;
use least_squares::Free;
use lobe::Lobes;
use rayon::prelude::*;
use std::ops::RangeInclusive;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The first lines of every table's .csv, which is made to be copied.
const LICENCE: [&str; 2] =
    ["SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD", "SPDX-FileCopyrightText: 2026 The Velour authors"];

/// The cosine at which a and b of the shipped table's row mu = 0 are fitted.
pub const GRAZING_MU: f64 = 0.01;

/// The same for a table of `resolution` nodes a side: not past the middle of the first cell.
pub fn grazing_mu(resolution: usize) -> f64 {
    GRAZING_MU.min(node(1, resolution) / 2.0)
}

/// Nodes a side of the shipped table.
pub const RESOLUTION: usize = 32;

/// Nodes a side that a table may be asked to have.
pub const RESOLUTIONS: RangeInclusive<usize> = 2..=128;

/// Fits the sheen's table with `resolution` nodes a side, the same on any number of threads.
///
/// `progress` is told (done, all) steps, from any of the working threads.
pub fn sheen(resolution: usize, progress: impl Fn(usize, usize) + Sync) -> (SheenTable, Report) {
    assert!(RESOLUTIONS.contains(&resolution), "a table has {RESOLUTIONS:?} nodes a side: {resolution}");
    let node = |k: usize| node(k, resolution);
    let samples = Albedos::samples(resolution);
    let (done, all) = (AtomicUsize::new(0), 2 * resolution - 1 + samples.len() + Report::steps(resolution));
    let step = || progress(done.fetch_add(1, Ordering::Relaxed) + 1, all);
    let lobes: Vec<Lobes> = (1..resolution)
        .into_par_iter()
        .map(|i| {
            let transport = Transport::new(Slab::new(node(i)), Resolution::default());
            step();
            Lobes::new(transport)
        })
        .collect();
    let rows: Vec<Vec<Fit>> = (0..resolution)
        .into_par_iter()
        .map(|j| {
            let row = row(&lobes, if j == 0 { grazing_mu(resolution) } else { node(j) });
            step();
            row
        })
        .collect();
    let samples = Albedos::new(samples.clone(), samples, step);
    let at_node = |(i, j): (usize, usize)| if i == 0 { 0.0 } else { lobes[i - 1].transport.albedo(node(j)) };
    let nodes = || (0..resolution).flat_map(|i| (0..resolution).map(move |j| (i, j)));
    let r = albedo::fit(resolution, &samples, &nodes().map(at_node).collect::<Vec<_>>());
    let cell = |i: usize, j: usize| {
        let SheenLtc { a, b } = rows[j][i.max(1) - 1].ltc;
        [a, b, r[i * resolution + j]].map(seven_digits)
    };
    let table = SheenTable::new([resolution; 2], nodes().map(|(i, j)| cell(i, j)).collect());
    let report = Report::new(&table, rows.iter().flatten(), step);
    (table, report)
}

/// The fit of one node.
struct Fit {
    ltc: SheenLtc,
    /// R.
    albedo: f64,
    /// Relative L2 distance of lobe and transformed cosine.
    distance: f64,
}

/// For one mu, the nodes with alpha > 0, ascending.
fn row(lobes: &[Lobes], mu: f64) -> Vec<Fit> {
    let mut start = SheenLtc { a: 1.0, b: 0.0 };
    let free = if mu == 1.0 { Free::OnlyA } else { Free::Both };
    let mut row: Vec<Fit> = lobes
        .iter()
        .rev()
        .map(|lobes| {
            let shape = lobes.shape(mu);
            let ltc = least_squares::fit(&shape, &lobes.hemisphere, start, free);
            start = ltc;
            let norm = lobes.hemisphere.integral(|node| shape[node] * shape[node]);
            let distance = (least_squares::squared_error(&shape, &lobes.hemisphere, ltc) / norm).sqrt();
            Fit { ltc, albedo: lobes.transport.albedo(mu), distance }
        })
        .collect();
    row.reverse();
    row
}

/// The nearest number of seven decimal digits, finer than anything here is known: what a table holds, its files hold too.
fn seven_digits(value: f64) -> f64 {
    // Adding 0 turns -0 into 0.
    format!("{value:.6e}").parse::<f64>().expect("a formatted number is one") + 0.0
}
