//! A picture over another number of pixels than it has.

use bytemuck::{Pod, Zeroable};
use wgpu::{BindGroupLayout, BindingResource, BufferUsages, CommandEncoder, Device, Queue, RenderPipeline, Sampler};
use wgpu::{TextureFormat, TextureUsages, TextureView};

use super::fullscreen;
use super::shader::module;
use super::targets::attachment;
use super::tracked_buffer::TrackedBuffer;
use super::view::Rect;

/// The pass' WGSL.
pub(super) const ENLARGEMENT_WGSL: &str = include_str!("../../shaders/passes/enlargement.wgsl");

/// `EnlargementUniforms` of `enlargement.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Uniforms {
    origin: [f32; 2],
    size: [f32; 2],
}

/// Shows a picture of its own, which has the output's format, in another size.
pub(super) struct Enlargement {
    layout: BindGroupLayout,
    pipeline: RenderPipeline,
    sampler: Sampler,
    uniforms: TrackedBuffer,
    output: TextureFormat,
    picture: Option<([u32; 2], TextureView)>,
}

impl Enlargement {
    /// `output` is a format that can be filtered.
    pub fn new(device: &Device, output: TextureFormat) -> Self {
        let layout = layout(device);
        let shader = module(device, "enlargement", ENLARGEMENT_WGSL);
        let pipeline = fullscreen::pipeline(device, (&layout, &shader), "enlargement_fragment", &[], &[output]);
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        });
        let uniforms = TrackedBuffer::new(device, "enlargement", &[0; size_of::<Uniforms>()], BufferUsages::UNIFORM);
        Self { layout, pipeline, sampler, uniforms, output, picture: None }
    }

    /// What is to be drawn before `encode`: the picture, of this size in pixels, which holds what it did if it had that size already.
    pub fn picture(&mut self, device: &Device, size: [u32; 2]) -> TextureView {
        let picture = self.picture.take().filter(|(held, _)| *held == size).unwrap_or_else(|| {
            let view = attachment(device, "coarse picture", (size, 1, self.output), TextureUsages::TEXTURE_BINDING);
            (size, view)
        });
        self.picture.insert(picture).1.clone()
    }

    /// Shows the picture in the rectangle `place` of the output. What lies around it becomes black.
    pub fn encode(
        &mut self,
        (device, queue): (&Device, &Queue),
        encoder: &mut CommandEncoder,
        picture: &TextureView,
        (output, place): (&TextureView, Rect),
    ) {
        let Rect { x, y, width, height } = place;
        let uniforms = Uniforms { origin: [x as f32, y as f32], size: [width as f32, height as f32] };
        self.uniforms.write(queue, bytemuck::bytes_of(&uniforms));
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("enlargement"),
            layout: &self.layout,
            entries: &[
                entry(0, self.uniforms.binding()),
                entry(1, BindingResource::TextureView(picture)),
                entry(2, BindingResource::Sampler(&self.sampler)),
            ],
        });
        fullscreen::run(encoder, (&self.pipeline, &bind_group), &[output], Some([x, y, width, height]));
    }
}

fn layout(device: &Device) -> BindGroupLayout {
    use wgpu::{BindingType, BufferBindingType, SamplerBindingType, TextureSampleType, TextureViewDimension};
    let entry =
        |binding, ty| wgpu::BindGroupLayoutEntry { binding, visibility: wgpu::ShaderStages::FRAGMENT, ty, count: None };
    let uniforms =
        BindingType::Buffer { ty: BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: None };
    let picture = BindingType::Texture {
        sample_type: TextureSampleType::Float { filterable: true },
        view_dimension: TextureViewDimension::D2,
        multisampled: false,
    };
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("enlargement"),
        entries: &[
            entry(0, uniforms),
            entry(1, picture),
            entry(2, BindingType::Sampler(SamplerBindingType::Filtering)),
        ],
    })
}

#[cfg(test)]
mod tests {
    use super::super::layout::{differences, members};
    use super::*;

    #[test]
    fn the_uniforms_stand_as_the_shader_reads_them() {
        let members = members!(Uniforms { origin, size });
        assert_eq!(differences(ENLARGEMENT_WGSL, "EnlargementUniforms", size_of::<Uniforms>(), members), [""; 0]);
    }
}
