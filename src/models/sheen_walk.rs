//! The sheen as single paths through the slab.

use super::{EMPTY_BELOW_ALPHA, check_alpha};
use crate::math::warp::{exponential, uniform};
use crate::physics::slab::Slab;
use glam::DVec3;
use rand::Rng;

/// A flat layer of thickness 1 through which light is followed scattering by scattering. The density of what comes out
/// is not known, so that a layer is no [`Bsdf`](super::Bsdf); but that of each single scattering is, so that lights can
/// be sampled from there.
///
/// z is the layer's normal; depths run from 0 at the top to 1 at the bottom; directions are unit. Everything is
/// symmetric: paths may be followed from the view to the light.
pub trait Layer {
    /// Where light from a depth, going `along`, scatters next.
    fn flight(&self, depth: f64, along: DVec3, rng: &mut impl Rng) -> Flight;

    /// Of the light that enters by the top, going `along`, and is scattered at all: the depth at which it is scattered
    /// first, sampled, and its share of all light. `None` where nothing is scattered.
    fn first_scattering(&self, along: DVec3, rng: &mut impl Rng) -> Option<(f64, f64)>;

    /// The direction, sampled, in which light that goes `along` goes on after a scattering; nothing is absorbed.
    fn scatter(&self, along: DVec3, rng: &mut impl Rng) -> DVec3;

    /// The density of [`Self::scatter`] at `out`, per steradian.
    fn phase(&self, along: DVec3, out: DVec3) -> f64;

    /// The share of light going `along` from a depth that leaves without another scattering.
    fn passing(&self, depth: f64, along: DVec3) -> f64;
}

/// How a flight ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Flight {
    /// At a scattering at this depth.
    Scattered(f64),
    /// By the top.
    Above,
    /// By the bottom.
    Below,
}

/// The slab of fibres as a layer: what [`SlabSheen`](super::SlabSheen) tabulates, path by path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SheenWalk {
    /// None where the slab is empty.
    slab: Option<Slab>,
}

impl SheenWalk {
    /// The slab of roughness `alpha` in \[0, 1\], which is empty below [`EMPTY_BELOW_ALPHA`].
    pub fn new(alpha: f64) -> Self {
        check_alpha(alpha);
        Self { slab: (alpha >= EMPTY_BELOW_ALPHA).then(|| Slab::new(alpha)) }
    }

    /// Follows light that enters from `wi`, above the horizon, until it leaves. Gives the direction in which it leaves,
    /// below the horizon where that is by the bottom, and how often it was scattered.
    pub fn walk(&self, wi: DVec3, rng: &mut impl Rng) -> (DVec3, u32) {
        let (mut depth, mut along, mut scatterings) = (0.0, -wi, 0);
        while let Flight::Scattered(next) = self.flight(depth, along, rng) {
            (depth, along, scatterings) = (next, self.scatter(along, rng), scatterings + 1);
        }
        (along, scatterings)
    }
}

impl Layer for SheenWalk {
    fn flight(&self, depth: f64, along: DVec3, rng: &mut impl Rng) -> Flight {
        let next = match &self.slab {
            Some(slab) => depth - along.z * exponential(rng) / slab.medium().extinction(along.z.clamp(-1.0, 1.0)),
            None => {
                if along.z > 0.0 {
                    -1.0
                } else {
                    2.0
                }
            }
        };
        // NaN leaves too.
        if next > 0.0 && next < 1.0 {
            Flight::Scattered(next)
        } else if along.z > 0.0 {
            Flight::Above
        } else {
            Flight::Below
        }
    }

    fn first_scattering(&self, along: DVec3, rng: &mut impl Rng) -> Option<(f64, f64)> {
        let mu = along.z.abs().min(1.0);
        let slab = self.slab.as_ref().filter(|_| along.z < 0.0)?;
        let (optical_depth, share) = (slab.depth(mu), slab.scattered(mu));
        let depth = -(-uniform(rng) * share).ln_1p() / optical_depth;
        Some((depth.clamp(0.0, 1.0), share))
    }

    fn scatter(&self, along: DVec3, rng: &mut impl Rng) -> DVec3 {
        // Without this, rounding would pile up over a thousand scatterings.
        self.slab.map_or(along, |slab| slab.medium().sample(-along, rng).normalize())
    }

    fn phase(&self, along: DVec3, out: DVec3) -> f64 {
        self.slab.map_or(0.0, |slab| slab.medium().phase(-along, out))
    }

    fn passing(&self, depth: f64, along: DVec3) -> f64 {
        let Some(slab) = &self.slab else { return 1.0 };
        let way = if along.z > 0.0 { depth } else { 1.0 - depth };
        let mu = along.z.abs().min(1.0);
        if mu > 0.0 { (-slab.medium().extinction(mu) * way / mu).exp() } else { 0.0 }
    }
}
