//! The second pass: from radiance to what is shown or measured.

use bytemuck::{Pod, Zeroable};
use wgpu::{BindGroup, BindGroupLayout, CommandEncoder, Device, Queue, RenderPipeline, TextureFormat, TextureView};

use super::targets::{RadianceFormat, Targets};
use super::view::Rect;
use crate::picture::ToneCurve;

/// The pass' WGSL.
const DISPLAY_WGSL: &str = include_str!("../../shaders/passes/display.wgsl");

/// What the radiance is turned into.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Showing {
    /// sRGB, exposed and through the tone curve.
    Shown {
        /// In stops: radiance is multiplied by 2 to this power.
        exposure: f32,
        /// What maps exposed radiance to the screen's range.
        tone: ToneCurve,
    },
    /// Linear radiance: the mean of each pixel's samples.
    Measured,
}

/// `DisplayUniforms` of `display.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Uniforms {
    tone_curve: u32,
    padding: u32,
    origin: [u32; 2],
}

impl Showing {
    /// The factor that radiance is multiplied by.
    pub(super) fn gain(self) -> f32 {
        match self {
            Self::Shown { exposure, .. } => exposure.exp2(),
            Self::Measured => 1.0,
        }
    }
}

/// Draws a frame's radiance into an output of one format.
pub struct DisplayPass {
    pipeline: RenderPipeline,
    layout: BindGroupLayout,
    uniforms: wgpu::Buffer,
    radiance_binding: u32,
}

impl DisplayPass {
    /// The pass for `Showing::Measured` where `measured`, else for `Showing::Shown`.
    pub fn new(device: &Device, radiance: RadianceFormat, output: TextureFormat, measured: bool) -> Self {
        let shader = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("display"),
            source: wgpu::ShaderSource::Wgsl(DISPLAY_WGSL.into()),
        });
        let multisampled = radiance.samples > 1;
        let entry_point = match (measured, multisampled) {
            (false, false) => "display_shown_single",
            (false, true) => "display_shown_multisampled",
            (true, false) => "display_measured_single",
            (true, true) => "display_measured_multisampled",
        };
        let radiance_binding = if multisampled { 2 } else { 1 };
        let layout = bind_group_layout(device, radiance_binding, multisampled);
        let pipeline = pipeline(device, &shader, &layout, entry_point, output);
        let uniforms = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("display uniforms"),
            size: size_of::<Uniforms>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { pipeline, layout, uniforms, radiance_binding }
    }

    /// Shows the targets' radiance in the rectangle `place` of the output, which is at most of the targets' size. What
    /// lies around it becomes black.
    pub fn encode(
        &self,
        (device, queue): (&Device, &Queue),
        encoder: &mut CommandEncoder,
        targets: &Targets,
        (output, place): (&TextureView, Rect),
        showing: Showing,
    ) {
        let tone_curve = match showing {
            Showing::Shown { tone: ToneCurve::None, .. } | Showing::Measured => 0,
            Showing::Shown { tone: ToneCurve::Neutral, .. } => 1,
            Showing::Shown { tone: ToneCurve::Agx, .. } => 2,
        };
        let uniforms = Uniforms { tone_curve, padding: 0, origin: [place.x, place.y] };
        queue.write_buffer(&self.uniforms, 0, bytemuck::bytes_of(&uniforms));
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("display"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: output,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        });
        pass.set_scissor_rect(place.x, place.y, place.width, place.height);
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.bind_group(device, targets), &[]);
        pass.draw(0..3, 0..1);
    }

    fn bind_group(&self, device: &Device, targets: &Targets) -> BindGroup {
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("display"),
            layout: &self.layout,
            entries: &[
                entry(0, self.uniforms.as_entire_binding()),
                entry(self.radiance_binding, wgpu::BindingResource::TextureView(&targets.radiance)),
            ],
        })
    }
}

fn bind_group_layout(device: &Device, radiance_binding: u32, multisampled: bool) -> BindGroupLayout {
    let entry =
        |binding, ty| wgpu::BindGroupLayoutEntry { binding, visibility: wgpu::ShaderStages::FRAGMENT, ty, count: None };
    let uniforms = wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let radiance = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled,
    };
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("display"),
        entries: &[entry(0, uniforms), entry(radiance_binding, radiance)],
    })
}

fn pipeline(
    device: &Device,
    shader: &wgpu::ShaderModule,
    layout: &BindGroupLayout,
    entry_point: &str,
    output: TextureFormat,
) -> RenderPipeline {
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("display"),
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("display"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: shader,
            entry_point: Some("display_vertex"),
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: shader,
            entry_point: Some(entry_point),
            compilation_options: Default::default(),
            targets: &[Some(output.into())],
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
    fn the_uniforms_stand_as_the_shader_reads_them() {
        let members = members!(Uniforms { tone_curve, padding, origin });
        assert_eq!(differences(DISPLAY_WGSL, "DisplayUniforms", size_of::<Uniforms>(), members), [""; 0]);
    }
}
