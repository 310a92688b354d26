//! The specular base: microfacets themselves, and the transformed cosine of real-time rendering.

use super::{Bsdf, Sample, check_uniforms, cosine};
use crate::math::frame::AzimuthFrame;
use crate::math::{check_cosine, cube_root};
use crate::physics::microfacet::{self, Reflected};
use crate::table::{GgxLobe, GgxTable, Ltc, cell, node};
use glam::DVec3;

/// Nodes along the cube root of mu, close enough at mu = alpha, where R dips: interpolated linearly, shares are off by
/// at most 1e-3.
const SHARES: usize = 129;

/// Schlick's approximation of Fresnel's reflectance, of one colour channel: f0 head on, f90 at grazing angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Schlick {
    f0: f64,
    f90: f64,
}

impl Schlick {
    /// A perfect mirror, which takes nothing from the light.
    pub const MIRROR: Self = Self { f0: 1.0, f90: 1.0 };

    /// From `f0` and `f90` in \[0, 1\]; panics outside that range.
    pub fn new(f0: f64, f90: f64) -> Self {
        assert!([f0, f90].iter().all(|f| (0.0..=1.0).contains(f)), "f0 and f90 are in [0, 1]: {f0}, {f90}");
        Self { f0, f90 }
    }

    /// One for each colour channel, from values that are clamped to \[0, 1\].
    pub fn channels(f0: DVec3, f90: DVec3) -> [Self; 3] {
        let [f0, f90] = [f0, f90].map(|f| f.clamp(DVec3::ZERO, DVec3::ONE));
        [0, 1, 2].map(|channel| Self::new(f0[channel], f90[channel]))
    }

    /// The reflectance at `cosine`, that of the light to the facet's normal (Schlick 1994).
    fn at(&self, cosine: f64) -> f64 {
        self.f0 + (self.f90 - self.f0) * (1.0 - cosine).max(0.0).powi(5)
    }

    /// The factor by which light that facets reflect more than once raises a lobe of albedo R: 1 + f0 (1/R - 1)
    /// (Turquin 2019).
    fn gain(&self, albedo: f64) -> f64 {
        1.0 + self.f0 * (1.0 / albedo - 1.0)
    }

    /// The share of light that comes back from facets of albedo R and Fresnel share S: f0 (R - S) + f90 S, times the gain.
    ///
    /// At most R / R = 1, because S <= R; exactly 1 for f0 = f90 = 1.
    pub fn albedo(&self, albedo: f64, fresnel: f64) -> f64 {
        (self.f0 * (albedo - fresnel) + self.f90 * fresnel) * self.gain(albedo)
    }
}

/// GGX microfacets with height-correlated shadowing, compensated for multiple reflection: [`microfacet`] has the
/// formulas.
///
/// Reciprocal but for the compensation, which depends on `wi` alone. Samples are mirrored at visible normals. Those
/// that would go below the horizon, a few in a hundred, are returned as `None`, so that densities integrate to less
/// than 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Ggx {
    facets: microfacet::Ggx,
    schlick: Schlick,
    /// At the nodes of mu^(1/3).
    shares: Vec<Reflected>,
}

impl Ggx {
    /// The specular base of the user's `roughness` in \[0, 1\]; takes some milliseconds. Panics outside that range.
    pub fn new(roughness: f64, schlick: Schlick) -> Self {
        check_roughness(roughness);
        let facets = microfacet::Ggx::from_roughness(roughness);
        let shares = (0..SHARES).map(|k| facets.reflected(node(k, SHARES).powi(3))).collect();
        Self { facets, schlick, shares }
    }

    /// [`Bsdf::evaluate`] for each colour channel, with the reflectances `schlick` in place of this model's own.
    pub fn evaluate_channels(&self, wi: DVec3, wo: DVec3, schlick: &[Schlick; 3]) -> DVec3 {
        let (mu_i, mu_o) = (cosine(wi), cosine(wo));
        if mu_i < 0.0 || mu_o <= 0.0 {
            return DVec3::ZERO;
        }
        let (facets, cosine) = (self.facets.lobe(wi, wo), (wi + wo).length() / 2.0);
        let albedo = self.shares(mu_i).albedo;
        DVec3::from(schlick.each_ref().map(|schlick| facets * schlick.at(cosine) * schlick.gain(albedo)))
    }

    /// [`Bsdf::albedo`] for each colour channel, with the reflectances `schlick` in place of this model's own.
    pub fn albedo_channels(&self, mu: f64, schlick: &[Schlick; 3]) -> DVec3 {
        let [albedo, fresnel] = self.shares_at(mu);
        DVec3::from(schlick.each_ref().map(|schlick| schlick.albedo(albedo, fresnel)))
    }

