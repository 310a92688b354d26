//! Many fibres, and the first of them that a ray meets.

use super::fibre::{Fibre, Hit};
use glam::{DVec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::cwbvh::{CwBvh, builder::build_cwbvh};
use obvhs::ray::{Ray, RayHit};
use obvhs::{BvhBuildParams, ploc::PlocSearchDistance};
use std::time::Duration;

/// Fibres of one radius in a tree of boxes.
///
/// Boxes around long slanting fibres would be mostly empty, and overlap: each fibre stands in several, of pieces of it.
/// The tree has eight boxes a node: twice as fast here as one of two. It is one of f32; boxes are wide enough for its round-off, and a fibre is met in f64.
#[derive(Clone)]
pub struct Forest {
    fibres: Vec<Fibre>,
    radius: f64,
    tree: CwBvh,
    /// The fibre in each place of the tree's leaves.
    leaves: Vec<u32>,
}

/// Boxes are widened by this share of the largest coordinate: several units in the last place of an f32, for the rounding of boxes, of rays and of
/// the tests between them.
const ROUND_OFF: f64 = 1e-6;

const BUILD: BvhBuildParams = BvhBuildParams {
    ploc_search_distance: PlocSearchDistance::Low,
    max_prims_per_leaf: 3,
    ..BvhBuildParams::fast_build()
};

impl Forest {
    /// The tree of the fibres of `radius`, of which only what lies between the corners `domain` is sought. Pieces reach as far as `piece`, along all
    /// axes but one; 1 / sqrt(length per volume), the fibres' mean distance, makes a fast tree.
    pub fn new(fibres: Vec<Fibre>, radius: f64, domain: [DVec3; 2], piece: f64) -> Self {
        assert!(piece > 0.0, "pieces have an extent: {piece}");
        assert!(radius > 0.0, "fibres have a radius: {radius}");
        assert!(u32::try_from(fibres.len()).is_ok(), "a fibre has a number of 32 bits: {}", fibres.len());
        let largest = domain[0].abs().max(domain[1].abs()).max_element();
        let pad = DVec3::splat(ROUND_OFF * largest);
        let (mut boxes, mut owners) = (Vec::new(), Vec::new());
        for (index, fibre) in fibres.iter().enumerate() {
            for piece in pieces(fibre, piece) {
                let [low, high] = fibre.bounds(radius, piece);
                let (low, high) = (low.max(domain[0]), high.min(domain[1]));
                if low.cmple(high).all() {
                    let [min, max] = [low - pad, high + pad].map(|corner| Vec3A::from(corner.as_vec3()));
                    boxes.push(Aabb { min, max });
                    owners.push(index as u32);
                }
            }
        }
        let tree = build_cwbvh(&boxes, BUILD, &mut Duration::default());
        let leaves = tree.primitive_indices.iter().map(|place| owners[*place as usize]).collect();
        Self { fibres, radius, tree, leaves }
    }

    pub fn fibres(&self) -> &[Fibre] {
        &self.fibres
    }

    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The boxes in the tree.
    pub fn boxes(&self) -> usize {
        self.leaves.len()
    }

    /// The first fibre that a ray from `origin` along the unit vector `direction` enters within `reach`.
    pub fn first(&self, origin: DVec3, direction: DVec3, reach: f64) -> Option<Hit> {
        let (mut distance, mut fibre) = (reach, None);
        // The tree takes -0 for a direction of one sign in one place, and of the other elsewhere: with 0 added there is none.
        let [from, to] = [origin, direction].map(|vector| Vec3A::from(vector.as_vec3()) + Vec3A::ZERO);
        let ray = Ray::new(from, to, 0.0, above(reach));
        self.tree.ray_traverse(ray, &mut RayHit::none(), |_, place| {
            let candidate = &self.fibres[self.leaves[place] as usize];
            if let Some(entered) = candidate.enter(self.radius, origin, direction)
                && entered < distance
            {
                (distance, fibre) = (entered, Some(candidate));
            }
            above(distance)
        });
        fibre.map(|fibre| Hit { distance, normal: fibre.normal(origin + distance * direction) })
    }

    /// [`Self::first`] without the tree: in a time that grows with the number of fibres.
    pub fn first_of_all(&self, origin: DVec3, direction: DVec3, reach: f64) -> Option<Hit> {
        let entered = |fibre: &Fibre| Some((fibre.enter(self.radius, origin, direction)?, *fibre));
        let hits = self.fibres.iter().filter_map(entered).filter(|(distance, _)| *distance < reach);
        let (distance, fibre) = hits.min_by(|(one, _), (other, _)| one.total_cmp(other))?;
        Some(Hit { distance, normal: fibre.normal(origin + distance * direction) })
    }
}

/// A distance in f32 that no fibre at it is beyond.
fn above(distance: f64) -> f32 {
    (distance as f32 * (1.0 + 4.0 * f32::EPSILON)).next_up()
}

/// Heights along the axis between which the pieces of a fibre lie: none reaches further than `extent` along two axes.
fn pieces(fibre: &Fibre, extent: f64) -> impl Iterator<Item = [f64; 2]> {
    let mut reaches = fibre.axis.abs().to_array();
    reaches.sort_by(f64::total_cmp);
    let length = 2.0 * fibre.half_length;
    let count = (length * reaches[1] / extent).ceil().clamp(1.0, MOST_PIECES);
    let half_length = fibre.half_length;
    (0..count as usize).map(move |k| [k, k + 1].map(|end| length * end as f64 / count - half_length))
}

/// More pieces than this would be a wrong unit somewhere.
const MOST_PIECES: f64 = 1000.0;
