//! The second pass: from radiance to what is shown or measured.

use std::collections::HashMap;

use bytemuck::{Pod, Zeroable};
use wgpu::{BindGroupLayout, BufferUsages, CommandEncoder, Device, Queue, RenderPipeline};
use wgpu::{ShaderModule, TextureFormat, TextureUsages, TextureView};

use super::accumulation::Means;
use super::enlargement::Enlargement;
use super::fullscreen;
use super::shader::module;
use super::targets::{Targets, attachment};
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
    gain: f32,
    padding: u32,
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

/// What a frame was drawn as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Source {
    /// One sample a pixel.
    Single,
    /// Four.
    Multisampled,
    /// Means of samples with shadows.
    Shadowed,
}

/// What of a frame is shown.
pub(super) enum Drawn<'a> {
    Targets(&'a Targets),
    /// The same with shadows: the shares that are left.
    Shared {
        targets: &'a Targets,
        shares: &'a TextureView,
        /// What exposed radiance is multiplied by.
        gain: f32,
    },
    Shadowed {
        means: &'a Means,
        /// The shares that are left, where they were filtered.
        shares: Option<&'a TextureView>,
        size: [u32; 2],
        /// What exposed radiance is multiplied by.
        gain: f32,
    },
}

/// Draws a frame's radiance into an output of one format.
pub struct DisplayPass {
    shader: ShaderModule,
    layout: BindGroupLayout,
    source: Source,
    output: TextureFormat,
    measured: bool,
    made: HashMap<Variant, RenderPipeline>,
    uniforms: TrackedBuffer,
    /// Bound where there are no shares.
    nothing: TextureView,
    /// For what is shown in another size.
    enlargement: Option<Enlargement>,
}

/// What a pipeline is made for.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct Variant {
    /// `DISPLAY_TONE_CURVE` of `display.wgsl`.
    tone_curve: u32,
    filtered: bool,
}

impl DisplayPass {
    /// The pass for `Showing::Measured` where `measured`, else for `Showing::Shown`.
    pub fn new(device: &Device, source: Source, output: TextureFormat, measured: bool) -> Self {
        let textures: &[(u32, bool)] = match source {
            Source::Single => &[(1, false), (4, false)],
            Source::Multisampled => &[(2, true), (4, false)],
            Source::Shadowed => &[(1, false), (3, false), (4, false)],
        };
        let layout = fullscreen::layout(device, "display", true, textures);
        let shader = module(device, "display", DISPLAY_WGSL);
        let uniforms = [0; size_of::<Uniforms>()];
        let uniforms = TrackedBuffer::new(device, "display uniforms", &uniforms, BufferUsages::UNIFORM);
        let nothing =
            attachment(device, "no shares", ([1; 2], 1, TextureFormat::Rgba16Float), TextureUsages::TEXTURE_BINDING);
        Self { shader, layout, source, output, measured, made: HashMap::new(), uniforms, nothing, enlargement: None }
    }

    /// How many pipelines there are.
    pub fn made(&self) -> usize {
        self.made.len() + usize::from(self.enlargement.is_some())
    }

    /// Shows what was drawn in the rectangle `place` of the output, which may be of another size where it is not measured. What lies around
    /// it becomes black.
    pub fn encode(
        &mut self,
        (device, queue): (&Device, &Queue),
        encoder: &mut CommandEncoder,
        drawn: &Drawn,
        (output, place): (&TextureView, Rect),
        showing: Showing,
    ) {
        let binding = if self.source == Source::Multisampled { 2 } else { 1 };
        let (textures, size, gain, filtered): (Vec<(u32, &TextureView)>, _, _, _) = match drawn {
            Drawn::Targets(targets) => {
                (vec![(binding, &targets.radiance), (4, &self.nothing)], targets.size, 1.0, false)
            }
            Drawn::Shared { targets, shares, gain } => {
                (vec![(binding, &targets.radiance), (4, shares)], targets.size, *gain, true)
            }
            Drawn::Shadowed { means, shares, size, gain } => {
                let textures = [(1, &means.radiance), (3, &means.blocked), (4, shares.unwrap_or(&means.blocked))];
                (textures.to_vec(), *size, *gain, shares.is_some())
            }
        };
        // In another size it is shown through a picture of its own size, whose format can be filtered.
        assert!(!self.measured || [place.width, place.height] == size, "measured in {size:?}, and shown in {place:?}");
        let coarse = ([place.width, place.height] != size).then(|| {
            let enlargement = self.enlargement.get_or_insert_with(|| Enlargement::new(device, self.output));
            enlargement.picture(device, size)
        });
        let (target, part) = coarse.as_ref().map_or((output, place), |coarse| (coarse, Rect::full(size)));
        let Rect { x, y, width, height } = part;
        let uniforms = Uniforms { origin: [x, y], gain, padding: 0 };
        self.uniforms.write(queue, bytemuck::bytes_of(&uniforms));
        let bind_group = fullscreen::bind_group(device, &self.layout, Some(self.uniforms.binding()), &textures);
        let variant = Variant { tone_curve: showing.tone_curve(), filtered };
        let pipeline = self.pipeline(device, variant);
        fullscreen::run(encoder, (pipeline, &bind_group), &[target], Some([x, y, width, height]));
        if let (Some(coarse), Some(enlargement)) = (&coarse, &mut self.enlargement) {
            enlargement.encode((device, queue), encoder, coarse, (output, place));
        }
    }

    fn pipeline(&mut self, device: &Device, variant: Variant) -> &RenderPipeline {
        self.made.entry(variant).or_insert_with(|| {
            let constants = [
                ("DISPLAY_TONE_CURVE", f64::from(variant.tone_curve)),
                ("DISPLAY_FILTERED", f64::from(u8::from(variant.filtered))),
            ];
            let fragment = entry_point(self.measured, self.source);
            fullscreen::pipeline(device, (&self.layout, &self.shader), fragment, &constants, &[self.output])
        })
    }
}

/// Of the fragment shader.
fn entry_point(measured: bool, source: Source) -> &'static str {
    match (measured, source) {
        (false, Source::Single) => "display_shown_single",
        (false, Source::Multisampled) => "display_shown_multisampled",
        (false, Source::Shadowed) => "display_shown_shadowed",
        (true, Source::Single) => "display_measured_single",
        (true, Source::Multisampled) => "display_measured_multisampled",
        (true, Source::Shadowed) => "display_measured_shadowed",
    }
}

#[cfg(test)]
mod tests {
    use super::super::layout::{differences, members};
    use super::*;

    #[test]
    fn the_uniforms_stand_as_the_shader_reads_them() {
        let members = members!(Uniforms { origin, gain });
        assert_eq!(differences(DISPLAY_WGSL, "DisplayUniforms", size_of::<Uniforms>(), members), [""; 0]);
    }
}
