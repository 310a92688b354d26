//! How far one table of the sheen is from another.

use std::fmt;

use rayon::prelude::*;

use crate::table::{Ltc, SheenTable, centres, node};

/// Points a side at which tables are compared: the nodes of 32 a side, and the places midway between them.
const SIDE: usize = 63;

/// Directions a side at which lobes are compared.
const DIRECTIONS: usize = 24;

/// Albedo from which there is a lobe to compare.
const DIM: f64 = 1e-3;

/// Differences of what is looked up in two tables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// The greatest of a, b and r.
    pub max: [f64; 3],
    /// The mean of a, b and r.
    pub mean: [f64; 3],
    /// The mean relative L2 distance of the lobes, where r > 1e-3; and the mean weighted by r.
    pub lobe: [f64; 2],
}

impl Difference {
    /// Of a table from the one that it stands for, of any sizes, at 63 x 63 points.
    pub fn between(table: &SheenTable, original: &SheenTable) -> Self {
        let points: Vec<([f64; 3], Option<[f64; 2]>)> = (0..SIDE * SIDE)
            .into_par_iter()
            .map(|index| {
                let [alpha, mu] = [index / SIDE, index % SIDE].map(|k| node(k, SIDE));
                let (found, expected) = (table.lookup(alpha, mu), original.lookup(alpha, mu));
                let apart = std::array::from_fn(|column| (found[column] - expected[column]).abs());
                let lobe = (expected[2] > DIM).then(|| [lobe_distance(found, expected), expected[2]]);
                (apart, lobe)
            })
            .collect();
        let column = |k: usize| points.iter().map(move |(apart, _)| apart[k]);
        let lobes: Vec<[f64; 2]> = points.iter().filter_map(|(_, lobe)| *lobe).collect();
        Self {
            max: std::array::from_fn(|k| column(k).fold(0.0, f64::max)),
            mean: std::array::from_fn(|k| column(k).sum::<f64>() / points.len() as f64),
            lobe: [mean(lobes.iter().map(|[distance, _]| [*distance, 1.0])), mean(lobes.iter().copied())],
        }
    }
}

/// The mean of values with their weights; 0 of none.
fn mean(values: impl Iterator<Item = [f64; 2]>) -> f64 {
    let (sum, weights) = values.fold((0.0, 0.0), |(sum, all), [value, weight]| (sum + value * weight, all + weight));
    if weights > 0.0 { sum / weights } else { 0.0 }
}

/// The relative L2 distance of two lobes `[a, b, r]`: integrals of their squares, each a mean over directions that the
/// second lobe spreads evenly. A lobe with a = 0 is dark.
fn lobe_distance(found: [f64; 3], expected: [f64; 3]) -> f64 {
    let ltc = |[a, b, _]: [f64; 3]| Ltc::sheen(a, b);
    let (lobe, original) = (ltc(found), ltc(expected));
    let (mut apart, mut whole) = (0.0, 0.0);
    for u in centres(DIRECTIONS) {
        for v in centres(DIRECTIONS) {
            let direction = original.sample([u, v]);
            let density = original.density(direction);
            let value = expected[2] * density;
            let other = if found[0] > 0.0 { found[2] * lobe.density(direction) } else { 0.0 };
            apart += (other - value).powi(2) / density;
            whole += value * value / density;
        }
    }
    (apart / whole).sqrt()
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("Difference from the shipped table at 63 x 63 points: ")?;
        for ((name, max), mean) in ["a", "b", "r"].into_iter().zip(self.max).zip(self.mean) {
            write!(f, "{name} mean {mean:.4}, max {max:.4}; ")?;
        }
        let [mean, weighted] = self.lobe;
        write!(f, "relative L2 of the lobe where r > {DIM}: mean {mean:.4}, weighted by r {weighted:.4}.")
    }
}
