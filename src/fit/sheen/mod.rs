//! From the slab's solution to the sheen's table.
//!
//! At each node the slab is solved, and the transformed cosine nearest to its lobe is found by least squares over
//! the hemisphere ([`least_squares`]). Nodes of one mu are fitted from alpha = 1 down, each starting from the one
//! before. Special cases:
//!
//! - mu = 0 is a limit that is approached steeply, and its lobe is nothing like its neighbours': that row's a, b are
//!   those of mu = [`GRAZING_MU`], as in the table that the paper published.
//! - alpha = 0 has no lobe (sigma = 0) and serves interpolation only: its a, b are those of the next alpha.
//! - r is not R at the nodes but what interpolates to R between them: see [`albedo`]. Below alpha = 0.25, along the
//!   edge where R rises from nothing, it is 10 to 80% under R. At the corner of low alpha and grazing mu, where R falls
//!   from 0.9 to nothing within a cell, it differs a lot from R in either direction, as it should.

pub mod albedo;
pub mod least_squares;
mod report;
mod row;

pub use report::Report;
pub use row::{GRAZING_MU, grazing_mu};

use super::RESOLUTIONS;
use super::lobe::Lobes;
use crate::physics::slab::Slab;
use crate::physics::transport::{Resolution, Transport};
use crate::table::{Ltc, SheenTable, node};
use albedo::Albedos;
use rayon::prelude::*;
use row::{Fit, row};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Fits the sheen's table with `resolution` nodes a side; the result is the same on any number of threads.
///
/// `progress` is called with the numbers of steps (done, all), from any of the working threads.
pub fn fit(resolution: usize, progress: impl Fn(usize, usize) + Sync) -> (SheenTable, Report) {
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
        let Ltc { a, b, .. } = rows[j][i.max(1) - 1].ltc;
        [a, b, r[i * resolution + j]].map(seven_digits)
    };
    let table = SheenTable::new([resolution; 2], nodes().map(|(i, j)| cell(i, j)).collect());
    let report = Report::new(&table, rows.iter().flatten(), step);
    (table, report)
}

/// The nearest number of seven decimal digits, finer than anything here is known: thus a table and its files hold the
/// same numbers.
fn seven_digits(value: f64) -> f64 {
    // Adding 0 turns -0 into 0.
    format!("{value:.6e}").parse::<f64>().expect("a formatted number is one") + 0.0
}
