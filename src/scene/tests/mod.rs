//! Lights, views and settings of scenes made in memory.

mod islands;
mod settings;
pub mod shapes;
mod tangents;
mod views;
