//! The filter of shadows while samples are few.

use wgpu::{BindGroupLayout, CommandEncoder, Device, RenderPipeline, TextureFormat, TextureUsages, TextureView};

use super::accumulation::Means;
use super::fullscreen;
use super::targets::attachment;

/// The pass' WGSL.
pub(super) const DENOISE_WGSL: &str = include_str!("../../shaders/passes/denoise.wgsl");

const FORMAT: TextureFormat = TextureFormat::Rgba16Float;
/// How far apart the pixels of each pass' kernel are.
const STEPS: [i32; 2] = [1, 2];

/// How many times a picture of so many samples is filtered: from [`UNFILTERED`](super::UNFILTERED) on not at all.
pub(super) fn passes(samples: u32) -> usize {
    match samples {
        0..4 => 2,
        4..super::UNFILTERED => 1,
        _ => 0,
    }
}

pub(super) struct DenoisePass {
    layout: BindGroupLayout,
    pipelines: [RenderPipeline; 2],
}

/// Of a picture's size.
pub(super) struct Shares([TextureView; 2]);

impl Shares {
    pub fn new(device: &Device, size: [u32; 2]) -> Self {
        Self([(); 2].map(|()| attachment(device, "denoise", (size, 1, FORMAT), TextureUsages::TEXTURE_BINDING)))
    }

    /// What the last of so many passes leaves.
    pub fn after(&self, passes: usize) -> &TextureView {
        &self.0[(passes + 1) % 2]
    }
}

impl DenoisePass {
    pub fn new(device: &Device) -> Self {
        let layout = fullscreen::layout(device, "denoise", false, &[0, 1, 2, 3].map(|binding| (binding, false)));
        let shader = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("denoise"),
            source: wgpu::ShaderSource::Wgsl(DENOISE_WGSL.into()),
        });
        let pipeline = |again: bool| {
            let again = usize::from(again);
            let constants = [("DENOISE_STEP", STEPS[again].into()), ("DENOISE_AGAIN", again as f64)];
            fullscreen::pipeline(
                device,
                (&layout, &shader),
                ["denoise_vertex", "denoise_fragment"],
                &constants,
                &[FORMAT],
            )
        };
        Self { pipelines: [pipeline(false), pipeline(true)], layout }
    }

    /// Filters the shares of the means so many times, by the guide.
    pub fn encode(
        &self,
        device: &Device,
        encoder: &mut CommandEncoder,
        (means, guide): (&Means, &TextureView),
        (shares, passes): (&Shares, usize),
    ) {
        for index in 0..passes {
            let [output, before] = [&shares.0[index % 2], &shares.0[(index + 1) % 2]];
            let textures = [(0, &means.radiance), (1, &means.blocked), (2, guide), (3, before)];
            let bind_group = fullscreen::bind_group(device, &self.layout, None, &textures);
            fullscreen::run(encoder, (&self.pipelines[index.min(1)], &bind_group), &[output], None);
        }
    }
}
