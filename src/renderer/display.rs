//! The second pass: from radiance to what is shown or measured.

use std::collections::HashMap;

use bytemuck::{Pod, Zeroable};
use wgpu::{BindGroup, BindGroupLayout, BufferUsages, CommandEncoder, Device, PipelineLayout, Queue, RenderPipeline};
use wgpu::{ShaderModule, TextureFormat, TextureView};

use super::targets::{RadianceFormat, Targets};
use super::tracked_buffer::TrackedBuffer;
use super::view::Rect;
use crate::picture::ToneCurve;

/// The pass' WGSL.
pub(super) const DISPLAY_WGSL: &str = include_str!("../../shaders/passes/display.wgsl");

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
    origin: [u32; 2],
    padding: [u32; 2],
}

impl Showing {
    /// The factor that radiance is multiplied by.
    pub(super) fn gain(self) -> f32 {
        match self {
            Self::Shown { exposure, .. } => exposure.exp2(),
            Self::Measured => 1.0,
        }
    }

    /// `DISPLAY_TONE_CURVE` of `display.wgsl`.
    fn tone_curve(self) -> u32 {
        match self {
            Self::Shown { tone: ToneCurve::None, .. } | Self::Measured => 0,
            Self::Shown { tone: ToneCurve::Neutral, .. } => 1,
            Self::Shown { tone: ToneCurve::Agx, .. } => 2,
        }
    }
}

/// Draws a frame's radiance into an output of one format.
pub struct DisplayPass {
    pipelines: Pipelines,
    /// By their tone curves, each made when it is first asked for.
    made: HashMap<u32, RenderPipeline>,
    layout: BindGroupLayout,
    uniforms: TrackedBuffer,
    radiance_binding: u32,
}

impl DisplayPass {
    /// The pass for `Showing::Measured` where `measured`, else for `Showing::Shown`.
    pub fn new(device: &Device, radiance: RadianceFormat, output: TextureFormat, measured: bool) -> Self {
        let multisampled = radiance.samples > 1;
        let radiance_binding = if multisampled { 2 } else { 1 };
        let layout = bind_group_layout(device, radiance_binding, multisampled);
        let pipelines = Pipelines::new(device, &layout, entry_point(measured, multisampled), output);
        let uniforms = [0; size_of::<Uniforms>()];
        let uniforms = TrackedBuffer::new(device, "display uniforms", &uniforms, BufferUsages::UNIFORM);
        Self { pipelines, made: HashMap::new(), layout, uniforms, radiance_binding }
    }

    /// How many pipelines there are.
    pub fn made(&self) -> usize {
        self.made.len()
    }

    /// Shows the targets' radiance in the rectangle `place` of the output, which is at most of the targets' size. What
    /// lies around it becomes black.
    pub fn encode(
        &mut self,
        (device, queue): (&Device, &Queue),
        encoder: &mut CommandEncoder,
        targets: &Targets,
        (output, place): (&TextureView, Rect),
        showing: Showing,
    ) {
        let uniforms = Uniforms { origin: [place.x, place.y], padding: [0; 2] };
        self.uniforms.write(queue, bytemuck::bytes_of(&uniforms));
        let bind_group = self.bind_group(device, targets);
        let tone_curve = showing.tone_curve();
        let pipeline = self.made.entry(tone_curve).or_insert_with(|| self.pipelines.make(device, tone_curve));
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
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &bind_group, &[]);
        pass.draw(0..3, 0..1);
    }

    fn bind_group(&self, device: &Device, targets: &Targets) -> BindGroup {
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("display"),
            layout: &self.layout,
            entries: &[
                entry(0, self.uniforms.binding()),
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

/// Of the fragment shader.
fn entry_point(measured: bool, multisampled: bool) -> &'static str {
    match (measured, multisampled) {
        (false, false) => "display_shown_single",
        (false, true) => "display_shown_multisampled",
        (true, false) => "display_measured_single",
        (true, true) => "display_measured_multisampled",
    }
}

/// What all pipelines of the pass have in common.
struct Pipelines {
    shader: ShaderModule,
    layout: PipelineLayout,
    entry_point: &'static str,
    output: TextureFormat,
}

impl Pipelines {
    fn new(device: &Device, layout: &BindGroupLayout, entry_point: &'static str, output: TextureFormat) -> Self {
        let shader = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("display"),
            source: wgpu::ShaderSource::Wgsl(DISPLAY_WGSL.into()),
        });
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("display"),
            bind_group_layouts: &[Some(layout)],
            immediate_size: 0,
        });
        Self { shader, layout, entry_point, output }
    }

    /// The pipeline of a tone curve, as `DISPLAY_TONE_CURVE` counts.
    fn make(&self, device: &Device, tone_curve: u32) -> RenderPipeline {
        let constants = [("DISPLAY_TONE_CURVE", f64::from(tone_curve))];
        let compilation_options = wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("display"),
            layout: Some(&self.layout),
            vertex: wgpu::VertexState {
                module: &self.shader,
                entry_point: Some("display_vertex"),
                compilation_options: compilation_options.clone(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &self.shader,
                entry_point: Some(self.entry_point),
                compilation_options,
                targets: &[Some(self.output.into())],
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::layout::{differences, members};
    use super::*;

    #[test]
    fn the_uniforms_stand_as_the_shader_reads_them() {
        let members = members!(Uniforms { origin, padding });
        assert_eq!(differences(DISPLAY_WGSL, "DisplayUniforms", size_of::<Uniforms>(), members), [""; 0]);
    }
}
