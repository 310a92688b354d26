//! What stands in the way of light, on the device: group 2 of the surfaces' pass.

use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Mat4, Vec3};
use wgpu::util::DeviceExt;
use wgpu::{BindGroup, BindGroupLayout, BufferUsages, Device, Limits, Queue, ShaderStages, Texture, TextureView};

use super::Gpu;
use super::blockers::{Gathered, Kind, MOST_LOOKS, Opacities, Tree, emitting_triangles, most_nodes};
use super::numbers::{self, Words};
use super::tracked_buffer::TrackedBuffer;
use crate::bvh::units;
use crate::scene::{AlphaMode, Drawn, Instance};

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
    first_look: u32,
    first_triangle: u32,
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

/// By instance that is an emitter: whether it is drawn, its mesh, and where.
type Placed = Vec<(bool, usize, Mat4)>;

fn placed(drawn: &Drawn) -> Placed {
    let emitters = (0..drawn.instances.len()).filter(|&instance| drawn.light_index(instance).is_some());
    let placed = |instance: usize| {
        let Instance { mesh, world_from_mesh, .. } = drawn.instances[instance];
        (drawn.is_drawn(instance), mesh, world_from_mesh)
    };
    emitters.map(placed).collect()
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
    numbers: Texture,
    bind_group: BindGroup,
    held: GpuBlockers,
    opacities: bool,
    /// Of what stays; none where nothing does.
    root: Option<u32>,
    /// How many triangles of emitters there is room for.
    room: usize,
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
        let (emitting, bounds) = (emitting_triangles(drawn), drawn.scene.bounds());
        let has_room = self.resident.as_ref().is_some_and(|resident| emitting <= resident.room);
        // About the world's origin: about any other point, what is near that would lose digits.
        let most = bounds.min.abs().max(bounds.max.abs()).as_dvec3();
        let opacities = self.opacities.get_or_insert_with(|| Arc::new(Opacities::new(drawn)));
        Some(Blockers {
            others: (!has_room).then(|| Gathered::new(drawn, Kind::Others)),
            emitters: Gathered::new(drawn, Kind::Emitters),
            // A few may be added without all being built anew.
            emitting: emitting + SPARE,
            opacities: opacities.clone(),
            placed,
            units: units([-most, most]),
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

    /// Where there are shadows: what is bound for them, and whether some of it lets light through.
    pub fn bound(&self) -> Option<(&BindGroup, bool)> {
        let resident = self.resident.as_ref().filter(|resident| resident.held.roots[0] != NONE);
        resident.map(|resident| (&resident.bind_group, resident.opacities))
    }
}

/// Why a device cannot hold what stands in the way of light in a scene.
fn lack(limits: &Limits, drawn: &Drawn) -> Option<String> {
    let side = limits.max_texture_dimension_2d as usize;
    if side < ROW {
        return Some(format!(
            "the adapter's textures have {side} texels a side, of {ROW} that shadows take: {WITHOUT}; use another --adapter"
        ));
    }
    let looks = drawn.materials.iter().filter(|material| material.alpha_mode != AlphaMode::Opaque).count();
    if looks > MOST_LOOKS {
        return Some(format!(
            "{looks} materials are cut out or blended, of at most {MOST_LOOKS} that rays tell apart: {WITHOUT}; merge those that are alike"
        ));
    }
    let triangles = |instance: usize| drawn.mesh_of(instance).indices.len() / 3;
    let all: usize = (0..drawn.instances.len()).map(triangles).sum();
    let most = side * ROW / TRIANGLE;
    (all > most).then(|| {
        format!("{all} triangles cast shadows, of at most {most} that the adapter holds: {WITHOUT}; simplify the scene")
    })
}

/// The same of trees that are built, which take so many rows for nodes, and for all.
fn lack_of_rows(limits: &Limits, [nodes, all]: [usize; 2]) -> Option<String> {
    let most = limits.max_texture_dimension_2d as usize;
    let said = |rows: usize, most: usize| {
        format!(
            "what casts shadows takes {rows} rows, of at most {most} that there is room for: {WITHOUT}; simplify the scene"
        )
    };
    if nodes > NODE_ROWS {
        return Some(said(nodes, NODE_ROWS));
    }
    (all > most).then(|| said(all, most))
}

/// Texels in a row of the trees' texture: two to the power of `BLOCKERS_ROW` of `blockers.wgsl`.
const ROW: usize = 1 << 13;

/// Rows of so many texels.
fn rows(texels: usize) -> usize {
    texels.div_ceil(ROW)
}

/// Room for triangles of emitters that are added.
const SPARE: usize = 1 << 12;

const WITHOUT: &str = "the picture is drawn without shadows";
/// The most rows of nodes: `rays.wgsl` keeps a node's number in 24 bits.
const NODE_ROWS: usize = (NODE << 24) / ROW;
/// Texels of a node, of a triangle, and of what says how one lets light through.
const NODE: usize = 5;
const TRIANGLE: usize = 3;
const OPACITY: usize = 2;

impl ResidentTrees {
    /// `emitting` triangles have room in the tree of emitters.
    fn new(
        gpu: &Gpu,
        layout: &BindGroupLayout,
        (mut others, emitters, emitting, (center, unit)): (Tree, Tree, usize, (DVec3, f64)),
        (opacities, placed): (&Opacities, Placed),
    ) -> Result<Self, String> {
        let device = &gpu.device;
        // First the emitters, in rows of their own; then the others; then opacities.
        let root = (NODE * most_nodes(emitting)).next_multiple_of(NODE * ROW);
        let first_triangle = (TRIANGLE * emitting).next_multiple_of(TRIANGLE * ROW);
        let first_record = root + NODE * others.nodes.len();
        let first_look = first_record + OPACITY * opacities.records.len();
        let texels = [first_look + OPACITY * opacities.looks.len(), first_triangle + TRIANGLE * others.triangles.len()];
        let [node_rows, triangle_rows] = texels.map(rows);
        if let Some(lack) = lack_of_rows(&device.limits(), [rows(first_record), node_rows + triangle_rows]) {
            return Err(lack);
        }
        others.place(root / NODE, first_triangle / TRIANGLE, first_record);
        let numbers = numbers::numbers(device, "blockers", [ROW, node_rows + triangle_rows]);
        let mut words: Vec<Words> = bytemuck::cast_vec(others.nodes);
        words.extend(opacities.records.as_flattened());
        words.extend(opacities.looks.as_flattened());
        numbers::write(&gpu.queue, &numbers, root / ROW, words);
        numbers::write(&gpu.queue, &numbers, node_rows + first_triangle / ROW, bytemuck::cast_vec(others.triangles));
        let root = (root < first_record).then_some((root / NODE) as u32);
        let (roots, first_look) = ([NONE; 2], first_look as u32);
        let held = GpuBlockers {
            center: center.as_vec3(),
            unit: unit as f32,
            roots,
            first_look,
            first_triangle: (node_rows * ROW) as u32,
        };
        let blockers = TrackedBuffer::new(device, "blockers", bytemuck::bytes_of(&held), BufferUsages::UNIFORM);
        let alphas = alphas(gpu, &opacities.alphas);
        let view = numbers.create_view(&Default::default());
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("blockers"),
            layout,
            entries: &[
                entry(0, blockers.binding()),
                entry(1, wgpu::BindingResource::TextureView(&view)),
                entry(2, wgpu::BindingResource::TextureView(&alphas)),
            ],
        });
        let opacities = !opacities.records.is_empty();
        let places = Placed::new();
        let mut resident =
            Self { blockers, numbers, bind_group, held, opacities, root, room: emitting, first_record, placed: places };
        resident.replace_emitters(&gpu.queue, emitters, placed);
        Ok(resident)
    }

    fn replace_emitters(&mut self, queue: &Queue, mut emitters: Tree, placed: Placed) {
        emitters.place(0, 0, self.first_record);
        let moving = (!emitters.nodes.is_empty()).then_some(0);
        numbers::write(queue, &self.numbers, 0, bytemuck::cast_vec(emitters.nodes));
        numbers::write(
            queue,
            &self.numbers,
            self.held.first_triangle as usize / ROW,
            bytemuck::cast_vec(emitters.triangles),
        );
        self.held.roots = match (self.root, moving) {
            (Some(root), moving) => [root, moving.unwrap_or(NONE)],
            (None, moving) => [moving.unwrap_or(NONE), NONE],
        };
        self.blockers.write(queue, bytemuck::bytes_of(&self.held));
        self.placed = placed;
    }
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
    use wgpu::{BindingType, TextureSampleType, TextureViewDimension};
    let blockers =
        BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: None };
    let alphas = BindingType::Texture {
        sample_type: TextureSampleType::Float { filterable: false },
        view_dimension: TextureViewDimension::D2Array,
        multisampled: false,
    };
    let types = [blockers, numbers::binding(), alphas];
    let entry =
        |(binding, ty)| wgpu::BindGroupLayoutEntry { binding, visibility: ShaderStages::FRAGMENT, ty, count: None };
    let entries: Vec<wgpu::BindGroupLayoutEntry> = (0..).zip(types).map(entry).collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("blockers"), entries: &entries })
}

