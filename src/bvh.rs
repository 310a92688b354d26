//! Rays against many things: a bounding volume hierarchy, over a scene's triangles or over anything else that has
//! bounds.
//!
//! The boxes are `f32`, what they hold is intersected in `f64`. They are scaled into a cube of side twice `SPAN`, and
//! each is padded by what `f32` may have rounded away, so that nothing is missed: the hierarchy says where to look, the
//! primitives say what is met.

mod triangle;

pub use triangle::Triangle;

use std::ops::ControlFlow;
use std::time::Duration;

use glam::{DVec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh;
use obvhs::ray::RayHit;
use obvhs::{Boundable, BvhBuildParams};

/// Half the scene's size in the tree's units: the tree passes over boxes that a ray leaves within 1e-4 of where it
/// starts.
const SPAN: f64 = (1 << 20) as f64;
/// Padding of a box: sixteen roundings of a coordinate, and those of a ray that is a few times as long as the scene.
const PADDING: f32 = 2e-6 * SPAN as f32;
/// How far beyond a hit boxes are still visited, as a share of its distance and of half the scene's size.
const BEHIND: f64 = 1e-5;

/// Three numbers in [0, 1), other ones for each index. Where one thing is far from all others these are so near to each
/// other that their boxes are all alike; the tree pairs boxes by their areas, and of many that are equal it pairs but
/// two at a time.
fn jitter(index: usize) -> Vec3A {
    let bits = [0, 1, 2].map(|axis| (index as u32).wrapping_mul(3).wrapping_add(axis).wrapping_mul(0x9e37_79b9));
    Vec3A::from_array(bits.map(|bits| (bits >> 8) as f32 / (1 << 24) as f32))
}

/// A half line.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Where it starts.
    pub origin: DVec3,
    /// Unit.
    pub direction: DVec3,
}

impl Ray {
    /// The point at this distance from the origin.
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

    /// The distance along the ray at which it is met, negative behind the origin, and the place; none where the ray
    /// misses it. Of several meetings the primitive chooses one.
    fn meet(&self, ray: &Ray) -> Option<(f64, Self::Place)>;
}

/// A primitive that is met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting<T> {
    /// Along the ray.
    pub distance: f64,
    /// Of the primitive, in [`Bvh::primitives`].
    pub index: usize,
    /// On the primitive.
    pub place: T,
}

/// A hierarchy over primitives.
#[derive(Clone)]
pub struct Bvh<P> {
    tree: CwBvh,
    /// In the tree's order.
    primitives: Vec<P>,
    center: DVec3,
    /// The tree's unit: half the greatest side of the box around everything, over [`SPAN`].
    scale: f64,
}

struct Boxed(Aabb);

impl Boundable for Boxed {
    fn aabb(&self) -> Aabb {
        self.0
    }
}

/// The units of a hierarchy over what is between two corners; they are exact in `f32`.
pub fn units([low, high]: [DVec3; 2]) -> (DVec3, f64) {
    if !low.is_finite() || !high.is_finite() {
        return (DVec3::ZERO, 1.0);
    }
    let half = (0.5 * high - 0.5 * low).max_element().max(1e-30);
    ((0.5 * low + 0.5 * high).as_vec3().as_dvec3(), f64::from((half / SPAN) as f32))
}

fn is_finite(bounds: &[DVec3; 2]) -> bool {
    bounds.iter().all(|corner| corner.is_finite())
}

