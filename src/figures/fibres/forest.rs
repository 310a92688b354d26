//! Many fibres, and the first of them that a ray meets.

use super::fibre::{Fibre, Hit};
use crate::bvh::{Bvh, Primitive, Ray};
use glam::DVec3;

/// Fibres of one radius in a tree of boxes.
///
/// Boxes around long slanting fibres would be mostly empty, and overlap. So each fibre is in several boxes, each around
/// a piece of it.
#[derive(Clone)]
pub struct Forest {
    fibres: Vec<Fibre>,
    radius: f64,
    tree: Bvh<Piece>,
}

/// The piece of a fibre that one box holds.
#[derive(Clone)]
struct Piece {
    fibre: Fibre,
    radius: f64,
    bounds: [DVec3; 2],
}

impl Primitive for Piece {
    type Place = ();

    fn bounds(&self) -> [DVec3; 2] {
        self.bounds
    }

    fn meet(&self, ray: &Ray) -> Option<(f64, ())> {
        Some((self.fibre.enter(self.radius, ray.origin, ray.direction)?, ()))
    }
}

impl Forest {
    /// The tree of the fibres of `radius`; rays look only for what lies between the corners `domain`. Pieces of fibres
    /// reach as far as `piece` along all axes but one; 1 / sqrt(length per volume), the fibres' mean distance, makes a
    /// fast tree. Panics unless `radius` and `piece` are positive.
    pub fn new(fibres: Vec<Fibre>, radius: f64, domain: [DVec3; 2], piece: f64) -> Self {
        assert!(piece > 0.0, "pieces have an extent: {piece}");
        assert!(radius > 0.0, "fibres have a radius: {radius}");
        let mut parts = Vec::new();
        for fibre in &fibres {
            for piece in pieces(fibre, piece) {
                let [low, high] = fibre.bounds(radius, piece);
                let bounds = [low.max(domain[0]), high.min(domain[1])];
                if bounds[0].cmple(bounds[1]).all() {
                    parts.push(Piece { fibre: *fibre, radius, bounds });
                }
            }
        }
        Self { fibres, radius, tree: Bvh::new(parts) }
    }

    /// All fibres.
    pub fn fibres(&self) -> &[Fibre] {
        &self.fibres
    }

    /// The radius of every fibre.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// How many boxes the tree has.
    pub fn boxes(&self) -> usize {
        self.tree.primitives().len()
    }

    /// The first fibre that a ray from `origin` along the unit vector `direction` enters within `reach`.
    pub fn first(&self, origin: DVec3, direction: DVec3, reach: f64) -> Option<Hit> {
        let ray = Ray { origin, direction };
        let met = self.tree.nearest(&ray, [0.0, reach], |_| true)?;
        let normal = self.tree.primitives()[met.index].fibre.normal(ray.at(met.distance));
        Some(Hit { distance: met.distance, normal })
    }

    /// [`Self::first`] without the tree: in a time that grows with the number of fibres.
    pub fn first_of_all(&self, origin: DVec3, direction: DVec3, reach: f64) -> Option<Hit> {
        let entered = |fibre: &Fibre| Some((fibre.enter(self.radius, origin, direction)?, *fibre));
        let hits = self.fibres.iter().filter_map(entered).filter(|(distance, _)| *distance < reach);
        let (distance, fibre) = hits.min_by(|(one, _), (other, _)| one.total_cmp(other))?;
        Some(Hit { distance, normal: fibre.normal(origin + distance * direction) })
    }
}

/// The heights along its axis between which each piece of a fibre lies: along two of the axes x, y, z, none reaches
/// further than `extent`.
fn pieces(fibre: &Fibre, extent: f64) -> impl Iterator<Item = [f64; 2]> {
    let mut reaches = fibre.axis.abs().to_array();
    reaches.sort_by(f64::total_cmp);
    let length = 2.0 * fibre.half_length;
    let count = (length * reaches[1] / extent).ceil().clamp(1.0, MOST_PIECES);
    let half_length = fibre.half_length;
    (0..count as usize).map(move |k| [k, k + 1].map(|end| length * end as f64 / count - half_length))
}

/// Most pieces of a fibre: more would mean a wrong unit somewhere.
const MOST_PIECES: f64 = 1000.0;
