//! A scene on the device: meshes and textures are uploaded once; what the user may change (materials, lights, where
//! things stand), whenever it changes.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use glam::{Vec2, Vec4};
use wgpu::util::{BufferInitDescriptor, DeviceExt};
use wgpu::{BindGroup, BindGroupLayout, Buffer, BufferUsages, Device};

use super::draws::{Batch, Draws};
use super::lights::GpuLights;
use super::materials::{GpuMaterial, Look, factors};
use super::numbers::{TrackedNumbers, Words};
use super::patterns::Patterns;
use super::tracked_buffer::TrackedBuffer;
use super::{Gpu, RenderError, textures};
use crate::scene::{Bounds, Drawn, Mesh};

/// A mesh's vertices, one buffer per attribute, so that no mesh pays for attributes that it lacks.
pub(super) struct MeshBuffers {
    pub positions: Buffer,
    pub normals: Buffer,
    pub tangents: Option<Buffer>,
    pub tex_coords: [Option<Buffer>; 2],
    pub colors: Option<Buffer>,
    pub indices: Buffer,
    pub index_count: u32,
}

/// The scene's buffers and textures.
pub(super) struct Resident {
    meshes: Vec<MeshBuffers>,
    /// Those of lights that are added, by their index, from when they are first drawn on.
    shapes: HashMap<usize, MeshBuffers>,
    mesh_bounds: Vec<Bounds>,
    pub instances: TrackedBuffer,
    /// The materials, the lights and their outlines.
    pub numbers: TrackedNumbers,
    /// Where the lights begin in them, and their outlines.
    pub first: [u32; 2],
    pub counts: TrackedBuffer,
    pub punctual: TrackedBuffer,
    pub light_points: TrackedBuffer,
    pub sheets: TrackedBuffer,
    /// They are many, and seldom change.
    pub pattern_texels: TrackedBuffer,
    patterns: Patterns,
    /// How many numbers of theirs the buffer has.
    held: usize,
    /// What stands in for attributes that a mesh lacks: zero, and white.
    pub constants: Buffer,
    pub material_layout: BindGroupLayout,
    /// Those of the materials that have textures, by their index, and one for all the others.
    material_groups: (HashMap<usize, BindGroup>, BindGroup),
    pub draws: Draws,
}

impl Resident {
    pub fn new(gpu: &Gpu, drawn: &Drawn) -> Result<Self, RenderError> {
        let scene = drawn.scene;
        let Gpu { device, queue, .. } = gpu;
        let mesh_bounds: Vec<Bounds> = scene.meshes.iter().map(|mesh| Bounds::of_points(&mesh.positions)).collect();
        let mut patterns = Patterns::new(drawn);
        let contents = Contents::new(drawn, &mesh_bounds, &mut patterns);
        let stored = |(name, bytes)| storage(device, name, bytes);
        let material_layout = textures::bind_group_layout(device);
        let material_groups = textures::bind_groups((device, queue), &material_layout, scene);
        let counts = bytemuck::bytes_of(&contents.lights.counts);
        let constants = [Vec4::ZERO, Vec4::ONE];
        let constants = BufferInitDescriptor {
            label: Some("constants"),
            contents: bytemuck::cast_slice(&constants),
            usage: BufferUsages::VERTEX,
        };
        let [instances, punctual, light_points, sheets] = contents.stored();
        let (numbers, first) = contents.numbers();
        let mut resident = Self {
            meshes: scene.meshes.iter().map(|mesh| mesh_buffers(gpu, mesh)).collect::<Result<_, _>>()?,
            shapes: HashMap::new(),
            instances: stored(instances)?,
            numbers: TrackedNumbers::new(gpu, NUMBERS, numbers)?,
            first,
            counts: TrackedBuffer::new(device, "lights", counts, BufferUsages::UNIFORM),
            punctual: stored(punctual)?,
            light_points: stored(light_points)?,
            sheets: stored(sheets)?,
            pattern_texels: stored((PATTERNS, bytemuck::cast_slice(patterns.texels())))?,
            held: patterns.texels().len(),
            patterns,
            constants: device.create_buffer_init(&constants),
            material_layout,
            material_groups,
            draws: contents.draws,
            mesh_bounds,
        };
        resident.take_shapes(gpu, drawn)?;
        Ok(resident)
    }

    /// The mesh of this index: the scene's, or the shape of a light that is added.
    pub fn mesh(&self, index: usize) -> &MeshBuffers {
        self.meshes.get(index).unwrap_or_else(|| &self.shapes[&index])
    }

    /// Uploads the shapes of added lights that are not there yet.
    fn take_shapes(&mut self, gpu: &Gpu, drawn: &Drawn) -> Result<(), RenderError> {
        let added = drawn.instances[drawn.scene.instances.len()..].iter().map(|instance| instance.mesh);
        for index in added.filter(|&index| index >= self.meshes.len()) {
            if let Entry::Vacant(place) = self.shapes.entry(index) {
                place.insert(mesh_buffers(gpu, drawn.mesh(index))?);
            }
        }
        Ok(())
    }

    /// Uploads the present values of materials, lights and instances. Returns whether buffers or textures were made
    /// anew, which happens where their contents have grown. Meshes and textures stay as they are.
    pub fn update(&mut self, gpu: &Gpu, drawn: &Drawn) -> Result<bool, RenderError> {
        self.take_shapes(gpu, drawn)?;
        let contents = Contents::new(drawn, &self.mesh_bounds, &mut self.patterns);
        self.counts.write(&gpu.queue, bytemuck::bytes_of(&contents.lights.counts));
        let (numbers, first) = contents.numbers();
        self.first = first;
        let mut grown = self.numbers.write(gpu, NUMBERS, numbers)?;
        let buffers = [&mut self.instances, &mut self.punctual, &mut self.light_points, &mut self.sheets];
        for (buffer, stored) in buffers.into_iter().zip(contents.stored()) {
            grown |= written(gpu, buffer, stored)?;
        }
        if self.patterns.texels().len() > self.held {
            let texels = bytemuck::cast_slice(self.patterns.texels());
            grown |= written(gpu, &mut self.pattern_texels, (PATTERNS, texels))?;
            self.held = self.patterns.texels().len();
        }
        self.draws = contents.draws;
        Ok(grown)
    }

