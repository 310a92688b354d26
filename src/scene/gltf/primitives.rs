//! Primitives: from accessors to indexed triangles with a normal at each vertex.

use glam::{DVec3, Vec3};
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::validation::Checked::Valid;

use super::Fault;
use super::accessor::Accessors;
use crate::scene::Mesh;
use crate::scene::notices::Notices;

/// What a triangle takes in memory at most: three vertices and three indices of its own.
const TRIANGLE_BYTES: u64 = 84;
/// Primitives may share accessors, so that a few bytes could ask for a lot of memory: they get this many times the
/// bytes of all buffers, several times what primitives that share nothing need, and a little for small files.
const SHARING: u64 = 64;
const SHARING_FLOOR: u64 = 64 << 20;

/// Reads primitives, within a budget of memory.
pub struct Reader<'a> {
    accessors: Accessors<'a>,
    budget: u64,
}

impl<'a> Reader<'a> {
    pub fn new(accessors: Accessors<'a>) -> Self {
        let bytes: u64 = accessors.root.buffers.iter().map(|buffer| buffer.byte_length.0).fold(0, u64::saturating_add);
        Self { accessors, budget: bytes.saturating_mul(SHARING).saturating_add(SHARING_FLOOR) }
    }

    /// The mesh of a primitive; none where there is nothing to draw.
    pub fn read(
        &mut self,
        primitive: &Primitive,
        material: usize,
        name: String,
        notices: &mut Notices,
    ) -> Result<Option<Mesh>, Fault> {
        let Valid(mode) = primitive.mode else { return Err(Fault::new("its mode is none of glTF's; export it again")) };
        if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            notices.add("points and lines are not drawn", || name);
            return Ok(None);
        }
        if primitive.targets.as_ref().is_some_and(|targets| !targets.is_empty()) {
            notices.add("morph targets are not applied", || name.clone());
        }
        let Some(positions) = primitive.attributes.get(&Valid(Semantic::Positions)) else {
            notices.add("primitives without positions are not drawn", || name);
            return Ok(None);
        };
        if let Some(codec) = compression(primitive) {
            return Err(Fault::new(format_args!("is compressed by {codec}; export the file without compression")));
        }
        let Corners { used, triangles: mut indices } = self.corners(primitive, positions.value(), mode)?;
        let positions = self.accessors.vectors(positions.value(), used.as_deref())?;
        indices.retain(|&triangle| area_vector(&positions, triangle) != DVec3::ZERO);
        if indices.is_empty() {
            return Ok(None);
        }
        let mut mesh = Mesh { name, positions, indices: indices.into_flattened(), material, ..Mesh::default() };
        match primitive.attributes.get(&Valid(Semantic::Normals)) {
            None => flatten(&mut mesh),
            Some(normals) => {
                mesh.normals = self.accessors.vectors(normals.value(), used.as_deref())?;
                unify(&mut mesh, notices);
            }
        }
        Ok(Some(mesh))
    }

    /// The triangles of a primitive. There are never more vertices than corners, so that what is read is paid for by
    /// indices.
    fn corners(&mut self, primitive: &Primitive, positions: usize, mode: Mode) -> Result<Corners, Fault> {
        let count = self.accessors.count(positions)?;
        if let Some(normals) = primitive.attributes.get(&Valid(Semantic::Normals)) {
            let normals = self.accessors.count(normals.value())?;
            if normals != count {
                return Err(Fault::new(format_args!("has {count} positions and {normals} normals; export it again")));
            }
        }
        let mut corners = match primitive.indices {
            Some(indices) => self.accessors.indices(indices.value())?,
            None => (0..u32::try_from(count).unwrap_or(u32::MAX)).collect(),
        };
        if let Some(at) = corners.iter().position(|&corner| corner as usize >= count) {
            let what = format_args!("index {at} is {}, past its {count} vertices; export it again", corners[at]);
            return Err(Fault::new(what));
        }
        self.charge(corners.len(), mode)?;
        let used = (count > corners.len()).then(|| {
            let mut used = corners.clone();
            used.sort_unstable();
            used.dedup();
            for corner in &mut corners {
                // Every corner was put into `used`.
                *corner = used.partition_point(|vertex| vertex < corner) as u32;
            }
            used
        });
        Ok(Corners { used, triangles: triangles(&corners, mode) })
    }

    fn charge(&mut self, corners: usize, mode: Mode) -> Result<(), Fault> {
        let triangles = if mode == Mode::Triangles { corners / 3 } else { corners } as u64;
        let over = || Fault::new("too many primitives share the same accessors; split the file or export it again");
        self.budget = self.budget.checked_sub(triangles.saturating_mul(TRIANGLE_BYTES)).ok_or_else(over)?;
        Ok(())
    }
}

