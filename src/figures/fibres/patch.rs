//! A layer of fibres that repeats itself sideways.

use super::fibre::{Fibre, Hit};
use super::forest::Forest;
use super::planting::{Planting, in_box};
use crate::math::sine;
use glam::DVec3;
use rand::SeedableRng;
use rand_pcg::Pcg64;

/// The layer 0 <= z <= 1 over a square in x and y, repeated without end; black below.
///
/// Fibres are planted independently of each other, uniformly in a layer thicker by half a fibre above and below, and
/// the layer's faces cut them: so the layer is the same at every depth. Fibres may cross. Their sides are mirrors seen
/// from outside, while their cut faces and ends are open, and their insides let light pass (a share of 0.8 d of light
/// starts there, d the diameter). Then the number of fibres that a ray enters on any straight way is a Poisson variable
/// whose mean per length is exactly the SGGX extinction, for fibres of any diameter and length; and single scattering
/// is exactly the slab's too. The only difference from the slab is what a path remembers: that the way it came by has
/// no fibres, and which fibres it has met.
#[derive(Clone)]
pub struct Patch {
    forest: Forest,
    period: f64,
}

/// How a path through a patch ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Passage {
    /// It left the patch.
    Left {
        /// Unit: above the patch where it points up, else below.
        direction: DVec3,
        /// How often it was scattered; 0 where it went straight through.
        scatterings: u64,
    },
    /// After [`MOST_STEPS`] it had still not left.
    Interrupted,
}

/// Most reflections and crossings of the patch's sides on a path: as hundreds are rare already, only broken numbers
/// reach this.
pub const MOST_STEPS: u64 = 1_000_000;

impl Patch {
    /// The patch with `count` fibres in it, not counting those of its neighbours that reach into it. Its period follows
    /// from their density.
    pub fn new(planting: &Planting, count: usize) -> Self {
        planting.check();
        assert!(count > 0, "a patch has fibres");
        let (axes, overhang) = (planting.axes(), planting.overhang());
        let (radius, half_length) = (planting.diameter / 2.0, planting.length / 2.0);
        let period = (count as f64 / planting.reaching()).sqrt();
        let mut rng = Pcg64::seed_from_u64(planting.seed);
        let space = DVec3::new(period, period, 1.0 + 2.0 * overhang);
        let mut fibres = Vec::with_capacity(count);
        while fibres.len() < count {
            let middle = in_box(space, &mut rng) - overhang * DVec3::Z;
            let axis = axes.sample(&mut rng);
            let reach = half_length * axis.z + radius * sine(axis.z);
            if middle.z + reach >= 0.0 && middle.z - reach <= 1.0 {
                fibres.push(Fibre { middle, axis, half_length });
            }
        }
        Self::from_fibres(&fibres, radius, period, planting.spacing())
    }

    /// The patch of these fibres, whose middles lie over the square with a corner at the origin and sides of `period`.
    /// [`Forest::new`] says what `piece` is.
    pub fn from_fibres(fibres: &[Fibre], radius: f64, period: f64, piece: f64) -> Self {
        assert!(period > 0.0 && period.is_finite(), "a patch has a period: {period}");
        let domain = [DVec3::ZERO, DVec3::new(period, period, 1.0)];
        let seen = fibres.iter().flat_map(|fibre| images(*fibre, radius, period)).collect();
        Self { forest: Forest::new(seen, radius, domain, piece), period }
    }

    /// The fibres, those of neighbours that reach into the patch included.
    pub fn forest(&self) -> &Forest {
        &self.forest
    }

    /// The side of the square that repeats, in thicknesses of the layer.
    pub fn period(&self) -> f64 {
        self.period
    }

    /// Follows light from a point of the patch along the unit vector `direction`, mirrored by each fibre that it meets, until it leaves.
    pub fn trace(&self, mut origin: DVec3, mut direction: DVec3) -> Passage {
        let mut scatterings = 0;
        for _ in 0..MOST_STEPS {
            match self.advance(&mut origin, direction) {
                Step::Met(hit) => {
                    direction = hit.mirrored(direction);
                    scatterings += 1;
                }
                Step::Left => return Passage::Left { direction, scatterings },
                Step::Crossed => {}
            }
        }
        Passage::Interrupted
    }

    /// The first fibre that light from a point of the patch meets, at its distance from there; `None` where light
    /// leaves the layer first.
    pub fn first(&self, origin: DVec3, direction: DVec3) -> Option<Hit> {
        let mut at = origin;
        let mut distance = 0.0;
        for _ in 0..MOST_STEPS {
            let from = at;
            match self.advance(&mut at, direction) {
                Step::Met(hit) => return Some(Hit { distance: distance + hit.distance, ..hit }),
                Step::Left => return None,
                Step::Crossed => distance += self.to_side(from, direction).0,
            }
        }
        None
    }

    /// Goes on from `at` to the next fibre, out of the layer, or across a side of the patch, to enter again by the
    /// opposite one.
    fn advance(&self, at: &mut DVec3, direction: DVec3) -> Step {
        let (side, axis) = self.to_side(*at, direction);
        let face = match direction.z {
            up if up > 0.0 => (1.0 - at.z) / up,
            down if down < 0.0 => -at.z / down,
            _ => f64::INFINITY,
        };
        if let Some(hit) = self.forest.first(*at, direction, side.min(face)) {
            *at += hit.distance * direction;
            return Step::Met(hit);
        }
        if face <= side {
            return Step::Left;
        }
        *at += side * direction;
        at[axis] = if direction[axis] > 0.0 { 0.0 } else { self.period };
        Step::Crossed
    }

    /// The distance to the side by which a ray leaves, and the axis which that side is perpendicular to.
    fn to_side(&self, at: DVec3, direction: DVec3) -> (f64, usize) {
        let [x, y] = [0, 1].map(|axis| match direction[axis] {
            along if along > 0.0 => (self.period - at[axis]) / along,
            along if along < 0.0 => -at[axis] / along,
            _ => f64::INFINITY,
        });
        if x < y { (x, 0) } else { (y, 1) }
    }
}

enum Step {
    Met(Hit),
    Left,
    Crossed,
}

/// All images of the fibre that reach into the patch: the fibre itself, and its copies in neighbouring patches.
fn images(fibre: Fibre, radius: f64, period: f64) -> impl Iterator<Item = Fibre> {
    let [low, high] = fibre.bounds(radius, [-fibre.half_length, fibre.half_length]);
    // low + k period <= period and high + k period >= 0.
    let range = move |axis: usize| (-high[axis] / period).ceil() as i64..=(1.0 - low[axis] / period).floor() as i64;
    range(0).flat_map(move |i| {
        range(1).map(move |j| {
            let shift = DVec3::new(i as f64, j as f64, 0.0) * period;
            Fibre { middle: fibre.middle + shift, ..fibre }
        })
    })
}
