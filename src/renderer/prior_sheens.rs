//! The albedos of prior work's sheens, summed up on the device once they are needed.

use wgpu::{Device, RenderPipeline, ShaderModule, Texture, TextureFormat, TextureView};

use super::Gpu;

/// `PRIOR_SHEENS_NODES` of `prior_sheens.wgsl`: nodes of the table, for each model along both axes.
pub(super) const NODES: u32 = 64;
/// Number of models in the table.
const MODELS: u32 = 4;
/// The bits of floats: OpenGL adapters are there that draw no 32-bit floats.
const FORMAT: TextureFormat = TextureFormat::R32Uint;

/// The table that `prior_sheens.wgsl` looks up: logarithms of albedos.
pub(super) struct PriorAlbedos {
    texture: Texture,
    is_filled: bool,
}

impl PriorAlbedos {
    /// The table, not filled yet.
    pub fn new(device: &Device) -> Self {
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("prior sheens' albedos"),
            size: wgpu::Extent3d { width: NODES, height: MODELS * NODES, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: FORMAT,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        });
        Self { texture, is_filled: false }
    }

    pub fn view(&self) -> TextureView {
        self.texture.create_view(&wgpu::TextureViewDescriptor::default())
    }

    /// Draws the table, unless that has been done.
    pub fn fill(&mut self, gpu: &Gpu, shader: &ShaderModule) {
        if self.is_filled {
            return;
        }
        let pipeline = pipeline(&gpu.device, shader);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("prior sheens' albedos"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.view(),
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        });
        pass.set_pipeline(&pipeline);
        pass.draw(0..3, 0..1);
        drop(pass);
        gpu.queue.submit([encoder.finish()]);
        self.is_filled = true;
    }
}

fn pipeline(device: &Device, shader: &ShaderModule) -> RenderPipeline {
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("prior sheens' albedos"),
        bind_group_layouts: &[],
        immediate_size: 0,
    });
    let constants = [("PRIOR_SHEENS_NODES", f64::from(NODES))];
    let compilation_options = wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("prior sheens' albedos"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: shader,
            entry_point: Some("prior_albedos_vertex"),
            compilation_options: compilation_options.clone(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: shader,
            entry_point: Some("prior_albedos_fragment"),
            compilation_options,
            targets: &[Some(FORMAT.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}
