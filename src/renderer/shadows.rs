//! What stands in the way of light, on the device: group 2 of the surfaces' pass.

use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Mat4, Vec3};
use wgpu::util::DeviceExt;
use wgpu::{BindGroup, BindGroupLayout, Buffer, BufferUsages, Device, Limits, Queue, ShaderStages, TextureView};

use super::Gpu;
use super::blockers::{Gathered, Kind, Opacities, Tree, emitting_triangles, most_nodes};
use super::tracked_buffer::TrackedBuffer;
use crate::bvh::units;
use crate::scene::Drawn;

/// Storage buffers of the fragment stage with shadows: those of materials and lights, and three of what stands in the way.
const STORAGE_BUFFERS: u32 = 8;
/// Longest side of a layer of alphas.
const ALPHAS_SIDE: usize = 4096;

/// `BLOCKERS_NONE` of `blockers.wgsl`.
const NONE: u32 = u32::MAX;

/// `Blockers` of `blockers.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct GpuBlockers {
    center: Vec3,
    unit: f32,
    roots: [u32; 2],
    split: u32,
    first_look: u32,
}

/// What the shaders are made for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(super) struct BlockerKinds {
    /// Some triangles let light through.
    pub opacities: bool,
    /// Triangles fill more than one buffer.
    pub more: bool,
}

/// What stands in the way of light in a scene as it is drawn, on its way to the device: first gathered, then built, which
/// takes about two seconds for a million triangles and may be done on another thread.
pub struct Blockers {
    others: Option<Gathered>,
    emitters: Gathered,
    /// Room for emitters, whether they are drawn or not.
    emitting: usize,
    opacities: Arc<Opacities>,
    placed: Placed,
    units: (DVec3, f64),
}

/// Trees that are built.
pub struct Built {
    others: Option<Tree>,
    emitters: Tree,
    emitting: usize,
    opacities: Arc<Opacities>,
    placed: Placed,
    units: (DVec3, f64),
}

/// By instance that is an emitter: whether it is drawn, and where.
type Placed = Vec<(bool, Mat4)>;

fn placed(drawn: &Drawn) -> Placed {
    let emitters = (0..drawn.instances.len()).filter(|&instance| drawn.light_index(instance).is_some());
    emitters.map(|instance| (drawn.is_drawn(instance), drawn.instances[instance].world_from_mesh)).collect()
}

impl Blockers {
    /// How many triangles are to be sorted into trees.
    pub fn triangles(&self) -> usize {
        self.others.as_ref().map_or(0, Gathered::triangles) + self.emitters.triangles()
    }

    /// Builds the trees.
    pub fn build(self) -> Built {
        let Self { others, emitters, emitting, opacities, placed, units } = self;
        Built {
            others: others.map(|gathered| gathered.build(units, &opacities)),
            emitters: emitters.build(units, &opacities),
            emitting,
            opacities,
            placed,
            units,
        }
    }
}

/// The device's part of a scene's shadows.
#[derive(Default)]
pub(super) struct Shadows {
    resident: Option<ResidentTrees>,
    opacities: Option<Arc<Opacities>>,
    /// Why there are none.
    pub lack: Option<String>,
}

struct ResidentTrees {
    blockers: TrackedBuffer,
    nodes: Buffer,
    /// The first of their buffers.
    triangles: Buffer,
    bind_group: BindGroup,
    held: GpuBlockers,
    kinds: BlockerKinds,
    /// Of what stays; none where nothing does.
    root: Option<u32>,
    /// Where the records of opacity begin in the nodes.
    first_record: usize,
    placed: Placed,
}

impl Shadows {
    /// What is to be built for the scene as it is drawn now; none where what is there will do, or where the device cannot hold it.
    pub fn gather(&mut self, limits: &Limits, drawn: &Drawn) -> Option<Blockers> {
        if self.lack.is_some() || !drawn.settings.shadows {
            return None;
        }
        let placed = placed(drawn);
        if self.resident.as_ref().is_some_and(|resident| resident.placed == placed) {
            return None;
        }
        self.lack = lack(limits, drawn);
        if self.lack.is_some() {
            return None;
        }
        let (is_first, bounds) = (self.resident.is_none(), drawn.scene.bounds());
        let opacities = self.opacities.get_or_insert_with(|| Arc::new(Opacities::new(drawn)));
        Some(Blockers {
            others: is_first.then(|| Gathered::new(drawn, Kind::Others)),
            emitters: Gathered::new(drawn, Kind::Emitters),
            emitting: emitting_triangles(drawn),
            opacities: opacities.clone(),
            placed,
            units: units([bounds.min, bounds.max].map(|corner| corner.as_dvec3())),
        })
    }

