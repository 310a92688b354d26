//! The picture in `f64`, by means that share nothing with the shaders.

pub mod polygon;
