//! A triangle as the view sees it: a convex polygon in the picture, and how near it is at each of its points.

use std::ops::Range;

use glam::{DMat3, DMat4, DVec2, DVec3, DVec4, Vec4Swizzles};
use rayon::prelude::*;

use super::{Painted, PlacedMesh};
use crate::renderer::view::View;

/// What is narrower in the picture than this share of half its side counts as nothing: a ten thousandth of a pixel
/// where there are 2000.
pub const NARROWEST: f64 = 1e-7;

/// How far vertices are off, in parts of their coordinates: four roundings to 32 bits.
const ROUNDING: f64 = 4.0 * (f32::EPSILON as f64) / 2.0;

/// What is left of a triangle in front of the near plane, projected into the picture, which is the square from -1 to 1.
#[derive(Clone, Debug)]
pub struct Polygon {
    /// Counter-clockwise: the first `count` of them, and the first one again.
    corners: [DVec2; 5],
    count: usize,
    /// The nearness at (x, y) is `plane . (x, y, 1)`. It grows towards the eye: the reciprocal of the depth along the
    /// view or, in an orthographic view, depth as it is stored.
    plane: DVec3,
    /// The least and the greatest nearness.
    pub range: [f64; 2],
    /// That of the mean of its corners in space.
    pub middle: f64,
    /// What rounding of the vertices can make of nearness.
    pub slack: f64,
    /// Twice the area in the picture.
    pub area: f64,
    /// Where it is from.
    pub source: Painted,
}

impl Polygon {
    pub fn corners(&self) -> &[DVec2] {
        &self.corners[..self.count]
    }

    /// From where to where each side runs.
    pub fn sides(&self) -> impl Iterator<Item = [DVec2; 2]> + '_ {
        self.corners[..=self.count].array_windows().copied()
    }

    /// The nearness of its plane at a point of the picture.
    pub fn nearness(&self, point: DVec2) -> f64 {
        self.plane.dot(point.extend(1.0))
    }

    /// The smallest box around what the picture shows of it: the least and greatest x and y.
    pub fn bounds(&self) -> [DVec2; 2] {
        let [min, max] = bounds(self.corners());
        [min.max(DVec2::NEG_ONE), max.min(DVec2::ONE)]
    }
}

fn bounds(corners: &[DVec2]) -> [DVec2; 2] {
    let widen = |[min, max]: [DVec2; 2], corner: &DVec2| [min.min(*corner), max.max(*corner)];
    corners.iter().fold([DVec2::INFINITY, DVec2::NEG_INFINITY], widen)
}

/// Takes what is in the world to polygons.
pub struct Projector {
    /// To x, y and nearness in the picture, all times w, and w.
    picture_from_world: DMat4,
    /// A point p is beyond the near plane where this . (p, 1) is positive.
    near: DVec4,
}

impl Projector {
    pub fn new(view: &View) -> Self {
        let clip_from_world = view.clip_from_world.as_dmat4();
        let [x, y, z, w] = [0, 1, 2, 3].map(|row| clip_from_world.row(row));
        let nearness = if view.eye.w == 0.0 { z } else { DVec4::W };
        Self { picture_from_world: DMat4::from_cols(x, y, nearness, w).transpose(), near: w - z }
    }

    /// The triangles of the mesh of this index that the view shows, in order.
    pub fn polygons<'a>(&'a self, index: u32, mesh: &'a PlacedMesh) -> impl ParallelIterator<Item = Polygon> + 'a {
        let world_from_mesh = mesh.world_from_mesh.as_dmat4();
        let mirrors = DMat3::from_mat4(world_from_mesh).determinant() < 0.0;
        let polygon = move |(triangle, corners): (usize, &[u32; 3])| {
            let corners = corners.map(|corner| mesh.positions[corner as usize].as_dvec3());
            let source = Painted { mesh: index, triangle: triangle as u32 };
            self.polygon(corners.map(|corner| world_from_mesh.transform_point3(corner)), source)
                .filter(|(_, is_counter_clockwise)| mesh.double_sided || *is_counter_clockwise != mirrors)
                .map(|(polygon, _)| polygon)
        };
        mesh.triangles.par_iter().enumerate().filter_map(polygon)
    }

