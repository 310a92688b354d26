//! Planar islands: the flat parts of a mesh, each of which lights as one polygon.
//!
//! Positions within 1e-6 of the mesh's size are welded, and triangles thinner than that are left out. Of triangles that
//! coincide and face the same way, one is kept. Two triangles are neighbours where they share a whole edge and run
//! along it in opposite directions. (A vertex in the middle of a neighbour's edge, a T-junction, separates the two;
//! their polygons then light as much as one would.) An island is connected, faces one way, and is planar to 1e-3 of its
//! size.

use std::collections::{HashMap, HashSet};

use glam::{DAffine3, DVec3, Vec3};

use super::outline::outline;
use super::{Bounds, Instance, Mesh, Polygon};

/// Relative to the diagonal of the mesh's bounding box.
const WELD_TOLERANCE: f64 = 1e-6;
/// Half the thickness of an island, relative to the diagonal of its bounding box.
const PLANE_TOLERANCE: f64 = 1e-3;
/// Cosine of the sharpest edge (60 degrees) within an island: in a finely divided plane, noise well within the plane's
/// tolerance may turn faces as far as that.
const FACING_COSINE: f64 = 0.5;
/// Cosine of the sharpest edge (3 degrees) within an island that is part of a patch which is not planar as a whole.
const SMOOTH_COSINE: f64 = 0.9986;
/// An edge shared by more triangles than this joins none of them: honest meshes have two, hostile ones a million.
const EDGE_USES_MAX: usize = 8;

/// How a mesh's triangles are connected, wherever the mesh is placed.
pub(super) struct Topology {
    /// Triangles of welded vertices, without the thin ones.
    triangles: Vec<[u32; 3]>,
    /// Which of the mesh's triangles they are.
    sources: Vec<u32>,
    /// The neighbours of triangle `i` are `neighbours[starts[i]..starts[i + 1]]`.
    starts: Vec<usize>,
    neighbours: Vec<u32>,
}

/// A flat part of a mesh.
pub(super) struct Island {
    pub polygon: Polygon,
    /// The mesh's triangles that make it up.
    pub triangles: Vec<u32>,
}

/// A triangle's place in the world.
pub(super) struct Face {
    /// The area along the normal.
    pub area: DVec3,
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
        let mut known = HashSet::new();
        let mut is_new = |triangle: &[u32; 3]| known.insert(from_least(*triangle));
        let kept = (0..).zip(triangles).filter(|(_, triangle)| is_wide(triangle) && is_new(triangle));
        let (sources, triangles): (Vec<u32>, Vec<[u32; 3]>) = kept.unzip();
        let (starts, neighbours) = adjacency(&triangles);
        Self { triangles, sources, starts, neighbours }
    }

    /// The islands of the mesh as `instance` places it, counter-clockwise seen from the front; `None` where there are
    /// more than `limit`.
    pub fn islands(&self, mesh: &Mesh, instance: &Instance, limit: usize) -> Option<Vec<Island>> {
        self.placed(mesh, instance).islands(limit)
    }

    /// The mesh as `instance` places it.
    pub fn placed(&self, mesh: &Mesh, instance: &Instance) -> Placed<'_> {
        let world_from_mesh = DAffine3::from_mat4(instance.world_from_mesh.as_dmat4());
        let positions = mesh.positions.iter().map(|position| world_from_mesh.transform_point3(position.as_dvec3()));
        let positions: Vec<DVec3> = positions.collect();
        let turned = |&[a, b, c]: &[u32; 3]| if instance.mirrors() { [a, c, b] } else { [a, b, c] };
        let triangles: Vec<[u32; 3]> = self.triangles.iter().map(turned).collect();
        let faces = triangles.iter().map(|&corners| {
            let [a, b, c] = corners.map(|corner| positions[corner as usize]);
            let area = 0.5 * (b - a).cross(c - a);
            Face { area, normal: area.normalize_or_zero() }
        });
        let faces: Vec<Face> = faces.collect();
        Placed { topology: self, positions, triangles, faces }
    }

    pub fn neighbours(&self, triangle: u32) -> &[u32] {
        let triangle = triangle as usize;
        &self.neighbours[self.starts[triangle]..self.starts[triangle + 1]]
    }
}

