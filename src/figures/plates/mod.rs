//! Pictures of surfaces: the figures of Zeltner, Burley and Chiang 2022 made anew, and comparisons of our own, by the reference renderer.
//!
//! | plates | what they show |
//! |---|---|
//! | `cloth_*` | their figure 1: a cloth asset without sheen, with one of low and with one of high roughness |
//! | `sphere_*` | their figure 2: a sphere lit from the front, from 90 and from 130 degrees, by our sheen, by explicit fibres, by models of prior work |
//! | `dust` | their figure 3: dust of roughness .85 on a sculpted form |
//! | `sweep_*` | their supplement's: all models over roughness |
//! | `layers_*` | the fit, the slab and the walk of one sphere; the layering rules and the walk through both layers |
//!
//! The scenes are the program's own; the shapes in the paper's figures are others.

mod ball;
mod page;
mod plate;
mod scenes;
mod spheres;
mod stage;

pub use page::page;
pub use plate::{Plate, PlateError, Progress};

/// All plates, in order.
pub fn plates() -> Vec<Plate> {
    [scenes::plates(), spheres::prior_work(), spheres::sweep(), spheres::layers()].into_iter().flatten().collect()
}
