//! Quadrature, series, frames and sampling warps: `f64`, no domain knowledge.

pub mod fourier;
pub mod frame;
pub mod quadrature;
pub mod simplex;
pub mod warp;

/// The sine in \[0, 1\] of an angle in \[0, pi\] from its cosine in \[-1, 1\], without cancellation near either end.
#[inline]
pub fn sine(cosine: f64) -> f64 {
    sine_square(cosine).sqrt()
}

/// Panics unless `mu` is the cosine of an angle in \[0, pi/2\]: a number in \[0, 1\].
#[inline]
pub fn check_cosine(mu: f64) {
    assert!((0.0..=1.0).contains(&mu), "mu is in [0, 1]: {mu}");
}

/// The square of [`sine`].
#[inline]
pub fn sine_square(cosine: f64) -> f64 {
    (1.0 - cosine) * (1.0 + cosine)
}

/// The cube root of `x` in \[0, 1\], to a relative 1e-13, in a third of the time of [`f64::cbrt`]. Below 1e-300 it is 0.
#[inline]
pub fn cube_root(x: f64) -> f64 {
    halley(x, near_cube_root(x))
}

/// The cube root of `x` in \[0, 1\], to a relative 1e-4, continuous: for uses that can't wait for [`cube_root`]. Below
/// 1e-300 it is 0.
///
/// A third of the exponent is a guess good to 6%; a step of Halley's iteration cubes that error.
#[inline]
pub fn near_cube_root(x: f64) -> f64 {
    // The constant of fdlibm's cbrt: two thirds of the exponent's bias, moved to spread the error evenly.
    const BIAS: u64 = 715_094_163 << 32;
    if x < 1e-300 { 0.0 } else { halley(x, f64::from_bits(x.to_bits() / 3 + BIAS)) }
}

/// One step of Halley's iteration for the cube root of `x`, from a guess `root`; a guess of 0 stays 0.
#[inline]
fn halley(x: f64, root: f64) -> f64 {
    let cube = root * root * root;
    if root > 0.0 { root * ((cube + 2.0 * x) / (2.0 * cube + x)) } else { 0.0 }
}

/// 1 - exp(-x) for x >= 0, to a relative 2e-14: in a fraction of [`f64::exp_m1`]'s time where nothing much cancels.
#[inline]
pub fn one_minus_exp(x: f64) -> f64 {
    if x < 0.01 { -(-x).exp_m1() } else { 1.0 - (-x).exp() }
}

#[cfg(test)]
mod tests {
    use super::frame::AzimuthFrame;
    use super::{cube_root, near_cube_root, one_minus_exp};
    use glam::DVec3;

    #[test]
    fn cube_roots_are_the_slow_ones() {
        assert_eq!([cube_root(0.0), cube_root(1e-301)], [0.0; 2]);
        for k in 0..=10_000 {
            let x = 1e-299_f64.powf(f64::from(k) / 10_000.0);
            assert!((cube_root(x) / x.cbrt() - 1.0).abs() < 1e-13, "{x:e}");
            assert!((near_cube_root(x) / x.cbrt() - 1.0).abs() < 1e-4, "{x:e}");
        }
    }

    #[test]
    fn what_an_exponential_leaves_of_1_is_kept_to_its_last_digits() {
        assert_eq!([one_minus_exp(0.0), one_minus_exp(f64::INFINITY)], [0.0, 1.0]);
        for k in 0..=10_000 {
            let x = 100.0 * 1e-20_f64.powf(f64::from(k) / 10_000.0);
            assert!((one_minus_exp(x) / -(-x).exp_m1() - 1.0).abs() < 2e-14, "{x:e}");
        }
    }

    #[test]
    fn frames_turn_their_direction_to_x() {
        for w in [DVec3::new(0.6, 0.0, 0.8), DVec3::new(-0.48, 0.64, 0.6), DVec3::new(0.0, -1.0, 0.0)] {
            let local = AzimuthFrame::of(w).local(w);
            assert!(local.x > 0.0 && local.y.abs() < 1e-15 && local.z == w.z, "{local}");
            let other = DVec3::new(0.3, -0.2, 0.1);
            let frame = AzimuthFrame::of(w);
            assert!((frame.outside(frame.local(other)) - other).length() < 1e-15, "{w}");
        }
        assert_eq!(AzimuthFrame::of(DVec3::Z).local(DVec3::X), DVec3::X);
    }
}