/// The same triangle, starting from the vertex of least index.
fn from_least(mut triangle: [u32; 3]) -> [u32; 3] {
    let least = (0..3).min_by_key(|&corner| triangle[corner]).unwrap_or_default();
    triangle.rotate_left(least);
    triangle
}

/// For each vertex, the first one that is at its place within `tolerance`.
fn weld(positions: &[Vec3], tolerance: f64) -> Vec<u32> {
    let mut places = Places::new(positions, tolerance);
    let mut same = HashMap::with_capacity(positions.len());
    // Most vertices that coincide are equal to the bit and need no search. Adding zero makes 0 of -0.
    let key = |position: &Vec3| (*position + Vec3::ZERO).to_array().map(f32::to_bits);
    let welded = positions.iter().enumerate();
    welded.map(|(index, position)| *same.entry(key(position)).or_insert_with(|| places.find_or_insert(index))).collect()
}

/// Vertices sorted into cells, no two of them at one place.
struct Places<'a> {
    positions: &'a [Vec3],
    tolerance: f64,
    origin: DVec3,
    cell_width: f64,
    /// The last vertex in each cell that has any, and for each vertex the one before it in its cell.
    last: HashMap<[i64; 3], u32>,
    before: Vec<Option<u32>>,
}

impl<'a> Places<'a> {
    fn new(positions: &'a [Vec3], tolerance: f64) -> Self {
        let origin = Bounds::of_points(positions).min.as_dvec3();
        // So wide that most searches end in one cell, and so narrow that no cell holds more than some hundreds.
        let cell_width = (8.0 * tolerance).max(f64::MIN_POSITIVE);
        let last = HashMap::with_capacity(positions.len());
        Self { positions, tolerance, origin, cell_width, last, before: vec![None; positions.len()] }
    }

    /// The vertex at the place of vertex `index`: that vertex itself where there was none yet.
    fn find_or_insert(&mut self, index: usize) -> u32 {
        let point = self.positions[index].as_dvec3();
        let (low, high) = (self.cell(point - self.tolerance), self.cell(point + self.tolerance));
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    let vertices = std::iter::successors(self.last.get(&[x, y, z]).copied(), |&vertex| {
                        self.before[vertex as usize]
                    });
                    let mut near = vertices
                        .filter(|&vertex| self.positions[vertex as usize].as_dvec3().distance(point) <= self.tolerance);
                    if let Some(vertex) = near.next() {
                        return vertex;
                    }
                }
            }
        }
        self.before[index] = self.last.insert(self.cell(point), index as u32);
        index as u32
    }

    fn cell(&self, point: DVec3) -> [i64; 3] {
        ((point - self.origin) / self.cell_width).floor().to_array().map(|index| index as i64)
    }
}

/// Neighbours of triangles, as `Topology` holds them.
fn adjacency(triangles: &[[u32; 3]]) -> (Vec<usize>, Vec<u32>) {
    // Every use of an edge: its ends in order, whether the triangle runs along it in that order, and which triangle it
    // is.
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

/// A mesh in the world, about to be split into flat parts.
pub(super) struct Placed<'a> {
    pub topology: &'a Topology,
    pub positions: Vec<DVec3>,
    /// Counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    pub faces: Vec<Face>,
}