    /// Takes trees to the device.
    pub fn receive(&mut self, gpu: &Gpu, layout: &BindGroupLayout, built: Built) {
        let Built { others, emitters, emitting, opacities, placed, units } = built;
        match (others, &mut self.resident) {
            (Some(others), _) => {
                let trees = (others, emitters, emitting, units);
                let resident = ResidentTrees::new(gpu, layout, trees, (&opacities, placed));
                match resident {
                    Ok(resident) => self.resident = Some(resident),
                    Err(lack) => self.lack = Some(lack),
                }
            }
            (None, Some(resident)) => resident.replace_emitters(&gpu.queue, emitters, placed),
            (None, None) => {}
        }
    }

    /// Where there are shadows: what is bound for them, and what shaders are to be made for.
    pub fn bound(&self) -> Option<(&BindGroup, BlockerKinds)> {
        let resident = self.resident.as_ref().filter(|resident| resident.held.roots[0] != NONE);
        resident.map(|resident| (&resident.bind_group, resident.kinds))
    }
}

/// Why a device cannot hold what stands in the way of light in a scene.
fn lack(limits: &Limits, drawn: &Drawn) -> Option<String> {
    let without = "the picture is drawn without shadows";
    let buffers = limits.max_storage_buffers_per_shader_stage;
    if buffers < STORAGE_BUFFERS {
        return Some(format!(
            "the adapter gives a shader {buffers} storage buffers of {STORAGE_BUFFERS} that shadows take: {without}; use \
             another --adapter"
        ));
    }
    let triangles = |instance: &crate::scene::Instance| drawn.scene.meshes[instance.mesh].indices.len() / 3;
    let all: usize = drawn.instances.iter().map(triangles).sum();
    let most = most_triangles(limits);
    (all > most).then(|| {
        format!("{all} triangles cast shadows, of at most {most} that the adapter holds: {without}; simplify the scene")
    })
}

/// In two buffers.
fn most_triangles(limits: &Limits) -> usize {
    let of_one = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size) / TRIANGLE as u64;
    2 * usize::try_from(of_one).unwrap_or(usize::MAX / 2)
}

/// Bytes of a triangle.
const TRIANGLE: usize = 48;
/// Bytes of a node, and of `blockers_nodes`' elements.
const NODE: usize = 80;
const WORDS: usize = 16;

