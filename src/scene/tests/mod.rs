//! Lights, views and settings of scenes made in memory.

mod emission;
mod islands;
mod settings;
pub mod shapes;
mod tangents;
mod views;
