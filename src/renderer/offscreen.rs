//! Pictures without a window: drawn in tiles, so that memory stays bounded at any size, and read back.

use half::f16;

use super::readback::Canvas;
use super::{Format, Gpu, RadianceFormat, Rect, RenderError, Renderer, Sample, Showing, View};
use crate::picture::{DisplayImage, Exposure, LinearImage};
use crate::scene::{Camera, Drawn, Edits, Scene, Settings};
use crate::table::SheenTable;

/// Longest side of a tile: pictures up to this size are drawn in one piece.
const TILE_SIDE: u32 = 2048;

/// Draws one scene into pictures.
pub struct Offscreen {
    renderer: Renderer,
    format: Format,
    notice: Option<String>,
    /// How much work pictures with shadows are: at first [`SAMPLES`] samples, all over the pixel if this was made with more than one
    /// sample per pixel.
    pub effort: Effort,
}

/// How much work a picture with shadows is. One without them has no noise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Samples a pixel, at least 1.
    pub samples: u32,
    /// Another seed gives other noise.
    pub seed: u32,
    /// Whether samples lie all over the pixel, or at its centre.
    pub spread: bool,
}

/// How far a picture is that is being drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Samples of pixels so far,
    pub done: u64,
    /// and in the end.
    pub all: u64,
    /// Rows of the part of the picture that is being drawn.
    pub height: u32,
}

/// Who watches a drawing: asked before each of its steps, when those before have been submitted, how many rows of a sample the
/// next one draws, at least 1; none ends it. In as many steps as you like it is the same picture.
pub type Watch<'a> = dyn FnMut(Progress) -> Option<u32> + 'a;

/// Draws each sample in one step.
fn unwatched(_: Progress) -> Option<u32> {
    Some(u32::MAX)
}

/// Samples a pixel where nobody has said how many: filtered, they leave no noise to see.
pub const SAMPLES: u32 = 3;

impl Offscreen {
    /// For pictures that are shown (`display`), with 1 or 4 samples per pixel. Fails where the adapter cannot draw so,
    /// or where the scene does not fit on the device.
    pub fn for_display(gpu: &Gpu, samples: u32, table: &SheenTable, drawn: &Drawn) -> Result<Self, RenderError> {
        let radiance = RadianceFormat::display(&gpu.adapter, samples);
        Self::for_display_in(gpu, radiance.ok_or_else(|| cannot_draw("floats", samples))?, table, drawn)
    }

    /// For linear pictures (`linear`) in 32-bit floats, with 1 or 4 samples per pixel. Fails as `for_display` does.
    pub fn for_linear(gpu: &Gpu, samples: u32, table: &SheenTable, drawn: &Drawn) -> Result<Self, RenderError> {
        let radiance = RadianceFormat::linear(&gpu.adapter, samples);
        Self::for_linear_in(gpu, radiance.ok_or_else(|| cannot_draw("32-bit floats", samples))?, table, drawn)
    }

    /// As `for_display`; where the adapter cannot draw so many samples, with one (see `radiance`).
    pub fn nearest_for_display(
        gpu: &Gpu,
        samples: u32,
        table: &SheenTable,
        drawn: &Drawn,
    ) -> Result<Self, RenderError> {
        let radiance = RadianceFormat::nearest_display(&gpu.adapter, samples);
        Self::for_display_in(gpu, radiance.ok_or_else(|| cannot_draw("floats", 1))?, table, drawn)
    }

    /// As `for_linear`; where the adapter cannot draw so many samples, with one, and where it draws no 32-bit floats, in 16-bit ones
    /// (see `radiance`).
    pub fn nearest_for_linear(gpu: &Gpu, samples: u32, table: &SheenTable, drawn: &Drawn) -> Result<Self, RenderError> {
        let radiance = RadianceFormat::nearest_linear(&gpu.adapter, samples);
        Self::for_linear_in(gpu, radiance.ok_or_else(|| cannot_draw("floats", 1))?, table, drawn)
    }

    fn for_display_in(
        gpu: &Gpu,
        radiance: RadianceFormat,
        table: &SheenTable,
        drawn: &Drawn,
    ) -> Result<Self, RenderError> {
        let format = Format { radiance, output: wgpu::TextureFormat::Rgba8Unorm, measured: false };
        Self::new(gpu, format, table, drawn)
    }

    fn for_linear_in(
        gpu: &Gpu,
        radiance: RadianceFormat,
        table: &SheenTable,
        drawn: &Drawn,
    ) -> Result<Self, RenderError> {
        let format = Format { radiance, output: radiance.texture, measured: true };
        Self::new(gpu, format, table, drawn)
    }