impl ResidentTrees {
    /// `emitting` triangles have room in the trees of emitters.
    fn new(
        gpu: &Gpu,
        layout: &BindGroupLayout,
        (mut others, emitters, emitting, (center, unit)): (Tree, Tree, usize, (DVec3, f64)),
        (opacities, placed): (&Opacities, Placed),
    ) -> Result<Self, String> {
        let Gpu { device, queue, .. } = gpu;
        // First the emitters' nodes, then the others', then opacities.
        let root = most_nodes(emitting);
        let first_record = 5 * (root + others.nodes.len());
        let first_look = first_record + 2 * opacities.records.len();
        let words = first_look + 2 * opacities.looks.len();
        let limits = device.limits();
        let most = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        if (words * WORDS) as u64 > most {
            return Err(format!(
                "what casts shadows takes {} bytes on the adapter, which holds at most {most} in one piece: the picture is drawn \
                 without shadows; simplify the scene",
                words * WORDS
            ));
        }
        others.place(root, emitting, first_record);
        let nodes = buffer(device, "blockers' nodes", words * WORDS);
        let write = |buffer: &Buffer, at: usize, bytes: &[u8]| queue.write_buffer(buffer, at as u64, bytes);
        write(&nodes, root * NODE, bytemuck::cast_slice(&others.nodes));
        write(&nodes, first_record * WORDS, bytemuck::cast_slice(&opacities.records));
        write(&nodes, first_look * WORDS, bytemuck::cast_slice(&opacities.looks));
        // Emitters' triangles are the first.
        let split = most as usize / TRIANGLE;
        let all = emitting + others.triangles.len();
        let triangles = [all.min(split), all.saturating_sub(split)]
            .map(|triangles| buffer(device, "blockers' triangles", triangles * TRIANGLE));
        let in_first = others.triangles.len().min(split.saturating_sub(emitting));
        let (first, second) = others.triangles.split_at(in_first);
        write(&triangles[0], emitting * TRIANGLE, bytemuck::cast_slice(first));
        write(&triangles[1], 0, bytemuck::cast_slice(second));
        let held = GpuBlockers {
            center: center.as_vec3(),
            unit: unit as f32,
            roots: [NONE; 2],
            split: split as u32,
            first_look: first_look as u32,
        };
        let blockers = TrackedBuffer::new(device, "blockers", bytemuck::bytes_of(&held), BufferUsages::UNIFORM);
        let alphas = alphas(gpu, &opacities.alphas);
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("blockers"),
            layout,
            entries: &[
                entry(0, blockers.binding()),
                entry(1, nodes.as_entire_binding()),
                entry(2, triangles[0].as_entire_binding()),
                entry(3, triangles[1].as_entire_binding()),
                entry(4, wgpu::BindingResource::TextureView(&alphas)),
            ],
        });
        let kinds = BlockerKinds { opacities: !opacities.records.is_empty(), more: all > split };
        let root = (!others.nodes.is_empty()).then_some(root as u32);
        let [triangles, _] = triangles;
        let places = Placed::new();
        let mut resident =
            Self { blockers, nodes, triangles, bind_group, held, kinds, root, first_record, placed: places };
        resident.replace_emitters(queue, emitters, placed);
        Ok(resident)
    }

    fn replace_emitters(&mut self, queue: &Queue, mut emitters: Tree, placed: Placed) {
        emitters.place(0, 0, self.first_record);
        queue.write_buffer(&self.nodes, 0, bytemuck::cast_slice(&emitters.nodes));
        queue.write_buffer(&self.triangles, 0, bytemuck::cast_slice(&emitters.triangles));
        let moving = (!emitters.nodes.is_empty()).then_some(0);
        self.held.roots = match (self.root, moving) {
            (Some(root), moving) => [root, moving.unwrap_or(NONE)],
            (None, moving) => [moving.unwrap_or(NONE), NONE],
        };
        self.blockers.write(queue, bytemuck::bytes_of(&self.held));
        self.placed = placed;
    }
}

/// An empty buffer of so many bytes, or some where there are to be none.
fn buffer(device: &Device, label: &str, bytes: usize) -> Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: bytes.max(TRIANGLE.next_multiple_of(WORDS)) as u64,
        usage: BufferUsages::STORAGE | BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

/// A texture of alphas, row by row and layer by layer.
fn alphas(gpu: &Gpu, alphas: &[u8]) -> TextureView {
    let limit = gpu.device.limits().max_texture_dimension_2d as usize;
    let width = limit.min(ALPHAS_SIDE);
    let rows = alphas.len().div_ceil(width).max(1);
    let height = rows.min(width);
    let layers = rows.div_ceil(height);
    let mut texels = alphas.to_vec();
    texels.resize(width * height * layers, 0);
    let size = wgpu::Extent3d { width: width as u32, height: height as u32, depth_or_array_layers: layers as u32 };
    let texture = gpu.device.create_texture_with_data(
        &gpu.queue,
        &wgpu::TextureDescriptor {
            label: Some("blockers' alphas"),
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::R8Unorm,
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        },
        wgpu::util::TextureDataOrder::LayerMajor,
        &texels,
    );
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    })
}

/// Group 2 of the surfaces' pass.
pub(super) fn bind_group_layout(device: &Device) -> BindGroupLayout {
    use wgpu::{BindingType, BufferBindingType};
    let buffer = |ty| BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    let storage = buffer(BufferBindingType::Storage { read_only: true });
    let alphas = BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension: wgpu::TextureViewDimension::D2Array,
        multisampled: false,
    };
    let types = [buffer(BufferBindingType::Uniform), storage, storage, storage, alphas];
    let entry =
        |(binding, ty)| wgpu::BindGroupLayoutEntry { binding, visibility: ShaderStages::FRAGMENT, ty, count: None };
    let entries: Vec<wgpu::BindGroupLayoutEntry> = (0..).zip(types).map(entry).collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("blockers"), entries: &entries })
}

#[cfg(test)]
mod tests {
    use super::super::layout::{differences, members};
    use super::super::shader::SURFACES_WGSL;
    use super::*;

    #[test]
    fn trees_stand_as_the_shader_reads_them() {
        let members = members!(GpuBlockers { center, unit, roots, split, first_look });
        assert_eq!(differences(SURFACES_WGSL, "Blockers", size_of::<GpuBlockers>(), members), [""; 0]);
    }
}
