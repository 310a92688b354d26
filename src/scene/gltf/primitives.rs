//! Primitives: made from accessors into indexed triangles, with what each vertex needs.

use glam::{DVec3, Vec3, Vec4};
use gltf::json::accessor::Type;
use gltf::json::mesh::{Mode, Primitive};
use gltf::json::validation::Checked::Valid;

use super::Fault;
use super::accessor::{Accessors, Numbers};
use super::attributes::Attributes;
use super::buffers;
use crate::scene::notices::Notices;
use crate::scene::{Material, Mesh, TextureUse, tangents};

/// Primitives may share accessors, so that a few bytes could ask for a lot of memory. So all primitives together get
/// this many times the bytes of all buffers, which is several times what primitives that share nothing need.
const SHARING: u64 = 64;
/// And so many bytes more, for small files.
const SHARING_FLOOR: u64 = 64 << 20;

/// Reads primitives, within a budget of memory.
pub struct Reader<'a> {
    pub accessors: Accessors<'a>,
    budget: u64,
}

impl<'a> Reader<'a> {
    pub fn new(accessors: Accessors<'a>) -> Self {
        let bytes = buffers::weight(accessors.buffers);
        Self { accessors, budget: bytes.saturating_mul(SHARING).saturating_add(SHARING_FLOOR) }
    }

    /// The mesh of a primitive of `material`, whose index is left for the caller to fill in; `None` where nothing is
    /// drawn.
    pub fn read(
        &mut self,
        primitive: &Primitive,
        material: &Material,
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
        let Some(attributes) = Attributes::of(primitive, material, notices, &name) else {
            notices.add("primitives without positions are not drawn", || name);
            return Ok(None);
        };
        let Corners { used, triangles: mut indices } = self.corners(primitive, &attributes, mode)?;
        let used = used.as_deref();
        let positions = self.accessors.read(attributes.positions, Type::Vec3, Numbers::Quantized, used)?;
        indices.retain(|&triangle| area_vector(&positions, triangle) != DVec3::ZERO);
        if indices.is_empty() {
            return Ok(None);
        }
        let mut mesh = Mesh { name, positions, indices: indices.into_flattened(), ..Mesh::default() };
        mesh.tex_coords = attributes.read_tex_coords(&self.accessors, used)?;
        mesh.colors = attributes.read_colors(&self.accessors, used)?;
        match attributes.normals {
            None => flatten(&mut mesh),
            Some(normals) => {
                mesh.normals = self.accessors.read(normals, Type::Vec3, Numbers::Signed, used)?;
                unify(&mut mesh, notices);
            }
        }
        if let Some(map) = attributes.normal_map {
            let own = attributes.read_tangents(&self.accessors, used)?;
            orient(&mut mesh, map, own.as_deref(), notices);
        }
        Ok(Some(mesh))
    }

    /// The triangles of a primitive. No more vertices are read than there are corners, so that the file's indices limit
    /// the memory that they take.
    fn corners(&mut self, primitive: &Primitive, attributes: &Attributes, mode: Mode) -> Result<Corners, Fault> {
        let count = attributes.count(&self.accessors)?;
        let indices = primitive.indices.map(|indices| indices.value());
        let corners = indices.map_or(Ok(count), |indices| self.accessors.count(indices))?;
        self.charge(corners, count, attributes, mode)?;
        let mut corners = match indices {
            Some(indices) => self.accessors.indices(indices)?,
            // There are fewer than 2^32: `charge` has seen to it.
            None => (0..count as u32).collect(),
        };
        if let Some(at) = corners.iter().position(|&corner| corner as usize >= count) {
            let what = format_args!("index {at} is {}, past its {count} vertices; export it again", corners[at]);
            return Err(Fault::new(what));
        }
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

    /// Takes from the budget the most memory that triangles of so many corners and vertices need.
    fn charge(&mut self, corners: usize, count: usize, attributes: &Attributes, mode: Mode) -> Result<(), Fault> {
        let indices = if mode == Mode::Triangles { corners } else { corners.saturating_mul(3) };
        let vertices = if attributes.may_split() { indices.max(count.min(corners)) } else { count.min(corners) };
        let bytes = vertices.saturating_mul(attributes.vertex_bytes()).saturating_add(indices.saturating_mul(4));
        let over = || Fault::new("too many primitives share the same accessors; split the file or export it again");
        self.budget = self.budget.checked_sub(bytes as u64).ok_or_else(over)?;
        // Indices of 32 bits must do for vertices that are split, too.
        (vertices < u32::MAX as usize).then_some(()).ok_or_else(over)
    }
}

/// Gives a normal-mapped mesh its tangents: the file's own, or computed ones where these are missing or unusable.
fn orient(mesh: &mut Mesh, map: TextureUse, own: Option<&[Vec4]>, notices: &mut Notices) {
    match own {
        Some(own) if tangents::adopt(mesh, own) => return,
        Some(_) => notices.add("tangents of no length or along the normal are computed anew", || mesh.name.clone()),
        None => {}
    }
    tangents::compute(mesh, map.tex_coord, map.uv_from_tex_coord);
}

/// What a primitive makes of its vertices.
struct Corners {
    /// The vertices that are read, in order; `None` where all are.
    used: Option<Vec<u32>>,
    /// Vertices are counted among those that are read.
    triangles: Vec<[u32; 3]>,
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
        _ => corners.as_chunks::<3>().0.to_vec(),
    }
}

/// A vector along the normal, of twice the area's length; exactly zero only where the corners are on one line, to
/// `f64`.
fn area_vector(positions: &[Vec3], [a, b, c]: [u32; 3]) -> DVec3 {
    let [a, b, c] = [a, b, c].map(|corner| positions[corner as usize].as_dvec3());
    (b - a).cross(c - a)
}

/// Gives each triangle vertices of its own, with its normal: what glTF asks for where there are no normals.
fn flatten(mesh: &mut Mesh) {
    let own = mesh.indices.len() == mesh.positions.len() && mesh.indices.iter().copied().eq(0..);
    if !own {
        let indices = std::mem::take(&mut mesh.indices);
        mesh.positions = at(&mesh.positions, &indices);
        for coords in &mut mesh.tex_coords {
            *coords = at(coords, &indices);
        }
        mesh.colors = at(&mesh.colors, &indices);
        mesh.indices = (0..mesh.positions.len() as u32).collect();
    }
    mesh.normals.reserve_exact(mesh.positions.len());
    for triangle in mesh.indices.as_chunks::<3>().0 {
        let normal = area_vector(&mesh.positions, *triangle).normalize().as_vec3();
        mesh.normals.extend([normal; 3]);
    }
}

/// The values at some indices; none where there are no values at all.
fn at<T: Copy>(values: &[T], indices: &[u32]) -> Vec<T> {
    if values.is_empty() { Vec::new() } else { indices.iter().map(|&index| values[index as usize]).collect() }
}

/// Makes normals unit; those of no length are replaced by the mean of their triangles'.
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
