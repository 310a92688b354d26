//! Quadrature, series and sampling warps: `f64`, no domain knowledge.

pub mod fourier;
pub mod quadrature;
pub mod warp;

/// The sine in \[0, 1\] of an angle in \[0, pi\] from its cosine in \[-1, 1\], without cancellation near either end.
pub fn sine(cosine: f64) -> f64 {
    ((1.0 - cosine) * (1.0 + cosine)).sqrt()
}