    /// The bind group of a batch's textures.
    pub fn textures(&self, batch: &Batch) -> &BindGroup {
        let (textured, plain) = &self.material_groups;
        textured.get(&batch.material).unwrap_or(plain)
    }
}

const PATTERNS: &str = "the lights' patterns";
const NUMBERS: &str = "the materials, the lights and their outlines";

/// What the buffers hold.
struct Contents {
    draws: Draws,
    materials: Vec<GpuMaterial>,
    lights: GpuLights,
}

impl Contents {
    fn new(drawn: &Drawn, mesh_bounds: &[Bounds], patterns: &mut Patterns) -> Self {
        let sampled = drawn.materials.iter().any(|material| Look::new(material).sheen_model != 0);
        let lights = GpuLights::new(drawn, sampled, patterns);
        Self {
            draws: Draws::new(drawn, mesh_bounds, lights.kinds()),
            materials: drawn.materials.iter().map(factors).collect(),
            lights,
        }
    }

    /// Materials, polygons and their vertices, and where the latter two begin.
    fn numbers(&self) -> (Vec<Words>, [u32; 2]) {
        let parts: [&[Words]; 3] = [
            bytemuck::cast_slice(&self.materials),
            bytemuck::cast_slice(&self.lights.polygons),
            bytemuck::cast_slice(&self.lights.vertices),
        ];
        let first_light = parts[0].len() as u32;
        (parts.concat(), [first_light, first_light + parts[1].len() as u32])
    }

    /// The contents of the storage buffers, with their names: instances, lights without extent, points on the polygons, where their
    /// patterns lie.
    fn stored(&self) -> [(&'static str, &[u8]); 4] {
        [
            ("the instances", bytemuck::cast_slice(&self.draws.instances)),
            ("the lights without extent", bytemuck::cast_slice(&self.lights.punctual)),
            ("the points on the lights", bytemuck::cast_slice(&self.lights.points)),
            ("the places of the lights' patterns", bytemuck::cast_slice(&self.lights.sheets)),
        ]
    }
}

fn mesh_buffers(gpu: &Gpu, mesh: &Mesh) -> Result<MeshBuffers, RenderError> {
    let limit = gpu.device.limits().max_buffer_size;
    // Where the device can read what the processor writes, there is no copy on the way.
    let shared = gpu.device.features().contains(wgpu::Features::MAPPABLE_PRIMARY_BUFFERS);
    let mapped = if shared { BufferUsages::MAP_WRITE } else { BufferUsages::empty() };
    let filled = |bytes: &[u8], usage| buffer(&gpu.device, &mesh.name, bytes, usage | mapped, limit);
    let vertices = |bytes: &[u8]| filled(bytes, BufferUsages::VERTEX);
    let some = |bytes: &[u8]| (!bytes.is_empty()).then(|| vertices(bytes)).transpose();
    let [first, second]: [&[Vec2]; 2] = mesh.tex_coords.each_ref().map(Vec::as_slice);
    Ok(MeshBuffers {
        positions: vertices(bytemuck::cast_slice(&mesh.positions))?,
        normals: vertices(bytemuck::cast_slice(&mesh.normals))?,
        tangents: some(bytemuck::cast_slice(&mesh.tangents))?,
        tex_coords: [some(bytemuck::cast_slice(first))?, some(bytemuck::cast_slice(second))?],
        colors: some(bytemuck::cast_slice(&mesh.colors))?,
        indices: filled(bytemuck::cast_slice(&mesh.indices), BufferUsages::INDEX)?,
        index_count: mesh.indices.len() as u32,
    })
}

/// A buffer with these contents, of at most `limit` bytes.
fn buffer(
    device: &Device,
    name: &str,
    contents: &[u8],
    usage: BufferUsages,
    limit: u64,
) -> Result<Buffer, RenderError> {
    let contents = bindable(name, contents, limit)?;
    Ok(device.create_buffer_init(&BufferInitDescriptor { label: Some(name), contents, usage }))
}

/// Writes contents to a storage buffer; returns whether it was made anew, because they have grown.
fn written(gpu: &Gpu, buffer: &mut TrackedBuffer, (name, bytes): (&str, &[u8])) -> Result<bool, RenderError> {
    let has_room = bytes.len() as u64 <= buffer.size();
    if has_room {
        buffer.write(&gpu.queue, bytes);
    } else {
        *buffer = storage(&gpu.device, name, bytes)?;
    }
    Ok(!has_room)
}

/// A storage buffer with these contents.
fn storage(device: &Device, name: &str, contents: &[u8]) -> Result<TrackedBuffer, RenderError> {
    let contents = bindable(name, contents, device.limits().max_storage_buffer_binding_size)?;
    Ok(TrackedBuffer::new(device, name, contents, BufferUsages::STORAGE))
}

/// The contents of a buffer that can be bound: 512 bytes of zeros instead of none. Fails where they pass the limit.
fn bindable<'a>(name: &str, contents: &'a [u8], limit: u64) -> Result<&'a [u8], RenderError> {
    let bytes = contents.len() as u64;
    if bytes > limit {
        return Err(RenderError::TooLarge { what: name.to_owned(), bytes, limit });
    }
    Ok(if contents.is_empty() { &[0; 512] } else { contents })
}
