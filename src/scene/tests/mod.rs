//! Lights, views and settings of scenes made in memory.

mod added_lights;
mod clusters;
mod drawn;
mod edits;
mod emission;
mod islands;
mod lighting;
mod overlaps;
mod patterns;
pub mod shapes;
mod tangents;
mod textures;
mod tolerances;
mod views;
