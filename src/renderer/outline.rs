//! The outline of what is made of a material, over a picture that is shown: a mask of where it is seen, and a line along
//! the mask's border. What is opaque hides it; holes that are cut out do not count.

use std::collections::HashMap;

use bytemuck::{Pod, Zeroable};
use glam::Mat4;
use wgpu::util::{BufferInitDescriptor, DeviceExt};
use wgpu::{BindGroupLayout, Buffer, BufferUsages, CommandEncoder, Device, LoadOp, RenderPass, RenderPipeline};
use wgpu::{ShaderModule, TextureFormat, TextureUsages, TextureView, VertexBufferLayout, VertexFormat, VertexStepMode};

use super::calls::{Call, Draw, Source, split};
use super::device::Gpu;
use super::fullscreen;
use super::resident::Resident;
use super::shader::module;
use super::targets::{DEPTH_FORMAT, attachment};
use super::tracked_buffer::TrackedBuffer;
use super::view::{Rect, View};

/// The pass' WGSL.
pub(super) const OUTLINE_WGSL: &str = include_str!("../../shaders/passes/outline.wgsl");

/// A format that every device draws into.
const MASK: TextureFormat = TextureFormat::R8Unorm;

/// `OutlineUniforms` of `outline.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Uniforms {
    origin: [u32; 2],
}

/// What the vertex shader reads once an instance.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Placed {
    clip_from_mesh: Mat4,
    mark: f32,
    padding: [f32; 3],
}

/// Which faces are drawn.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct Faces {
    double_sided: bool,
    mirrored: bool,
}

/// Draws outlines into outputs of one format.
pub(super) struct OutlinePass {
    shader: ShaderModule,
    layout: BindGroupLayout,
    marks: HashMap<Faces, RenderPipeline>,
    line: RenderPipeline,
    uniforms: TrackedBuffer,
}

impl OutlinePass {
    pub fn new(device: &Device, output: TextureFormat) -> Self {
        let shader = module(device, "outline", OUTLINE_WGSL);
        let layout = fullscreen::layout(device, "outline", true, &[(1, false)]);
        let line = fullscreen::pipeline(device, (&layout, &shader), "outline_line", &[], &[output]);
        let uniforms = [0; size_of::<Uniforms>()];
        let uniforms = TrackedBuffer::new(device, "outline uniforms", &uniforms, BufferUsages::UNIFORM);
        Self { shader, layout, marks: HashMap::new(), line, uniforms }
    }

    /// Draws the outline of what is seen of a material's instances in the rectangle `place` of the output, with at most so
    /// many triangles in a pass. Everything else of the output stays.
    pub fn encode(
        &mut self,
        gpu: &Gpu,
        encoder: &mut CommandEncoder,
        (output, place): (&TextureView, Rect),
        (resident, view): (&Resident, &View),
        (material, triangles_a_pass): (usize, u32),
    ) {
        let mask = self.mask(
            &gpu.device,
            encoder,
            [place.width, place.height],
            (resident, view),
            (material, triangles_a_pass),
        );
        let Rect { x, y, width, height } = place;
        self.uniforms.write(&gpu.queue, bytemuck::bytes_of(&Uniforms { origin: [x, y] }));
        let uniforms = Some(self.uniforms.binding());
        let bind_group = fullscreen::bind_group(&gpu.device, &self.layout, uniforms, &[(1, &mask)]);
        let mut pass = begin(encoder, "outline", output, None, LoadOp::Load);
        pass.set_scissor_rect(x, y, width, height);
        pass.set_pipeline(&self.line);
        pass.set_bind_group(0, &bind_group, &[]);
        pass.draw(0..3, 0..1);
    }

