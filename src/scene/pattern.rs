use std::ops::{Add, Mul, Sub};
use std::sync::Arc;

use glam::{DVec2, DVec3, Vec3};

use super::Polygon;

/// How the light of a textured emitter varies over one of its polygons: an image in the polygon's plane.
///
/// Each texel stands for its whole cell: nothing is interpolated, so that the light is that of so many small evenly lit
/// quads. A camera that looks at the emitter sees its texture filtered, which differs by less than a texel's width.
#[derive(Clone, Debug, PartialEq)]
pub struct Pattern {
    /// Where the image's first corner lies in the world, metres.
    pub origin: Vec3,
    /// Along the image's rows and along its columns, from its first corner to its edges' ends, metres: perpendicular to
    /// 0.01%, and of either handedness.
    pub axes: [Vec3; 2],
    /// What it shows.
    pub image: Arc<PatternImage>,
}

/// What a [`Pattern`] shows.
#[derive(Clone, Debug, PartialEq)]
pub struct PatternImage {
    /// Columns and rows, > 0.
    pub size: [u32; 2],
    /// Row by row: factors of the light's radiance, linear and >= 0. Their mean over all polygons of the light, before
    /// other emitters in their planes are cut out of them, is 1 in each channel that is seen. Cells that the polygon
    /// does not reach into are black.
    pub texels: Vec<Vec3>,
}

/// A pattern's grid in a frame of its user's choice.
#[derive(Clone, Copy, Debug)]
pub struct PatternGrid {
    origin: DVec3,
    axes: [DVec3; 2],
    /// Their product with a point gives its place along the axes.
    inverse: [DVec3; 2],
    size: [u32; 2],
}

impl Pattern {
    /// Its grid in the frame to which `place` takes points and, less what it makes of 0, vectors of the world: a turn and
    /// a shift.
    pub fn grid(&self, place: impl Fn(DVec3) -> DVec3) -> PatternGrid {
        let origin = place(self.origin.as_dvec3());
        let axes = self.axes.map(|axis| place(self.origin.as_dvec3() + axis.as_dvec3()) - origin);
        PatternGrid::new(origin, axes, self.image.size)
    }
}

impl PatternGrid {
    pub(super) fn new(origin: DVec3, axes: [DVec3; 2], size: [u32; 2]) -> Self {
        let [u, v] = axes;
        let normal = u.cross(v);
        let inverse = [v.cross(normal), normal.cross(u)].map(|axis| axis / normal.length_squared());
        Self { origin, axes, inverse, size }
    }

    /// The index of the cell in which a point of the plane lies, or of the nearest.
    pub fn cell(&self, point: DVec3) -> usize {
        let place = self.cells(point);
        let index = |axis: usize| (place[axis].max(0.0) as usize).min(self.size[axis] as usize - 1);
        index(1) * self.size[0] as usize + index(0)
    }

    /// The point of a cell at shares of its sides.
    pub fn point(&self, cell: usize, shares: [f64; 2]) -> DVec3 {
        let columns = self.size[0] as usize;
        let at = [(cell % columns) as f64 + shares[0], (cell / columns) as f64 + shares[1]];
        self.origin + (0..2).map(|axis| at[axis] / f64::from(self.size[axis]) * self.axes[axis]).sum::<DVec3>()
    }

    /// The area of a cell.
    pub fn cell_area(&self) -> f64 {
        self.axes[0].cross(self.axes[1]).length() / (f64::from(self.size[0]) * f64::from(self.size[1]))
    }

    /// The cells into which a convex polygon of the plane reaches, each with the area of it that lies there.
    pub fn areas(&self, part: &[DVec3]) -> Vec<(usize, f64)> {
        let flat: Vec<DVec2> = part.iter().map(|vertex| self.cells(*vertex)).collect();
        let cell_area = self.cell_area();
        let mut areas = Vec::new();
        for row in stretch(&flat, 1, self.size[1]) {
            let strip = between(&flat, 1, row);
            for column in stretch(&strip, 0, self.size[0]) {
                let area = area(&between(&strip, 0, column)).abs();
                if area > 0.0 {
                    areas.push(((row * self.size[0] + column) as usize, area * cell_area));
                }
            }
        }
        areas
    }

    /// What of a convex polygon of the plane lies in the cells from `low` on and before `high`, by column and row. What is beside
    /// the image is in its outermost cells.
    pub fn clipped(&self, part: &[DVec3], low: [u32; 2], high: [u32; 2]) -> Vec<DVec3> {
        let mut kept = part.to_vec();
        for axis in 0..2 {
            if low[axis] > 0 {
                kept = cut(&kept, |point| self.cells(point)[axis] - f64::from(low[axis]));
            }
            if high[axis] < self.size[axis] {
                kept = cut(&kept, |point| f64::from(high[axis]) - self.cells(point)[axis]);
            }
        }
        kept
    }

    /// A point's place, where cells have sides of 1.
    pub(super) fn cells(&self, point: DVec3) -> DVec2 {
        let arm = point - self.origin;
        let [x, y] = self.inverse.map(|inverse| inverse.dot(arm));
        DVec2::new(x * f64::from(self.size[0]), y * f64::from(self.size[1]))
    }
}

impl Polygon {
    /// The factor of its light's radiance at a point of its plane.
    pub fn factor(&self, point: DVec3) -> DVec3 {
        let of = |pattern: &Pattern| pattern.image.texels[pattern.grid(|point| point).cell(point)].as_dvec3();
        self.pattern.as_ref().map_or(DVec3::ONE, of)
    }
}

/// The rows, or columns, into which an outline reaches.
fn stretch(flat: &[DVec2], axis: usize, count: u32) -> std::ops::Range<u32> {
    let places = || flat.iter().map(|at| at[axis]);
    let (low, high) = (places().fold(f64::INFINITY, f64::min), places().fold(0.0, f64::max));
    (low.max(0.0) as u32)..(high.ceil().min(f64::from(count)) as u32)
}

/// What of a convex outline lies in a row, or a column.
fn between(flat: &[DVec2], axis: usize, index: u32) -> Vec<DVec2> {
    let above = cut(flat, |at| at[axis] - f64::from(index));
    cut(&above, |at| f64::from(index) + 1.0 - at[axis])
}

/// The part of a convex outline with heights of 0 and more, which are linear.
fn cut<P>(outline: &[P], height: impl Fn(P) -> f64) -> Vec<P>
where
    P: Copy + Add<Output = P> + Sub<Output = P> + Mul<f64, Output = P>,
{
    let mut kept = Vec::with_capacity(outline.len() + 1);
    for (&p, &q) in outline.iter().zip(outline.iter().cycle().skip(1)) {
        let [start, end] = [p, q].map(&height);
        if start >= 0.0 {
            kept.push(p);
        }
        if (start < 0.0) != (end < 0.0) {
            kept.push(p + (q - p) * (start / (start - end)));
        }
    }
    kept
}

fn area(flat: &[DVec2]) -> f64 {
    let next = flat.iter().cycle().skip(1);
    flat.iter().zip(next).map(|(p, q)| 0.5 * (*p - flat[0]).perp_dot(*q - flat[0])).sum()
}
