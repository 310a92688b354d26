//! Lights, views and settings of scenes made in memory.

mod islands;
mod settings;
mod shapes;
mod views;