    fn new(gpu: &Gpu, format: Format, table: &SheenTable, drawn: &Drawn) -> Result<Self, RenderError> {
        let effort = Effort { samples: SAMPLES, seed: 0, spread: format.radiance.samples > 1 };
        let mut renderer = Renderer::new(gpu, format, table, drawn)?;
        renderer.keep_one();
        let mut offscreen = Self { renderer, format, notice: None, effort };
        offscreen.build(gpu, drawn);
        Ok(offscreen)
    }

    /// Builds what shadows take.
    fn build(&mut self, gpu: &Gpu, drawn: &Drawn) {
        if let Some(blockers) = self.renderer.blockers(gpu, drawn) {
            self.renderer.receive(gpu, blockers.build());
        }
    }

    /// The picture that `velour render` makes of a scene with the flags that make these edits: through their camera, else
    /// the scene's first, with 4 samples a pixel (1 where the adapter has no 4) and the shipped table. In one call, for
    /// tests that compare it with a picture that is kept; whoever draws a scene more than once keeps an `Offscreen`.
    /// Panics where the scene has no camera; a scene that was loaded has one.
    pub async fn screenshot(
        gpu: &Gpu,
        scene: &Scene,
        edits: &Edits,
        size: [u32; 2],
    ) -> Result<DisplayImage, RenderError> {
        let drawn = Drawn::new(scene, edits);
        let mut renderer = Self::nearest_for_display(gpu, 4, &SheenTable::embedded(), &drawn)?;
        let (camera, mut settings) = (edits.camera(scene), drawn.settings);
        if edits.exposure == Some(Exposure::Auto) {
            settings.exposure = renderer.meter(gpu, &camera, size, &settings).await?.unwrap_or(0.0);
        }
        renderer.display(gpu, &camera, size, &settings).await
    }

    /// How radiance is kept on the way: samples a pixel, and bits of each number.
    pub fn radiance(&self) -> RadianceFormat {
        self.format.radiance
    }

    /// What is to be said of the picture that was drawn last: where so much is blended that it could not be sorted exactly.
    pub fn notice(&self) -> Option<&str> {
        self.notice.as_deref()
    }

    /// Whether pictures with these settings have shadows: they are asked for, and the device can have them (else `notice` says
    /// why not).
    pub fn has_shadows(&self, settings: &Settings) -> bool {
        self.renderer.has_shadows(settings)
    }

    /// Sends what other edits make of the same scene to the device; its meshes and textures stay as they were.
    pub fn update(&mut self, gpu: &Gpu, drawn: &Drawn) -> Result<(), RenderError> {
        self.renderer.update(gpu, drawn)?;
        self.build(gpu, drawn);
        Ok(())
    }

    /// The exposure value that metering takes for a picture of this size ([`metered`](crate::picture::metered)): of what
    /// surfaces scatter, so that lamps in sight do not count; where they scatter nothing, of what they emit. None where
    /// nothing is lit. Unlit surfaces do not count. Reads the settings as `display` does, but for exposure and tone curve.
    pub async fn meter(
        &mut self,
        gpu: &Gpu,
        camera: &Camera,
        size: [u32; 2],
        settings: &Settings,
    ) -> Result<Option<f32>, RenderError> {
        self.renderer.meter(gpu, camera, size, settings).await
    }

    /// The picture as it is shown, with shadows of as many samples as `effort` says; those of fewer than
    /// [`UNFILTERED`](super::UNFILTERED) are filtered. Of the settings, `lights_visible` took effect when this was made or updated,
    /// as `shadows` did where they are off; the others are read here. Panics unless this was made by `for_display`.
    pub async fn display(
        &mut self,
        gpu: &Gpu,
        camera: &Camera,
        size: [u32; 2],
        settings: &Settings,
    ) -> Result<DisplayImage, RenderError> {
        self.display_watched(gpu, camera, size, settings, &mut unwatched).await
    }

    /// The same while somebody watches, who may end it: [`RenderError::Stopped`].
    pub async fn display_watched(
        &mut self,
        gpu: &Gpu,
        camera: &Camera,
        size: [u32; 2],
        settings: &Settings,
        watch: &mut Watch<'_>,
    ) -> Result<DisplayImage, RenderError> {
        assert!(!self.format.measured, "a renderer for linear pictures was asked for a shown one");
        let showing = Showing::Shown { exposure: settings.exposure, tone: settings.tone };
        let convert = |texel: [u8; 4]| [texel[0], texel[1], texel[2]];
        let pixels = self.pixels(gpu, (camera, size), (settings, showing), watch, convert).await?;
        Ok(DisplayImage { width: size[0], height: size[1], pixels })
    }

    /// Linear radiance, never filtered; reads the settings as `display` does. Made with one sample per pixel, each pixel is the
    /// value at its centre. Panics unless this was made by `for_linear`.
    pub async fn linear(
        &mut self,
        gpu: &Gpu,
        camera: &Camera,
        size: [u32; 2],
        settings: &Settings,
    ) -> Result<LinearImage, RenderError> {
        self.linear_watched(gpu, camera, size, settings, &mut unwatched).await
    }

