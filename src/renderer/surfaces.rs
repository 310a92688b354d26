//! The first pass: every surface's radiance into the targets.

use std::collections::HashMap;
use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec3, Vec4};
use wgpu::{BindGroup, BindGroupLayout, BufferUsages, Device, Face, Queue, RenderPass, RenderPipeline, TextureView};

use super::Gpu;
use super::blended::Blended;
use super::calls::{Call, Draw, Source, split};
use super::draws::{Batch, Frustum, Variant};
use super::pipelines::{Pipelines, Shaders, Stage};
use super::prior_sheens::PriorAlbedos;
use super::resident::{MeshBuffers, Resident};
use super::sample::Sample;
use super::targets::{RadianceFormat, ShadowedTargets, Targets};
use super::tracked_buffer::TrackedBuffer;
use super::view::View;
use super::{numbers, shadows, tables};
use crate::scene::Settings;
use crate::table::SheenTable;

/// `Frame` of `frame.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Frame {
    clip_from_world: Mat4,
    eye: Vec4,
    diffuse: f32,
    specular: f32,
    sheen: f32,
    emission: f32,
    origin: Vec3,
    first_light: u32,
    ambient: Vec3,
    gain: f32,
    sample: u32,
    footprint: f32,
    seed: u32,
    first_vertex: u32,
}

/// Draws a scene's surfaces.
pub struct SurfacesPass {
    layout: BindGroupLayout,
    made: HashMap<(Variant, Stage), RenderPipeline>,
    /// Of what stands in the way of light.
    pub blockers_layout: BindGroupLayout,
    pipelines: Pipelines,
    frame: TrackedBuffer,
    albedos: PriorAlbedos,
    /// The tables of the sheen, of the specular base, and of the albedos of the other sheens.
    tables: [TextureView; 3],
    bind_group: BindGroup,
    /// Most that a pass draws.
    pub(super) triangles_a_pass: u32,
}

