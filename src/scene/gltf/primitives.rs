//! Primitives: made from accessors into indexed triangles, with what each vertex needs.

use glam::{DAffine3, DVec3, Vec3, Vec4};
use gltf::json::mesh::{Mode, Primitive};
use gltf::json::validation::Checked::Valid;

use super::Fault;
use super::accessor::Accessors;
use super::attributes::{Attributes, WHITE};
use super::morph::Deltas;
use super::{buffers, morph, skinning};
use crate::scene::notices::Notices;
use crate::scene::{Material, Mesh, TextureUse, tangents};

/// Primitives may share accessors, so that a few bytes could ask for a lot of memory. So all primitives together get
/// this many times the bytes of all buffers, which is several times what primitives that share nothing need.
const SHARING: u64 = 64;
/// And so many bytes more, for small files.
const SHARING_FLOOR: u64 = 64 << 20;

/// What gives a primitive its shape besides its own vertices.
#[derive(Clone, Copy, Default)]
pub struct Shape<'a> {
    /// Of its morph targets.
    pub weights: &'a [f32],
    /// Where each joint of a skin puts what is bound to it, in the world.
    pub joints: Option<&'a [DAffine3]>,
}

/// A primitive in its shape.
pub struct Shaped {
    /// Its material is left for the caller to fill in.
    pub mesh: Mesh,
    /// Whether it is bound to joints.
    pub is_bound: bool,
    /// Where in the world the joints of its shape have put the mesh's origin; `None` where they have not moved it.
    pub origin: Option<DVec3>,
}

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

    /// Takes so many bytes from the budget.
    pub fn charge(&mut self, bytes: usize) -> Result<(), Fault> {
        let what =
            "too many primitives, poses or instances share the same accessors; split the file or export it again";
        self.budget = self.budget.checked_sub(bytes as u64).ok_or_else(|| Fault::new(what))?;
        Ok(())
    }

    /// A primitive of `material` in a shape; `None` where nothing is drawn.
    pub fn read(
        &mut self,
        primitive: &Primitive,
        material: &Material,
        name: String,
        shape: Shape,
        notices: &mut Notices,
    ) -> Result<Option<Shaped>, Fault> {
        // What is not drawn is looked at all the same, in each shape.
        self.charge(size_of::<Mesh>())?;
        let Valid(mode) = primitive.mode else { return Err(Fault::new("its mode is none of glTF's; export it again")) };
        if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            notices.add("points and lines are not drawn", || name);
            return Ok(None);
        }
        let Some(mut attributes) = Attributes::of(primitive, material, notices, &name) else {
            notices.add("primitives without positions are not drawn", || name);
            return Ok(None);
        };
        if attributes.has_wide_tex_coords(&self.accessors) {
            notices.add("the third component of texture coordinates is left out", || name.clone());
        }
        let is_bound = !attributes.influences.is_empty();
        if shape.joints.is_none() {
            attributes.influences.clear();
        }
        let Corners { count, used, mut triangles } = self.corners(primitive, &attributes, mode)?;
        let used = used.as_deref();
        let mut mesh = Mesh { name, ..attributes.read(&self.accessors, used)? };
        self.morph(&mut mesh, primitive, (shape.weights, count, used))?;
        let origin = self.bend(&mut mesh, &mut triangles, &attributes, (shape.joints, used), notices)?;
        triangles.retain(|&triangle| area_vector(&mesh.positions, triangle) != DVec3::ZERO);
        if triangles.is_empty() {
            if origin.is_some() {
                notices.add("meshes that their pose leaves without area are not drawn", || mesh.name);
            }
            return Ok(None);
        }
        mesh.indices = triangles.into_flattened();
        if mesh.colors.iter().all(|&color| color == WHITE) {
            mesh.colors = Vec::new();
        }
        if attributes.normals.is_some() {
            unify(&mut mesh, notices)
        } else {
            flatten(&mut mesh)
        }
        if let Some(map) = attributes.normal_map {
            orient(&mut mesh, map, notices);
        }
        Ok(Some(Shaped { mesh, is_bound, origin }))
    }

    /// Adds the morph targets that have a weight.
    fn morph(
        &mut self,
        mesh: &mut Mesh,
        primitive: &Primitive,
        (weights, count, used): (&[f32], usize, Option<&[u32]>),
    ) -> Result<(), Fault> {
        if weights.is_empty() {
            return Ok(());
        }
        self.charge(morph::targets_bytes(primitive))?;
        let targets = morph::targets(primitive)?;
        self.charge(Deltas::bytes(&targets, weights, mesh.positions.len()))?;
        Deltas { accessors: &self.accessors, targets: &targets, weights, used, count }.add_to(mesh)
    }

    /// Moves vertices by the joints that they are bound to, and says where these have put the mesh's origin.
    fn bend(
        &mut self,
        mesh: &mut Mesh,
        triangles: &mut [[u32; 3]],
        attributes: &Attributes,
        (joints, used): (Option<&[DAffine3]>, Option<&[u32]>),
        notices: &mut Notices,
    ) -> Result<Option<DVec3>, Fault> {
        let Some(joints) = joints.filter(|_| !attributes.influences.is_empty()) else { return Ok(None) };
        let sets = attributes.influences.len();
        self.charge(skinning::vertex_bytes(sets).saturating_mul(mesh.positions.len()))?;
        let sets = attributes.read_influences(&self.accessors, used)?;
        skinning::apply(mesh, triangles, &sets, joints, notices).map(Some)
    }

    /// The triangles of a primitive. No more vertices are read than there are corners, so that the file's indices limit
    /// the memory that they take.
    fn corners(&mut self, primitive: &Primitive, attributes: &Attributes, mode: Mode) -> Result<Corners, Fault> {
        let count = attributes.count(&self.accessors)?;
        let indices = primitive.indices.map(|indices| indices.value());
        let corners = indices.map_or(Ok(count), |indices| self.accessors.count(indices))?;
        self.charge_vertices(corners, count, attributes, mode)?;
        let mut corners = match indices {
            Some(indices) => self.accessors.indices(indices)?,
            // There are fewer than 2^32: `charge_vertices` has seen to it.
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
        Ok(Corners { count, used, triangles: triangles(&corners, mode) })
    }

    /// Takes from the budget the most memory that triangles of so many corners and vertices need.
    fn charge_vertices(
        &mut self,
        corners: usize,
        count: usize,
        attributes: &Attributes,
        mode: Mode,
    ) -> Result<(), Fault> {
        let indices = if mode == Mode::Triangles { corners } else { corners.saturating_mul(3) };
        let vertices = if attributes.may_split() { indices.max(count.min(corners)) } else { count.min(corners) };
        let bytes = vertices.saturating_mul(attributes.vertex_bytes()).saturating_add(indices.saturating_mul(4));
        // Indices of 32 bits must do for vertices that are split, too.
        self.charge(if vertices < u32::MAX as usize { bytes } else { usize::MAX })
    }
}

/// Gives a normal-mapped mesh its tangents: the file's own, or computed ones where these are missing or unusable.
fn orient(mesh: &mut Mesh, map: TextureUse, notices: &mut Notices) {
    let own: Vec<Vec4> = std::mem::take(&mut mesh.tangents);
    if !own.is_empty() {
        if tangents::adopt(mesh, &own) {
            return;
        }
        notices.add("tangents of no length or along the normal are computed anew", || mesh.name.clone());
    }
    tangents::compute(mesh, map.tex_coord, map.uv_from_tex_coord);
}

/// What a primitive makes of its vertices.
struct Corners {
    /// How many vertices the primitive has.
    count: usize,
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
