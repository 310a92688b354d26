//! The exposure that what is seen asks for: a small picture of its radiance, read back.

use super::display::{DisplayPass, Drawn, Source};
use super::pipelines::Stage;
use super::readback::Canvas;
use super::targets::Targets;
use super::{Gpu, Rect, RenderError, Renderer, Showing, View};
use crate::picture::{LinearImage, metered, metered_size};
use crate::scene::{Camera, Lobes, Settings};

/// Half floats are exact in the middle of their range: an exposure that was found by a picture of one so many stops away,
/// or nearer, is not looked for again.
const NEAR: f32 = 6.0;
/// Stops by which a picture in which nothing was seen is brightened: beyond them, half floats hold as many again.
const DARK: f32 = 28.0;
/// Pictures that are tried at most: a radiance that a float holds is found by the fourth.
const TRIES: usize = 8;

/// What a small picture is drawn with.
struct Meter {
    canvas: Canvas,
    targets: Targets,
    display: DisplayPass,
    size: [u32; 2],
    view: View,
}

impl Renderer {
    /// As `Offscreen::meter` says.
    pub async fn meter(
        &mut self,
        gpu: &Gpu,
        camera: &Camera,
        size: [u32; 2],
        settings: &Settings,
    ) -> Result<Option<f32>, RenderError> {
        let mut meter = self.small(gpu, camera, size);
        let scattered = Settings { lobes: Lobes { emission: false, ..settings.lobes }, ..*settings };
        for settings in [&scattered, settings] {
            if let Some(exposure) = self.metered(gpu, &mut meter, settings).await? {
                return Ok(Some(exposure));
            }
        }
        Ok(None)
    }

    /// What the camera sees, small: radiance times 2 to the settings' exposure. Unlit surfaces, which have no exposure,
    /// are black.
    pub async fn glance(
        &mut self,
        gpu: &Gpu,
        camera: &Camera,
        size: [u32; 2],
        settings: &Settings,
    ) -> Result<LinearImage, RenderError> {
        let mut meter = self.small(gpu, camera, size);
        self.exposed(gpu, &mut meter, settings).await
    }

    fn small(&self, gpu: &Gpu, camera: &Camera, size: [u32; 2]) -> Meter {
        let (size, format) = (metered_size(size), self.format.radiance);
        let source = if format.samples > 1 { Source::Multisampled } else { Source::Single };
        Meter {
            canvas: Canvas::new(gpu, size, format.texture),
            targets: Targets::new(&gpu.device, size, format),
            display: DisplayPass::new(&gpu.device, source, format.texture, true),
            size,
            view: View::new(camera, size, Rect::full(size)),
        }
    }

    async fn metered(&mut self, gpu: &Gpu, meter: &mut Meter, settings: &Settings) -> Result<Option<f32>, RenderError> {
        let mut settings = Settings { exposure: 0.0, ..*settings };
        for _ in 0..TRIES {
            match metered(&self.exposed(gpu, meter, &settings).await?) {
                Some(further) if further.abs() <= NEAR => return Ok(Some(hundredths(settings.exposure + further))),
                Some(further) => settings.exposure += further,
                None if settings.exposure > 2.0 * DARK => return Ok(None),
                None => settings.exposure += DARK,
            }
        }
        Ok(Some(hundredths(settings.exposure)))
    }

    async fn exposed(&mut self, gpu: &Gpu, meter: &mut Meter, settings: &Settings) -> Result<LinearImage, RenderError> {
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("meter") });
        let gain = settings.exposure.exp2();
        self.blended.prepare(gpu, &self.resident.draws, &meter.view);
        self.surfaces.prepare(gpu, &self.resident, &[Stage::Unshadowed]);
        let things = (&self.resident, &self.blended);
        self.surfaces.encode(
            &gpu.queue,
            &mut encoder,
            &meter.targets,
            things,
            (&meter.view, settings, gain),
            &(0..meter.size[1]),
        );
        let output = (&meter.canvas.view, Rect::full(meter.size));
        let drawn = Drawn::Targets(&meter.targets);
        meter.display.encode((&gpu.device, &gpu.queue), &mut encoder, &drawn, output, Showing::Measured);
        let texels = meter.canvas.read_floats(gpu, encoder).await?;
        // Its last number is the share that is lit.
        let lit = |[red, green, blue, share]: [f32; 4]| if share > 0.5 { [red, green, blue] } else { [0.0; 3] };
        let [width, height] = meter.size;
        Ok(LinearImage { width, height, pixels: texels.into_iter().map(lit).collect() })
    }
}

/// Sums of hundredths are not quite hundredths; and exposures go no farther than `metered` takes them.
fn hundredths(exposure: f32) -> f32 {
    (exposure.clamp(-100.0, 100.0) * 100.0).round() / 100.0
}
