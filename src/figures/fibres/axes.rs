//! Which way fibres must point for their surfaces to be those of SGGX microflakes.

use crate::math::warp;
use glam::DVec3;
use rand::Rng;
use std::f64::consts::{FRAC_2_PI, TAU};

/// How the axes of thin circular cylinders are distributed around z, such that their single scattering is that of the
/// SGGX medium of a `sigma`.
///
/// # Derivation
///
/// Cylinders of diameter d, of length L per volume, have d L / 2 of lateral surface per volume and radian around the
/// axis. Their normals m lie on the great circle perpendicular to the axis t; so the density of normals at m gathers
/// the axes on the great circle perpendicular to m. Let p(c), an even function, be the density of c = t_z over \[-1,
/// 1\], let azimuths be uniform, and let s be the sine of m's angle to z. Then these axes have c = s cos(phi), and
///
/// ```text
/// D(m) = (L d / 2) (1 / 2 pi) integral of p(s cos(phi)) d phi = (L d / pi) integral from 0 to s of p(c) / sqrt(s^2 - c^2) dc.
/// ```
///
/// SGGX has pi D = sigma^3 / (1 - k s^2)^2 with k = 1 - sigma^2 (Heitz et al. 2015, eq. 9, for S = diag(1, 1,
/// sigma^2)). With that on its left side, this is Abel's integral equation, whose solution is
///
/// ```text
/// L d p(c) = (2 sigma^3 / pi) dI/dc,  I(c) = integral from 0 to c of s / ((1 - k s^2)^2 sqrt(c^2 - s^2)) ds
///                                          = c / (2 A^2) + atan(sqrt(k) c / A) / (2 sqrt(k) A^3),  A^2 = 1 - k c^2,
/// dI/dc = 1 / (2 A^2) + k c^2 / A^4 + 1 / (2 A^4) + 3 sqrt(k) c atan(sqrt(k) c / A) / (2 A^5).
/// ```
///
/// It is positive: there are such fibres for every sigma. I(c) / I(1) is the cumulative distribution of |c|. As p
/// integrates to 1, L d = (2 / pi) (sigma + u), u = atan(sqrt(k) / sigma) / sqrt(k), which is 4 / pi for sigma = 1 (all
/// directions, p = 1/2) and tends to 1 as sigma tends to 0 (all along z). The flakes' area projected along a direction
/// w is the extinction, so that L d E|w x t| = sigma_t(w), which is 1 across z.
///
/// With y = c / A, everything is written without cancellation: g^2 = 1 + k y^2 = 1 / A^2, I = (y g + u(y) g^3) / 2 with
/// u(y) = atan(sqrt(k) y) / sqrt(k). And x = sigma y in \[0, 1\] makes the axis (sigma sqrt(1 - x^2), x), normalised.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes {
    sigma: f64,
    /// 1 - sigma^2.
    k: f64,
    /// I(1).
    whole: f64,
}

impl Axes {
    /// The axes for the medium of cross-section `sigma` in (0, 1]; panics outside that range.
    pub fn new(sigma: f64) -> Self {
        assert!(sigma > 0.0 && sigma <= 1.0, "sigma is in (0, 1]: {sigma}");
        let axes = Self { sigma, k: (1.0 - sigma) * (1.0 + sigma), whole: 1.0 };
        Self { whole: axes.integral(1.0 / sigma), ..axes }
    }

    /// The density p(c) of the cosine `c` in \[-1, 1\] of axes to z, where each unit of the fibres' length counts
    /// alike; its integral is 1.
    pub fn density(&self, c: f64) -> f64 {
        let (y, g) = self.stretched(c);
        // dy/dc = g^3.
        self.slope(y) * g * g * g / (2.0 * self.whole)
    }

    /// The share of the fibres' length whose axes have a cosine to z of magnitude at most `c`, in \[0, 1\].
    pub fn share_below(&self, c: f64) -> f64 {
        self.integral(self.stretched(c).0) / self.whole
    }

    /// Length times diameter of the fibres in a unit of volume, for an extinction of 1 across z: in (1, 4 / pi].
    pub fn cover(&self) -> f64 {
        FRAC_2_PI * (self.sigma + self.arc(1.0 / self.sigma))
    }

    /// The mean of |c|: 1 - sigma^2 u / (sigma + u), from the integral of I over \[0, 1\], which is u / (2 sigma).
    pub fn mean_cosine(&self) -> f64 {
        let arc = self.arc(1.0 / self.sigma);
        1.0 - self.sigma * self.sigma * arc / (self.sigma + arc)
    }

    /// The mean of the sine of axes to z: times [`Self::cover`] it is sigma, what the fibres cover as seen along z.
    pub fn mean_sine(&self) -> f64 {
        self.sigma / self.cover()
    }

    /// A random axis, a unit vector of the upper hemisphere: which end is up makes no difference.
    pub fn sample(&self, rng: &mut impl Rng) -> DVec3 {
        let y = self.inverse(warp::uniform(rng));
        let x = (self.sigma * y).min(1.0);
        let (sin_phi, cos_phi) = (TAU * warp::uniform(rng)).sin_cos();
        let across = self.sigma * (1.0 - x * x).sqrt();
        DVec3::new(across * cos_phi, across * sin_phi, x).normalize_or(DVec3::Z)
    }

    /// The y below which a share lies. I rises ever more steeply, by a power between 1 and about 3, so that Newton's
    /// iteration approaches the root from above.
    fn inverse(&self, share: f64) -> f64 {
        let mut y = share.cbrt() / self.sigma;
        for _ in 0..NEWTON_STEPS {
            let step = (self.integral(y) - share * self.whole) / self.slope(y);
            y -= step;
            if step.abs() <= 1e-14 * y {
                break;
            }
        }
        y.clamp(0.0, 1.0 / self.sigma)
    }

    /// y and g of a cosine.
    fn stretched(&self, c: f64) -> (f64, f64) {
        assert!(c.abs() <= 1.0, "c is a cosine: {c}");
        let g = ((1.0 - c) * (1.0 + c) + (self.sigma * c).powi(2)).sqrt().recip();
        (c * g, g)
    }

    /// I as a function of y.
    fn integral(&self, y: f64) -> f64 {
        let square = 1.0 + self.k * y * y;
        0.5 * square.sqrt() * (y + self.arc(y) * square)
    }

    /// dI/dy.
    fn slope(&self, y: f64) -> f64 {
        let g = (1.0 + self.k * y * y).sqrt();
        g + self.k * y * (0.5 * y / g + 1.5 * self.arc(y) * g)
    }

    /// u(y), to round-off even where k is 0.
    fn arc(&self, y: f64) -> f64 {
        let square = self.k * y * y;
        if square < 1e-6 {
            y * (1.0 - square / 3.0 + square * square / 5.0)
        } else {
            square.sqrt().atan() * y / square.sqrt()
        }
    }
}

/// More steps than are ever taken: the start is the root where sigma is small and above it elsewhere, from which ten or
/// so steps reach round-off.
const NEWTON_STEPS: usize = 50;
