//! A rough mirror: microfacets of the GGX distribution that reflect all light, each once.
//!
//! W: Walter, Marschner, Li, Torrance 2007; H: Heitz 2014; V: Heitz 2018 (visible normals). Isotropic, masking and shadowing correlated by
//! height, F = 1. With root(mu) = sqrt(mu^2 + alpha^2 (1 - mu^2)), and thus 1 + 2 Lambda = root / mu (H eq. 72), the
//! formulas contain none of the quotients that fail at grazing angles:
//!
//! ```text
//! D(m)       = alpha^2 / (pi (1 - (1 - alpha^2) m_z^2)^2)                                  W eq. 33
//! G2         = 1 / (1 + Lambda_i + Lambda_o) = 2 mu_i mu_o / (mu_o root_i + mu_i root_o)   H eq. 99
//! f_r mu_o   = D G2 / (4 mu_i)               = D mu_o / (2 (mu_o root_i + mu_i root_o))    W eq. 20
//! pdf(wo)    = D G1 / (4 mu_i)               = D / (2 (mu_i + root_i))                     V, with G1 = 1 / (1 + Lambda_i)
//! ```
//!
//! Light that facets reflect downwards, or would reflect a second time, is lost: it is the share 1 - R.

use crate::math::quadrature::gauss_legendre;
use crate::math::{check_cosine, sine, sine_square};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Least alpha: smoother surfaces are treated as this rough. Their highlight is as sharp as a light seen at a sixth of a degree.
pub const LEAST_ALPHA: f64 = 1e-3;

/// Microfacets of roughness alpha.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ggx {
    alpha: f64,
}

/// Shares of light that a rough mirror reflects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reflected {
    /// R: the integral of f_r mu_o.
    pub albedo: f64,
    /// The integral of f_r mu_o (1 - dot(wi, h))^5: what Schlick's approximation of Fresnel's reflectance multiplies by f90 - f0.
    pub fresnel: f64,
}

/// A direction of light, with its weight in integrals over `wo`: it stands for both sides of the plane of incidence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// The direction, unit and above the horizon.
    pub wo: DVec3,
    /// dot(wi, h), h the half vector.
    pub cosine: f64,
    /// Solid angle.
    pub weight: f64,
    /// f_r mu_o, per steradian.
    pub lobe: f64,
}

impl Ggx {
    /// Microfacets of `alpha` in \[[`LEAST_ALPHA`], 1\]; panics outside that range.
    pub fn new(alpha: f64) -> Self {
        assert!((LEAST_ALPHA..=1.0).contains(&alpha), "alpha of microfacets is in [{LEAST_ALPHA}, 1]: {alpha}");
        Self { alpha }
    }

    /// Microfacets of the user's `roughness` in \[0, 1\]: alpha is its square, and no less than [`LEAST_ALPHA`].
    pub fn from_roughness(roughness: f64) -> Self {
        Self::new((roughness * roughness).max(LEAST_ALPHA))
    }

    /// The roughness alpha, in \[[`LEAST_ALPHA`], 1\].
    pub fn alpha(&self) -> f64 {
        self.alpha
    }

    /// D: microfacet area per steradian of normals of cosine `m_z`, of a surface of unit area (W eq. 33).
    pub fn normal_density(&self, m_z: f64) -> f64 {
        let form = sine_square(m_z) + (self.alpha * m_z).powi(2);
        (self.alpha / form).powi(2) / PI
    }

    /// sqrt(mu^2 + alpha^2 (1 - mu^2)) = (1 + 2 Lambda) mu.
    #[inline]
    fn root(&self, mu: f64) -> f64 {
        (mu * mu + self.alpha * self.alpha * sine_square(mu)).sqrt()
    }

    /// f_r(wi, wo) mu_o, per steradian; both directions unit, `wi` above the horizon or on it. 0 where `wo` is not above it.
    pub fn lobe(&self, wi: DVec3, wo: DVec3) -> f64 {
        if wo.z <= 0.0 {
            return 0.0;
        }
        let masking = wo.z / (2.0 * (wo.z * self.root(wi.z) + wi.z * self.root(wo.z)));
        self.normal_density((wi + wo).normalize().z.min(1.0)) * masking
    }