#[cfg(test)]
mod tests {
    use super::super::layout::{differences, members};
    use super::super::shader::SHADOWED_WGSL;
    use super::*;
    use crate::scene::{Edits, Material, Mesh, Scene};

    /// So many instances of a hundred thousand triangles, and so many materials that are blended.
    fn crowd(instances: usize, blended: usize) -> Scene {
        let mesh = Mesh { positions: vec![Vec3::ZERO], indices: vec![0; 3 * 100_000], ..Mesh::default() };
        let instance = Instance { name: String::new(), mesh: 0, world_from_mesh: Mat4::IDENTITY };
        let blend = Material { alpha_mode: AlphaMode::Blend, ..Material::matte("glass", Vec3::ONE) };
        let mut materials = vec![Material::matte("cloth", Vec3::ONE)];
        materials.extend(vec![blend; blended]);
        Scene { meshes: vec![mesh], instances: vec![instance; instances], materials, ..Scene::default() }
    }

    #[test]
    fn what_a_device_cannot_hold_is_said() {
        let limits = |side: usize| Limits { max_texture_dimension_2d: side as u32, ..Limits::default() };
        let said = |side: usize, scene: &Scene| lack(&limits(side), &Drawn::new(scene, &Edits::default()));
        let hint = |said: Option<String>, hint: &str| {
            assert!(said.as_ref().is_some_and(|said| said.contains(hint)), "{said:?}")
        };
        // A third of ROW x ROW texels: 22.4 million triangles.
        assert_eq!(said(ROW, &crowd(223, MOST_LOOKS)), None);
        hint(said(ROW, &crowd(224, 1)), "22400000 triangles cast shadows, of at most 22369621");
        assert_eq!(said(2 * ROW, &crowd(224, 1)), None);
        hint(said(ROW - 1, &crowd(1, 1)), "textures have 8191 texels a side");
        hint(said(ROW, &crowd(1, MOST_LOOKS + 1)), "65537 materials are cut out or blended");
        assert_eq!(lack_of_rows(&limits(ROW), [100, ROW]), None);
        hint(lack_of_rows(&limits(ROW), [100, ROW + 1]), "takes 8193 rows");
        assert_eq!(lack_of_rows(&limits(2 * ROW), [NODE_ROWS; 2]), None);
        hint(lack_of_rows(&limits(2 * ROW), [NODE_ROWS + 1; 2]), "takes 10241 rows");
    }

    #[test]
    fn trees_stand_as_the_shader_reads_them() {
        let members = members!(GpuBlockers { center, unit, roots, first_look, first_triangle });
        assert_eq!(differences(SHADOWED_WGSL, "Blockers", size_of::<GpuBlockers>(), members), [""; 0]);
    }
}