impl SurfacesPass {
    pub(super) fn new(
        gpu: &Gpu,
        (radiance, guide): (RadianceFormat, Option<wgpu::TextureFormat>),
        table: &SheenTable,
        resident: &Resident,
    ) -> Self {
        let device = &gpu.device;
        let frame = [0; size_of::<Frame>()];
        let frame = TrackedBuffer::new(device, "surfaces frame", &frame, BufferUsages::UNIFORM);
        let layout = bind_group_layout(device);
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("surfaces"),
            bind_group_layouts: &[Some(&layout), Some(&resident.material_layout)],
            immediate_size: 0,
        });
        let blockers_layout = shadows::bind_group_layout(device);
        let shadowed_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("surfaces with shadows"),
            bind_group_layouts: &[Some(&layout), Some(&resident.material_layout), Some(&blockers_layout)],
            immediate_size: 0,
        });
        let albedos = PriorAlbedos::new(device);
        let tables = [tables::sheen(gpu, table), tables::ggx(gpu), albedos.view()];
        let bind_group = bind_group(device, &layout, (&frame, &tables), resident);
        let pipelines =
            Pipelines { shaders: Shaders::default(), layout: pipeline_layout, shadowed_layout, radiance, guide };
        let triangles_a_pass = if gpu.is_software() { TRIANGLES_A_PASS } else { u32::MAX };
        let made = HashMap::new();
        Self { layout, made, blockers_layout, pipelines, frame, albedos, tables, bind_group, triangles_a_pass }
    }

    /// Makes what the scene needs for these stages and does not have yet: pipelines, and the table of the other sheens' albedos.
    pub(super) fn prepare(&mut self, gpu: &Gpu, resident: &Resident, stages: &[Stage]) {
        if resident.draws.samples_lights() {
            self.albedos.fill(gpu, self.pipelines.shaders.surfaces(&gpu.device));
        }
        for (batch, stage) in needed(resident, stages) {
            let culled = (!batch.variant.look.double_sided).then_some(Face::Back);
            let make = || self.pipelines.make(&gpu.device, &batch.variant, stage, culled);
            self.made.entry((batch.variant, stage)).or_insert_with(make);
        }
    }

    /// Whether there is something to be made for these stages.
    pub(super) fn lacks(&self, resident: &Resident, stages: &[Stage]) -> bool {
        needed(resident, stages).any(|(batch, stage)| !self.made.contains_key(&(batch.variant, stage)))
    }

    /// How many pipelines there are.
    pub(super) fn made(&self) -> usize {
        self.made.len()
    }

    /// Binds what was made anew.
    pub(super) fn rebind(&mut self, device: &Device, resident: &Resident) {
        self.bind_group = bind_group(device, &self.layout, (&self.frame, &self.tables), resident);
    }

    /// Draws everything, with nothing in the way of light.
    pub(super) fn encode(
        &mut self,
        queue: &Queue,
        encoder: &mut wgpu::CommandEncoder,
        targets: &Targets,
        things: (&Resident, &Blended),
        (view, settings, gain): (&View, &Settings, f32),
    ) {
        self.write_frame(queue, things.0.first, (view, settings, gain), &Sample::FIRST);
        let (opaque, blended) = self.draws(things, view);
        let calls = split(opaque.into_iter().chain(blended), self.triangles_a_pass);
        let colors = [Some(&targets.radiance)];
        self.run(encoder, things, (&calls, Stage::Unshadowed, None), (&colors, &targets.depth, [true; 2]), None);
    }

    /// Draws one of each pixel's samples in these rows: depth first, in all rows with the first ones, so that what is hidden traces
    /// no rays; then what is seen, and what of it is blocked by what is bound as `blockers`.
    pub(super) fn encode_shadowed(
        &mut self,
        queue: &Queue,
        encoder: &mut wgpu::CommandEncoder,
        (targets, stage, blockers): (&ShadowedTargets, Stage, &BindGroup),
        things: (&Resident, &Blended),
        (view, settings, gain, sample): (&View, &Settings, f32, &Sample),
        rows: &Range<u32>,
    ) {
        let view = view.shifted(sample.offset(), targets.size);
        self.write_frame(queue, things.0.first, (&view, settings, gain), sample);
        let (opaque, blended) = self.draws(things, &view);
        let is_first = rows.start == 0;
        if is_first {
            let calls = split(opaque.iter().cloned(), self.triangles_a_pass);
            self.run(encoder, things, (&calls, Stage::Depth, None), (&[], &targets.depth, [true; 2]), None);
        }
        // Where two surfaces are equally near, the first is seen, also of those that are drawn where depth is equal.
        let calls = split(opaque.into_iter().rev().chain(blended), self.triangles_a_pass);
        let colors = [Some(&targets.radiance), Some(&targets.blocked), targets.guide.as_ref()];
        let colors = &colors[..if targets.guide.is_some() { 3 } else { 2 }];
        let part = Some([0, rows.start, targets.size[0], rows.end - rows.start]);
        self.run(encoder, things, (&calls, stage, Some(blockers)), (colors, &targets.depth, [is_first, false]), part);
    }

    fn write_frame(
        &mut self,
        queue: &Queue,
        [first_light, first_vertex]: [u32; 2],
        (view, settings, gain): (&View, &Settings, f32),
        sample: &Sample,
    ) {
        let weight = |on: bool| f32::from(u8::from(on));
        let lobes = settings.lobes;
        let frame = Frame {
            clip_from_world: view.clip_from_world,
            eye: view.eye,
            diffuse: weight(lobes.diffuse),
            specular: weight(lobes.specular),
            sheen: weight(lobes.sheen),
            emission: weight(lobes.emission),
            origin: view.origin,
            first_light,
            ambient: settings.ambient,
            gain,
            sample: sample.index,
            footprint: sample.footprint(),
            seed: sample.seed,
            first_vertex,
        };
        self.frame.write(queue, bytemuck::bytes_of(&frame));
    }

    /// What the view sees that is opaque, and what is blended.
    fn draws<'a>(
        &self,
        (resident, blended): (&'a Resident, &'a Blended),
        view: &View,
    ) -> (Vec<Draw<'a>>, impl Iterator<Item = Draw<'a>> + use<'a>) {
        let frustum = Frustum::new(view.clip_from_world, view.eye);
        let opaque = resident.draws.opaque(&frustum).map(|(batch, instances)| {
            let indices = 0..resident.mesh(batch.mesh).index_count;
            Draw { batch, instances, indices, source: Source::Mesh }
        });
        (opaque.collect(), blended.draws(resident))
    }

    /// Makes these calls over the targets, or over a part of them: x, y, width and height. Their colours and their depth are cleared
    /// first where that is asked for, all over.
    fn run(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        things: (&Resident, &Blended),
        (calls, stage, blockers): (&[Call], Stage, Option<&BindGroup>),
        (colors, depth, clears): (&[Option<&TextureView>], &TextureView, [bool; 2]),
        part: Option<[u32; 4]>,
    ) {
        // The first pass clears the targets, whatever there is to draw.
        let passes = calls.chunk_by(|one, next| one.pass == next.pass).chain(calls.is_empty().then_some(&[][..]));
        for (index, calls) in passes.enumerate() {
            let mut pass = begin(encoder, colors, depth, clears.map(|clears| clears && index == 0));
            if let Some([x, y, width, height]) = part {
                pass.set_scissor_rect(x, y, width, height);
            }
            pass.set_bind_group(0, &self.bind_group, &[]);
            if let Some(blockers) = blockers {
                pass.set_bind_group(2, blockers, &[]);
            }
            let mut before = None;
            for Call { draw, .. } in calls {
                self.bind(&mut pass, things, (draw, before.replace(draw)), stage);
                pass.draw_indexed(draw.indices.clone(), 0, draw.instances.clone());
            }
        }
    }

    /// Sets what a call needs and the one before it in the pass did not: of blended triangles there may be many calls.
    fn bind(
        &self,
        pass: &mut RenderPass,
        (resident, blended): (&Resident, &Blended),
        (draw, before): (&Draw, Option<&Draw>),
        stage: Stage,
    ) {
        let mesh = resident.mesh(draw.batch.mesh);
        let is_same_batch = before.is_some_and(|before| std::ptr::eq(before.batch, draw.batch));
        if !is_same_batch {
            pass.set_bind_group(1, resident.textures(draw.batch), &[]);
            bind_vertices(pass, mesh, &resident.constants, &draw.batch.variant);
            pass.set_pipeline(&self.made[&(draw.batch.variant, stage)]);
        }
        let is_same_source = before.is_some_and(|before| before.source == draw.source);
        if !(is_same_source && (is_same_batch || draw.source == Source::Sorted)) {
            let sorted = blended.indices().filter(|_| draw.source == Source::Sorted);
            pass.set_index_buffer(sorted.unwrap_or(&mesh.indices).slice(..), wgpu::IndexFormat::Uint32);
        }
    }
}

