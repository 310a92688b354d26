//! The shader files that people copy.

mod device;
mod files;
mod filters;
mod form_factor;
mod ggx;
mod golden;
mod lights;
mod millions;
mod named_cases;
mod polygons;
mod reserved;
mod sampler;
mod sampler_points;
mod sampling;
mod sheen;
mod sheen_fit;
mod sweeps;
mod translated;
mod vector;
