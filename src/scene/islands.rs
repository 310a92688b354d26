//! Planar islands: the flat parts of a mesh, each of which lights as one polygon.
//!
//! Positions within 1e-6 of the mesh's size are welded, triangles thinner than that are left out, and two triangles are
//! neighbours where they share a whole edge, run through in opposite directions. (A vertex in the middle of a
//! neighbour's edge, a T-junction, parts them; their polygons then light as much as one would.)
//! An island is connected, faces one way, and is planar to 1e-3 of its size.

use std::collections::HashMap;

use glam::{DAffine3, DVec3, Vec3};

use super::outline::outline;
use super::{Bounds, Instance, Mesh, Polygon};

/// Relative to the diagonal of the mesh's bounding box.
const WELD_TOLERANCE: f64 = 1e-6;
/// Half the thickness of an island, relative to the diagonal of its bounding box.
const PLANE_TOLERANCE: f64 = 1e-3;
/// Cosines of the sharpest edges (30 and 3 degrees) within parts that are looked at as a whole, one after the other.
/// The sharper lets flat parts be uneven within the tolerance, the blunter tells them from the rounded rims around them.
const SMOOTH_COSINES: [f64; 2] = [0.866, 0.9986];
/// Edges with more triangles than this join none: where honest meshes have two, hostile ones have a million.
const EDGE_USES_MAX: usize = 8;

/// How a mesh's triangles hang together, in whatever place it stands.
pub(super) struct Topology {
    /// Triangles of welded vertices, thin ones left out.
    triangles: Vec<[u32; 3]>,
    /// The neighbours of triangle `i` are `neighbours[starts[i]..starts[i + 1]]`.
    starts: Vec<usize>,
    neighbours: Vec<u32>,
}

/// A triangle's place in the world.
struct Face {
    /// The area along the normal.
    area: DVec3,
    normal: DVec3,
}

impl Topology {
    pub fn new(mesh: &Mesh) -> Self {
        let tolerance = WELD_TOLERANCE * Bounds::of_points(&mesh.positions).diagonal();
        let welded = weld(&mesh.positions, tolerance);
        let triangles = mesh.indices.chunks_exact(3).map(|corners| [0, 1, 2].map(|i| welded[corners[i] as usize]));
        let is_wide = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|corner| mesh.positions[corner as usize].as_dvec3());
            let longest = (b - a).length().max((c - b).length()).max((a - c).length());
            (b - a).cross(c - a).length() > tolerance * longest
        };
        let triangles: Vec<[u32; 3]> = triangles.filter(is_wide).collect();
        let (starts, neighbours) = adjacency(&triangles);
        Self { triangles, starts, neighbours }
    }

    /// The islands of the mesh as `instance` places it, counter-clockwise seen from the front. None where there are
    /// more than `limit`.
    pub fn polygons(&self, mesh: &Mesh, instance: &Instance, limit: usize) -> Option<Vec<Polygon>> {
        let world_from_mesh = DAffine3::from_mat4(instance.world_from_mesh.as_dmat4());
        let positions = mesh.positions.iter().map(|position| world_from_mesh.transform_point3(position.as_dvec3()));
        let positions: Vec<DVec3> = positions.collect();
        let mirrored = world_from_mesh.matrix3.determinant() < 0.0;
        let turned = |&[a, b, c]: &[u32; 3]| if mirrored { [a, c, b] } else { [a, b, c] };
        let triangles: Vec<[u32; 3]> = self.triangles.iter().map(turned).collect();
        let faces = triangles.iter().map(|&corners| {
            let [a, b, c] = corners.map(|corner| positions[corner as usize]);
            let area = 0.5 * (b - a).cross(c - a);
            Face { area, normal: area.normalize_or_zero() }
        });
        let faces: Vec<Face> = faces.collect();
        Placed { topology: self, positions, triangles, faces }.polygons(limit)
    }

    fn neighbours(&self, triangle: u32) -> &[u32] {
        let triangle = triangle as usize;
        &self.neighbours[self.starts[triangle]..self.starts[triangle + 1]]
    }
}

/// For each vertex the first one at its place, to `tolerance`.
fn weld(positions: &[Vec3], tolerance: f64) -> Vec<u32> {
    let mut cells = Cells::new(positions, tolerance);
    // Most vertices that meet are equal to the bit: these need no search. Adding zero makes -0 and 0 one.
    let key = |position: &Vec3| (*position + Vec3::ZERO).to_array().map(f32::to_bits);
    let mut same = HashMap::with_capacity(positions.len());
    let first = |(index, position)| *same.entry(key(position)).or_insert_with(|| cells.find_or_insert(index as u32));
    positions.iter().enumerate().map(first).collect()
}