/// What is drawn in these stages: of what is blended there is no depth.
fn needed<'a>(resident: &'a Resident, stages: &'a [Stage]) -> impl Iterator<Item = (&'a Batch, Stage)> {
    let drawn = |batch: &Batch, stage| stage != Stage::Depth || !batch.variant.look.blend;
    let stages_of =
        move |batch| stages.iter().filter(move |stage| drawn(batch, **stage)).map(move |stage| (batch, *stage));
    resident.draws.batches.iter().flat_map(stages_of)
}

/// Most triangles that a pass draws on software drivers, which first sort them into tiles and keep 70 bytes for each
/// until the pass ends.
const TRIANGLES_A_PASS: u32 = 1 << 16;

/// Begins a pass over targets, whose colours and whose depth are cleared first or keep what they hold.
fn begin<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    colors: &[Option<&'a TextureView>],
    depth: &'a TextureView,
    [clears_colors, clears_depth]: [bool; 2],
) -> RenderPass<'a> {
    let color = if clears_colors { wgpu::LoadOp::Clear(wgpu::Color::BLACK) } else { wgpu::LoadOp::Load };
    let far = if clears_depth { wgpu::LoadOp::Clear(0.0) } else { wgpu::LoadOp::Load };
    let attachment = |view: &Option<&'a TextureView>| {
        view.map(|view| wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: color, store: wgpu::StoreOp::Store },
        })
    };
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("surfaces"),
        color_attachments: &colors.iter().map(attachment).collect::<Vec<_>>(),
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: depth,
            depth_ops: Some(wgpu::Operations { load: far, store: wgpu::StoreOp::Store }),
            stencil_ops: None,
        }),
        ..Default::default()
    })
}

