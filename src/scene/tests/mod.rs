//! Lights, views and settings of scenes made in memory.

mod drawn;
mod emission;
mod islands;
mod settings;
pub mod shapes;
mod tangents;
mod textures;
mod tolerances;
mod views;
