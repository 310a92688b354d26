//! Patterns of textured emitters, made of what their own triangles show.
//!
//! Where all triangles of a flat part show one image in one place, undistorted but for stretching along its rows and
//! columns, the pattern is that image, texel by texel; where it would have more texels than there is room for, each is
//! the mean of a whole number of them. Any other part is sampled in a rectangle along its longest edge, as its texture is
//! magnified.

use std::sync::Arc;

use glam::{DMat2, DMat4, DVec2, DVec3, Vec3};
use rayon::prelude::*;

use super::emission::{OnTriangle, Surface};
use super::islands::Island;
use super::{Pattern, PatternGrid, PatternImage, Polygon};

/// How far a triangle's corner may lie from where the image shows it, in texels.
const ALIGNED: f64 = 0.02;
/// The cosine between an image's rows and columns up to which they are perpendicular.
const PERPENDICULAR: f64 = 1e-4;
/// The most texels of an image along one side of a part, repetitions counted.
const ALONG_MAX: f64 = 1e6;
/// Points in each cell along each of its sides, where a cell is no single texel.
const POINTS: u32 = 4;
/// The most of them.
const POINTS_MAX: u32 = 8;
/// The fewest cells along the longer side of what is sampled as magnified.
const SAMPLED_MIN: f64 = 64.0;
/// How far outside a triangle a point may lie by rounding, relative to the triangle, or in cells.
const WITHIN: f64 = 1e-9;
/// Values that differ by less, relative to the greatest, are the same.
const EVEN: f64 = 1e-5;

/// What the flat parts of an emitter show.
pub(super) struct Patterns {
    /// One for each part; none where it is as bright as all of them are on average, everywhere.
    pub patterns: Vec<Option<Pattern>>,
    /// The share of the emission that is seen, by channel: the mean over all parts.
    pub mean: DVec3,
}

impl Patterns {
    /// Of parts in the world, with at most `most` cells along a side; none where all of them are even and alike.
    pub fn new(surface: &Surface, world_from_mesh: DMat4, islands: &[Island], most: u32) -> Option<Self> {
        let shown: Vec<Shown> = islands
            .par_iter()
            .filter_map(|island| Shown::new(&Part::new(surface, world_from_mesh, island), most))
            .collect();
        let all = || shown.iter().flat_map(Shown::covered);
        if shown.len() < islands.len() || even(all().map(|(value, _)| value)) {
            return None;
        }
        let (sum, whole) =
            all().fold((DVec3::ZERO, 0.0), |(sum, whole), (value, area)| (sum + area * value, whole + area));
        let mean = sum / whole;
        let patterns = shown.into_iter().map(|shown| shown.pattern(mean)).collect();
        mean.is_finite().then_some(Self { patterns, mean })
    }
}

fn even(values: impl Iterator<Item = DVec3>) -> bool {
    let bounds = (DVec3::INFINITY, DVec3::ZERO);
    let (low, high) = values.fold(bounds, |(low, high), value| (low.min(value), high.max(value)));
    (high - low).cmple(EVEN * high).all()
}

/// A flat part of an emitter.
struct Part<'a> {
    surface: &'a Surface<'a>,
    polygon: &'a Polygon,
    /// In the world, and in the textures.
    triangles: Vec<([DVec3; 3], OnTriangle)>,
}

/// Where a pattern lies, and how it is made.
struct Sheet {
    origin: DVec3,
    axes: [DVec3; 2],
    size: [u32; 2],
    /// Points in each cell along its sides.
    points: u32,
    /// Whether texels are looked up without filtering.
    is_own: bool,
}

impl<'a> Part<'a> {
    fn new(surface: &'a Surface, world_from_mesh: DMat4, island: &'a Island) -> Self {
        let place = |triangle: &u32| {
            let (corners, on) = surface.triangle(*triangle as usize);
            (corners.map(|corner| world_from_mesh.transform_point3(corner)), on)
        };
        Self { surface, polygon: &island.polygon, triangles: island.triangles.iter().map(place).collect() }
    }

