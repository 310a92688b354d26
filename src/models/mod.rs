//! How surfaces scatter light, for path tracers: evaluate, sample, density, albedo.
//!
//! | model | what it is | what to know |
//! |---|---|---|
//! | [`LtcSheen`] | the transformed cosine that renders in real time: a fit of the slab's lobe | sampled perfectly; reciprocal only nearly |
//! | [`SlabSheen`] | the slab itself: exact single scattering, the rest from a table to 0.2% of a lobe | reciprocal; weights to 1.7 R |
//! | [`SheenWalk`] | the slab path by path, a [`Layer`]: no density, but nothing tabulated | about ten scatterings a path, a thousand at low alpha |
//! | [`LtcGgx`] | the transformed cosine of the specular base | sampled perfectly; reciprocal only nearly |
//! | [`Ggx`] | the specular base itself: GGX microfacets, compensated for multiple reflection | weights to its albedo over R |
//! | [`Lambert`] | the diffuse base | |
//!
//! Sheens of prior work, to compare with, each by its paper's formula; each is sampled from a table that takes some
//! milliseconds to make.
//!
//! | model | what it is | what to know |
//! |---|---|---|
//! | [`Burley`] | Schlick's weight at the difference angle (Disney 2012) | no roughness; reciprocal |
//! | [`NeubeltPettineo`] | inverted Gaussian of half vectors (The Order: 1886, 2013) | reciprocal; a ground that shines at all angles |
//! | [`ContyKulla`] | power of the half vector's sine, shadowing fitted (Imageworks 2017) | reciprocal with [`Terminator::Physical`]; creates light where alpha is small |
//! | [`Patry`] | single scattering of SGGX fibres (Ghost of Tsushima 2020) | not reciprocal |
//!
//! Sheens have no colour: `C_sheen` multiplies what they give. The specular base is made for each colour channel.
//! Models live in a frame whose z is the normal; `wi` and `wo` may be anywhere on the sphere, but below the horizon
//! nothing is scattered. A model is made for one roughness, and may be shared by any number of threads.
//!
//! # Example
//!
//! What a path tracer does where a path meets the surface: it samples the next direction, and weighs light from a
//! direction that it has found by sampling the lights.
//!
//! ```
//! use glam::DVec3;
//! use velour::models::{Bsdf, Sample, SlabSheen};
//! use velour::table::SlabTable;
//!
//! // Once for a material: takes a millisecond.
//! let sheen = SlabSheen::new(&SlabTable::embedded(), 0.3);
//! let c_sheen = DVec3::new(0.9, 0.8, 0.7);
//!
//! // wi points back along the path (to the viewer), in the frame in which z is the normal.
//! let wi = DVec3::new(0.6, 0.48, 0.64);
//! let mut throughput = DVec3::ONE;
//! if let Some(Sample { wo, weight, .. }) = sheen.sample(wi, [0.2, 0.7]) {
//!     throughput *= c_sheen * weight;
//!     assert!(wo.z > 0.0 && throughput.max_element() < 2.0);
//! }
//!
//! // A light in direction wo that was found with a density of its own, by multiple importance sampling (balance heuristic).
//! let (wo, light_density, radiance) = (DVec3::new(-0.8, 0.0, 0.6), 2.5, DVec3::ONE);
//! let light = c_sheen * sheen.evaluate(wi, wo) * radiance / (light_density + sheen.pdf(wi, wo));
//! assert!(light.min_element() > 0.0);
//!
//! // What is left for the layers below.
//! let below = DVec3::ONE - c_sheen * sheen.albedo(wi.z);
//! assert!(below.min_element() > 0.0);
//! ```

mod burley;
mod conty_kulla;
mod directions;
mod elevations;
mod ggx;
mod half_vector;
mod lambert;
mod ltc_sheen;
mod neubelt_pettineo;
mod patry;
mod sheen_walk;
mod slab_sheen;

pub use burley::Burley;
pub use conty_kulla::{ContyKulla, Terminator};
pub use directions::LEAST_ALPHA;
pub use ggx::{Ggx, LtcGgx, Schlick};
pub use lambert::Lambert;
pub use ltc_sheen::LtcSheen;
pub use neubelt_pettineo::NeubeltPettineo;
pub use patry::Patry;
pub use sheen_walk::{Flight, Layer, SheenWalk};
pub use slab_sheen::{EMPTY_BELOW_ALPHA, SlabSheen};

use glam::DVec3;

/// How a surface scatters light, without colour.
///
/// Directions are unit to [`UNIT_TOLERANCE`], point away from the surface, and have the normal as z. Others, NaN among
/// them, are mistakes of the caller and panic with their value, as do uniform numbers and cosines outside their ranges.
pub trait Bsdf {
    /// f_r(wi, wo) times the cosine of `wo`, per steradian: multiplied by the radiance from `wo` and integrated over
    /// `wo`, it gives the radiance towards `wi`. 0 where one of them is below the horizon, or `wo` is on it.
    fn evaluate(&self, wi: DVec3, wo: DVec3) -> f64;

    /// A direction from two uniform numbers in \[0, 1); `None` where nothing is scattered: then the path ends.
    fn sample(&self, wi: DVec3, uniforms: [f64; 2]) -> Option<Sample>;

    /// Density per steradian with which [`Self::sample`] finds `wo`; 0 where `wi` or `wo` is below the horizon, or `wo`
    /// is on it.
    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64;

    /// The share of light of cosine `mu` in \[0, 1\] that is scattered: the integral of [`Self::evaluate`] over `wo`.
    /// In \[0, 1\], except for [`ContyKulla`], which creates light.
    fn albedo(&self, mu: f64) -> f64;
}

/// A sampled direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Unit, above the horizon.
    pub wo: DVec3,
    /// [`Bsdf::evaluate`] divided by `pdf`.
    pub weight: f64,
    /// Density of `wo` per steradian.
    pub pdf: f64,
}

/// How far the square of a direction's length may be from 1, since directions may come from `f32`.
pub const UNIT_TOLERANCE: f64 = 1e-5;

/// The cosine of a direction to the normal, at most 1.
#[inline]
fn cosine(w: DVec3) -> f64 {
    assert!((w.length_squared() - 1.0).abs() < UNIT_TOLERANCE, "a direction is unit: {w}");
    w.z.min(1.0)
}

#[inline]
fn check_uniforms(uniforms: [f64; 2]) {
    assert!(uniforms.iter().all(|u| (0.0..1.0).contains(u)), "uniform numbers are in [0, 1): {uniforms:?}");
}

fn check_alpha(alpha: f64) {
    assert!((0.0..=1.0).contains(&alpha), "alpha is in [0, 1]: {alpha}");
}
