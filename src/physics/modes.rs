//! The scattering kernel split into azimuthal modes, in closed form.
//!
//! Seen around the fibres' axis only the difference phi of two azimuths counts, so that the kernel of propagation directions of
//! cosines mu' (before) and mu (after) is a Fourier series,
//!
//! ```text
//! K(mu, mu', phi) = K_0 + 2 sum over m >= 1 of K_m cos(m phi),      K_m = 1/(2 pi) integral of K cos(m phi) d phi.
//! ```
//!
//! With s, s' the sines, w - w' has the square 2 (a - b cos phi) for a = 1 - mu mu', b = s s', and the half vector of w and -w'
//! lies along it: its cosine's square is (mu - mu')^2 / (2 (a - b cos phi)). Put into D(wh) / 4 (Heitz et al. 2015, eq. 9), with
//! k = (1 - sigma^2) (mu - mu')^2 / (2 sigma^2) and A = a + k:
//!
//! ```text
//! K = 1/(4 pi sigma) (1 + k / (a - b cos phi))^-2 = 1/(4 pi sigma) (1 - k / (A - b cos phi))^2.
//! ```
//!
//! The modes of 1 / (A - b cos phi) are r^m / W, with W = sqrt(A^2 - b^2) and r = b / (A + W) (a geometric series); those of its
//! square follow by -d/dA, where dW/dA = A / W and dr/dA = -r / W: r^m (A + m W) / W^3. Hence
//!
//! ```text
//! K_m = 1/(4 pi sigma) [ (m = 0) - 2 k r^m / W + k^2 r^m (A + m W) / W^3 ].
//! ```
//!
//! Written so, terms cancel: for m = 0, f64 loses everything below alpha = 0.03. With d = W - k, which is
//! (2 a k + (mu - mu')^2) / (W + k) because a^2 - b^2 = (mu - mu')^2, and with A - W = b r,
//!
//! ```text
//! K_0 = 1/(4 pi sigma) (W d^2 + k^2 b r) / W^3,
//! K_m = 1/(4 pi sigma) k r^m (k b r + W ((m - 1) k - 2 d)) / W^3,      m >= 1,
//! ```
//!
//! a sum of positive terms for m = 0; and a - b = (mu - mu')^2 / (a + b), 2 a = (mu - mu')^2 + s^2 + s'^2 make the rest exact near the
//! axis. Along directions that keep their elevation (W = 0) the kernel is 1/(4 pi sigma) for every phi.

use super::sggx::Sggx;
use crate::math::sine;
use std::f64::consts::PI;

/// An angle to the horizon by its sine `mu`, the cosine to the fibres, and its cosine `s`, each to full relative precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elevation {
    /// Cosine to the normal, in \[-1, 1\]; negative below the horizon.
    pub mu: f64,
    /// Sine to the normal, in \[0, 1\].
    pub s: f64,
}

impl Elevation {
    /// From the angle above the horizon in \[-pi/2, pi/2\].
    pub fn from_angle(angle: f64) -> Self {
        let (mu, s) = angle.sin_cos();
        Self { mu, s: s.max(0.0) }
    }

    /// From the cosine to the normal in \[-1, 1\].
    #[inline]
    pub fn from_cosine(mu: f64) -> Self {
        Self { mu, s: sine(mu) }
    }

    /// The mirrored one on the other side of the horizon.
    #[inline]
    pub fn opposite(self) -> Self {
        Self { mu: -self.mu, s: self.s }
    }
}

impl Sggx {
    /// Extinction along an elevation, as [`Sggx::extinction`].
    #[inline]
    pub fn extinction_at(&self, elevation: Elevation) -> f64 {
        let along = self.sigma() * elevation.mu;
        (along * along + elevation.s * elevation.s).sqrt()
    }

    /// The first modes `K_0`, `K_1`, ... of the kernel between two propagation directions, one for each place in `modes`; per length
    /// and steradian. Symmetric in its arguments. `K_0` to a relative 3e-15, the others to 1e-13 of `K_0`.
    #[inline]
    pub fn kernel_modes(&self, one: Elevation, other: Elevation, modes: &mut [f64]) {
        let sigma = self.sigma();
        let isotropic = 1.0 / (4.0 * PI * sigma);
        let step = one.mu - other.mu;
        let square = step * step;
        let a = 0.5 * (square + one.s * one.s + other.s * other.s);
        let b = one.s * other.s;
        let k = (1.0 - sigma) * (1.0 + sigma) * square / (2.0 * sigma * sigma);
        let big_a = a + k;
        let a_minus_b = if a + b > 0.0 { square / (a + b) } else { 0.0 };
        let w = ((a_minus_b + k) * (big_a + b)).sqrt();
        if w == 0.0 {
            modes.fill(0.0);
            modes[0] = isotropic;
            return;
        }
        let r = b / (big_a + w);
        let d = (2.0 * a * k + square) / (w + k);
        let scale = isotropic / (w * w * w);
        let kbr = k * b * r;
        modes[0] = scale * (w * d * d + k * kbr);
        let mut power = k * scale;
        for (m, mode) in modes.iter_mut().enumerate().skip(1) {
            power *= r;
            *mode = power * (kbr + w * ((m as f64 - 1.0) * k - 2.0 * d));
        }
    }
}
