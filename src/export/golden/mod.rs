//! Golden numbers: what every function of the copied shaders gives for some inputs, to check a port by, with a key to mistakes.
//!
//! Inputs are exact in `f32`. Outputs are computed in `f64` from the shipped halves, by definitions that share none of the
//! shaders' devices: matrices with their inverses and determinants, [`f64::atan2`], the exact polygon of
//! [`reference::polygon`](crate::reference::polygon). Each comes with a tolerance that any `f32` port of the same method keeps.
//!
//! Structs are their fields in order, vectors their numbers from x on, matrices their columns, bools 0 or 1; textures are
//! left out, for they are the shipped tables.

mod angles;
mod fan;
mod fans;
mod flat;
mod frame;
mod function;
mod lobe;
mod lobes;
mod lookup;
mod mistake;
mod outline;
mod scenes;
mod text;
mod walks;
mod whole;

pub use function::{Function, Row};
pub use mistake::Mistake;

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

const MAKES: [Make; 24] = [
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
}

impl Default for Golden {
    fn default() -> Self {
        Self::new()
    }
}
