//! Frames with shadows: samples, their means, and what is shown of them.

use wgpu::{CommandEncoder, TextureFormat, TextureView};

use super::accumulation::{AccumulationPass, Means};
use super::denoise::{DenoisePass, Shares};
use super::display::{DisplayPass, Drawn, Source};
use super::targets::{RadianceFormat, ShadowedTargets};
use super::{Format, Gpu, Rect, Showing};

/// What frames with shadows are drawn with, and the last of them.
pub(super) struct Shadowed {
    formats: Formats,
    accumulation: AccumulationPass,
    filter: Option<DenoisePass>,
    display: DisplayPass,
    picture: Option<Picture>,
    pictures_made: usize,
}

/// Of the targets.
#[derive(Clone, Copy)]
pub(super) struct Formats {
    radiance: TextureFormat,
    means: TextureFormat,
    /// Where there is a filter, of what it goes by.
    pub guide: Option<TextureFormat>,
}

impl Formats {
    /// In this order of what the adapter draws; pictures that are measured are not filtered.
    pub fn new(gpu: &Gpu, format: Format) -> Self {
        let is_float_drawn = RadianceFormat::draws(&gpu.adapter, TextureFormat::Rgba32Float);
        let means = if is_float_drawn { TextureFormat::Rgba32Float } else { TextureFormat::Rgba16Float };
        let guide = (is_float_drawn && !format.measured).then_some(TextureFormat::Rgba32Float);
        Self { radiance: format.radiance.texture, means, guide }
    }
}

/// The samples of a picture so far.
struct Picture {
    size: [u32; 2],
    targets: ShadowedTargets,
    /// Those after the last sample, and those before it.
    means: [Means; 2],
    shares: Option<Shares>,
    samples: u32,
    /// By which radiance was multiplied.
    gain: f32,
}

impl Shadowed {
    pub fn new(gpu: &Gpu, format: Format, formats: Formats) -> Self {
        let device = &gpu.device;
        Self {
            formats,
            accumulation: AccumulationPass::new(device, formats.means),
            filter: formats.guide.map(|_| DenoisePass::new(device)),
            display: DisplayPass::new(device, Source::Shadowed, format.output, format.measured),
            picture: None,
            pictures_made: 0,
        }
    }

    pub fn made(&self) -> usize {
        self.display.made() + self.pictures_made
    }

    /// Samples of the picture so far.
    pub fn samples(&self) -> u32 {
        self.picture.as_ref().map_or(0, |picture| picture.samples)
    }

    /// The targets for sample `index` of a picture of this size, and what its radiance is multiplied by: of the first what is
    /// asked for, of others what the first was.
    pub fn begin(&mut self, gpu: &Gpu, size: [u32; 2], index: u32, gain: f32) -> (&ShadowedTargets, f32) {
        let device = &gpu.device;
        if self.picture.as_ref().is_none_or(|picture| picture.size != size) {
            self.pictures_made += 1;
            self.picture = None;
        }
        let Formats { radiance, means, guide } = self.formats;
        let picture = self.picture.get_or_insert_with(|| Picture {
            size,
            targets: ShadowedTargets::new(device, size, (radiance, guide)),
            means: [(); 2].map(|()| Means::new(device, size, means)),
            shares: guide.map(|_| Shares::new(device, size)),
            samples: 0,
            gain,
        });
        if index == 0 {
            (picture.samples, picture.gain) = (0, gain);
        }
        (&picture.targets, picture.gain)
    }

    /// Adds what the targets hold to the means.
    pub fn add(&mut self, gpu: &Gpu, encoder: &mut CommandEncoder) {
        let Some(picture) = &mut self.picture else { return };
        let [after, before] = &picture.means;
        let sample = (&picture.targets, picture.samples);
        self.accumulation.encode((&gpu.device, &gpu.queue), encoder, sample, [after, before]);
        picture.means.swap(0, 1);
        picture.samples += 1;
    }

    /// Shows the means in the rectangle `place` of the output; of few samples, shares of radiance are filtered first. `varied`: lights
    /// have patterns.
    pub fn show(
        &mut self,
        gpu: &Gpu,
        encoder: &mut CommandEncoder,
        output: (&TextureView, Rect),
        (showing, varied): (Showing, bool),
    ) {
        let Some(picture) = &self.picture else { return };
        let (means, device) = (&picture.means[0], &gpu.device);
        let guided = picture.shares.as_ref().zip(picture.targets.guide.as_ref());
        let shares = self.filter.as_mut().zip(guided).and_then(|(filter, (shares, guide))| {
            filter.encode((device, &gpu.queue), encoder, (means, picture.samples, guide, varied), shares)
        });
        let drawn = Drawn::Shadowed { means, shares, size: picture.size, gain: showing.gain() / picture.gain };
        self.display.encode((device, &gpu.queue), encoder, &drawn, output, showing);
    }
}
