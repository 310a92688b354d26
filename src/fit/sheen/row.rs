//! A row of the sheen's table: the nodes of one mu.

use super::least_squares::{self, Free};
use crate::fit::lobe::Lobes;
use crate::table::{Ltc, node};

/// The cosine at which a and b of the shipped table's row mu = 0 are fitted.
pub const GRAZING_MU: f64 = 0.01;

/// That cosine for a table of `resolution` nodes a side: [`GRAZING_MU`], but not past the middle of the first cell.
pub fn grazing_mu(resolution: usize) -> f64 {
    GRAZING_MU.min(node(1, resolution) / 2.0)
}

/// The fit of one node.
pub(super) struct Fit {
    pub ltc: Ltc,
    /// R.
    pub albedo: f64,
    /// Relative L2 distance of lobe and transformed cosine.
    pub distance: f64,
}

/// The fits for one mu, at the nodes with alpha > 0, ascending.
pub(super) fn row(lobes: &[Lobes], mu: f64) -> Vec<Fit> {
    let mut start = Ltc::sheen(1.0, 0.0);
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
