//! Quadrature and sampling warps: `f64`, no domain knowledge.

pub mod quadrature;
pub mod warp;
