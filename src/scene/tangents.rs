//! Tangents for normal maps: those of MikkTSpace, with which such maps are made (glTF 2.0, section 3.7.2.1).
//!
//! Its time grows with the square of the number of triangles around a vertex, and it takes about 600 bytes per
//! triangle. So meshes are given to it in blocks; where there are triangles enough for several, no picture shows the
//! seams between them. And where a vertex is the hub of very many triangles, each vertex gets the mean direction of its
//! triangles instead.

use std::collections::HashMap;

use bevy_mikktspace::{Geometry, TangentSpace, generate_tangents};
use glam::{Affine2, DVec2, DVec3, Vec2, Vec3, Vec4};

use super::Mesh;

/// Triangles per block.
const BLOCK: usize = 1 << 16;
/// The most triangles around a vertex that MikkTSpace is given: it recurses as deep as there are.
const HUB_MAX: u32 = 128;
/// Stands for no index.
const NONE: u32 = u32::MAX;

/// Gives a mesh tangents along the u of a normal map that a set of texture coordinates, transformed, places on it.
/// Vertices whose triangles disagree are split. Where the coordinates leave a direction open, it is any that is
/// perpendicular to the normal.
pub(super) fn compute(mesh: &mut Mesh, set: usize, uv_from_tex_coord: Affine2) {
    if mesh.tex_coords[set].is_empty() {
        mesh.tangents = mesh.normals.iter().map(|&normal| frame(normal, Vec3::ZERO, 1.0)).collect();
        return;
    }
    let coords: Vec<Vec2> = mesh.tex_coords[set].iter().map(|&at| uv_from_tex_coord.transform_point2(at)).collect();
    mesh.tangents = vec![Vec4::ZERO; mesh.positions.len()];
    // Vertices that were split off form a list that starts at the one from which they were split.
    let mut next = vec![NONE; mesh.positions.len()];
    for start in (0..mesh.indices.len()).step_by(3 * BLOCK) {
        let end = (start + 3 * BLOCK).min(mesh.indices.len());
        let tangents = Block::new(mesh, &coords, &mesh.indices[start..end]).tangents();
        for (corner, tangent) in (start..end).zip(tangents) {
            mesh.indices[corner] = vertex_with(mesh, &mut next, mesh.indices[corner], tangent);
        }
    }
}

/// Gives a mesh the tangents of its file, made perpendicular to the normals and unit, and returns true. Where one of
/// them leaves no direction, the mesh gets none, and the result is false.
pub(super) fn adopt(mesh: &mut Mesh, tangents: &[Vec4]) -> bool {
    let frames = mesh.normals.iter().zip(tangents).map(|(&normal, &tangent)| {
        let handedness = if tangent.w < 0.0 { -1.0 } else { 1.0 };
        Some(across(normal, tangent.truncate())?.extend(handedness))
    });
    let frames: Option<Vec<Vec4>> = frames.collect();
    let is_whole = frames.is_some();
    mesh.tangents = frames.unwrap_or_default();
    is_whole
}

/// The vertex that is like `vertex` and has `tangent`: that vertex itself, one split off before, or a new one.
fn vertex_with(mesh: &mut Mesh, next: &mut Vec<u32>, vertex: u32, tangent: Vec4) -> u32 {
    let mut at = vertex;
    loop {
        let own = mesh.tangents[at as usize];
        if own == Vec4::ZERO {
            mesh.tangents[at as usize] = tangent;
        }
        if own == Vec4::ZERO || own == tangent {
            return at;
        }
        match next[at as usize] {
            NONE => break,
            other => at = other,
        }
    }
    let new = mesh.positions.len() as u32;
    next[at as usize] = new;
    next.push(NONE);
    mesh.positions.push(mesh.positions[vertex as usize]);
    mesh.normals.push(mesh.normals[vertex as usize]);
    mesh.tangents.push(tangent);
    for coords in mesh.tex_coords.iter_mut().filter(|coords| !coords.is_empty()) {
        coords.push(coords[vertex as usize]);
    }
    if !mesh.colors.is_empty() {
        mesh.colors.push(mesh.colors[vertex as usize]);
    }
    new
}

/// The part of a direction that is perpendicular to a unit normal, made unit.
fn across(normal: Vec3, direction: Vec3) -> Option<Vec3> {
    let (normal, direction) = (normal.as_dvec3(), direction.as_dvec3().try_normalize()?);
    let across = direction - normal * normal.dot(direction);
    // What rounding leaves of a direction along the normal does not count.
    (across.length() > 1e-6).then(|| across.normalize().as_vec3())
}