    /// The polygon of a triangle, and whether it is seen counter-clockwise; none where nothing of it is in sight.
    fn polygon(&self, triangle: [DVec3; 3], source: Painted) -> Option<(Polygon, bool)> {
        let points = triangle.map(|corner| self.picture_from_world * corner.extend(1.0));
        let [a, b, c] = points.map(|point| point.xyw());
        let determinant = a.dot(b.cross(c));
        let plane = (points[0].z * b.cross(c) + points[1].z * c.cross(a) + points[2].z * a.cross(b)) / determinant;
        let (mut kept, count) = beyond(triangle.map(|corner| self.near.dot(corner.extend(1.0))), points);
        if determinant < 0.0 {
            kept[..count].reverse();
        }
        let mut corners = [DVec2::ZERO; 5];
        kept[..count].iter().zip(&mut corners).for_each(|(point, corner)| *corner = point.xy() / point.w);
        corners[count] = corners[0];
        let [min, max] = bounds(&corners[..count]);
        let is_seen = min.cmplt(DVec2::ONE).all() && max.cmpgt(DVec2::NEG_ONE).all();
        let area = area(&corners[..count]);
        let is_edge_on = !plane.is_finite() || !area.is_finite() || area <= NARROWEST * NARROWEST;
        if !is_seen || is_edge_on {
            return None;
        }
        let nearnesses = kept[..count].iter().map(|point| point.z / point.w);
        let range =
            nearnesses.fold([f64::INFINITY, f64::NEG_INFINITY], |[min, max], near| [min.min(near), max.max(near)]);
        let sum: DVec4 = kept[..count].iter().sum();
        let slack = self.slack(triangle, range);
        let polygon = Polygon { corners, count, plane, range, middle: sum.z / sum.w, slack, area, source };
        Some((polygon, determinant > 0.0))
    }

    /// The nearness by which the rounding of its corners' coordinates can move a triangle.
    fn slack(&self, triangle: [DVec3; 3], [far, near]: [f64; 2]) -> f64 {
        let is_orthographic = self.picture_from_world.row(2) != DVec4::W;
        let along = if is_orthographic { self.picture_from_world.row(2) } else { self.picture_from_world.row(3) };
        let moves = triangle.map(|corner| along.truncate().abs().dot(corner.abs()));
        // The derivative of 1/w is 1/w^2.
        ROUNDING * moves.into_iter().fold(0.0, f64::max) * if is_orthographic { 1.0 } else { far * near }
    }
}

/// The part of a triangle where the heights of its corners are positive, and how many corners it has.
fn beyond(heights: [f64; 3], points: [DVec4; 3]) -> ([DVec4; 4], usize) {
    let mut kept = [DVec4::W; 4];
    let mut count = 0;
    let mut keep = |point: DVec4| {
        kept[count] = point;
        count += 1;
    };
    for (from, to) in [(0, 1), (1, 2), (2, 0)] {
        if heights[from] >= 0.0 {
            keep(points[from]);
        }
        if (heights[from] >= 0.0) != (heights[to] >= 0.0) {
            // From the same end for both triangles at an edge, so that they keep the same corner.
            let (inside, outside) = if heights[from] >= 0.0 { (from, to) } else { (to, from) };
            let share = heights[inside] / (heights[inside] - heights[outside]);
            keep(points[inside] + share * (points[outside] - points[inside]));
        }
    }
    (kept, count)
}

/// Twice the area of a polygon that runs counter-clockwise.
fn area(corners: &[DVec2]) -> f64 {
    let fan: Range<usize> = 1..corners.len().max(2) - 1;
    fan.map(|index| (corners[index] - corners[0]).perp_dot(corners[index + 1] - corners[0])).sum()
}