    /// Density of [`Self::sample`] per steradian, below the horizon too.
    pub fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        let half = wi + wo;
        if half.z <= 0.0 {
            return 0.0;
        }
        self.normal_density(half.normalize().z.min(1.0)) / (2.0 * (wi.z + self.root(wi.z)))
    }

    /// `wi` mirrored at a visible normal, from two uniform numbers in \[0, 1); it may lie below the horizon (V, section 3).
    ///
    /// Stretched by alpha, the facets form a hemisphere. What `wi` sees of it is a disc, one half of which is squeezed
    /// into half an ellipse.
    pub fn sample(&self, wi: DVec3, [one, other]: [f64; 2]) -> DVec3 {
        let seen = DVec3::new(self.alpha * wi.x, self.alpha * wi.y, wi.z).normalize();
        let across = DVec3::new(-seen.y, seen.x, 0.0).try_normalize().unwrap_or(DVec3::X);
        let (radius, (sin_phi, cos_phi)) = (one.sqrt(), (TAU * other).sin_cos());
        let x = radius * cos_phi;
        let share = 0.5 * (1.0 + seen.z);
        let y = (1.0 - share) * (1.0 - x * x).sqrt() + share * radius * sin_phi;
        let normal = x * across + y * seen.cross(across) + (1.0 - x * x - y * y).max(0.0).sqrt() * seen;
        let m = DVec3::new(self.alpha * normal.x, self.alpha * normal.y, normal.z.max(1e-12)).normalize();
        2.0 * wi.dot(m) * m - wi
    }

    /// R and the Fresnel share for `wi` of cosine `mu` in \[0, 1\], to 1e-5.
    pub fn reflected(&self, mu: f64) -> Reflected {
        let mut sum = Reflected { albedo: 0.0, fresnel: 0.0 };
        for Node { cosine, weight, lobe, .. } in self.quadrature(mu, ALBEDO_NODES) {
            sum.albedo += weight * lobe;
            sum.fresnel += weight * lobe * (1.0 - cosine).max(0.0).powi(5);
        }
        sum
    }

    /// Nodes over the directions above the horizon for `wi` = (sqrt(1 - mu^2), 0, mu), fine where the lobe is, for any alpha.
    ///
    /// The nodes run over the half vector's angles theta and phi. `wo` is above the horizon for
    /// theta < (atan2(s cos phi, mu) + pi / 2) / 2, s = sqrt(1 - mu^2): the domain's edge is smooth in phi, except for
    /// a turn of width mu at pi / 2. With tan theta = alpha tan chi the distribution is even in chi:
    /// D cos theta sin theta dtheta dphi = sin(2 chi) dchi dphi / 2 pi. `counts` are the numbers of Gauss nodes in chi,
    /// which are densest at the horizon, and in phi on either side of pi / 2, which are densest there and in the plane
    /// of incidence, against which grazing lobes are pressed.
    pub fn quadrature(&self, mu: f64, counts: [usize; 2]) -> Vec<Node> {
        check_cosine(mu);
        let (s, wi) = (sine(mu), DVec3::new(sine(mu), 0.0, mu));
        let unit = counts.map(|count| gauss_legendre(count, 0.0, 1.0));
        let mut nodes = Vec::with_capacity(2 * counts[0] * counts[1]);
        for (x, x_weight) in &unit[1] {
            for side in [-1.0, 1.0] {
                let phi = FRAC_PI_2 * (1.0 + side * x * x * (3.0 - 2.0 * x));
                let phi_weight = TAU * 3.0 * x * (1.0 - x) * x_weight;
                let (sin_phi, cos_phi) = phi.sin_cos();
                let edge = ((s * cos_phi).atan2(mu) + FRAC_PI_2) / 2.0;
                let last = edge.tan().atan2(self.alpha);
                for (t, t_weight) in &unit[0] {
                    let chi = last * t * (2.0 - t);
                    let chi_weight = last * 2.0 * (1.0 - t) * t_weight;
                    let slope = self.alpha * chi.tan();
                    let m = DVec3::new(slope * cos_phi, slope * sin_phi, 1.0);
                    let h_z = 1.0 / m.length();
                    let cosine = wi.dot(m) * h_z;
                    let wo = 2.0 * cosine * h_z * m - wi;
                    let facets = (2.0 * chi).sin() * chi_weight * phi_weight / TAU;
                    let weight = facets * 4.0 * cosine / (h_z * self.normal_density(h_z));
                    let masking = wo.z / (2.0 * (wo.z * self.root(mu) + mu * self.root(wo.z)));
                    if wo.z > 0.0 && weight > 0.0 {
                        nodes.push(Node { wo, cosine, weight, lobe: self.normal_density(h_z) * masking });
                    }
                }
            }
        }
        nodes
    }
}

/// Nodes in chi, and in phi on either side, with which albedos are integrated.
const ALBEDO_NODES: [usize; 2] = [32, 24];
