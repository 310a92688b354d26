//! The first pass: every surface's radiance into the targets.

use std::collections::HashMap;

use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec3, Vec4};
use wgpu::util::DeviceExt;
use wgpu::{BindGroup, BindGroupLayout, CommandEncoder, Device, Queue, RenderPipeline};

use super::resident::{Facing, GpuVertex, Resident};
use super::targets::{DEPTH_FORMAT, RadianceFormat, Targets};
use super::view::View;
use crate::scene::Settings;
use crate::table::LtcTable;

/// The pass' WGSL: the files that engines copy, and this program's own entry points.
pub const SURFACES_WGSL: &str = concat!(
    include_str!("../../shaders/ltc.wgsl"),
    include_str!("../../shaders/sheen.wgsl"),
    include_str!("../../shaders/passes/surfaces.wgsl"),
);

/// `SurfacesFrame` of `surfaces.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Frame {
    clip_from_world: Mat4,
    eye: Vec4,
    lobes: Vec3,
    polygon_count: u32,
    gain: f32,
    padding: [u32; 3],
}

/// Draws a scene's surfaces.
pub struct SurfacesPass {
    layout: BindGroupLayout,
    pipelines: HashMap<Facing, RenderPipeline>,
    shader: wgpu::ShaderModule,
    radiance: RadianceFormat,
    frame: wgpu::Buffer,
    bind_group: BindGroup,
}

impl SurfacesPass {
    pub(super) fn new(
        device: &Device,
        queue: &Queue,
        radiance: RadianceFormat,
        table: &LtcTable,
        resident: &Resident,
    ) -> Self {
        let shader = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("surfaces"),
            source: wgpu::ShaderSource::Wgsl(SURFACES_WGSL.into()),
        });
        let frame = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("surfaces frame"),
            size: size_of::<Frame>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let layout = bind_group_layout(device);
        let sheen_table = table_texture(device, queue, table);
        let bind_group = bind_group(device, &layout, &frame, &sheen_table, resident);
        let mut pass = Self { layout, pipelines: HashMap::new(), shader, radiance, frame, bind_group };
        pass.prepare(device, resident);
        pass
    }

    /// Makes the pipelines that the scene needs and that are not there yet.
    pub(super) fn prepare(&mut self, device: &Device, resident: &Resident) {
        for batch in &resident.batches {
            let make = || pipeline(device, &self.shader, &self.layout, self.radiance, batch.facing);
            self.pipelines.entry(batch.facing).or_insert_with(make);
        }
    }

    pub(super) fn encode(
        &self,
        queue: &Queue,
        encoder: &mut CommandEncoder,
        targets: &Targets,
        resident: &Resident,
        (view, settings, gain): (&View, &Settings, f32),
    ) {
        let weight = |on: bool| f32::from(u8::from(on));
        let lobes = settings.lobes;
        let frame = Frame {
            clip_from_world: view.clip_from_world,
            eye: view.eye,
            lobes: Vec3::new(weight(lobes.sheen), weight(lobes.diffuse), weight(lobes.emission)),
            polygon_count: resident.polygon_count,
            gain,
            padding: [0; 3],
        };
        queue.write_buffer(&self.frame, 0, bytemuck::bytes_of(&frame));
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("surfaces"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &targets.radiance,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &targets.depth,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_bind_group(0, &self.bind_group, &[]);
        for batch in &resident.batches {
            let mesh = &resident.meshes[batch.mesh];
            pass.set_pipeline(&self.pipelines[&batch.facing]);
            pass.set_vertex_buffer(0, mesh.vertices.slice(..));
            pass.set_index_buffer(mesh.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..mesh.index_count, 0, batch.first..batch.first + batch.count);
        }
    }
}

/// The sheen's table at the full precision of its file; it is read without a sampler.
fn table_texture(device: &Device, queue: &Queue, table: &LtcTable) -> wgpu::TextureView {
    let [alphas, mus] = table.size();
    let descriptor = wgpu::TextureDescriptor {
        label: Some("sheen table"),
        size: wgpu::Extent3d { width: alphas as u32, height: mus as u32, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba32Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    let texels = table.texels();
    let order = wgpu::util::TextureDataOrder::LayerMajor;
    let texture = device.create_texture_with_data(queue, &descriptor, order, bytemuck::cast_slice(&texels));
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

fn bind_group_layout(device: &Device) -> BindGroupLayout {
    use wgpu::{BindingType, BufferBindingType, ShaderStages};
    let buffer = |ty| BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    let storage = buffer(BufferBindingType::Storage { read_only: true });
    let table = BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let entry = |binding, visibility, ty| wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None };
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("surfaces"),
        entries: &[
            entry(0, ShaderStages::VERTEX_FRAGMENT, buffer(BufferBindingType::Uniform)),
            entry(1, ShaderStages::FRAGMENT, table),
            entry(2, ShaderStages::VERTEX, storage),
            entry(3, ShaderStages::FRAGMENT, storage),
            entry(4, ShaderStages::FRAGMENT, storage),
            entry(5, ShaderStages::FRAGMENT, storage),
        ],
    })
}

fn bind_group(
    device: &Device,
    layout: &BindGroupLayout,
    frame: &wgpu::Buffer,
    sheen_table: &wgpu::TextureView,
    resident: &Resident,
) -> BindGroup {
    let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("surfaces"),
        layout,
        entries: &[
            entry(0, frame.as_entire_binding()),
            entry(1, wgpu::BindingResource::TextureView(sheen_table)),
            entry(2, resident.instances.as_entire_binding()),
            entry(3, resident.materials.as_entire_binding()),
            entry(4, resident.polygons.as_entire_binding()),
            entry(5, resident.light_vertices.as_entire_binding()),
        ],
    })
}

fn pipeline(
    device: &Device,
    shader: &wgpu::ShaderModule,
    layout: &BindGroupLayout,
    radiance: RadianceFormat,
    facing: Facing,
) -> RenderPipeline {
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("surfaces"),
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("surfaces"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: shader,
            entry_point: Some("surfaces_vertex"),
            compilation_options: Default::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: size_of::<GpuVertex>() as u64,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3],
            })],
        },
        primitive: wgpu::PrimitiveState {
            front_face: if facing.mirrored { wgpu::FrontFace::Cw } else { wgpu::FrontFace::Ccw },
            cull_mode: (!facing.double_sided).then_some(wgpu::Face::Back),
            ..Default::default()
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: wgpu::MultisampleState { count: radiance.samples, ..Default::default() },
        fragment: Some(wgpu::FragmentState {
            module: shader,
            entry_point: Some("surfaces_fragment"),
            compilation_options: Default::default(),
            targets: &[Some(radiance.texture.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

#[cfg(test)]
mod tests {
    use super::super::layout::{differences, members};
    use super::*;

    #[test]
    fn the_frame_stands_as_the_shader_reads_it() {
        let members = members!(Frame { clip_from_world, eye, lobes, polygon_count, gain });
        assert_eq!(differences(SURFACES_WGSL, "SurfacesFrame", size_of::<Frame>(), members), [""; 0]);
    }
}
