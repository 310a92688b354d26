//! All golden numbers.

use super::function::{Function, Row};
use super::{angles, fans, formulas, frame, lobe, lobes, scenes, walks};

/// All functions with their rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Golden {
    /// In the order in which rows and harnesses number them.
    pub functions: Vec<Function>,
    /// In order of the functions.
    pub rows: Vec<Row>,
}

/// A function and its rows, given its index.
type Make = fn(usize) -> (Function, Vec<Row>);

const MAKES: [Make; 25] = [
    frame::frames,
    frame::sides,
    walks::begins,
    walks::nexts,
    walks::edge_sums,
    walks::edge_vectors,
    walks::turns,
    angles::form_factors,
    angles::vectors,
    angles::arcs,
    angles::angles,
    angles::crosses,
    lobe::densities,
    lobe::samples,
    fans::begins,
    fans::edges,
    fans::points,
    lobes::sheens,
    lobes::sheen_bases,
    lobes::sheen_bases_openpbr,
    lobes::ggxs,
    lobes::ggx_albedos,
    lobes::ggx_bases,
    scenes::lights_factors,
    formulas::sheen_fits,
];

impl Golden {
    /// Computes them all.
    pub fn new() -> Self {
        let (mut functions, mut rows) = (Vec::new(), Vec::new());
        for (index, make) in MAKES.into_iter().enumerate() {
            let (function, made) = make(index);
            functions.push(function);
            rows.extend(made);
        }
        Self { functions, rows }
    }

    /// The row with this id.
    pub fn row(&self, id: u32) -> Option<&Row> {
        self.rows.binary_search_by_key(&id, |row| row.id).ok().map(|index| &self.rows[index])
    }
}

impl Default for Golden {
    fn default() -> Self {
        Self::new()
    }
}
