//! Elevations of a lobe, sampled from a tabulated density.
//!
//! For each of a few warped cosines of `wi` a row holds the lobe's density over the warped root y of the cosine of `wo`
//! ([`SlabWarp::root`]), linear between nodes. In y it ends at the horizon neither at 0 nor at infinity for grazing `wi`, where lobes don't vanish,
//! and as a straight line for others. Between two rows the density is their mixture: one of them is drawn.

use crate::table::SlabWarp;

/// Nodes of a row, at the places k / (n - 1) along the table's axis: twice as fine as the table.
const NODES: usize = 63;

/// Rows, at the places k / (n - 1).
const ROWS: usize = 32;

/// Least density over y, over its mean: in the far tails of fuzz, lobes between nodes are many times what these say.
const LEAST: f64 = 1e-3;

/// Parts of \[0, 1) for which a row remembers where to search.
const GUIDES: usize = 64;

/// Densities of the elevation of `wo` given that of `wi`, of one alpha.
#[derive(Clone, Debug)]
pub struct Elevations {
    /// y of the nodes.
    roots: [f64; NODES],
    /// One over their distances.
    inverse_widths: [f64; NODES - 1],
    /// Density over y at the nodes, row by row; each row's integral is 1.
    densities: Vec<f64>,
    /// The integral from 0 to each node.
    cumulated: Vec<f64>,
    /// For each row, the last node whose integral is at most k / GUIDES: where the search for a number beyond that begins.
    guides: Vec<[u8; GUIDES]>,
}

impl Elevations {
    /// From a density over y given the roots of `wi` and `wo`, above 0 somewhere and of any scale.
    pub fn new(density: impl Fn(f64, f64) -> f64) -> Self {
        let root = |k: usize, n: usize| SlabWarp::root_from_place(k as f64 / (n - 1) as f64);
        let roots: [f64; NODES] = std::array::from_fn(|k| root(k, NODES));
        let inverse_widths = std::array::from_fn(|k| 1.0 / (roots[k + 1] - roots[k]));
        let (mut densities, mut cumulated, mut guides) = (Vec::new(), Vec::new(), Vec::new());
        for row in 0..ROWS {
            let mut values: Vec<f64> = roots.iter().map(|&other| density(root(row, ROWS), other)).collect();
            let whole = integrals(&roots, &values)[NODES - 1];
            assert!(whole > 0.0 && whole.is_finite(), "row {row} of a density has the integral {whole}");
            values.iter_mut().for_each(|value| *value = value.max(LEAST * whole));
            let mut sums = integrals(&roots, &values);
            let whole = sums[NODES - 1];
            sums.iter_mut().for_each(|sum| *sum /= whole);
            densities.extend(values.iter().map(|value| value / whole));
            guides.push(std::array::from_fn(|k| last_at_most(&sums, k as f64 / GUIDES as f64) as u8));
            cumulated.extend(sums);
        }
        Self { roots, inverse_widths, densities, cumulated, guides }
    }

    /// The density over y at `root`, whose place along the axis is `at`, for `wi` at the place `from`.
    #[inline]
    pub fn density(&self, from: f64, at: f64, root: f64) -> f64 {
        let (row, share) = row(from);
        let k = ((at * (NODES - 1) as f64) as usize).min(NODES - 2);
        let fraction = (root - self.roots[k]) * self.inverse_widths[k];
        let of_row = |row: usize| {
            let first = row * NODES + k;
            self.densities[first] + fraction * (self.densities[first + 1] - self.densities[first])
        };
        ((1.0 - share) * of_row(row) + share * of_row(row + 1)).max(0.0)
    }

    /// A root of that density from a uniform number in \[0, 1).
    #[inline]
    pub fn sample(&self, from: f64, uniform: f64) -> f64 {
        let (row, share) = row(from);
        // What is left of the number after the choice of a row is uniform again.
        let (row, uniform) =
            if uniform < share { (row + 1, uniform / share) } else { (row, (uniform - share) / (1.0 - share)) };
        let cumulated = &self.cumulated[row * NODES..(row + 1) * NODES];
        let mut k = usize::from(self.guides[row][((uniform * GUIDES as f64) as usize).min(GUIDES - 1)]);
        while k + 2 < NODES && cumulated[k + 1] <= uniform {
            k += 1;
        }
        let width = self.roots[k + 1] - self.roots[k];
        let [low, high] = [0, 1].map(|step| self.densities[row * NODES + k + step]);
        // Of width (low x + (high - low) x^2 / 2) = rest, the root that does not cancel.
        let rest = (uniform - cumulated[k]) * self.inverse_widths[k];
        let below = low + (low * low + 2.0 * (high - low) * rest).max(0.0).sqrt();
        let x = if below > 0.0 { (2.0 * rest / below).min(1.0) } else { 0.0 };
        self.roots[k] + width * x
    }
}

/// The integrals from 0 to each node of what is linear between values there.
fn integrals(roots: &[f64], values: &[f64]) -> Vec<f64> {
    let part = |k: usize| if k == 0 { 0.0 } else { (roots[k] - roots[k - 1]) * (values[k] + values[k - 1]) / 2.0 };
    let mut sum = 0.0;
    let mut next = |k: usize| {
        sum += part(k);
        sum
    };
    (0..values.len()).map(&mut next).collect()
}

/// The last node but one, or an earlier one, whose integral is at most `value`.
fn last_at_most(sums: &[f64], value: f64) -> usize {
    sums.partition_point(|sum| *sum <= value).clamp(1, NODES - 1) - 1
}

/// The row at or below a place in \[0, 1\], and the next one's share.
#[inline]
fn row(place: f64) -> (usize, f64) {
    let x = place * (ROWS - 1) as f64;
    let row = (x as usize).min(ROWS - 2);
    (row, x - row as f64)
}