    /// R and the Fresnel share at a cosine in \[0, 1\], whatever the reflectance: what [`Schlick::albedo`] takes.
    pub fn shares_at(&self, mu: f64) -> [f64; 2] {
        check_cosine(mu);
        let Reflected { albedo, fresnel } = self.shares(mu);
        [albedo, fresnel]
    }

    fn shares(&self, mu: f64) -> Reflected {
        let (below, t) = cell(cube_root(mu), SHARES);
        let [low, high] = [self.shares[below], self.shares[below + 1]];
        let between = |value: fn(Reflected) -> f64| (1.0 - t) * value(low) + t * value(high);
        Reflected { albedo: between(|share| share.albedo), fresnel: between(|share| share.fresnel) }
    }
}

impl Bsdf for Ggx {
    fn evaluate(&self, wi: DVec3, wo: DVec3) -> f64 {
        let (mu_i, mu_o) = (cosine(wi), cosine(wo));
        if mu_i < 0.0 || mu_o <= 0.0 {
            return 0.0;
        }
        let reflectance = self.schlick.at((wi + wo).length() / 2.0);
        self.facets.lobe(wi, wo) * reflectance * self.schlick.gain(self.shares(mu_i).albedo)
    }

    fn sample(&self, wi: DVec3, uniforms: [f64; 2]) -> Option<Sample> {
        check_uniforms(uniforms);
        if cosine(wi) < 0.0 {
            return None;
        }
        let wo = self.facets.sample(wi, uniforms);
        let pdf = self.facets.pdf(wi, wo);
        (wo.z > 0.0 && pdf > 0.0).then(|| Sample { wo, weight: self.evaluate(wi, wo) / pdf, pdf })
    }

    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        if cosine(wi) < 0.0 || cosine(wo) <= 0.0 { 0.0 } else { self.facets.pdf(wi, wo) }
    }

    fn albedo(&self, mu: f64) -> f64 {
        check_cosine(mu);
        let Reflected { albedo, fresnel } = self.shares(mu);
        self.schlick.albedo(albedo, fresnel)
    }
}

/// The specular base as a transformed cosine, with the table's numbers: what the shaders integrate over polygons. Fresnel's reflectance
/// is averaged over the lobe. Samples have the lobe's density: their weight is the albedo.
#[derive(Clone, Debug, PartialEq)]
pub struct LtcGgx {
    table: GgxTable,
    roughness: f64,
    schlick: Schlick,
}

impl LtcGgx {
    /// The specular base of the user's `roughness` in \[0, 1\]; panics outside that range.
    pub fn new(table: &GgxTable, roughness: f64, schlick: Schlick) -> Self {
        check_roughness(roughness);
        Self { table: table.clone(), roughness, schlick }
    }

    /// The lobe at a cosine, and the share that it sends back.
    fn lobe(&self, mu: f64) -> (Ltc, f64) {
        let GgxLobe { ltc, albedo, fresnel } = self.table.lookup(self.roughness, mu);
        (ltc, self.schlick.albedo(albedo, fresnel))
    }

    /// The albedo and the density at `wo`; `None` where one of the directions is below the horizon.
    fn meeting(&self, wi: DVec3, wo: DVec3) -> Option<(f64, f64)> {
        let (mu_i, mu_o) = (cosine(wi), cosine(wo));
        (mu_i >= 0.0 && mu_o > 0.0).then(|| {
            let (ltc, albedo) = self.lobe(mu_i);
            (albedo, ltc.density(AzimuthFrame::of(wi).local(wo)))
        })
    }
}

impl Bsdf for LtcGgx {
    fn evaluate(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.meeting(wi, wo).map_or(0.0, |(albedo, density)| albedo * density)
    }

    fn sample(&self, wi: DVec3, uniforms: [f64; 2]) -> Option<Sample> {
        check_uniforms(uniforms);
        let mu_i = cosine(wi);
        (mu_i >= 0.0).then(|| {
            let (ltc, weight) = self.lobe(mu_i);
            let wo = ltc.sample(uniforms);
            Sample { wo: AzimuthFrame::of(wi).outside(wo), weight, pdf: ltc.density(wo) }
        })
    }

    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.meeting(wi, wo).map_or(0.0, |(_, density)| density)
    }

    fn albedo(&self, mu: f64) -> f64 {
        check_cosine(mu);
        self.lobe(mu).1
    }
}

fn check_roughness(roughness: f64) {
    assert!((0.0..=1.0).contains(&roughness), "roughness is in [0, 1]: {roughness}");
}
