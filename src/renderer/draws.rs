//! What is drawn, and in which order: instances sorted into batches, and which of a batch a view sees.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec3, Vec4};

use super::lights::LightKinds;
use super::materials::Look;
use crate::scene::{Bounds, Drawn, Mesh};

/// `VerticesInstance` of `vertices.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(super) struct GpuInstance {
    pub world_from_mesh: Mat4,
    /// Columns of the matrix that takes normals to the world: the inverse transpose, up to a positive factor.
    normal_from_mesh: [Vec4; 3],
    emission: Vec3,
    pub material: u32,
    handedness: f32,
    padding: [u32; 3],
}

/// What a pipeline is specialised for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Variant {
    pub look: Look,
    /// What the mesh's vertices have; nothing where it is not needed.
    pub attributes: Attributes,
    pub lights: LightKinds,
    /// The transform mirrors: front faces wind clockwise.
    pub mirrored: bool,
}

/// What vertices have besides position and normal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Attributes {
    /// Whether any of the others counts; those that are missing are constants.
    pub any: bool,
    pub tangents: bool,
    pub tex_coords: [bool; 2],
    pub colors: bool,
}

impl Variant {
    fn new(look: Look, mesh: &Mesh, lights: LightKinds, mirrored: bool) -> Self {
        let attributes = match look.textures != 0 || !mesh.colors.is_empty() {
            false => Attributes::default(),
            true => Attributes {
                any: true,
                tangents: !mesh.tangents.is_empty(),
                tex_coords: mesh.tex_coords.each_ref().map(|set| !set.is_empty()),
                colors: !mesh.colors.is_empty(),
            },
        };
        Self { look, attributes, lights, mirrored }
    }
}

/// Instances of one mesh that are drawn alike: `instances[range]`.
pub(super) struct Batch {
    pub variant: Variant,
    pub mesh: usize,
    pub material: usize,
    pub range: Range<u32>,
}

/// All instances sorted by how they are drawn.
#[derive(Default)]
pub(super) struct Draws {
    pub instances: Vec<GpuInstance>,
    /// Each instance's, in the world.
    bounds: Vec<Bounds>,
    /// What is opaque comes first. Hidden lights are in no batch.
    pub batches: Vec<Batch>,
    /// The blended instances that are drawn, in the file's order.
    pub blended: Vec<BlendedInstance>,
}

/// What is to be known of a blended instance to sort it.
#[derive(Clone, Copy)]
pub(super) struct BlendedInstance {
    pub mesh: usize,
    pub world_from_mesh: Mat4,
    pub double_sided: bool,
    /// In the world.
    pub bounds: Bounds,
    /// Index into `Draws::batches`.
    pub batch: usize,
    /// Index into `Draws::instances`.
    pub slot: u32,
}

impl Draws {
    /// `mesh_bounds` are the bounds of the scene's meshes, `kinds` the kinds of its lights.
    pub fn new(drawn: &Drawn, mesh_bounds: &[Bounds], kinds: LightKinds) -> Self {
        let is_hidden = |index: usize| !drawn.is_drawn(index);
        let looks: Vec<Look> = drawn.materials.iter().map(Look::new).collect();
        let variant = |index: usize| {
            let mesh = drawn.mesh_of(index);
            let look = Look { double_sided: drawn.is_double_sided(index), ..looks[mesh.material] };
            Variant::new(look, mesh, kinds, drawn.instances[index].mirrors())
        };
        let variants: Vec<Variant> = (0..drawn.instances.len()).map(variant).collect();
        let key = |&index: &usize| {
            (is_hidden(index), variants[index].look.blend, variants[index], drawn.instances[index].mesh)
        };
        let mut order: Vec<usize> = (0..drawn.instances.len()).collect();
        // Stable: instances that are drawn alike stay in the file's order.
        order.sort_by_key(key);
        let mut draws = Self::default();
        let mut blended: Vec<(usize, BlendedInstance)> = Vec::new();
        for index in order {
            let instance = &drawn.instances[index];
            let at = draws.instances.len() as u32;
            draws.instances.push(gpu_instance(drawn, index, variants[index].mirrored));
            let of_shape = || Bounds::of_points(&drawn.mesh(instance.mesh).positions);
            let bounds = mesh_bounds.get(instance.mesh).copied().unwrap_or_else(of_shape);
            let bounds = bounds.transformed(instance.world_from_mesh);
            draws.bounds.push(bounds);
            if is_hidden(index) {
                continue;
            }
            let (variant, mesh) = (variants[index], instance.mesh);
            match draws.batches.last_mut().filter(|batch| (batch.variant, batch.mesh) == (variant, mesh)) {
                Some(batch) => batch.range.end = at + 1,
                None => {
                    let material = drawn.mesh(mesh).material;
                    draws.batches.push(Batch { variant, mesh, material, range: at..at + 1 });
                }
            }
            if variant.look.blend {
                let (world_from_mesh, double_sided) = (instance.world_from_mesh, variant.look.double_sided);
                let batch = draws.batches.len() - 1;
                blended.push((index, BlendedInstance { mesh, world_from_mesh, double_sided, bounds, batch, slot: at }));
            }
        }
        blended.sort_by_key(|(index, _)| *index);
        draws.blended = blended.into_iter().map(|(_, instance)| instance).collect();
        draws
    }