impl<P: Primitive> Bvh<P> {
    /// A hierarchy over these primitives, in another order; those whose bounds are not finite are left out.
    pub fn new(primitives: Vec<P>) -> Self {
        let bounds = primitives.iter().map(P::bounds).filter(is_finite);
        let union = |[low, high]: [DVec3; 2], bounds: [DVec3; 2]| [low.min(bounds[0]), high.max(bounds[1])];
        let [low, high] = bounds.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], union);
        // Rays are followed from where they enter a sphere around everything.
        Self::padded(primitives, units([low, high]), |_| PADDING)
    }

    /// The same in units of one's choice, which is for several hierarchies that a ray is to go through: where the coordinates
    /// begin, and half the size of a cube about it in which everything is, over 2^20. It is for rays that are followed from where
    /// they start: boxes are padded by what their own coordinates are rounded by, and are tight beside something very large.
    pub fn in_units(primitives: Vec<P>, units: (DVec3, f64)) -> Self {
        Self::padded(primitives, units, |farthest| PADDING / SPAN as f32 * farthest)
    }

    /// With boxes padded by a function of their greatest coordinate.
    fn padded(primitives: Vec<P>, (center, scale): (DVec3, f64), padding: impl Fn(f32) -> f32) -> Self {
        let bounded = |primitive: P| {
            let bounds = primitive.bounds();
            is_finite(&bounds).then_some((primitive, bounds))
        };
        let bounded: Vec<(P, [DVec3; 2])> = primitives.into_iter().filter_map(bounded).collect();
        let scaled = |corner: DVec3| Vec3A::from(((corner - center) / scale).as_vec3());
        let padded = |index: usize, [low, high]: [DVec3; 2]| {
            let (low, high) = (scaled(low), scaled(high));
            let padding = padding(low.abs().max(high.abs()).max_element());
            let is_tiny = (high - low).max_element() < padding;
            let padding = if is_tiny { padding * (1.0 + jitter(index)) } else { Vec3A::splat(padding) };
            Boxed(Aabb::new(low - padding, high + padding))
        };
        let boxes: Vec<Boxed> = bounded.iter().enumerate().map(|(index, (_, bounds))| padded(index, *bounds)).collect();
        let tree = build_cwbvh(&boxes, BvhBuildParams::medium_build(), &mut Duration::default());
        let mut primitives: Vec<Option<P>> = bounded.into_iter().map(|(primitive, _)| Some(primitive)).collect();
        let primitives = tree.primitive_indices.iter().filter_map(|&index| primitives[index as usize].take()).collect();
        Self { tree, primitives, center, scale }
    }

    /// The primitives, in the order of [`Meeting::index`].
    pub fn primitives(&self) -> &[P] {
        &self.primitives
    }

    /// The nodes as devices read them, 80 bytes each, the root first: eight children with their boxes in eight bits a side
    /// (Ylitie, Karras and Laine 2017, "Efficient incoherent ray traversal on GPUs through compressed wide BVHs"; minima
    /// and maxima side by side). A leaf's children are [`Self::primitives`], by index.
    pub fn nodes(&self) -> &[u8] {
        bytemuck::cast_slice(&self.tree.nodes)
    }

    /// The nearest of the meetings between two distances that `accept` takes.
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

    /// Visits the meetings between two distances, in any order, until `visit` breaks off: gives the value that it broke
    /// off with.
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

    /// The ray in the tree's units, from where it enters a sphere around everything, and the distance to there; none
    /// where it misses.
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
        // Adding zero turns -0 into 0: the tree takes -0 for a direction that goes down.
        let direction = Vec3A::from(ray.direction.as_vec3()) + Vec3A::ZERO;
        Some((start, obvhs::ray::Ray::new(entry, direction, 0.0, self.shortened(far - start))))
    }

    /// A length in the tree's units, and some more.
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

    /// Rays towards balls, at random and along the axes (with zeros of either sign), from far away and from a hair in
    /// front of them.
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
                // The nearest of those that are accepted.
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

    /// They were padded by more than all that was small, so that rays met all of it.
    #[test]
    fn boxes_are_tight_beside_something_very_large() {
        let mut balls = balls(1000, DVec3::ZERO, 1.0);
        balls.push(Ball { center: DVec3::ZERO, radius: 1e7 });
        let (center, unit) = units([DVec3::splat(-1e7), DVec3::splat(1e7)]);
        let bvh = Bvh::in_units(balls, (center, unit));
        let nodes = bvh.nodes().as_chunks::<80>().0;
        // The exponents of a step of a child's box, of which there are up to 255.
        let side = |node: &[u8; 80]| (12..15).map(|at| 255.0 * f64::from(node[at]).exp2()).fold(0.0, f64::max);
        let small = nodes.iter().filter(|node| side(node) * (-127.0_f64).exp2() * unit < 8.0).count();
        assert!(small + 2 >= nodes.len() && nodes.len() > 100, "{small} of {}", nodes.len());
    }

    /// Their boxes are all alike: to pair but two of them at a time took minutes.
    #[test]
    fn one_thing_may_be_far_from_very_many() {
        let mut balls = balls(60_000, DVec3::ZERO, 1.0);
        balls.push(Ball { center: DVec3::splat(1e10), radius: 0.5 });
        let start = std::time::Instant::now();
        let bvh = Bvh::new(balls);
        assert!(start.elapsed().as_secs() < 20, "{:?}", start.elapsed());
        let ray = Ray { origin: DVec3::splat(-5.0), direction: DVec3::ONE.normalize() };
        let hits = bvh.primitives().iter().filter_map(|ball| Some(ball.meet(&ray)?.0));
        let found = bvh.nearest(&ray, [0.0, 1e11], |_| true).map(|meeting| meeting.distance);
        assert_eq!(found, hits.min_by(f64::total_cmp));
    }
}
