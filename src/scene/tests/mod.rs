//! Lights, views and settings of scenes made in memory.

mod emission;
mod islands;
mod settings;
mod shapes;
mod views;
