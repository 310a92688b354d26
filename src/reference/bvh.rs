//! Rays against many things: a bounding volume hierarchy of `f32` boxes around things that are met in `f64`.
//!
//! Boxes are those of the scene scaled into a cube of twice `SPAN`, each padded by what `f32` may have rounded away, so that no thing is
//! lost: the hierarchy says where to look, the things themselves say what is met.

use std::ops::ControlFlow;
use std::time::Duration;

use glam::{DVec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh;
use obvhs::ray::RayHit;
use obvhs::{Boundable, BvhBuildParams};

/// Half the scene in the tree's units: the tree passes over boxes that a ray leaves within 1e-4 of where it starts.
const SPAN: f64 = (1 << 20) as f64;
/// Room around boxes: sixteen roundings of a coordinate, and those of a ray that is a few times as long as the scene.
const PADDING: f32 = 2e-6 * SPAN as f32;
/// Room behind a hit in which boxes are still looked into, as a share of its distance and in half scenes.
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
#[derive(Clone)]
pub struct Bvh<P> {
    tree: CwBvh,
    /// In the tree's order.
    primitives: Vec<P>,
    center: DVec3,
    /// The tree's unit: of half the greatest side of the box around all, one of [`SPAN`].
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
            (0.5 * low + 0.5 * high, (0.5 * high - 0.5 * low).max_element().max(f64::MIN_POSITIVE.sqrt()) / SPAN)
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
        // The cube lies in a sphere of sqrt(3) times half its side.
        const RADIUS_SQUARE: f64 = 3.0001 * SPAN * SPAN;
        if self.primitives.is_empty() {
            return None;
        }
        let origin = (ray.origin - self.center) / self.scale;
        let along = origin.dot(ray.direction);
        let across = (origin - along * ray.direction).length_squared();
        let half = (RADIUS_SQUARE - across).max(0.0).sqrt();
        let start = (-along - half).max(0.0);
        if across > RADIUS_SQUARE || along > half || start * self.scale > far {
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
        ((length / self.scale).abs() * (1.0 + BEHIND) + BEHIND * SPAN) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::warp::{uniform, unit_sphere};
    use rand::SeedableRng;
    use rand_pcg::Pcg64;

    #[derive(Clone, Copy)]
    struct Ball {
        center: DVec3,
        radius: f64,
    }

    impl Primitive for Ball {
        type Place = ();

        fn bounds(&self) -> [DVec3; 2] {
            [self.center - self.radius, self.center + self.radius]
        }

        fn meet(&self, ray: &Ray) -> Option<(f64, ())> {
            let to_center = self.center - ray.origin;
            let nearest = to_center.dot(ray.direction);
            let inside = self.radius * self.radius - (to_center - nearest * ray.direction).length_squared();
            (inside > 0.0).then(|| (nearest - inside.sqrt(), ()))
        }
    }

    fn balls(count: usize, offset: DVec3, scale: f64) -> Vec<Ball> {
        let mut rng = Pcg64::seed_from_u64(5);
        let ball = |_| Ball {
            center: offset + scale * unit_sphere(&mut rng) * uniform(&mut rng),
            radius: scale * 0.02 * uniform(&mut rng),
        };
        (0..count).map(ball).collect()
    }

    /// Rays towards balls, at random and along the axes (with zeros of either sign), from far away and from a hair before them.
    fn rays(balls: &[Ball], scale: f64) -> Vec<Ray> {
        let mut rng = Pcg64::seed_from_u64(6);
        let ray = |k: usize| {
            let direction = match k % 8 {
                0 => DVec3::new(-0.0, 0.0, 1.0),
                1 => DVec3::new(0.0, -1.0, -0.0),
                2 => DVec3::new(1.0, -0.0, -0.0),
                3 => DVec3::new(1e-9, -1.0, -1e-12).normalize(),
                _ => unit_sphere(&mut rng),
            };
            let Ball { center, radius } = balls[k % balls.len()];
            let beside = 0.9 * radius * unit_sphere(&mut rng);
            let distance = radius + scale * [0.3, 3.0, 1e4, 1e-3, 1e-5, 1e-7][k % 6];
            Ray { origin: center + beside - distance * direction, direction }
        };
        (0..600).map(ray).collect()
    }

    #[test]
    fn nothing_is_lost_that_a_search_through_all_finds() {
        for (offset, scale) in [(DVec3::ZERO, 1.0), (DVec3::new(1e3, -5e2, 2e3), 0.1), (DVec3::splat(-7.0), 1e6)] {
            let all = balls(500, offset, scale);
            let bvh = Bvh::new(all.clone());
            assert_eq!(bvh.primitives().len(), all.len());
            let mut met = 0;
            for ray in rays(&all, scale) {
                let range = [0.0, 2e4 * scale];
                let inside = |distance: &f64| (range[0]..range[1]).contains(distance);
                let mut expected: Vec<f64> =
                    all.iter().filter_map(|ball| Some(ball.meet(&ray)?.0)).filter(inside).collect();
                expected.sort_by(f64::total_cmp);
                let nearest = bvh.nearest(&ray, range, |_| true).map(|met| met.distance);
                assert_eq!(nearest, expected.first().copied(), "{ray:?}");
                // Of those that are taken.
                let second = bvh.nearest(&ray, range, |met| Some(met.distance) != nearest).map(|met| met.distance);
                assert_eq!(second, expected.get(1).copied(), "{ray:?}");
                let mut visited = Vec::new();
                let stopped = bvh.visit(&ray, range, |met| {
                    visited.push(met.distance);
                    ControlFlow::<()>::Continue(())
                });
                visited.sort_by(f64::total_cmp);
                assert_eq!((stopped, &visited), (None, &expected), "{ray:?}");
                if let Some(first) = nearest {
                    let short = bvh.nearest(&ray, [0.0, first], |_| true);
                    assert_eq!(short, None);
                    assert_eq!(bvh.visit(&ray, range, |met| ControlFlow::Break(met.distance > 0.0)), Some(true));
                    met += 1;
                }
            }
            assert!(met > 300, "{met} rays meet anything");
        }
    }

    #[test]
    fn none_and_one_are_no_special_cases() {
        let ray = Ray { origin: DVec3::ZERO, direction: DVec3::Z };
        assert_eq!(Bvh::<Ball>::new(Vec::new()).nearest(&ray, [0.0, 1e9], |_| true), None);
        let one = Bvh::new(vec![Ball { center: 3.0 * DVec3::Z, radius: 1.0 }]);
        assert_eq!(one.nearest(&ray, [0.0, 1e9], |_| true).map(|met| met.distance), Some(2.0));
        let broken = Bvh::new(vec![Ball { center: DVec3::NAN, radius: 1.0 }]);
        assert!(broken.primitives().is_empty() && broken.nearest(&ray, [0.0, 1e9], |_| true).is_none());
    }
}
