//! Frames with shadows: samples, their means, and what is shown of them.
//!
//! There may be two pictures of different sizes: while things move a small one is shown, and goes on to be shown until the first
//! sample of a larger one is there. And while things move little, the last picture's shadows are looked up in it.

use std::ops::Range;

use wgpu::{CommandEncoder, TextureFormat, TextureView};

use super::accumulation::{AccumulationPass, Means};
use super::denoise::{DenoisePass, Shares, passes};
use super::display::{DisplayPass, Drawn, Source};
use super::reprojection::Seen;
use super::targets::{RadianceFormat, ShadowedTargets};
use super::{Format, Gpu, Rect, Showing, View};

/// What frames with shadows are drawn with, and the last of them.
pub(super) struct Shadowed {
    formats: Formats,
    accumulation: AccumulationPass,
    filter: Option<DenoisePass>,
    display: DisplayPass,
    pictures: [Option<Picture>; 2],
    /// The index of the picture that is shown.
    shown: usize,
    /// The index of the one that is drawn.
    drawn: usize,
    pictures_made: usize,
    /// Whether what is shown is kept while a sample is drawn in parts.
    keeps_shown: bool,
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
    /// What the filter goes by: the guide of the last sample. The targets' is that of the one that is being drawn.
    guide: Option<TextureView>,
    shares: Option<Shares>,
    /// Which of the shares are filtered, and after how many samples that was done.
    filtered: Option<(usize, u32)>,
    /// From where it is seen.
    view: View,
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
            pictures: [None, None],
            shown: 0,
            drawn: 0,
            pictures_made: 0,
            keeps_shown: true,
        }
    }

    /// Keeps no picture but the one that is drawn.
    pub fn keep_one(&mut self) {
        self.keeps_shown = false;
    }

    pub fn made(&self) -> usize {
        self.display.made() + self.pictures_made
    }

    /// Samples of the picture so far that is shown.
    pub fn samples(&self) -> u32 {
        self.pictures[self.shown].as_ref().map_or(0, |picture| picture.samples)
    }

    /// The targets for these rows of sample `index` of a picture of this size, and what its radiance is multiplied by: of the first what is
    /// asked for, of others what the first was.
    pub fn begin(
        &mut self,
        gpu: &Gpu,
        (view, size): (&View, [u32; 2]),
        (index, rows): (u32, &Range<u32>),
        gain: f32,
    ) -> (&ShadowedTargets, f32) {
        let device = &gpu.device;
        if index == 0 && rows.start == 0 {
            // What takes long is drawn apart, so that what is shown can be looked up meanwhile.
            let is_apart = rows.end < size[1] && self.keeps_shown;
            let fits = self.pictures[self.shown].as_ref().is_none_or(|picture| picture.size == size);
            self.drawn = if (fits || !self.keeps_shown) && !is_apart { self.shown } else { 1 - self.shown };
        }
        let picture = &mut self.pictures[self.drawn];
        if picture.as_ref().is_none_or(|picture| picture.size != size) {
            self.pictures_made += 1;
            *picture = None;
        }
        let Formats { radiance, means, guide } = self.formats;
        let picture = picture.get_or_insert_with(|| Picture {
            size,
            targets: ShadowedTargets::new(device, size, (radiance, guide)),
            means: [(); 2].map(|()| Means::new(device, size, means)),
            guide: guide.map(|guide| ShadowedTargets::guide(device, size, guide)),
            shares: guide.map(|_| Shares::new(device, size)),
            filtered: None,
            view: *view,
            samples: 0,
            gain,
        });
        if index == 0 {
            (picture.samples, picture.gain, picture.view) = (0, gain, *view);
        }
        (&picture.targets, picture.gain)
    }

    /// Adds what the targets hold to the means, which are shown from now on.
    pub fn add(&mut self, gpu: &Gpu, encoder: &mut CommandEncoder) {
        self.shown = self.drawn;
        let Some(picture) = &mut self.pictures[self.drawn] else { return };
        let [after, before] = &picture.means;
        let sample = (&picture.targets, picture.samples);
        self.accumulation.encode((&gpu.device, &gpu.queue), encoder, sample, [after, before]);
        picture.means.swap(0, 1);
        std::mem::swap(&mut picture.guide, &mut picture.targets.guide);
        picture.samples += 1;
        picture.filtered = None;
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
        let Some(picture) = &mut self.pictures[self.shown] else { return };
        let passes = passes(picture.samples);
        let shares = if passes > 0 { picture.filter(&mut self.filter, gpu, encoder, varied) } else { None };
        let picture = &*picture;
        let shares = shares.zip(picture.shares.as_ref()).map(|(index, shares)| &shares.0[index]);
        let gain = showing.gain() / picture.gain;
        let drawn = Drawn::Shadowed { means: &picture.means[0], shares, size: picture.size, gain };
        self.display.encode((&gpu.device, &gpu.queue), encoder, &drawn, output, showing);
    }

    /// What is known of the shadows in the picture that is shown; none where there is none, or no filter.
    pub fn seen(&mut self, gpu: &Gpu, encoder: &mut CommandEncoder, varied: bool) -> Option<Seen<'_>> {
        let picture = self.pictures[self.shown].as_mut()?;
        let index = picture.filter(&mut self.filter, gpu, encoder, varied)?;
        let (shares, guide) = (&picture.shares.as_ref()?.0[index], picture.guide.as_ref()?);
        Some(Seen { view: &picture.view, size: picture.size, guide, shares })
    }

    /// Whether there is a picture whose shadows can be looked up.
    pub fn is_seen(&self) -> bool {
        self.filter.is_some() && self.pictures[self.shown].as_ref().is_some_and(|picture| picture.samples > 0)
    }
}

impl Picture {
    /// Filters the shares, where that has not been done since the last sample; which of them are filtered, if there is a filter.
    fn filter(
        &mut self,
        filter: &mut Option<DenoisePass>,
        gpu: &Gpu,
        encoder: &mut CommandEncoder,
        varied: bool,
    ) -> Option<usize> {
        let (filter, shares, guide) = (filter.as_mut()?, self.shares.as_ref()?, self.guide.as_ref()?);
        if let Some((index, samples)) = self.filtered
            && samples == self.samples
        {
            return Some(index);
        }
        let sampled = (&self.means[0], self.samples, guide, varied);
        let shares = (shares, passes(self.samples).max(1));
        let index = filter.encode((&gpu.device, &gpu.queue), encoder, sampled, shares);
        self.filtered = Some((index, self.samples));
        Some(index)
    }
}
