//! The picture in `f64`, by means that share nothing with the shaders: the exact form factor of a polygon, points of
//! convex ones, and path tracing.

#[cfg(feature = "scenes")]
pub mod convex;
pub mod polygon;
#[cfg(feature = "scenes")]
mod render;

#[cfg(feature = "scenes")]
pub use render::{Effort, Filter, Options, Picture, Reference, ReferenceError, SpecularModel};