impl Placed<'_> {
    fn islands(&self, limit: usize) -> Option<Vec<Island>> {
        let mut taken = vec![false; self.triangles.len()];
        let mut islands = Vec::new();
        for seed in 0..self.triangles.len() as u32 {
            let patch = self.grow(seed, &mut taken, |from, to| self.cosine(from, to) > FACING_COSINE);
            self.part(patch, &mut islands, limit)?;
        }
        let found = |island: Vec<u32>| {
            let polygon = self.polygon(&island)?;
            let triangles = island.into_iter().map(|triangle| self.topology.sources[triangle as usize]).collect();
            Some(Island { polygon, triangles })
        };
        Some(islands.into_iter().filter_map(found).collect())
    }

    /// Splits connected triangles into islands: where they do not all lie in one plane, the smooth parts between sharp
    /// edges may. `None` where there are more than `limit` islands.
    fn part(&self, patch: Vec<u32>, islands: &mut Vec<Vec<u32>>, limit: usize) -> Option<()> {
        if self.is_planar(&patch) {
            // An empty patch is no island.
            islands.extend(Some(patch).filter(|patch| !patch.is_empty()));
            return (islands.len() <= limit).then_some(());
        }
        let mut taken = self.all_taken_but(&patch);
        for &seed in &patch {
            let smooth = self.grow(seed, &mut taken, |from, to| self.cosine(from, to) > SMOOTH_COSINE);
            if self.is_planar(&smooth) {
                islands.extend(Some(smooth).filter(|smooth| !smooth.is_empty()));
            } else {
                self.split(smooth, islands, limit)?;
            }
            if islands.len() > limit {
                return None;
            }
        }
        Some(())
    }

    /// Marks all triangles as taken but those of `patch`.
    fn all_taken_but(&self, patch: &[u32]) -> Vec<bool> {
        let mut taken = vec![true; self.triangles.len()];
        patch.iter().for_each(|&triangle| taken[triangle as usize] = false);
        taken
    }

    fn cosine(&self, left: u32, right: u32) -> f64 {
        self.faces[left as usize].normal.dot(self.faces[right as usize].normal)
    }

    /// Takes the triangles that are connected to `seed` through pairs of neighbours that `joins` accepts; none if
    /// `seed` is taken.
    fn grow(&self, seed: u32, taken: &mut [bool], mut joins: impl FnMut(u32, u32) -> bool) -> Vec<u32> {
        if std::mem::replace(&mut taken[seed as usize], true) {
            return Vec::new();
        }
        let mut grown = vec![seed];
        let mut next = 0;
        while let Some(&triangle) = grown.get(next) {
            next += 1;
            for &other in self.topology.neighbours(triangle) {
                if !taken[other as usize] && joins(triangle, other) {
                    taken[other as usize] = true;
                    grown.push(other);
                }
            }
        }
        grown
    }

    /// Splits a curved patch into planes, each grown from the largest triangle that is left. `None` where there are
    /// more than `limit` islands.
    fn split(&self, patch: Vec<u32>, islands: &mut Vec<Vec<u32>>, limit: usize) -> Option<()> {
        let mut taken = self.all_taken_but(&patch);
        let mut seeds = patch;
        let area = |triangle: &u32| self.faces[*triangle as usize].area.length_squared();
        seeds.sort_by(|left, right| area(right).total_cmp(&area(left)).then(left.cmp(right)));
        for &seed in &seeds {
            islands.extend(Some(self.grow_plane(seed, &mut taken)).filter(|island| !island.is_empty()));
            if islands.len() > limit {
                return None;
            }
        }
        Some(())
    }

    /// Grows through triangles that lie in the plane of `seed`, within the tolerance for the size that the island has
    /// so far.
    fn grow_plane(&self, seed: u32, taken: &mut [bool]) -> Vec<u32> {
        let normal = self.faces[seed as usize].normal;
        let origin = self.positions[self.triangles[seed as usize][0] as usize];
        let mut bounds = Extent::new(self.corners(seed));
        self.grow(seed, taken, |_, triangle| {
            let grown = self.corners(triangle).into_iter().fold(bounds, Extent::with);
            let tolerance = PLANE_TOLERANCE * grown.diagonal();
            let in_plane = |corner: DVec3| normal.dot(corner - origin).abs() <= tolerance;
            let joins = self.cosine(seed, triangle) > SMOOTH_COSINE && self.corners(triangle).into_iter().all(in_plane);
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

    /// The polygon of an island; `None` where no area is left of it.
    fn polygon(&self, island: &[u32]) -> Option<Polygon> {
        let triangles = island.iter().map(|&triangle| self.triangles[triangle as usize]);
        let normal = self.normal(island);
        let contours = outline(triangles, &self.positions, normal);
        (!contours.is_empty()).then(|| Polygon { contours, normal: normal.as_vec3(), pattern: None })
    }
}

/// An axis-aligned box in `f64`.
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
