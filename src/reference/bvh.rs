//! Rays against many things: a bounding volume hierarchy of `f32` boxes around things that are met in `f64`.
//!
//! Boxes are those of the scene scaled into a cube of side 2, each padded by what `f32` may have rounded away, so that no thing is
//! lost: the hierarchy says where to look, the things themselves say what is met.

use std::ops::ControlFlow;
use std::time::Duration;

use glam::{DVec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh;
use obvhs::ray::RayHit;
use obvhs::{Boundable, BvhBuildParams};

/// Room around boxes, in units of half the scene: sixteen roundings of a coordinate, and those of a ray that is a few units long.
const PADDING: f32 = 2e-6;
/// Room behind a hit, as a share of its distance and in half scenes, in which boxes are still looked into.
const BEHIND: f64 = 1e-5;

/// A half line.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    pub origin: DVec3,
    /// Unit.
    pub direction: DVec3,
}

impl Ray {
    pub fn at(&self, distance: f64) -> DVec3 {
        self.origin + distance * self.direction
    }
}

/// What a hierarchy is made of.
pub trait Primitive {
    /// Where it is met, in coordinates of its own.
    type Place: Copy;

    /// Least and greatest corner of a box around it.
    fn bounds(&self) -> [DVec3; 2];

    /// The distance along the ray at which it is met, and where; of several the caller's affair.
    fn meet(&self, ray: &Ray) -> Option<(f64, Self::Place)>;
}

/// A primitive that is met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting<T> {
    pub distance: f64,
    /// Of the primitive, as [`Bvh::primitives`] counts.
    pub index: usize,
    pub place: T,
}

/// A hierarchy over primitives.
pub struct Bvh<P> {
    tree: CwBvh,
    /// In the tree's order.
    primitives: Vec<P>,
    center: DVec3,
    /// Half the greatest side of the box around all.
    scale: f64,
}

struct Boxed(Aabb);

impl Boundable for Boxed {
    fn aabb(&self) -> Aabb {
        self.0
    }
}

impl<P: Primitive> Bvh<P> {
    /// Over primitives whose bounds are finite; what is not is left out. Their order changes.
    pub fn new(primitives: Vec<P>) -> Self {
        let bounded: Vec<(P, [DVec3; 2])> = primitives
            .into_iter()
            .map(|primitive| {
                let bounds = primitive.bounds();
                (primitive, bounds)
            })
            .filter(|(_, [low, high])| low.is_finite() && high.is_finite())
            .collect();
        let union = |[low, high]: [DVec3; 2], (_, bounds): &(P, [DVec3; 2])| [low.min(bounds[0]), high.max(bounds[1])];
        let [low, high] = bounded.iter().fold([DVec3::INFINITY, DVec3::NEG_INFINITY], union);
        let (center, scale) = if bounded.is_empty() {
            (DVec3::ZERO, 1.0)
        } else {
            (0.5 * low + 0.5 * high, (0.5 * high - 0.5 * low).max_element().max(f64::MIN_POSITIVE.sqrt()))
        };
        let scaled = |corner: DVec3| Vec3A::from(((corner - center) / scale).as_vec3());
        let boxes: Vec<Boxed> = bounded
            .iter()
            .map(|(_, [low, high])| Boxed(Aabb::new(scaled(*low) - PADDING, scaled(*high) + PADDING)))
            .collect();
        let tree = build_cwbvh(&boxes, BvhBuildParams::medium_build(), &mut Duration::default());
        let mut primitives: Vec<Option<P>> = bounded.into_iter().map(|(primitive, _)| Some(primitive)).collect();
        let ordered = tree.primitive_indices.iter().filter_map(|&index| primitives[index as usize].take());
        let primitives = ordered.collect();
        Self { tree, primitives, center, scale }
    }

    /// In the order in which meetings count them.
    pub fn primitives(&self) -> &[P] {
        &self.primitives
    }

    /// The nearest primitive met between two distances of those that `accept` takes.
    pub fn nearest(
        &self,
        ray: &Ray,
        [near, far]: [f64; 2],
        mut accept: impl FnMut(&Meeting<P::Place>) -> bool,
    ) -> Option<Meeting<P::Place>> {
        let (start, unit_ray) = self.unit_ray(ray, far)?;
        let mut nearest: Option<Meeting<P::Place>> = None;
        let mut limit = far;
        self.tree.ray_traverse(unit_ray, &mut RayHit::none(), |_, index| {
            let Some((distance, place)) = self.primitives[index].meet(ray) else { return f32::INFINITY };
            let meeting = Meeting { distance, index, place };
            if distance < near || distance >= limit || !accept(&meeting) {
                return f32::INFINITY;
            }
            limit = distance;
            nearest = Some(meeting);
            self.shortened(distance - start)
        });
        nearest
    }

    /// Visits primitives between two distances, in any order, until told to stop: gives what stopped it.
    pub fn visit<B>(
        &self,
        ray: &Ray,
        [near, far]: [f64; 2],
        mut visit: impl FnMut(&Meeting<P::Place>) -> ControlFlow<B>,
    ) -> Option<B> {
        let (_, unit_ray) = self.unit_ray(ray, far)?;
        let mut stopped = None;
        self.tree.ray_traverse_miss(unit_ray, |_, index| {
            if let Some((distance, place)) = self.primitives[index].meet(ray)
                && distance >= near
                && distance < far
                && let ControlFlow::Break(value) = visit(&Meeting { distance, index, place })
            {
                stopped = Some(value);
                return f32::NEG_INFINITY;
            }
            f32::INFINITY
        });
        stopped
    }

    /// The ray in the tree's scale from where it enters a sphere around all, and the distance to there; none where it misses.
    fn unit_ray(&self, ray: &Ray, far: f64) -> Option<(f64, obvhs::ray::Ray)> {
        // The cube of side 2 lies in a sphere of radius sqrt(3).
        const RADIUS_SQUARE: f64 = 3.0001;
        if self.primitives.is_empty() {
            return None;
        }
        let origin = (ray.origin - self.center) / self.scale;
        let along = origin.dot(ray.direction);
        let across = (origin - along * ray.direction).length_squared();
        let half = (RADIUS_SQUARE - across).max(0.0).sqrt();
        let start = (-along - half).max(0.0);
        if across > RADIUS_SQUARE || along > half || !(start * self.scale <= far) {
            return None;
        }
        let entry = Vec3A::from((origin + start * ray.direction).as_vec3());
        let start = start * self.scale;
        // Added, a zero loses its sign: the tree takes -0 for a direction that goes down.
        let direction = Vec3A::from(ray.direction.as_vec3()) + Vec3A::ZERO;
        Some((start, obvhs::ray::Ray::new(entry, direction, 0.0, self.shortened(far - start))))
    }

    /// A length in the tree's scale, and some.
    fn shortened(&self, length: f64) -> f32 {
        ((length / self.scale).abs() * (1.0 + BEHIND) + BEHIND) as f32
    }
}
