//! The filter of shadows while samples are few.

use bytemuck::{Pod, Zeroable};
use wgpu::{BindGroupLayout, BufferUsages, CommandEncoder, Device, Queue, RenderPipeline};
use wgpu::{TextureFormat, TextureUsages, TextureView};

use super::UNFILTERED;
use super::accumulation::Means;
use super::fullscreen;
use super::shader::module;
use super::targets::attachment;
use super::tracked_buffer::TrackedBuffer;

/// The pass' WGSL.
pub(super) const DENOISE_WGSL: &str = include_str!("../../shaders/passes/denoise.wgsl");

const FORMAT: TextureFormat = TextureFormat::Rgba16Float;
/// How far apart the pixels of each pass' kernel are.
const STEPS: [i32; 2] = [1, 2];

/// Samples up to which neighbours count in full.
const WIDE: u32 = 4;

/// How many times a picture of so many samples is filtered: from [`UNFILTERED`] on not at all.
pub(super) fn passes(samples: u32) -> usize {
    match samples {
        0..16 => 2,
        16..UNFILTERED => 1,
        _ => 0,
    }
}

/// How much neighbours count then: the filter narrows until it is gone.
fn neighbours(samples: u32) -> f32 {
    let left = UNFILTERED.saturating_sub(samples) as f32 / (UNFILTERED - WIDE) as f32;
    left.min(1.0)
}

/// `DenoiseUniforms` of `denoise.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Uniforms {
    neighbours: f32,
    least: f32,
    most: f32,
}

/// Between what the share that is left lies, after some samples, under lights that do not vary and under such that do.
const SHARES: [[f32; 2]; 2] = [[0.0, 1.2], [-7.0, 8.0]];

pub(super) struct DenoisePass {
    layout: BindGroupLayout,
    pipelines: [RenderPipeline; 2],
    uniforms: TrackedBuffer,
}

/// Of a picture's size.
pub(super) struct Shares(pub [TextureView; 2]);

impl Shares {
    pub fn new(device: &Device, size: [u32; 2]) -> Self {
        Self([(); 2].map(|()| attachment(device, "denoise", (size, 1, FORMAT), TextureUsages::TEXTURE_BINDING)))
    }
}

impl DenoisePass {
    pub fn new(device: &Device) -> Self {
        let layout = fullscreen::layout(device, "denoise", true, &[1, 2, 3, 4].map(|binding| (binding, false)));
        let shader = module(device, "denoise", DENOISE_WGSL);
        let pipeline = |again: bool| {
            let again = usize::from(again);
            let constants = [("DENOISE_STEP", STEPS[again].into()), ("DENOISE_AGAIN", again as f64)];
            fullscreen::pipeline(device, (&layout, &shader), "denoise_fragment", &constants, &[FORMAT])
        };
        let uniforms = [0; size_of::<Uniforms>()];
        let uniforms = TrackedBuffer::new(device, "denoise", &uniforms, BufferUsages::UNIFORM);
        Self { pipelines: [pipeline(false), pipeline(true)], layout, uniforms }
    }

    /// Filters the shares of the means of so many samples, by the guide, in this number of passes, at least one; in which of the textures
    /// the last leaves them. `varied`: lights have patterns.
    pub fn encode(
        &mut self,
        (device, queue): (&Device, &Queue),
        encoder: &mut CommandEncoder,
        (means, samples, guide, varied): (&Means, u32, &TextureView, bool),
        (shares, passes): (&Shares, usize),
    ) -> usize {
        let [least, most] = SHARES[usize::from(varied)];
        let uniforms = Uniforms { neighbours: neighbours(samples), least, most };
        self.uniforms.write(queue, bytemuck::bytes_of(&uniforms));
        for index in 0..passes {
            let [output, before] = [&shares.0[index % 2], &shares.0[(index + 1) % 2]];
            let textures = [(1, &means.radiance), (2, &means.blocked), (3, guide), (4, before)];
            let bind_group = fullscreen::bind_group(device, &self.layout, Some(self.uniforms.binding()), &textures);
            fullscreen::run(encoder, (&self.pipelines[index.min(1)], &bind_group), &[output], None);
        }
        (passes - 1) % 2
    }
}

#[cfg(test)]
mod tests {
    use super::super::layout::{differences, members};
    use super::*;

    #[test]
    fn the_uniforms_stand_as_the_shader_reads_them() {
        let members = members!(Uniforms { neighbours, least, most });
        assert_eq!(differences(DENOISE_WGSL, "DenoiseUniforms", size_of::<Uniforms>(), members), [""; 0]);
    }

    #[test]
    fn the_filter_narrows_and_is_gone() {
        assert_eq!([0, 15, 16, UNFILTERED - 1, UNFILTERED].map(passes), [2, 2, 1, 1, 0]);
        assert_eq!([1, WIDE, UNFILTERED].map(neighbours), [1.0, 1.0, 0.0]);
        assert!((1..2 * UNFILTERED).all(|samples| neighbours(samples + 1) <= neighbours(samples)));
    }
}
