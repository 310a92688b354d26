//! A scene on the device: meshes once, and what the user may change (materials, lights, places) whenever it changes.

use std::collections::BTreeMap;

use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec3, Vec4};
use wgpu::util::{BufferInitDescriptor, DeviceExt};
use wgpu::{Buffer, BufferUsages, Device, Queue};

use super::RenderError;
use crate::scene::{Light, Material, Mesh, Scene, Settings};

#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(super) struct GpuVertex {
    position: Vec3,
    normal: Vec3,
}

/// `SurfacesInstance` of `surfaces.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(super) struct GpuInstance {
    world_from_mesh: Mat4,
    /// Columns of the matrix that takes normals to the world; up to a positive factor the inverse transpose.
    normal_from_mesh: [Vec4; 3],
    /// Radiance that the surface emits: its light's, or its material's.
    emission: Vec3,
    material: u32,
}

/// `SurfacesMaterial` of `surfaces.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(super) struct GpuMaterial {
    base_color: Vec3,
    alpha: f32,
    sheen_color: Vec3,
    padding: u32,
}

/// `SurfacesPolygon` of `surfaces.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(super) struct GpuPolygon {
    radiance: Vec3,
    two_sided: u32,
    normal: Vec3,
    first_vertex: u32,
    end_vertex: u32,
    padding: [u32; 3],
}

/// How a group of instances is rasterised.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Facing {
    /// Back faces are drawn.
    pub double_sided: bool,
    /// The transform mirrors: front faces wind clockwise.
    pub mirrored: bool,
}

/// Instances of one mesh that are drawn by one call: `instances[first..first + count]`.
pub(super) struct Batch {
    pub facing: Facing,
    pub mesh: usize,
    pub first: u32,
    pub count: u32,
}

pub(super) struct MeshBuffers {
    pub vertices: Buffer,
    pub indices: Buffer,
    pub index_count: u32,
}

/// The scene's buffers.
pub(super) struct Resident {
    pub meshes: Vec<MeshBuffers>,
    pub instances: Buffer,
    pub materials: Buffer,
    pub polygons: Buffer,
    pub light_vertices: Buffer,
    /// What is drawn, by facing, then mesh; hidden lights left out.
    pub batches: Vec<Batch>,
    pub polygon_count: u32,
}

impl Resident {
    pub fn new(device: &Device, scene: &Scene, settings: &Settings) -> Result<Self, RenderError> {
        let (instances, batches) = instances(scene, settings);
        let (polygons, light_vertices) = polygons(&scene.lights);
        let storage = |label: &'static str, contents: &[u8]| {
            let limit = device.limits().max_storage_buffer_binding_size;
            buffer(device, label, contents, BufferUsages::STORAGE | BufferUsages::COPY_DST, limit)
        };
        Ok(Self {
            meshes: scene.meshes.iter().map(|mesh| mesh_buffers(device, mesh)).collect::<Result<_, _>>()?,
            instances: storage("the instances", bytemuck::cast_slice(&instances))?,
            materials: storage("the materials", bytemuck::cast_slice(&materials(scene, settings)))?,
            polygons: storage("the lights", bytemuck::cast_slice(&polygons))?,
            light_vertices: storage("the lights' outlines", bytemuck::cast_slice(&light_vertices))?,
            batches,
            polygon_count: polygons.len() as u32,
        })
    }

    /// Takes over the materials', lights' and instances' present values. Their number and the meshes are as they were.
    pub fn update(&mut self, queue: &Queue, scene: &Scene, settings: &Settings) {
        let (instances, batches) = instances(scene, settings);
        let (polygons, light_vertices) = polygons(&scene.lights);
        queue.write_buffer(&self.instances, 0, bytemuck::cast_slice(&instances));
        queue.write_buffer(&self.materials, 0, bytemuck::cast_slice(&materials(scene, settings)));
        queue.write_buffer(&self.polygons, 0, bytemuck::cast_slice(&polygons));
        queue.write_buffer(&self.light_vertices, 0, bytemuck::cast_slice(&light_vertices));
        self.batches = batches;
    }
}

