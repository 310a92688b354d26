//! How fibres are planted.

use super::axes::Axes;
use crate::math::warp;
use crate::physics::slab::sigma_from_alpha;
use glam::DVec3;
use rand::Rng;

/// Which fibres a layer has, in units of its thickness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Planting {
    /// Roughness of the slab that the fibres stand for, in (0, 1].
    pub alpha: f64,
    /// Diameter of the fibres, in (0, 1\]; to come near the slab, it must be small against 1.
    pub diameter: f64,
    /// Length of the fibres, in (0, 100\].
    pub length: f64,
    /// Equal seeds plant equal fibres.
    pub seed: u64,
}

impl Planting {
    /// How the fibres' axes are distributed.
    pub fn axes(&self) -> Axes {
        Axes::new(sigma_from_alpha(self.alpha))
    }

    /// Fibres per volume: the extinction across the normal is 1 per thickness, whatever the diameter and length.
    pub fn number_density(&self) -> f64 {
        self.axes().cover() / (self.diameter * self.length)
    }

    /// How far above and below the layer the middles of fibres may lie.
    pub(super) fn overhang(&self) -> f64 {
        (self.length + self.diameter) / 2.0
    }

    /// Number of fibres per unit of area that reach into the layer, at least in part.
    pub(super) fn reaching(&self) -> f64 {
        let axes = self.axes();
        self.number_density() * (1.0 + self.length * axes.mean_cosine() + self.diameter * axes.mean_sine())
    }

    /// Mean distance between the fibres, across them.
    pub(super) fn spacing(&self) -> f64 {
        (self.diameter / self.axes().cover()).sqrt()
    }

    pub(super) fn check(&self) {
        let Self { diameter, length, .. } = self;
        assert!(*diameter > 0.0 && *diameter <= 1.0, "a fibre's diameter is in (0, 1] thicknesses: {diameter}");
        assert!(*length > 0.0 && *length <= 100.0, "a fibre's length is in (0, 100] thicknesses: {length}");
    }
}

/// Uniform in the box of `size` with a corner at the origin.
pub fn in_box(size: DVec3, rng: &mut impl Rng) -> DVec3 {
    size * DVec3::new(warp::uniform(rng), warp::uniform(rng), warp::uniform(rng))
}
