//! Emitters of very many flat parts, lit by fewer: neighbouring triangles are merged into parts that are nearly flat.
//!
//! Two parts whose areas along their normals are the vectors A and B become one of A + B, and light in all directions
//! that see both of them is kept: the flux towards a direction is the sum of areas along normals times that direction.
//! What is lost of the area is |A| + |B| - |A + B|, and the pair that loses least is merged first (as in the face
//! hierarchies of Garland, Willmott and Heckbert 2001, with the loss as their error). Each part is then drawn as a
//! polygon in its mean plane, scaled about its middle so that it has the area of its triangles: the radiant power is
//! kept, and so is the radiance.

use std::cmp::Ordering;
use std::collections::{BTreeSet, BinaryHeap};

use glam::{DVec3, Vec3};

use super::Polygon;
use super::islands::Placed;
use super::outline::contours;

/// How near the outline of a part stays to that of its triangles, relative to its size.
const OUTLINE_TOLERANCE: f64 = 0.12;
/// Only parts are merged whose normals are less than 60 degrees apart.
const FACING_COSINE: f64 = 0.5;

/// The triangles of a placed mesh as at most `limit` nearly flat parts; more where there are more that do not touch, or
/// whose neighbours all face elsewhere.
pub(super) fn polygons(placed: &Placed, limit: usize) -> Vec<Polygon> {
    merged(placed, limit).iter().filter_map(|part| polygon(placed, part)).collect()
}

/// Two neighbours that may be merged.
#[derive(PartialEq)]
struct Pair {
    loss: f64,
    parts: [usize; 2],
    /// Of both together as this pair saw them: what has been merged since is another part.
    area: DVec3,
}

impl Eq for Pair {}

impl PartialOrd for Pair {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Pair {
    /// What loses least is the greatest.
    fn cmp(&self, other: &Self) -> Ordering {
        other.loss.total_cmp(&self.loss).then(other.parts.cmp(&self.parts))
    }
}

/// Parts on their way: each triangle is one at first.
struct Parts {
    /// Areas along their normals.
    areas: Vec<DVec3>,
    neighbours: Vec<BTreeSet<usize>>,
    triangles: Vec<Vec<u32>>,
}

impl Parts {
    fn pair(&self, one: usize, other: usize) -> Option<Pair> {
        let [a, b] = [one, other].map(|part| self.areas[part]);
        let (lengths, area) = ([a.length(), b.length()], a + b);
        let is_facing = a.dot(b) > FACING_COSINE * lengths[0] * lengths[1];
        let parts = [one.min(other), one.max(other)];
        is_facing.then(|| Pair { loss: lengths[0] + lengths[1] - area.length(), parts, area })
    }

    /// Whether neither of a pair has been merged since.
    fn is_current(&self, pair: &Pair) -> bool {
        let [one, other] = pair.parts;
        self.areas[one] + self.areas[other] == pair.area && self.neighbours[one].contains(&other)
    }

    /// Adds the part `other` to `one`.
    fn merge(&mut self, one: usize, other: usize) {
        let triangles = std::mem::take(&mut self.triangles[other]);
        self.triangles[one].extend(triangles);
        let area = std::mem::take(&mut self.areas[other]);
        self.areas[one] += area;
        for neighbour in std::mem::take(&mut self.neighbours[other]) {
            self.neighbours[neighbour].remove(&other);
            if neighbour != one {
                self.neighbours[neighbour].insert(one);
                self.neighbours[one].insert(neighbour);
            }
        }
    }
}

/// The triangles of each part.
fn merged(placed: &Placed, limit: usize) -> Vec<Vec<u32>> {
    let count = placed.triangles.len();
    let mut parts = Parts {
        areas: placed.faces.iter().map(|face| face.area).collect(),
        neighbours: (0..count as u32)
            .map(|triangle| placed.topology.neighbours(triangle).iter().map(|&other| other as usize).collect())
            .collect(),
        triangles: (0..count as u32).map(|triangle| vec![triangle]).collect(),
    };
    let later = |one: usize, parts: &Parts| -> Vec<Pair> {
        parts.neighbours[one].range(one + 1..).filter_map(|&other| parts.pair(one, other)).collect()
    };
    let mut pairs: BinaryHeap<Pair> = (0..count).flat_map(|one| later(one, &parts)).collect();
    let mut left = count;
    while let Some(pair) = pairs.pop().filter(|_| left > limit) {
        if !parts.is_current(&pair) {
            continue;
        }
        // The smaller of the two lists is moved.
        let [mut one, mut other] = pair.parts;
        if parts.triangles[one].len() + parts.neighbours[one].len()
            < parts.triangles[other].len() + parts.neighbours[other].len()
        {
            std::mem::swap(&mut one, &mut other);
        }
        parts.merge(one, other);
        left -= 1;
        pairs.extend(parts.neighbours[one].iter().filter_map(|&neighbour| parts.pair(one, neighbour)));
    }
    parts.triangles.into_iter().filter(|part| !part.is_empty()).collect()
}

/// A part in its mean plane; `None` where it has no area.
fn polygon(placed: &Placed, part: &[u32]) -> Option<Polygon> {
    let faces = || part.iter().map(|&triangle| &placed.faces[triangle as usize]);
    let whole: f64 = faces().map(|face| face.area.length()).sum();
    let vector: DVec3 = faces().map(|face| face.area).sum();
    let normal = vector.try_normalize()?;
    let corners = |triangle: u32| placed.triangles[triangle as usize].map(|corner| placed.positions[corner as usize]);
    let center: DVec3 = part
        .iter()
        .map(|&triangle| {
            placed.faces[triangle as usize].area.length() / whole * corners(triangle).iter().sum::<DVec3>() / 3.0
        })
        .sum();
    let triangles = || part.iter().map(|&triangle| placed.triangles[triangle as usize]);
    let of_tolerance = |tolerance: f64| contours(triangles(), &placed.positions, normal, tolerance);
    let square = || {
        let (x, y) = normal.any_orthonormal_pair();
        vec![[-x - y, x - y, x + y, y - x].map(|corner| (center + corner).as_vec3()).to_vec()]
    };
    // Where little is left of a coarse outline, a finer one has to do, and at last a square.
    let fits = |contours: &Vec<Vec<Vec3>>| (0.7..1.4).contains(&(area(contours, normal) / vector.length()));
    let contours = [OUTLINE_TOLERANCE, 0.0].map(of_tolerance).into_iter().find(fits).unwrap_or_else(square);
    let scale = (whole / area(&contours, normal)).sqrt();
    let place = |vertex: Vec3| {
        let arm = vertex.as_dvec3() - center;
        (center + scale * (arm - normal * normal.dot(arm))).as_vec3()
    };
    let contours = contours.into_iter().map(|contour| contour.into_iter().map(place).collect()).collect();
    Some(Polygon { contours, normal: normal.as_vec3(), pattern: None })
}

/// What contours enclose in the plane of unit `normal`.
fn area(contours: &[Vec<Vec3>], normal: DVec3) -> f64 {
    let of_contour = |contour: &Vec<Vec3>| {
        let origin = contour[0].as_dvec3();
        let next = contour.iter().cycle().skip(1);
        let crossed = contour.iter().zip(next).map(|(p, q)| (p.as_dvec3() - origin).cross(q.as_dvec3() - origin));
        0.5 * crossed.sum::<DVec3>()
    };
    contours.iter().map(of_contour).sum::<DVec3>().dot(normal)
}