/// All instances sorted by how they are drawn, and the calls that draw them.
fn instances(scene: &Scene, settings: &Settings) -> (Vec<GpuInstance>, Vec<Batch>) {
    let mut lights = vec![None; scene.instances.len()];
    scene.lights.iter().for_each(|light| lights[light.instance] = Some(light));
    let mut groups: BTreeMap<(Facing, usize), Vec<GpuInstance>> = BTreeMap::new();
    let mut unseen = Vec::new();
    for (instance, light) in scene.instances.iter().zip(lights) {
        let world_from_mesh = instance.world_from_mesh;
        let material = scene.meshes[instance.mesh].material;
        let facing = Facing { double_sided: scene.materials[material].double_sided, mirrored: instance.mirrors() };
        let gpu_instance = GpuInstance {
            world_from_mesh,
            normal_from_mesh: instance.world_from_normal().to_cols_array_2d().map(|[x, y, z]| Vec4::new(x, y, z, 0.0)),
            emission: light.map_or(scene.materials[material].emission, |light| light.radiance),
            material: material as u32,
        };
        if light.is_some() && !settings.lights_visible {
            &mut unseen
        } else {
            groups.entry((facing, instance.mesh)).or_default()
        }
        .push(gpu_instance);
    }
    let mut sorted = Vec::with_capacity(scene.instances.len());
    let mut batches = Vec::with_capacity(groups.len());
    for ((facing, mesh), group) in groups {
        batches.push(Batch { facing, mesh, first: sorted.len() as u32, count: group.len() as u32 });
        sorted.extend(group);
    }
    // Kept, so that the buffer's length does not depend on what is visible.
    sorted.extend(unseen);
    (sorted, batches)
}

fn materials(scene: &Scene, settings: &Settings) -> Vec<GpuMaterial> {
    let convert = |(index, material): (usize, &Material)| {
        let sheen = settings.sheen_of(index, material);
        GpuMaterial {
            base_color: material.base_color,
            alpha: sheen.map_or(0.0, |look| look.roughness_map.alpha_from_roughness(look.sheen.roughness)),
            sheen_color: sheen.map_or(Vec3::ZERO, |look| look.sheen.weight * look.sheen.color),
            padding: 0,
        }
    };
    scene.materials.iter().enumerate().map(convert).collect()
}

/// The lights' polygons, and the vertices of their outlines: each outline's first vertex is marked by w = 1 and comes
/// again at its end.
fn polygons(lights: &[Light]) -> (Vec<GpuPolygon>, Vec<Vec4>) {
    let mut polygons = Vec::new();
    let mut vertices: Vec<Vec4> = Vec::new();
    for light in lights {
        for polygon in &light.polygons {
            let first_vertex = vertices.len() as u32;
            for contour in &polygon.contours {
                let closed = contour.iter().chain(contour.first());
                vertices.extend(closed.enumerate().map(|(i, p)| p.extend(if i == 0 { 1.0 } else { 0.0 })));
            }
            polygons.push(GpuPolygon {
                radiance: light.radiance,
                two_sided: light.two_sided.into(),
                normal: polygon.normal,
                first_vertex,
                end_vertex: vertices.len() as u32,
                padding: [0; 3],
            });
        }
    }
    (polygons, vertices)
}

fn mesh_buffers(device: &Device, mesh: &Mesh) -> Result<MeshBuffers, RenderError> {
    let vertices: Vec<GpuVertex> =
        mesh.positions.iter().zip(&mesh.normals).map(|(&position, &normal)| GpuVertex { position, normal }).collect();
    let limit = device.limits().max_buffer_size;
    Ok(MeshBuffers {
        vertices: buffer(device, &mesh.name, bytemuck::cast_slice(&vertices), BufferUsages::VERTEX, limit)?,
        indices: buffer(device, &mesh.name, bytemuck::cast_slice(&mesh.indices), BufferUsages::INDEX, limit)?,
        index_count: mesh.indices.len() as u32,
    })
}

/// A buffer with these contents; an empty one, which cannot be bound, is given 256 bytes of zeros.
fn buffer(
    device: &Device,
    name: &str,
    contents: &[u8],
    usage: BufferUsages,
    limit: u64,
) -> Result<Buffer, RenderError> {
    let bytes = contents.len() as u64;
    if bytes > limit {
        return Err(RenderError::TooLarge { what: name.to_owned(), bytes, limit });
    }
    let contents = if contents.is_empty() { &[0; 256] } else { contents };
    Ok(device.create_buffer_init(&BufferInitDescriptor { label: Some(name), contents, usage }))
}

#[cfg(test)]
mod tests {
    use super::super::layout::{differences, members};
    use super::super::surfaces::SURFACES_WGSL;
    use super::*;

    #[test]
    fn structs_stand_as_the_shader_reads_them() {
        let instance = members!(GpuInstance { world_from_mesh, normal_from_mesh, emission, material });
        let material = members!(GpuMaterial { base_color, alpha, sheen_color });
        let polygon = members!(GpuPolygon { radiance, two_sided, normal, first_vertex, end_vertex });
        for (name, size, members) in [
            ("SurfacesInstance", size_of::<GpuInstance>(), &instance[..]),
            ("SurfacesMaterial", size_of::<GpuMaterial>(), material),
            ("SurfacesPolygon", size_of::<GpuPolygon>(), polygon),
        ] {
            assert_eq!(differences(SURFACES_WGSL, name, size, members), [""; 0]);
        }
    }
}
