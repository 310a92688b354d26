//! Lights, views and settings of scenes made in memory.

mod drawn;
mod edits;
mod emission;
mod islands;
pub mod shapes;
mod tangents;
mod textures;
mod tolerances;
mod views;
