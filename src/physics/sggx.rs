//! The medium: SGGX microflakes (Heitz et al. 2015) with the matrix S = diag(1, 1, sigma^2), fibres along z.

use crate::math::warp;
use glam::DVec3;
use rand::Rng;
use std::f64::consts::PI;

/// Mirror-like microflakes on fibres along z. Small `sigma`: thin fibres; `sigma` = 1: the isotropic medium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sggx {
    sigma: f64,
    /// (1 - sigma^2) / (2 sigma^2).
    contrast: f64,
    /// 1 / (4 pi sigma).
    straight_on: f64,
}

impl Sggx {
    /// The medium of cross-section `sigma` in (0, 1].
    pub fn new(sigma: f64) -> Self {
        assert!(sigma > 0.0 && sigma <= 1.0, "sigma is in (0, 1]: {sigma}");
        let contrast = (1.0 - sigma) * (1.0 + sigma) / (2.0 * sigma * sigma);
        Self { sigma, contrast, straight_on: 1.0 / (4.0 * PI * sigma) }
    }

    /// The fibres' cross-section seen along their axis.
    #[inline]
    pub fn sigma(&self) -> f64 {
        self.sigma
    }

    /// (1 - sigma^2) / (2 sigma^2): 0 for the isotropic medium.
    #[inline]
    pub(super) fn contrast(&self) -> f64 {
        self.contrast
    }

    /// The kernel's greatest value, 1 / (4 pi sigma), that of going straight on.
    #[inline]
    pub(super) fn straight_on(&self) -> f64 {
        self.straight_on
    }

    /// Extinction per unit length along directions of cosine `mu` to the fibres: sqrt(w^T S w) (eq. 7 for unit density).
    ///
    /// In \[sigma, 1\]: 1 across the fibres, sigma along them.
    pub fn extinction(&self, mu: f64) -> f64 {
        assert!(mu.abs() <= 1.0, "mu is a cosine: {mu}");
        let along = mu * self.sigma;
        (along * along + (1.0 - mu) * (1.0 + mu)).sqrt()
    }

    /// Density D of the flakes' normals over the sphere at cosine `m_z` to the fibres (eq. 9), per steradian.
    ///
    /// Scaled so that the flakes' area projected along w is the extinction: its integral over the sphere is not 1.
    pub fn flake_density(&self, m_z: f64) -> f64 {
        let sigma_square = self.sigma * self.sigma;
        // m^T S^-1 m = (sigma^2 + (1 - sigma^2) m_z^2) / sigma^2, with its terms in an order in which nothing cancels.
        let form = sigma_square + (1.0 - self.sigma) * (1.0 + self.sigma) * m_z * m_z;
        self.sigma * sigma_square / (PI * form * form)
    }

    /// The scattering kernel extinction x phase function, D(wh) / 4: symmetric in its arguments, per length and steradian.
    ///
    /// `back` points back to where the light came from, `out` along where it goes, both unit; wh is their half vector.
    /// Where `out` = -`back` (straight on) it is 1 / (4 pi sigma), the limit along directions that keep their
    /// elevation.
    #[inline]
    pub fn kernel(&self, back: DVec3, out: DVec3) -> f64 {
        let sum = back + out;
        let half_square = 0.5 * sum.length_squared();
        if half_square == 0.0 {
            return self.straight_on;
        }
        // [`Self::flake_density`] / 4 at wh_z^2 = sum_z^2 / (2 half_square), expanded by half_square so that one
        // division is enough.
        let ratio = half_square / (half_square + self.contrast * sum.z * sum.z);
        self.straight_on * ratio * ratio
    }

    /// The phase function D(wh) / (4 extinction(back)) (eq. 17): its integral over `out` is 1.
    pub fn phase(&self, back: DVec3, out: DVec3) -> f64 {
        self.kernel(back, out) / self.stretched(back).length()
    }

    /// A direction distributed as [`Self::phase`] of `back`, a unit vector.
    ///
    /// Light hits flakes in proportion to how much of them it sees, so that the normals it hits are those of an
    /// ellipsoid at points that are uniform in its silhouette (section 4.3 of the source). S^(1/2) maps the unit
    /// sphere's normals to the ellipsoid's, and its silhouette to the ellipsoid's; and the sphere's normals, as seen
    /// from t, are distributed as t plus a uniform point on the sphere. Neither small sigma nor grazing light needs a
    /// case of its own.
    pub fn sample(&self, back: DVec3, rng: &mut impl Rng) -> DVec3 {
        self.sample_seen(back, self.stretched(back).normalize(), rng)
    }

    /// [`Self::sample`] where the caller has the unit vector `seen` = S^(1/2) back / extinction already.
    pub(super) fn sample_seen(&self, back: DVec3, seen: DVec3, rng: &mut impl Rng) -> DVec3 {
        loop {
            let normal = self.stretched(seen + warp::unit_sphere(rng));
            let length_square = normal.length_squared();
            // Zero where the point lies opposite `seen` to the last bit.
            if length_square > 0.0 {
                return normal * (2.0 * back.dot(normal) / length_square) - back;
            }
        }
    }

    /// S^(1/2) w, whose length is the extinction along w.
    pub(super) fn stretched(&self, w: DVec3) -> DVec3 {
        DVec3::new(w.x, w.y, self.sigma * w.z)
    }
}
