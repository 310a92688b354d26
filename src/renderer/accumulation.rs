//! The third pass of a frame with shadows: means over samples.

use bytemuck::{Pod, Zeroable};
use wgpu::{BindGroupLayout, BufferUsages, CommandEncoder, Device, Queue, RenderPipeline, TextureFormat};
use wgpu::{TextureUsages, TextureView};

use super::fullscreen;
use super::shader::module;
use super::targets::{ShadowedTargets, attachment};
use super::tracked_buffer::TrackedBuffer;

/// The pass' WGSL.
pub(super) const ACCUMULATION_WGSL: &str = include_str!("../../shaders/passes/accumulation.wgsl");

/// `AccumulationUniforms` of `accumulation.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Uniforms {
    share: f32,
}

/// The means of a picture's samples: of its radiance with nothing in the way of light, and of what is blocked.
pub(super) struct Means {
    pub radiance: TextureView,
    pub blocked: TextureView,
}

impl Means {
    /// `size` is positive and within the device's limit for textures.
    pub fn new(device: &Device, size: [u32; 2], format: TextureFormat) -> Self {
        let mean = |label| attachment(device, label, (size, 1, format), TextureUsages::TEXTURE_BINDING);
        Self { radiance: mean("mean radiance"), blocked: mean("mean blocked") }
    }
}

pub(super) struct AccumulationPass {
    layout: BindGroupLayout,
    pipeline: RenderPipeline,
    uniforms: TrackedBuffer,
}

impl AccumulationPass {
    pub fn new(device: &Device, format: TextureFormat) -> Self {
        let layout = fullscreen::layout(device, "accumulation", true, &[1, 2, 3, 4].map(|binding| (binding, false)));
        let shader = module(device, "accumulation", ACCUMULATION_WGSL);
        let pipeline = fullscreen::pipeline(device, (&layout, &shader), "accumulation_fragment", &[], &[format; 2]);
        let uniforms = [0; size_of::<Uniforms>()];
        let uniforms = TrackedBuffer::new(device, "accumulation", &uniforms, BufferUsages::UNIFORM);
        Self { layout, pipeline, uniforms }
    }

    /// Adds sample `index`, counted from 0, to the means `before` it, which do not count where it is the first.
    pub fn encode(
        &mut self,
        (device, queue): (&Device, &Queue),
        encoder: &mut CommandEncoder,
        (targets, index): (&ShadowedTargets, u32),
        [before, after]: [&Means; 2],
    ) {
        let uniforms = Uniforms { share: 1.0 / (index as f32 + 1.0) };
        self.uniforms.write(queue, bytemuck::bytes_of(&uniforms));
        let textures = [(1, &targets.radiance), (2, &targets.blocked), (3, &before.radiance), (4, &before.blocked)];
        let bind_group = fullscreen::bind_group(device, &self.layout, Some(self.uniforms.binding()), &textures);
        let bound = (&self.pipeline, &bind_group);
        fullscreen::run(encoder, bound, &[&after.radiance, &after.blocked], None);
    }
}

#[cfg(test)]
mod tests {
    use super::super::layout::{differences, members};
    use super::*;

    #[test]
    fn the_uniforms_stand_as_the_shader_reads_them() {
        let members = members!(Uniforms { share });
        assert_eq!(differences(ACCUMULATION_WGSL, "AccumulationUniforms", size_of::<Uniforms>(), members), [""; 0]);
    }
}
