//! The order in which blended triangles are painted: back to front, as one view sees them.
//!
//! A sort by the depth of the triangles' middles is wrong wherever a large one meets a small one. Here every two
//! triangles that overlap in the picture are compared where they overlap, and the order is one that agrees with all
//! these comparisons (Newell, Newell and Sancha 1972 make the same comparisons, on their way through a sorted list). It
//! is exact for triangles that do not cross. There is none where three or more overlap in a circle: only among those
//! does the farthest middle go first.

mod constraints;
mod overlap;
mod polygon;
#[cfg(test)]
mod tests;
mod topology;

use glam::{Mat4, Vec3};
use rayon::prelude::*;

use super::view::View;
use polygon::{Polygon, Projector};

/// The most triangles, of the meshes in view, that are sorted.
pub const TRIANGLES_MAX: usize = 1 << 20;

/// The most pairs of triangles whose boxes overlap in the picture, for the order to be exact.
pub const PAIRS_MAX: usize = 1 << 23;

/// A mesh placed in the world.
#[derive(Clone, Copy, Debug)]
pub struct PlacedMesh<'a> {
    /// In the mesh's own space.
    pub positions: &'a [Vec3],
    /// Indices into `positions`, counter-clockwise seen from the front.
    pub triangles: &'a [[u32; 3]],
    /// Affine; where it mirrors, front faces are back faces by winding.
    pub world_from_mesh: Mat4,
    /// Whether back faces are painted.
    pub double_sided: bool,
}

/// A triangle of one of several meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Painted {
    /// The mesh's index.
    pub mesh: u32,
    /// The triangle's index in the mesh.
    pub triangle: u32,
}

/// What is painted, the farthest first.
#[derive(Clone, Debug)]
pub struct PaintOrder {
    /// All triangles that the view shows: no culled back faces, nothing seen edge-on, nothing outside.
    pub triangles: Vec<Painted>,
    /// Whether the order is that of the overlaps; that of the triangles' middles where these were too many.
    pub is_exact: bool,
}

impl PaintOrder {
    /// The order for a view. Triangles in one plane keep theirs: what comes later lies on top. Of one mesh as many as
    /// possible follow each other.
    ///
    /// Time and memory grow with the pairs of triangles that overlap in the picture: 30 ns and 12 bytes each at most.
    /// Past `PAIRS_MAX` of them, the order is that of the triangles' middles.
    pub fn new(meshes: &[PlacedMesh], view: &View) -> Self {
        let projector = Projector::new(view);
        let project = |(index, mesh)| projector.polygons(index as u32, mesh);
        let polygons: Vec<Polygon> = meshes.par_iter().enumerate().flat_map(project).collect();
        let middles = polygons.iter().map(|polygon| polygon.middle).zip(0..);
        let mut by_middle: Vec<(f64, u32)> = middles.collect();
        by_middle.par_sort_by(|(one, _), (other, _)| one.total_cmp(other));
        let by_middle: Vec<u32> = by_middle.into_iter().map(|(_, index)| index).collect();
        let constraints = constraints::find(&polygons);
        let is_exact = constraints.is_some();
        let order = match constraints {
            Some(constraints) => {
                let groups: Vec<u32> = polygons.iter().map(|polygon| polygon.source.mesh).collect();
                topology::sort(&constraints, &by_middle, &groups, meshes.len())
            }
            None => by_middle,
        };
        let triangles = order.into_iter().map(|index| polygons[index as usize].source).collect();
        Self { triangles, is_exact }
    }
}