    /// Where the material is seen.
    fn mask(
        &mut self,
        device: &Device,
        encoder: &mut CommandEncoder,
        size: [u32; 2],
        (resident, view): (&Resident, &View),
        (material, triangles_a_pass): (usize, u32),
    ) -> TextureView {
        let mask = attachment(device, "outline mask", (size, 1, MASK), TextureUsages::TEXTURE_BINDING);
        let depth = attachment(device, "outline depth", (size, 1, DEPTH_FORMAT), TextureUsages::empty());
        let placed = placed(device, resident, view, material);
        let counts = |blended: bool, of: usize| !blended || of == material;
        let batches = resident.draws.batches.iter().filter(|batch| counts(batch.variant.look.blend, batch.material));
        let draws = batches.map(|batch| {
            let indices = 0..resident.mesh(batch.mesh).index_count;
            Draw { batch, instances: batch.range.clone(), indices, source: Source::Mesh }
        });
        let calls = split(draws, triangles_a_pass);
        for Call { draw, .. } in &calls {
            let faces = faces(draw);
            self.marks.entry(faces).or_insert_with(|| mark_pipeline(device, &self.shader, faces));
        }
        // The first pass clears the targets, whatever there is to draw.
        let passes = calls.chunk_by(|one, next| one.pass == next.pass).chain(calls.is_empty().then_some(&[][..]));
        for (index, calls) in passes.enumerate() {
            let load = if index == 0 { LoadOp::Clear(wgpu::Color::BLACK) } else { LoadOp::Load };
            let mut pass = begin(encoder, "outline mask", &mask, Some(&depth), load);
            for Call { draw, .. } in calls {
                let mesh = resident.mesh(draw.batch.mesh);
                pass.set_pipeline(&self.marks[&faces(draw)]);
                pass.set_vertex_buffer(0, mesh.positions.slice(..));
                let first = u64::from(draw.instances.start) * size_of::<Placed>() as u64;
                pass.set_vertex_buffer(1, placed.slice(first..));
                pass.set_index_buffer(mesh.indices.slice(..), wgpu::IndexFormat::Uint32);
                pass.draw_indexed(draw.indices.clone(), 0, 0..draw.instances.len() as u32);
            }
        }
        mask
    }
}

/// All instances in the view, marked where they are of the material.
fn placed(device: &Device, resident: &Resident, view: &View, material: usize) -> Buffer {
    let clip_from_world = view.clip_from_world.as_dmat4();
    let placed = resident.draws.instances.iter().map(|instance| Placed {
        clip_from_mesh: (clip_from_world * instance.world_from_mesh.as_dmat4()).as_mat4(),
        mark: f32::from(u8::from(instance.material as usize == material)),
        padding: [0.0; 3],
    });
    device.create_buffer_init(&BufferInitDescriptor {
        label: Some("outline instances"),
        contents: bytemuck::cast_slice(&placed.collect::<Vec<_>>()),
        usage: BufferUsages::VERTEX,
    })
}

fn faces(draw: &Draw) -> Faces {
    let variant = &draw.batch.variant;
    Faces { double_sided: variant.look.double_sided, mirrored: variant.mirrored }
}

/// Marks what is nearest.
fn mark_pipeline(device: &Device, shader: &ShaderModule, faces: Faces) -> RenderPipeline {
    const POSITION: &[wgpu::VertexAttribute] = &wgpu::vertex_attr_array![0 => Float32x3];
    const PLACED: &[wgpu::VertexAttribute] =
        &wgpu::vertex_attr_array![1 => Float32x4, 2 => Float32x4, 3 => Float32x4, 4 => Float32x4, 5 => Float32];
    let buffer = |array_stride, step_mode, attributes| Some(VertexBufferLayout { array_stride, step_mode, attributes });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("outline mask"),
        layout: None,
        vertex: wgpu::VertexState {
            module: shader,
            entry_point: Some("outline_place"),
            compilation_options: Default::default(),
            buffers: &[
                buffer(VertexFormat::Float32x3.size(), VertexStepMode::Vertex, POSITION),
                buffer(size_of::<Placed>() as u64, VertexStepMode::Instance, PLACED),
            ],
        },
        primitive: wgpu::PrimitiveState {
            front_face: if faces.mirrored { wgpu::FrontFace::Cw } else { wgpu::FrontFace::Ccw },
            cull_mode: (!faces.double_sided).then_some(wgpu::Face::Back),
            ..Default::default()
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: shader,
            entry_point: Some("outline_mark"),
            compilation_options: Default::default(),
            targets: &[Some(MASK.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// Begins a pass over a target and, where there is one, its depth, which begins and ends with the mask's colours.
fn begin<'a>(
    encoder: &'a mut CommandEncoder,
    label: &str,
    view: &TextureView,
    depth: Option<&TextureView>,
    load: LoadOp<wgpu::Color>,
) -> RenderPass<'a> {
    let far = if matches!(load, LoadOp::Load) { LoadOp::Load } else { LoadOp::Clear(0.0) };
    let store = wgpu::StoreOp::Store;
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(label),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load, store },
        })],
        depth_stencil_attachment: depth.map(|view| wgpu::RenderPassDepthStencilAttachment {
            view,
            depth_ops: Some(wgpu::Operations { load: far, store }),
            stencil_ops: None,
        }),
        ..Default::default()
    })
}
