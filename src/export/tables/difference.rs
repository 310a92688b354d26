//! How far one table of the sheen is from another.

use std::fmt;

use crate::table::{SheenTable, node};

/// Points a side at which tables are compared: the nodes of 32 a side, and the places midway between them.
const SIDE: usize = 63;

/// Absolute differences of what is looked up in two tables: of a, b and r.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// The greatest.
    pub max: [f64; 3],
    /// The mean.
    pub mean: [f64; 3],
}

impl Difference {
    /// Between two tables of any sizes, at 63 x 63 points.
    pub fn between(one: &SheenTable, other: &SheenTable) -> Self {
        let mut difference = Self { max: [0.0; 3], mean: [0.0; 3] };
        for index in 0..SIDE * SIDE {
            let [alpha, mu] = [index / SIDE, index % SIDE].map(|k| node(k, SIDE));
            let pairs = one.lookup(alpha, mu).into_iter().zip(other.lookup(alpha, mu));
            for (column, (one, other)) in pairs.enumerate() {
                let apart = (one - other).abs();
                difference.max[column] = difference.max[column].max(apart);
                difference.mean[column] += apart / (SIDE * SIDE) as f64;
            }
        }
        difference
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let columns = ["a", "b", "r"].into_iter().zip(self.max).zip(self.mean);
        let columns: Vec<String> =
            columns.map(|((name, max), mean)| format!("{name} max {max:.4}, mean {mean:.4}")).collect();
        f.write_str(&columns.join("; "))
    }
}