/// Vertices in cells of space, further apart than the tolerance.
struct Cells<'a> {
    positions: &'a [Vec3],
    tolerance: f64,
    origin: DVec3,
    /// The last vertex put into each cell, and for each vertex the one before it.
    last: HashMap<[u32; 3], u32>,
    previous: Vec<Option<u32>>,
}

impl<'a> Cells<'a> {
    /// In tolerances: wide enough for most vertices to be near one cell only, narrow enough to hold few.
    const WIDTH: f64 = 8.0;

    fn new(positions: &'a [Vec3], tolerance: f64) -> Self {
        let origin = Bounds::of_points(positions).min.as_dvec3();
        Self { positions, tolerance, origin, last: HashMap::new(), previous: vec![None; positions.len()] }
    }

    /// A vertex within the tolerance of this one, or itself, put into its cell.
    fn find_or_insert(&mut self, index: u32) -> u32 {
        let point = self.positions[index as usize].as_dvec3();
        let (low, high) = (self.cell(point - self.tolerance), self.cell(point + self.tolerance));
        for corner in 0..8 {
            let is_high = [corner & 1 != 0, corner & 2 != 0, corner & 4 != 0];
            if (0..3).any(|axis| is_high[axis] && low[axis] == high[axis]) {
                continue;
            }
            let cell = [0, 1, 2].map(|axis| if is_high[axis] { high[axis] } else { low[axis] });
            let mut other = self.last.get(&cell).copied();
            while let Some(vertex) = other {
                if self.positions[vertex as usize].as_dvec3().distance(point) <= self.tolerance {
                    return vertex;
                }
                other = self.previous[vertex as usize];
            }
        }
        self.previous[index as usize] = self.last.insert(self.cell(point), index);
        index
    }

    /// The counts fit: the tolerance is a millionth of the whole.
    fn cell(&self, point: DVec3) -> [u32; 3] {
        let width = (Self::WIDTH * self.tolerance).max(f64::MIN_POSITIVE);
        ((point - self.origin) / width).to_array().map(|index| index as u32)
    }
}

/// Neighbours of triangles, as `Topology` holds them.
fn adjacency(triangles: &[[u32; 3]]) -> (Vec<usize>, Vec<u32>) {
    // Every use of an edge: its ends in order, whether it is run through in that order, and by which triangle.
    let mut uses = Vec::with_capacity(3 * triangles.len());
    for (triangle, &[a, b, c]) in triangles.iter().enumerate() {
        uses.extend(
            [(a, b), (b, c), (c, a)].map(|(from, to)| (from.min(to), from.max(to), from < to, triangle as u32)),
        );
    }
    uses.sort_unstable();
    let mut pairs = Vec::with_capacity(uses.len());
    for edge in uses.chunk_by(|left, right| (left.0, left.1) == (right.0, right.1)) {
        if edge.len() > EDGE_USES_MAX {
            continue;
        }
        let (backward, forward) = edge.split_at(edge.partition_point(|(_, _, forward, _)| !forward));
        for (.., left) in backward {
            pairs.extend(forward.iter().flat_map(|(.., right)| [(*left, *right), (*right, *left)]));
        }
    }
    pairs.sort_unstable();
    let starts = (0..=triangles.len()).map(|triangle| pairs.partition_point(|&(left, _)| (left as usize) < triangle));
    (starts.collect(), pairs.into_iter().map(|(_, right)| right).collect())
}

/// A mesh in the world, about to be taken apart.
struct Placed<'a> {
    topology: &'a Topology,
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    faces: Vec<Face>,
}

/// Islands found so far.
struct Found {
    islands: Vec<Vec<u32>>,
    limit: usize,
    /// Triangles that are in no island yet and may be joined to one.
    open: Vec<bool>,
}

impl Found {
    /// None where that is one too many.
    fn push(&mut self, island: Vec<u32>) -> Option<()> {
        self.islands.push(island);
        (self.islands.len() <= self.limit).then_some(())
    }
}