fn frame(normal: Vec3, direction: Vec3, handedness: f32) -> Vec4 {
    across(normal, direction).unwrap_or_else(|| normal.any_orthonormal_vector()).extend(handedness)
}

/// Some triangles of a mesh.
struct Block<'a> {
    mesh: &'a Mesh,
    coords: &'a [Vec2],
    indices: &'a [u32],
    /// One per corner.
    tangents: Vec<Vec4>,
}

impl<'a> Block<'a> {
    fn new(mesh: &'a Mesh, coords: &'a [Vec2], indices: &'a [u32]) -> Self {
        Self { mesh, coords, indices, tangents: Vec::new() }
    }

    /// A tangent for each corner.
    fn tangents(mut self) -> Vec<Vec4> {
        if self.has_hub() {
            return self.means();
        }
        let fallback = |&vertex: &u32| frame(self.mesh.normals[vertex as usize], Vec3::ZERO, 1.0);
        self.tangents = self.indices.iter().map(fallback).collect();
        // It cannot fail: its result has no error to tell.
        let _ = generate_tangents(&mut self);
        self.tangents
    }

    /// Whether very many triangles meet in a vertex, where equal vertices count as one, as they do for MikkTSpace.
    fn has_hub(&self) -> bool {
        let mut uses: HashMap<[u32; 8], u32> = HashMap::new();
        self.indices.iter().any(|&vertex| {
            let vertex = vertex as usize;
            let ([x, y, z], [a, b, c]) = (self.mesh.positions[vertex].to_array(), self.mesh.normals[vertex].to_array());
            let [u, v] = self.coords[vertex].to_array();
            let uses = uses.entry([x, y, z, a, b, c, u, v].map(f32::to_bits)).or_default();
            *uses += 1;
            *uses > HUB_MAX
        })
    }

    /// For each corner, the mean direction of u around its vertex, triangles weighted by their size (Lengyel 2001).
    fn means(&self) -> Vec<Vec4> {
        let mut sums: HashMap<u32, (DVec3, f64)> = HashMap::new();
        for triangle in self.indices.as_chunks::<3>().0 {
            let [a, b, c] = triangle.map(|vertex| self.mesh.positions[vertex as usize].as_dvec3());
            let [s, t, u] = triangle.map(|vertex| self.coords[vertex as usize].as_dvec2());
            let (along_s, along_t): (DVec2, DVec2) = (t - s, u - s);
            let area = along_s.perp_dot(along_t);
            let direction = (along_t.y * (b - a) - along_s.y * (c - a)) * area.signum();
            for &vertex in triangle {
                let sum = sums.entry(vertex).or_default();
                *sum = (sum.0 + direction, sum.1 + area);
            }
        }
        let mean = |vertex: &u32| {
            let (direction, area) = sums[vertex];
            let direction = direction.try_normalize().unwrap_or_default();
            frame(self.mesh.normals[*vertex as usize], direction.as_vec3(), handedness(area > 0.0))
        };
        self.indices.iter().map(mean).collect()
    }

    fn vertex(&self, face: usize, corner: usize) -> usize {
        self.indices[3 * face + corner] as usize
    }
}

/// The sign of the bitangent. In glTF, v runs downwards in the image and y upwards in normal maps: where a triangle
/// winds the same way in texture coordinates as it does seen from its front, the frame is left-handed.
fn handedness(uv_turns_with_triangle: bool) -> f32 {
    if uv_turns_with_triangle { -1.0 } else { 1.0 }
}

impl Geometry for Block<'_> {
    fn num_faces(&self) -> usize {
        self.indices.len() / 3
    }

    fn num_vertices_of_face(&self, _: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.mesh.positions[self.vertex(face, corner)].to_array()
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        self.mesh.normals[self.vertex(face, corner)].to_array()
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        self.coords[self.vertex(face, corner)].to_array()
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, corner: usize) {
        if let Some(space) = space {
            let normal = self.mesh.normals[self.vertex(face, corner)];
            let tangent = Vec3::from(space.tangent());
            self.tangents[3 * face + corner] = frame(normal, tangent, handedness(space.is_orientation_preserving()));
        }
    }
}