fn bind_vertices(pass: &mut RenderPass, mesh: &MeshBuffers, constants: &wgpu::Buffer, variant: &Variant) {
    pass.set_vertex_buffer(0, mesh.positions.slice(..));
    pass.set_vertex_buffer(1, mesh.normals.slice(..));
    if variant.attributes.any {
        let [first, second] = &mesh.tex_coords;
        for (slot, buffer) in (2..).zip([&mesh.tangents, first, second]) {
            pass.set_vertex_buffer(slot, buffer.as_ref().map_or(constants.slice(..16), |buffer| buffer.slice(..)));
        }
        pass.set_vertex_buffer(5, mesh.colors.as_ref().map_or(constants.slice(16..), |buffer| buffer.slice(..)));
    }
}

fn bind_group_layout(device: &Device) -> BindGroupLayout {
    use wgpu::{BindingType, BufferBindingType, ShaderStages};
    let buffer = |ty| BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    let storage = buffer(BufferBindingType::Storage { read_only: true });
    let uniform = buffer(BufferBindingType::Uniform);
    let texture = |sample_type| BindingType::Texture {
        sample_type,
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let table = texture(wgpu::TextureSampleType::Float { filterable: false });
    let entry = |binding, visibility, ty| wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None };
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("surfaces"),
        entries: &[
            entry(0, ShaderStages::VERTEX_FRAGMENT, uniform),
            entry(1, ShaderStages::FRAGMENT, table),
            entry(2, ShaderStages::FRAGMENT, table),
            entry(3, ShaderStages::VERTEX, storage),
            entry(4, ShaderStages::FRAGMENT, numbers::binding()),
            entry(5, ShaderStages::FRAGMENT, uniform),
            entry(6, ShaderStages::FRAGMENT, storage),
            entry(7, ShaderStages::FRAGMENT, storage),
            entry(8, ShaderStages::FRAGMENT, texture(wgpu::TextureSampleType::Uint)),
            entry(9, ShaderStages::FRAGMENT, storage),
            entry(10, ShaderStages::FRAGMENT, storage),
        ],
    })
}

fn bind_group(
    device: &Device,
    layout: &BindGroupLayout,
    (frame, [sheen, ggx, albedos]): (&TrackedBuffer, &[TextureView; 3]),
    resident: &Resident,
) -> BindGroup {
    let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("surfaces"),
        layout,
        entries: &[
            entry(0, frame.binding()),
            entry(1, wgpu::BindingResource::TextureView(sheen)),
            entry(2, wgpu::BindingResource::TextureView(ggx)),
            entry(3, resident.instances.binding()),
            entry(4, resident.numbers.binding()),
            entry(5, resident.counts.binding()),
            entry(6, resident.punctual.binding()),
            entry(7, resident.light_points.binding()),
            entry(8, wgpu::BindingResource::TextureView(albedos)),
            entry(9, resident.sheets.binding()),
            entry(10, resident.pattern_texels.binding()),
        ],
    })
}

#[cfg(test)]
mod tests {
    use super::super::layout::{differences, members};
    use super::super::shader::SURFACES_WGSL;
    use super::*;

    #[test]
    fn the_frame_stands_as_the_shader_reads_it() {
        let members = members!(Frame {
            clip_from_world,
            eye,
            diffuse,
            specular,
            sheen,
            emission,
            origin,
            first_light,
            ambient,
            gain,
            sample,
            footprint,
            seed,
            first_vertex
        });
        assert_eq!(differences(SURFACES_WGSL, "Frame", size_of::<Frame>(), members), [""; 0]);
    }
}
