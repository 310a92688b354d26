//! Elevations of a lobe, sampled from a tabulated density.
//!
//! For each of a few warped cosines of `wi` a row holds the lobe's density p over the warped root y of the cosine of `wo`
//! ([`SlabWarp::root`]). Towards the horizon, a density over y is finite and above 0 for grazing `wi`, whose lobes
//! don't vanish there, and falls off as a straight line for others. Between two rows the density is linear, and so is
//! its integral, which is inverted without choosing one of the two rows at random.
//!
//! Only in the cell at the horizon is a row linear in y between nodes: beyond, sqrt(t) p is linear in the place
//! t = y^(2/3), so that the place itself, which the table's lookup waits for, is sampled without a root. With x running
//! from 0 to 1 over a cell (x = y / y_1 in the first, x = (NODES - 1) t - k in the others) and t_1 the first cell's
//! end,
//!
//! ```text
//! p = v(x) / sqrt(max(t, t_1)), v linear,   p dy = v dx / (NODES - 1) times 1 in the first cell, 3/2 in the others,
//! y p = v times x t_1 in the first cell, t in the others: the density over ln y, which needs no root either.
//! ```

use crate::math::cube_root;
use crate::table::{SlabWarp, cell};

/// Nodes of a row, at the places k / (n - 1) along the table's axis: twice as fine as the table.
const NODES: usize = 63;

/// Rows, at the places k / (n - 1).
const ROWS: usize = 32;

/// Least density over y, relative to its mean: in the far tails of fuzz, a lobe may be many times larger between nodes
/// than at them.
const LEAST: f64 = 1e-3;

/// Number of equal parts of \[0, 1) for each of which a row remembers where to begin a search.
const GUIDES: usize = 64;

/// Cells between nodes.
const CELLS: f64 = (NODES - 1) as f64;

/// Densities of the elevation of `wo` given that of `wi`, for one alpha.
#[derive(Clone, Debug)]
pub struct Elevations {
    /// v at the nodes, row by row; each row's integral of p over y is 1.
    values: Vec<f64>,
    /// The integral from 0 to each node.
    cumulated: Vec<f64>,
    /// For each row and each k, the last node whose integral is at most k / GUIDES: where the search for a larger
    /// number begins.
    guides: Vec<[u8; GUIDES]>,
}

/// A sampled elevation.
pub struct Drawn {
    /// See [`SlabWarp::place`].
    pub place: f64,
    /// See [`SlabWarp::w`].
    pub w: f64,
    /// Density over ln y.
    pub log_density: f64,
}

impl Elevations {
    /// From a density over y given the roots of `wi` and `wo`; it is above 0 somewhere, and its scale does not matter.
    pub fn new(density: impl Fn(f64, f64) -> f64) -> Self {
        let (mut values, mut cumulated, mut guides) = (Vec::new(), Vec::new(), Vec::new());
        for row in 0..ROWS {
            let from = SlabWarp::root_from_place(row as f64 / (ROWS - 1) as f64);
            let place = |k: usize| k as f64 / CELLS;
            let densities: [f64; NODES] = std::array::from_fn(|k| density(from, SlabWarp::root_from_place(place(k))));
            let stretched = |least: f64| std::array::from_fn(|k| densities[k].max(least) * stretch(place(k)));
            let whole = integrals(&stretched(0.0))[NODES - 1];
            assert!(whole > 0.0 && whole.is_finite(), "row {row} of a density has the integral {whole}");
            let row = stretched(LEAST * whole);
            let sums = integrals(&row);
            let whole = sums[NODES - 1];
            let sums = sums.map(|sum| sum / whole);
            values.extend(row.map(|value| value / whole));
            guides.push(std::array::from_fn(|k| last_at_most(&sums, k as f64 / GUIDES as f64) as u8));
            cumulated.extend(sums);
        }
        Self { values, cumulated, guides }
    }

    /// The density over ln y at the place `at`, for `wi` at the place `from`.
    #[inline]
    pub fn log_density(&self, from: f64, at: f64) -> f64 {
        let row = Row::at(from);
        let cell = at * CELLS;
        let k = (cell as usize).min(NODES - 2);
        let x = if k == 0 { SlabWarp::root_from_place(cell) } else { cell - k as f64 };
        let [low, high] = [k, k + 1].map(|k| row.between(&self.values, k));
        (low + x * (high - low)) * if k == 0 { x / CELLS } else { at }
    }

    /// An elevation from a uniform number in \[0, 1), for `wi` at the place `from`.
    #[inline]
    pub fn sample(&self, from: f64, uniform: f64) -> Drawn {
        let row = Row::at(from);
        let part = ((uniform * GUIDES as f64) as usize).min(GUIDES - 1);
        let mut k = usize::from(self.guides[row.first][part].min(self.guides[row.first + 1][part]));
        while k + 2 < NODES && row.between(&self.cumulated, k + 1) <= uniform {
            k += 1;
        }
        let [low, high] = [k, k + 1].map(|k| row.between(&self.values, k));
        // The solution of width (low x + (high - low) x^2 / 2) = rest, in the form that does not cancel.
        let rest = (uniform - row.between(&self.cumulated, k)) * if k == 0 { 1.0 / width(0) } else { 1.0 / width(1) };
        let below = low + (low * low + 2.0 * (high - low) * rest).max(0.0).sqrt();
        let x = (2.0 * rest / below).clamp(0.0, 1.0);
        let value = low + x * (high - low);
        if k == 0 {
            let w = x * x / (CELLS * CELLS * CELLS);
            Drawn { place: cube_root(w), w, log_density: value * x / CELLS }
        } else {
            let place = (k as f64 + x) * (1.0 / CELLS);
            Drawn { place, w: place * place * place, log_density: value * place }
        }
    }
}

/// A place between two rows.
#[derive(Clone, Copy)]
struct Row {
    /// The row below.
    first: usize,
    /// The next row's share.
    share: f64,
}

impl Row {
    /// The rows around a place; a place slightly past 1 is taken for 1, so that densities stay above 0.
    #[inline]
    fn at(place: f64) -> Self {
        let (first, share) = cell(place.min(1.0), ROWS);
        Self { first, share }
    }

    /// The value at node `k`, from a table that holds values row by row.
    #[inline]
    fn between(self, table: &[f64], k: usize) -> f64 {
        let at = self.first * NODES + k;
        (1.0 - self.share) * table[at] + self.share * table[at + NODES]
    }
}

/// sqrt(max(t, t_1)) at the place t.
fn stretch(place: f64) -> f64 {
    place.max(1.0 / CELLS).sqrt()
}

/// p dy of a cell over v dx.
#[inline]
fn width(k: usize) -> f64 {
    if k == 0 { 1.0 / CELLS } else { 1.5 / CELLS }
}

/// The integrals of p from 0 to each node.
fn integrals(values: &[f64; NODES]) -> [f64; NODES] {
    let mut sums = [0.0; NODES];
    for k in 1..NODES {
        sums[k] = sums[k - 1] + width(k - 1) * (values[k - 1] + values[k]) / 2.0;
    }
    sums
}

/// The last node whose integral is at most `value`, the very last excepted.
fn last_at_most(sums: &[f64], value: f64) -> usize {
    sums.partition_point(|sum| *sum <= value).clamp(1, NODES - 1) - 1
}
