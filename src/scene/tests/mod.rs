//! Lights, views and settings of scenes made in memory.

mod emitter;
mod islands;
mod settings;
mod shapes;
mod views;