    /// Whether any instance has a sheen that is summed over points on the lights.
    pub fn samples_lights(&self) -> bool {
        self.batches.iter().any(|batch| batch.variant.look.sheen_model != 0)
    }

    /// Whether lights that shine on any instance have patterns.
    pub fn has_patterns(&self) -> bool {
        self.batches.iter().any(|batch| batch.variant.lights.patterns)
    }

    /// The runs of opaque instances that may be in the view, batch by batch.
    pub fn opaque(&self, frustum: &Frustum) -> impl Iterator<Item = (&Batch, Range<u32>)> {
        self.batches.iter().filter(|batch| !batch.variant.look.blend).flat_map(|batch| {
            let mut runs: Vec<Range<u32>> = Vec::new();
            for at in batch.range.clone().filter(|at| frustum.may_show(&self.bounds[*at as usize])) {
                match runs.last_mut().filter(|run| run.end == at) {
                    Some(run) => run.end = at + 1,
                    None => runs.push(at..at + 1),
                }
            }
            runs.into_iter().map(move |run| (batch, run))
        })
    }
}

fn gpu_instance(drawn: &Drawn, index: usize, mirrored: bool) -> GpuInstance {
    let instance = &drawn.instances[index];
    GpuInstance {
        world_from_mesh: instance.world_from_mesh,
        normal_from_mesh: instance.world_from_normal().to_cols_array_2d().map(|[x, y, z]| Vec4::new(x, y, z, 0.0)),
        emission: drawn.emission(index),
        material: drawn.mesh_of(index).material as u32,
        handedness: if mirrored { -1.0 } else { 1.0 },
        padding: [0; 3],
    }
}

/// The part of space that a view shows.
pub(super) struct Frustum {
    /// A point p is inside where all `planes . (p, 1)` are positive.
    planes: [Vec4; 6],
    /// Grows with the distance along the view.
    depth: Vec4,
}

impl Frustum {
    /// `eye` as in `View`.
    pub fn new(clip_from_world: Mat4, eye: Vec4) -> Self {
        let [x, y, z, w] = [0, 1, 2, 3].map(|row| clip_from_world.row(row));
        // Clip z falls from w at the near plane to 0 at the far one. Without perspective w is 1, so z has to tell.
        let depth = if eye.w == 0.0 { -z } else { w };
        Self { planes: [w - x, w + x, w - y, w + y, w - z, z], depth }
    }

    /// Whether any part of the box may be inside. Boxes near the edges may be let through although they are outside.
    pub fn may_show(&self, bounds: &Bounds) -> bool {
        let (center, half) = (bounds.center(), 0.5 * bounds.max - 0.5 * bounds.min);
        self.planes.iter().all(|plane| {
            let (normal, reach) = (plane.truncate(), plane.truncate().abs().dot(half));
            // Room for rounding: whatever touches is drawn.
            let size = normal.abs().dot(center.abs() + half) + plane.w.abs();
            normal.dot(center) + plane.w + reach >= -1e-5 * size
        })
    }

    /// Grows with the distance along the view.
    pub fn depth(&self, point: Vec3) -> f32 {
        self.depth.dot(point.extend(1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::super::layout::{differences, members};
    use super::super::shader::SURFACES_WGSL;
    use super::super::view::{Rect, View};
    use super::*;
    use crate::scene::{Camera, Projection};

    #[test]
    fn instances_stand_as_the_shader_reads_them() {
        let members = members!(GpuInstance { world_from_mesh, normal_from_mesh, emission, material, handedness });
        assert_eq!(differences(SURFACES_WGSL, "VerticesInstance", size_of::<GpuInstance>(), members), [""; 0]);
    }

    fn frustum(projection: Projection) -> Frustum {
        let camera = Camera { name: String::new(), world_from_camera: Mat4::IDENTITY, projection };
        let view = View::new(&camera, [200, 100], Rect::full([200, 100]));
        Frustum::new(view.clip_from_world, view.eye)
    }

    fn cube(center: Vec3) -> Bounds {
        Bounds { min: center - 0.5, max: center + 0.5 }
    }

    #[test]
    fn what_is_out_of_sight_is_left_out() {
        let perspective = Projection::Perspective { yfov: 1.57, near: 0.1, far: f32::INFINITY };
        let orthographic = Projection::Orthographic { ymag: 5.0, near: 0.1, far: 50.0 };
        for projection in [perspective, orthographic] {
            let frustum = frustum(projection);
            let seen = [Vec3::NEG_Z, Vec3::new(9.0, 0.0, -5.0), Vec3::new(-9.0, 4.9, -5.0)];
            assert!(seen.iter().all(|center| frustum.may_show(&cube(*center))), "{projection:?}");
            let unseen = [2.0 * Vec3::Z, Vec3::new(12.0, 0.0, -5.0), Vec3::new(0.0, -6.5, -5.0)];
            assert!(!unseen.iter().any(|center| frustum.may_show(&cube(*center))), "{projection:?}");
            assert!(frustum.depth(Vec3::NEG_Z) < frustum.depth(2.0 * Vec3::NEG_Z));
        }
        assert!(!frustum(orthographic).may_show(&cube(Vec3::new(0.0, 0.0, -52.0))));
        assert!(frustum(perspective).may_show(&cube(Vec3::new(0.0, 0.0, -1e9))));
    }
}
