//! Passes that go over each pixel of their targets once.

use wgpu::{BindGroup, BindGroupLayout, CommandEncoder, Device, LoadOp, RenderPipeline, ShaderModule};
use wgpu::{TextureFormat, TextureView};

use super::shader::module;

/// The WGSL of their vertices.
pub(super) const FULLSCREEN_WGSL: &str = include_str!("../../shaders/passes/fullscreen.wgsl");

/// A layout for the fragment stage: a uniform where there is one, at 0; then textures that are not filtered, at these bindings, multisampled
/// or not.
pub(super) fn layout(device: &Device, label: &str, uniform: bool, textures: &[(u32, bool)]) -> BindGroupLayout {
    let entry =
        |binding, ty| wgpu::BindGroupLayoutEntry { binding, visibility: wgpu::ShaderStages::FRAGMENT, ty, count: None };
    let uniforms = wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let texture = |multisampled| wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled,
    };
    let uniform = uniform.then(|| entry(0, uniforms));
    let textures = textures.iter().map(|&(binding, multisampled)| entry(binding, texture(multisampled)));
    let entries: Vec<wgpu::BindGroupLayoutEntry> = uniform.into_iter().chain(textures).collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries })
}

/// What is bound for such a layout.
pub(super) fn bind_group(
    device: &Device,
    layout: &BindGroupLayout,
    uniform: Option<wgpu::BindingResource>,
    textures: &[(u32, &TextureView)],
) -> BindGroup {
    let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
    let uniform = uniform.map(|resource| entry(0, resource));
    let textures = textures.iter().map(|&(binding, view)| entry(binding, wgpu::BindingResource::TextureView(view)));
    let entries: Vec<wgpu::BindGroupEntry> = uniform.into_iter().chain(textures).collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries })
}

/// A pipeline for targets of these formats, of a module's entry point for fragments.
pub(super) fn pipeline(
    device: &Device,
    (layout, shader): (&BindGroupLayout, &ShaderModule),
    fragment: &str,
    constants: &[(&str, f64)],
    formats: &[TextureFormat],
) -> RenderPipeline {
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(fragment),
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    });
    let compilation_options = wgpu::PipelineCompilationOptions { constants, ..Default::default() };
    let targets: Vec<Option<wgpu::ColorTargetState>> = formats.iter().map(|&format| Some(format.into())).collect();
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(fragment),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module(device, "fullscreen", FULLSCREEN_WGSL),
            entry_point: Some("fullscreen_vertex"),
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: shader,
            entry_point: Some(fragment),
            compilation_options,
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// Runs it over all of the targets, or over a part: x, y, width and height. Around a part they become black.
pub(super) fn run(
    encoder: &mut CommandEncoder,
    (pipeline, bind_group): (&RenderPipeline, &BindGroup),
    targets: &[&TextureView],
    part: Option<[u32; 4]>,
) {
    let attachment = |view| {
        Some(wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
        })
    };
    let attachments: Vec<_> = targets.iter().map(|view| attachment(view)).collect();
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("fullscreen"),
        color_attachments: &attachments,
        ..Default::default()
    });
    if let Some([x, y, width, height]) = part {
        pass.set_scissor_rect(x, y, width, height);
    }
    pass.set_pipeline(pipeline);
    pass.set_bind_group(0, bind_group, &[]);
    pass.draw(0..3, 0..1);
}