    /// The same while somebody watches, who may end it: [`RenderError::Stopped`].
    pub async fn linear_watched(
        &mut self,
        gpu: &Gpu,
        camera: &Camera,
        size: [u32; 2],
        settings: &Settings,
        watch: &mut Watch<'_>,
    ) -> Result<LinearImage, RenderError> {
        assert!(self.format.measured, "a renderer for shown pictures was asked for a linear one");
        let (seen, how) = ((camera, size), (settings, Showing::Measured));
        let pixels = match self.format.radiance.bits() {
            16 => {
                let convert =
                    |texel: [u16; 4]| [texel[0], texel[1], texel[2]].map(|bits| f16::from_bits(bits).to_f32());
                self.pixels(gpu, seen, how, watch, convert).await?
            }
            _ => {
                let convert = |texel: [f32; 4]| [texel[0], texel[1], texel[2]];
                self.pixels(gpu, seen, how, watch, convert).await?
            }
        };
        Ok(LinearImage { width: size[0], height: size[1], pixels })
    }

    async fn pixels<Texel: bytemuck::AnyBitPattern, Pixel: Clone + Default>(
        &mut self,
        gpu: &Gpu,
        (camera, size): (&Camera, [u32; 2]),
        (settings, showing): (&Settings, Showing),
        watch: &mut Watch<'_>,
        convert: impl Fn(Texel) -> Pixel,
    ) -> Result<Vec<Pixel>, RenderError> {
        let limit = gpu.device.limits().max_texture_dimension_2d;
        if size.iter().any(|side| !(1..=limit).contains(side)) {
            return Err(RenderError::Size { size, limit });
        }
        let mut pixels = vec![Pixel::default(); size[0] as usize * size[1] as usize];
        self.notice = None;
        let samples = if self.renderer.has_shadows(settings) { self.effort.samples } else { 1 };
        let of = |size: [u32; 2]| u64::from(size[0]) * u64::from(size[1]) * u64::from(samples);
        let mut progress = Progress { done: 0, all: of(size), height: 0 };
        for tile in Rect::tiles(size, TILE_SIDE) {
            let view = View::new(camera, size, tile);
            progress.height = tile.height;
            let rows = self.tile(gpu, (&view, tile), (settings, showing), samples, &mut progress, watch).await?;
            self.notice = self.notice.take().or_else(|| self.renderer.notice().map(str::to_owned));
            let texel_size = size_of::<Texel>();
            let stride = rows.len() / tile.height as usize;
            for (y, row) in rows.chunks_exact(stride).enumerate() {
                let first = (tile.y as usize + y) * size[0] as usize + tile.x as usize;
                let texels = row[..tile.width as usize * texel_size].chunks_exact(texel_size);
                for (pixel, texel) in pixels[first..].iter_mut().zip(texels) {
                    *pixel = convert(bytemuck::pod_read_unaligned(texel));
                }
            }
        }
        Ok(pixels)
    }

    /// Draws one tile and reads its texels back, in rows of equal length that have padding at their ends.
    async fn tile(
        &mut self,
        gpu: &Gpu,
        (view, tile): (&View, Rect),
        (settings, showing): (&Settings, Showing),
        samples: u32,
        progress: &mut Progress,
        watch: &mut Watch<'_>,
    ) -> Result<Vec<u8>, RenderError> {
        let size = [tile.width, tile.height];
        let canvas = Canvas::new(gpu, size, self.format.output);
        let begin = || gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("picture") });
        let Effort { seed, spread, .. } = self.effort;
        for index in 0..samples {
            let (sample, mut first) = (Sample { index, seed, spread }, 0);
            while first < tile.height {
                let count = watch(*progress).ok_or(RenderError::Stopped)?.clamp(1, tile.height - first);
                let (rows, mut encoder) = (first..first + count, begin());
                self.renderer.draw_rows(gpu, &mut encoder, size, (view, settings, showing), &sample, rows);
                // What is written for a sample counts for all that is submitted with it.
                gpu.queue.submit([encoder.finish()]);
                first += count;
                progress.done += u64::from(count) * u64::from(tile.width);
            }
        }
        let mut encoder = begin();
        self.renderer.show(gpu, &mut encoder, (&canvas.view, Rect::full(size)), showing);
        canvas.read(gpu, encoder).await
    }
}

fn cannot_draw(what: &'static str, samples: u32) -> RenderError {
    let instead = if samples > 1 { "--msaa 1 or another --adapter" } else { "another --adapter" };
    RenderError::Multisampling { what, samples, instead }
}