    fn outline(&self) -> impl Iterator<Item = DVec3> + '_ {
        self.polygon.contours.iter().flatten().map(|vertex| vertex.as_dvec3())
    }

    fn area(&self) -> f64 {
        self.triangles.iter().map(|([a, b, c], _)| 0.5 * (*b - *a).cross(*c - *a).length()).sum()
    }

    /// The cells of the texture itself, where they lie evenly in the plane.
    fn own_sheet(&self, most: u32) -> Option<Sheet> {
        let size = self.surface.leading_size()?;
        let area = |([a, b, c], _): &&([DVec3; 3], OnTriangle)| (*b - *a).cross(*c - *a).length_squared();
        let ([a, b, c], on) = self.triangles.iter().max_by(|one, other| area(one).total_cmp(&area(other)))?;
        let [start, right, up] = self.surface.leading(on)?;
        let shares = DMat2::from_cols(right - start, up - start).inverse();
        let axes = [shares.x_axis, shares.y_axis].map(|shares| shares.x * (*b - *a) + shares.y * (*c - *a));
        let origin = *a - start.x * axes[0] - start.y * axes[1];
        let texel = [0, 1].map(|axis| axes[axis] / f64::from(size[axis]));
        let lengths = texel.map(DVec3::length);
        let is_near = |(corner, uv): (&DVec3, DVec2)| {
            corner.distance(origin + uv.x * axes[0] + uv.y * axes[1]) <= ALIGNED * lengths[0].min(lengths[1])
        };
        let mut triangles = self.triangles.iter();
        let is_one = triangles
            .all(|(corners, on)| self.surface.leading(on).is_some_and(|uv| corners.iter().zip(uv).all(is_near)));
        if !is_one || (texel[0].dot(texel[1]).abs() > PERPENDICULAR * lengths[0] * lengths[1]) {
            return None;
        }
        let grid = PatternGrid::new(origin, axes, size);
        let (low, high) = bounds(self.outline().map(|vertex| grid.cells(vertex)));
        let (low, high) = ((low + ALIGNED).floor(), (high - ALIGNED).ceil());
        let count = (high - low).max(DVec2::ONE);
        let fits = count.max_element() <= ALONG_MAX;
        if !fits {
            return None;
        }
        let step = (count / f64::from(most)).ceil();
        let cells = (count / step).ceil();
        let axes = [0, 1].map(|axis| cells[axis] * step[axis] * texel[axis]);
        let is_full = (axes[0].cross(axes[1]).length() / self.area() - 1.0).abs() < EVEN;
        let points = step.max_element() as u32 * if is_full && !self.surface.has_both() { 1 } else { POINTS };
        let origin = origin + low.x * texel[0] + low.y * texel[1];
        let size = [cells.x as u32, cells.y as u32];
        Some(Sheet { origin, axes, size, points: points.min(POINTS_MAX), is_own: true })
    }

    /// Cells of about the texture's size in a rectangle along the longest edge.
    fn sampled_sheet(&self, most: u32) -> Option<Sheet> {
        let normal = self.polygon.normal.as_dvec3();
        let edges = self.polygon.contours.iter().flat_map(|contour| {
            let next = contour.iter().cycle().skip(1);
            contour.iter().zip(next).map(|(p, q)| q.as_dvec3() - p.as_dvec3())
        });
        let longest = edges.max_by(|one, other| one.length_squared().total_cmp(&other.length_squared()))?;
        let x = (longest - normal * normal.dot(longest)).try_normalize()?;
        let y = normal.cross(x);
        let start = self.outline().next()?;
        let (low, high) = bounds(self.outline().map(|vertex| DVec2::new(x.dot(vertex - start), y.dot(vertex - start))));
        let extent = high - low;
        let texels: f64 = self.triangles.iter().map(|(_, on)| self.surface.leading_texels(on)).sum();
        let density = (texels / self.area()).sqrt().max(SAMPLED_MIN / extent.max_element());
        let count = (density * extent).ceil().clamp(DVec2::ONE, DVec2::splat(most.into()));
        let size = [count.x as u32, count.y as u32];
        let axes = [extent.x * x, extent.y * y];
        let origin = start + low.x * x + low.y * y;
        (extent.min_element() > 0.0).then_some(Sheet { origin, axes, size, points: POINTS, is_own: false })
    }
}

fn bounds(places: impl Iterator<Item = DVec2>) -> (DVec2, DVec2) {
    let nowhere = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    places.fold(nowhere, |(low, high), place| (low.min(place), high.max(place)))
}

/// What is seen of the emission in each cell of a sheet.
struct Shown {
    origin: Vec3,
    axes: [Vec3; 2],
    size: [u32; 2],
    values: Vec<DVec3>,
    /// The areas of the polygon in the cells that it reaches into.
    areas: Vec<(usize, f64)>,
}

