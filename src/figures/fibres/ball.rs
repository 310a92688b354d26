//! A ball with fibres on it.

use super::fibre::Fibre;
use super::forest::Forest;
use super::patch::MOST_STEPS;
use super::planting::Planting;
use crate::math::warp;
use glam::{DQuat, DVec3};
use rand::SeedableRng;
use rand_pcg::Pcg64;
use std::f64::consts::PI;

/// A black ball around the origin in a layer of fibres, which stand on it as those of a [`Patch`](super::Patch) stand
/// on its ground.
#[derive(Clone)]
pub struct Ball {
    forest: Forest,
    radius: f64,
    thickness: f64,
}

/// How a ray at a ball ended. Mirrors leave nothing to chance: equal rays end alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fate {
    /// It met neither a fibre nor the ball below.
    Missed,
    /// It ended on the black ball.
    Absorbed {
        /// By how many fibres it was mirrored before that.
        scatterings: u64,
    },
    /// Fibres have sent it away.
    Left(Exit),
    /// After [`MOST_STEPS`] it had still not left.
    Interrupted,
}

/// A ray that fibres have sent away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exit {
    /// Where it met the last fibre.
    pub origin: DVec3,
    /// Unit vector.
    pub direction: DVec3,
    /// At least 1.
    pub scatterings: u64,
}

impl Ball {
    /// The black ball of `radius` with a layer of `thickness` around it, whose fibres are planted by `planting`, in
    /// units of that thickness. Panics where one of these sizes is not positive.
    ///
    /// The middles of fibres are uniform in space, and their axes are distributed around the normal there. For a thin
    /// layer that makes about 4 pi (radius / thickness)^2 times as many as in a patch of period 1.
    pub fn new(planting: &Planting, radius: f64, thickness: f64) -> Self {
        planting.check();
        assert!(radius > 0.0 && thickness > 0.0, "a ball and its layer have sizes: {radius}, {thickness}");
        let shell = Shell::of(planting, radius, thickness);
        let (axes, half_length) = (planting.axes(), planting.length * thickness / 2.0);
        let mut rng = Pcg64::seed_from_u64(planting.seed);
        let planted = (planting.number_density() * shell.volume() / thickness.powi(3)).round() as u64;
        let plant = |_| {
            let normal = warp::unit_sphere(&mut rng);
            let middle = shell.distance(warp::uniform(&mut rng)) * normal;
            let axis = DQuat::from_rotation_arc(DVec3::Z, normal) * axes.sample(&mut rng);
            Fibre { middle, axis, half_length }
        };
        let reach = planting.diameter * thickness / 2.0;
        let layer = [radius - reach, radius + thickness + reach];
        let fibres = (0..planted).map(plant).filter(|fibre| reaches(fibre, layer)).collect();
        let corner = DVec3::splat(radius + thickness);
        let forest = Forest::new(fibres, reach, [-corner, corner], planting.spacing() * thickness);
        Self { forest, radius, thickness }
    }

    /// The fibres.
    pub fn forest(&self) -> &Forest {
        &self.forest
    }

    /// The radii between which light meets fibres.
    pub fn layer(&self) -> [f64; 2] {
        [self.radius, self.radius + self.thickness]
    }

    /// Follows a ray from outside the ball along the unit vector `direction`, mirrored by each fibre that it meets in
    /// the layer.
    pub fn trace(&self, mut origin: DVec3, mut direction: DVec3) -> Fate {
        let [inner, outer] = self.layer();
        let Some([enter, _]) = sphere(origin, direction, outer).filter(|[_, leave]| *leave > 0.0) else {
            return Fate::Missed;
        };
        origin += enter.max(0.0) * direction;
        for scatterings in 0..MOST_STEPS {
            let Some([_, leave]) = sphere(origin, direction, outer) else {
                return left(origin, direction, scatterings);
            };
            let black = sphere(origin, direction, inner).map(|[enter, _]| enter).filter(|enter| *enter > 0.0);
            let Some(hit) = self.forest.first(origin, direction, black.unwrap_or(leave).max(0.0)) else {
                return if black.is_some() {
                    Fate::Absorbed { scatterings }
                } else {
                    left(origin, direction, scatterings)
                };
            };
            origin += hit.distance * direction;
            direction = hit.mirrored(direction);
        }
        Fate::Interrupted
    }
}

fn left(origin: DVec3, direction: DVec3, scatterings: u64) -> Fate {
    if scatterings == 0 { Fate::Missed } else { Fate::Left(Exit { origin, direction, scatterings }) }
}

/// The radii between which the middles of fibres lie.
struct Shell {
    inner: f64,
    outer: f64,
}

impl Shell {
    fn of(planting: &Planting, radius: f64, thickness: f64) -> Self {
        let overhang = planting.overhang() * thickness;
        Self { inner: (radius - overhang).max(0.0), outer: radius + thickness + overhang }
    }

    fn volume(&self) -> f64 {
        4.0 / 3.0 * PI * (self.outer.powi(3) - self.inner.powi(3))
    }

    /// The distance from the middle within which a share of the volume lies.
    fn distance(&self, share: f64) -> f64 {
        (self.inner.powi(3) + share * (self.outer.powi(3) - self.inner.powi(3))).cbrt()
    }
}

/// Whether any part of a fibre's axis is between the radii.
fn reaches(fibre: &Fibre, [inner, outer]: [f64; 2]) -> bool {
    let Fibre { middle, axis, half_length } = *fibre;
    let nearest = (-middle.dot(axis)).clamp(-half_length, half_length);
    let [one, other] = [-half_length, half_length].map(|height| (middle + height * axis).length());
    (middle + nearest * axis).length() <= outer && one.max(other) >= inner
}

/// Distances at which a line enters and leaves the sphere of `radius` around the origin.
fn sphere(origin: DVec3, direction: DVec3, radius: f64) -> Option<[f64; 2]> {
    let nearest = -origin.dot(direction);
    let inside = radius * radius - (origin + nearest * direction).length_squared();
    (inside > 0.0).then(|| [nearest - inside.sqrt(), nearest + inside.sqrt()])
}