impl Placed<'_> {
    fn polygons(&self, limit: usize) -> Option<Vec<Polygon>> {
        let all: Vec<u32> = (0..self.triangles.len() as u32).collect();
        let mut found = Found { islands: Vec::new(), limit, open: vec![true; all.len()] };
        self.divide(all, &SMOOTH_COSINES, &mut found)?;
        Some(found.islands.iter().filter_map(|island| self.polygon(island)).collect())
    }

    /// Finds the islands in a part, all of which is open: what hangs together smoothly, to the first of the cosines, and
    /// is planar as a whole; else by the next; else what grows from the largest triangle that is left.
    fn divide(&self, mut part: Vec<u32>, smooth_cosines: &[f64], found: &mut Found) -> Option<()> {
        let Some((&smooth, finer)) = smooth_cosines.split_first() else {
            let area = |triangle: u32| self.faces[triangle as usize].area.length_squared();
            part.sort_by(|&left, &right| area(right).total_cmp(&area(left)).then(left.cmp(&right)));
            for seed in part {
                if found.open[seed as usize] {
                    let island = self.grow_plane(seed, &mut found.open);
                    found.push(island)?;
                }
            }
            return Some(());
        };
        for seed in part {
            if !found.open[seed as usize] {
                continue;
            }
            let grown = self.grow(seed, &mut found.open, |from, to| self.cosine(from, to) > smooth);
            if self.is_planar(&grown) {
                found.push(grown)?;
            } else {
                grown.iter().for_each(|&triangle| found.open[triangle as usize] = true);
                self.divide(grown, finer, found)?;
            }
        }
        Some(())
    }

    fn cosine(&self, left: u32, right: u32) -> f64 {
        self.faces[left as usize].normal.dot(self.faces[right as usize].normal)
    }

    /// Takes the open triangles that hang together with `seed` through pairs that `joins`.
    fn grow(&self, seed: u32, open: &mut [bool], mut joins: impl FnMut(u32, u32) -> bool) -> Vec<u32> {
        open[seed as usize] = false;
        let mut grown = vec![seed];
        let mut next = 0;
        while let Some(&triangle) = grown.get(next) {
            next += 1;
            for &other in self.topology.neighbours(triangle) {
                if open[other as usize] && joins(triangle, other) {
                    open[other as usize] = false;
                    grown.push(other);
                }
            }
        }
        grown
    }

    /// Grows through triangles that lie in the plane of `seed`, to the tolerance of what has grown so far.
    fn grow_plane(&self, seed: u32, open: &mut [bool]) -> Vec<u32> {
        let normal = self.faces[seed as usize].normal;
        let origin = self.positions[self.triangles[seed as usize][0] as usize];
        let mut bounds = Extent::new(self.corners(seed));
        self.grow(seed, open, |_, triangle| {
            let grown = self.corners(triangle).into_iter().fold(bounds, Extent::with);
            let tolerance = PLANE_TOLERANCE * grown.diagonal();
            let in_plane = |corner: DVec3| normal.dot(corner - origin).abs() <= tolerance;
            let faces_on = self.cosine(seed, triangle) > SMOOTH_COSINES[0];
            let joins = faces_on && self.corners(triangle).into_iter().all(in_plane);
            if joins {
                bounds = grown;
            }
            joins
        })
    }

    /// Whether all corners lie within the tolerance of one plane, whose normal is the area-weighted mean.
    fn is_planar(&self, island: &[u32]) -> bool {
        let normal = self.normal(island);
        let corners = || island.iter().flat_map(|&triangle| self.corners(triangle));
        let Some(origin) = corners().next() else { return true };
        let heights = corners().map(|corner| normal.dot(corner - origin));
        let (low, high) = heights.fold((0.0f64, 0.0f64), |(low, high), height| (low.min(height), high.max(height)));
        let size = corners().fold(Extent::new([origin]), Extent::with).diagonal();
        let faces_on = island.iter().all(|&triangle| self.faces[triangle as usize].normal.dot(normal) > 0.0);
        faces_on && high - low <= 2.0 * PLANE_TOLERANCE * size
    }

    fn normal(&self, island: &[u32]) -> DVec3 {
        island.iter().map(|&triangle| self.faces[triangle as usize].area).sum::<DVec3>().normalize_or_zero()
    }

    fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.triangles[triangle as usize].map(|corner| self.positions[corner as usize])
    }

    /// The outline of an island; none where nothing of an area is left of it.
    fn polygon(&self, island: &[u32]) -> Option<Polygon> {
        let triangles = island.iter().map(|&triangle| self.triangles[triangle as usize]);
        let normal = self.normal(island);
        if normal == DVec3::ZERO {
            return None;
        }
        let contours = outline(triangles, &self.positions, normal);
        (!contours.is_empty()).then(|| Polygon { contours, normal: normal.as_vec3() })
    }
}

/// An axis-aligned box in the precision of the work here.
#[derive(Clone, Copy)]
struct Extent {
    min: DVec3,
    max: DVec3,
}

impl Extent {
    fn new<const N: usize>(points: [DVec3; N]) -> Self {
        points.into_iter().fold(Self { min: points[0], max: points[0] }, Self::with)
    }

    fn with(self, point: DVec3) -> Self {
        Self { min: self.min.min(point), max: self.max.max(point) }
    }

    fn diagonal(&self) -> f64 {
        self.min.distance(self.max)
    }
}

#[cfg(test)]
mod tests;