/// What a primitive makes of its vertices.
struct Corners {
    /// The vertices that are read, in order; all of them where there is no list.
    used: Option<Vec<u32>>,
    /// Of vertices by their place among those that are read.
    triangles: Vec<[u32; 3]>,
}

/// The extension that a primitive's data is compressed with.
fn compression(primitive: &Primitive) -> Option<&str> {
    let names = primitive.extensions.as_ref()?.others.keys();
    names.map(String::as_str).find(|name| name.contains("compression"))
}

/// Corners taken three by three, or as a strip or fan; an incomplete last triangle is left out.
fn triangles(corners: &[u32], mode: Mode) -> Vec<[u32; 3]> {
    match mode {
        Mode::TriangleStrip => {
            let turned = |(i, w): (usize, &[u32])| if i % 2 == 0 { [w[0], w[1], w[2]] } else { [w[0], w[2], w[1]] };
            corners.windows(3).enumerate().map(turned).collect()
        }
        Mode::TriangleFan => {
            let hub = corners.first().copied().unwrap_or_default();
            corners.windows(2).skip(1).map(|rim| [hub, rim[0], rim[1]]).collect()
        }
        _ => corners.chunks_exact(3).map(|corner| [corner[0], corner[1], corner[2]]).collect(),
    }
}

/// Along the normal, twice the area long; exactly zero only where the corners are, to f64, on one line.
fn area_vector(positions: &[Vec3], [a, b, c]: [u32; 3]) -> DVec3 {
    let [a, b, c] = [a, b, c].map(|corner| positions[corner as usize].as_dvec3());
    (b - a).cross(c - a)
}

/// Gives each triangle vertices of its own with its normal: what glTF asks for where there are none.
fn flatten(mesh: &mut Mesh) {
    let own = mesh.indices.len() == mesh.positions.len() && mesh.indices.iter().copied().eq(0..);
    if !own {
        mesh.positions = mesh.indices.iter().map(|&corner| mesh.positions[corner as usize]).collect();
        mesh.indices = (0..mesh.positions.len() as u32).collect();
    }
    mesh.normals.reserve_exact(mesh.positions.len());
    for triangle in mesh.indices.as_chunks::<3>().0 {
        let normal = area_vector(&mesh.positions, *triangle).normalize().as_vec3();
        mesh.normals.extend([normal; 3]);
    }
}

/// Makes normals unit, and those of no length the mean of their triangles'.
fn unify(mesh: &mut Mesh, notices: &mut Notices) {
    let is_zero = |normal: &Vec3| normal.as_dvec3().length_squared() == 0.0;
    if mesh.normals.iter().any(is_zero) {
        notices.add("normals of no length are replaced by those of the faces", || mesh.name.clone());
        let zero: Vec<bool> = mesh.normals.iter().map(is_zero).collect();
        let mut sums = vec![DVec3::ZERO; mesh.positions.len()];
        for triangle in mesh.indices.chunks_exact(3) {
            let area = area_vector(&mesh.positions, [triangle[0], triangle[1], triangle[2]]);
            triangle.iter().for_each(|&corner| sums[corner as usize] += area);
        }
        for (normal, (sum, _)) in mesh.normals.iter_mut().zip(sums.iter().zip(zero)).filter(|(_, (_, zero))| *zero) {
            *normal = sum.try_normalize().unwrap_or(DVec3::Z).as_vec3();
        }
    }
    for normal in &mut mesh.normals {
        *normal = normal.as_dvec3().normalize().as_vec3();
    }
}
