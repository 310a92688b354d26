//! Figures: the table and how right it is, as SVG, and pictures of surfaces.
//!
//! - [`table_planes`]: the table's columns a, b, r over (alpha, mu);
//! - [`lobes`]: the slab's lobes in the plane of incidence, solved, walked and fitted;
//! - [`fibres`]: the slab beside explicit fibres, which [`all`] leaves out because it takes a minute;
//! - [`errors`]: the distance of the table's lobes, and of its interpolated r, from the solution;
//! - [`plates`]: the paper's figures and our own comparisons, rendered.
//!
//! Each is the same on any number of threads, and says in its caption what it was made with.

mod canvas;
mod color;
mod errors;
pub mod fibres;
mod field;
mod incidence;
mod lobes;
#[cfg(test)]
mod parsed;
mod planes;
pub mod plates;
mod polar;

pub use canvas::Figure;
pub use errors::errors;
pub use lobes::lobes;
pub use planes::table_planes;

use crate::table::SheenTable;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Names of the figures that [`all`] makes, in order.
pub const NAMES: [&str; 6] =
    [planes::NAMES[0], planes::NAMES[1], planes::NAMES[2], lobes::NAME, errors::NAMES[0], errors::NAMES[1]];

/// All figures of `table`. Takes some seconds; `progress` is called with the numbers of steps (done, all), from any of
/// the working threads.
pub fn all(table: &SheenTable, progress: impl Fn(usize, usize) + Sync) -> Vec<Figure> {
    let (done, all) = (AtomicUsize::new(0), lobes::steps() + errors::steps());
    progress(0, all);
    let step = || progress(done.fetch_add(1, Ordering::Relaxed) + 1, all);
    let mut figures = table_planes(table);
    figures.push(lobes(table, step));
    figures.extend(errors(table, step));
    figures
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_the_figures() {
        let planes: Vec<&str> = table_planes(&SheenTable::embedded()).iter().map(|figure| figure.name).collect();
        assert_eq!(NAMES[..3], planes);
        assert_eq!(NAMES[3..], ["lobes.svg", "error_lobe.svg", "error_r.svg"]);
    }
}