impl Shown {
    fn new(part: &Part, most: u32) -> Option<Self> {
        let sheet = part.own_sheet(most).or_else(|| part.sampled_sheet(most))?;
        let Sheet { origin, axes, size, .. } = sheet;
        let (origin, axes) = (origin.as_vec3(), axes.map(|axis| axis.as_vec3()));
        let grid = PatternGrid::new(origin.as_dvec3(), axes.map(|axis| axis.as_dvec3()), size);
        let areas: Vec<(usize, f64)> = part.polygon.convex_parts().iter().flat_map(|part| grid.areas(part)).collect();
        let values = filled(&means(part, &sheet, &grid), size, &areas);
        let is_sound = axes.iter().all(|axis| axis.is_finite() && *axis != Vec3::ZERO) && origin.is_finite();
        is_sound.then_some(Self { origin, axes, size, values, areas })
    }

    /// The cells of the polygon, with the area of it in each.
    fn covered(&self) -> impl Iterator<Item = (DVec3, f64)> + '_ {
        self.areas.iter().map(|&(cell, area)| (self.values[cell], area))
    }

    fn pattern(self, mean: DVec3) -> Option<Pattern> {
        let factor = |value: DVec3| DVec3::select(mean.cmpgt(DVec3::ZERO), value / mean, DVec3::ONE).as_vec3();
        let values = || self.covered().map(|(value, _)| value);
        let first = values().next()?;
        let (size, texels) = if !even(values()) {
            (self.size, self.values.iter().map(|value| factor(*value)).collect())
        } else if even([first, mean].into_iter()) {
            return None;
        } else {
            ([1, 1], vec![factor(first)])
        };
        Some(Pattern { origin: self.origin, axes: self.axes, image: Arc::new(PatternImage { size, texels }) })
    }
}

/// The mean of what each cell shows, where it shows anything.
fn means(part: &Part, sheet: &Sheet, grid: &PatternGrid) -> Vec<Option<DVec3>> {
    let [columns, rows] = sheet.size;
    let mut sums = vec![(DVec3::ZERO, 0u32); (columns * rows) as usize];
    for (corners, on) in &part.triangles {
        let [a, b, c] = corners.map(|corner| f64::from(sheet.points) * grid.cells(corner));
        let shares = DMat2::from_cols(b - a, c - a).inverse();
        let (low, high) = bounds([a, b, c].into_iter());
        for row in centres(low.y, high.y, rows * sheet.points) {
            let y = f64::from(row) + 0.5;
            // Where the triangle's edges cross the row.
            let crossing = |(p, q): (DVec2, DVec2)| p.x + (q.x - p.x) * ((y - p.y) / (q.y - p.y)).clamp(0.0, 1.0);
            let edges = [(a, b), (b, c), (c, a)].into_iter().filter(|(p, q)| p.y.min(q.y) <= y && p.y.max(q.y) >= y);
            let (left, right) = bounds(edges.map(crossing).map(DVec2::splat));
            let (left, right) = if left.x <= right.x { (left.x, right.x) } else { (low.x, high.x) };
            for column in centres(left, right, columns * sheet.points) {
                let at = shares * (DVec2::new(column.into(), row.into()) + 0.5 - a);
                if at.min_element() >= -WITHIN && at.x + at.y <= 1.0 + WITHIN {
                    let cell = &mut sums[(row / sheet.points * columns + column / sheet.points) as usize];
                    *cell = (cell.0 + part.surface.shown(on, at, sheet.is_own), cell.1 + 1);
                }
            }
        }
    }
    sums.into_iter().map(|(sum, count)| (count > 0).then(|| sum / f64::from(count))).collect()
}

/// The squares of side 1, of so many, whose middles lie between two places, or about so.
fn centres(low: f64, high: f64, count: u32) -> std::ops::Range<u32> {
    (low - 0.5 - WITHIN).ceil().max(0.0) as u32..((high + 0.5 + WITHIN).min(count.into()).max(0.0) as u32)
}

/// Values for all cells: those at the outline in which no point lay have the mean of their neighbours, those off the
/// polygon are black.
fn filled(means: &[Option<DVec3>], [columns, rows]: [u32; 2], areas: &[(usize, f64)]) -> Vec<DVec3> {
    let mut values: Vec<DVec3> = means.iter().map(|mean| mean.unwrap_or_default()).collect();
    for &(cell, _) in areas.iter().filter(|(cell, _)| means[*cell].is_none()) {
        let (column, row) = (cell as u32 % columns, cell as u32 / columns);
        let around = |at: u32, count: u32| at.saturating_sub(1)..(at + 2).min(count);
        let cells = around(row, rows).flat_map(|row| around(column, columns).map(move |column| row * columns + column));
        let near: Vec<DVec3> = cells.filter_map(|cell| means[cell as usize]).collect();
        values[cell] = near.iter().sum::<DVec3>() / near.len().max(1) as f64;
    }
    values
}
