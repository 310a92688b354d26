//! wgpu: device, targets, passes. The same passes draw offscreen and on a window's surface.
//!
//! A frame goes through two passes. The first draws every surface's radiance, lit by the polygon lights in closed form,
//! and exposed, into floating-point targets; the second shows it (tone curve, sRGB) or measures it (plain linear radiance).

mod accumulation;
mod blended;
mod blockers;
#[cfg(test)]
mod branches;
mod calls;
mod denoise;
pub mod device;
mod display;
mod draws;
mod enlargement;
mod fullscreen;
#[cfg(test)]
mod layout;
mod levels;
mod lights;
mod materials;
mod meter;
mod numbers;
mod offscreen;
mod outline;
pub mod paint_order;
mod patterns;
mod pieces;
mod pipelines;
mod prior_sheens;
mod readback;
mod reprojection;
mod resident;
mod sample;
mod shader;
mod shadowed;
mod shadows;
mod surfaces;
mod tables;
mod targets;
#[cfg(test)]
mod tests;
mod textures;
mod tracked_buffer;
mod view;

pub use device::{DeviceError, Gpu};
pub use display::Showing;
pub use offscreen::{Effort, Offscreen, Progress, SAMPLES, Watch};
pub use sample::Sample;
pub use shader::SURFACES_WGSL;
pub use shadows::{Blockers, Built};
pub use targets::RadianceFormat;
pub use view::{Rect, View};

use std::ops::Range;

use blended::Blended;
use display::{DisplayPass, Source};
use outline::OutlinePass;
use pipelines::Stage;
use reprojection::Reprojection;
use resident::Resident;
use shadowed::{Formats, Shadowed};
use shadows::Shadows;
use surfaces::SurfacesPass;
use targets::Targets;

use crate::scene::{Drawn, Settings};
use crate::table::SheenTable;

/// Why a picture could not be made.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    #[error(
        "{what} take {bytes} bytes on the device, which holds at most {limit} in one piece: split the mesh or use another adapter"
    )]
    /// A buffer is larger than what the device holds in one piece.
    TooLarge {
        /// What the buffer holds.
        what: String,
        /// The buffer's size.
        bytes: u64,
        /// The device's limit, in bytes.
        limit: u64,
    },
    /// A side of the picture is 0, or longer than that of the device's largest texture.
    #[error("size {}x{} is past what this adapter draws: use 1x1 to {limit}x{limit}", size[0], size[1])]
    Size {
        /// Width and height that were asked for, in pixels.
        size: [u32; 2],
        /// The longest side that the device draws.
        limit: u32,
    },
    /// The adapter cannot draw into such targets with so many samples per pixel.
    #[error("this adapter cannot draw {what} with {samples} samples a pixel: use {instead}")]
    Multisampling {
        /// The targets' numbers.
        what: &'static str,
        /// Samples per pixel that were asked for.
        samples: u32,
        /// What to try.
        instead: &'static str,
    },
    /// The picture could not be copied from the device.
    #[error("the device did not hand the picture over ({0}): try a smaller --size or another --adapter")]
    Readback(String),
    /// Whoever watched the drawing has ended it.
    #[error("the drawing was stopped")]
    Stopped,
}

/// In which formats radiance is kept and shown.
#[derive(Clone, Copy, Debug)]
pub struct Format {
    /// The format of the first pass' target.
    pub radiance: RadianceFormat,
    /// The format of the texture that the second pass draws into.
    pub output: wgpu::TextureFormat,
    /// Whether the output is plain linear radiance (`Showing::Measured`).
    pub measured: bool,
}

/// Samples from which on a picture is shown as they are; shadows of fewer are filtered.
pub const UNFILTERED: u32 = 64;

/// A scene on a device, ready to be drawn from any view.
pub struct Renderer {
    format: Format,
    resident: Resident,
    blended: Blended,
    surfaces: SurfacesPass,
    display: DisplayPass,
    targets: Option<Targets>,
    targets_made: usize,
    shadows: Shadows,
    shadowed: Shadowed,
    /// There where it has been needed.
    reprojection: Option<Reprojection>,
    /// There from the first outline on.
    outline: Option<OutlinePass>,
    latest: Latest,
}

/// What was drawn last.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Latest {
    Unshadowed,
    Shadowed,
    /// With the shadows of an earlier picture; and by what its radiance was multiplied.
    Remembering {
        gain: f32,
    },
}

impl Renderer {
    /// No picture but the one that is drawn is kept: parts of a sample take no second one, and what was drawn before is shown no more.
    fn keep_one(&mut self) {
        self.shadowed.keep_one();
    }

    /// Uploads the scene and makes the pipelines. Drivers may put off compiling them until the first frame. There are no
    /// shadows before [`Self::receive`].
    pub fn new(gpu: &Gpu, format: Format, table: &SheenTable, drawn: &Drawn) -> Result<Self, RenderError> {
        let resident = Resident::new(gpu, drawn)?;
        let mut blended = Blended::default();
        blended.update(drawn, &resident.draws);
        let formats = Formats::new(gpu, format);
        let mut surfaces = SurfacesPass::new(gpu, (format.radiance, formats.guide), table, &resident);
        let source = if format.radiance.samples > 1 { Source::Multisampled } else { Source::Single };
        let display = DisplayPass::new(&gpu.device, source, format.output, format.measured);
        surfaces.prepare(gpu, &resident, &[]);
        Ok(Self {
            format,
            resident,
            blended,
            surfaces,
            display,
            targets: None,
            targets_made: 0,
            shadows: Shadows::default(),
            shadowed: Shadowed::new(gpu, format, formats),
            reprojection: None,
            outline: None,
            latest: Latest::Unshadowed,
        })
    }

    /// Sends what other edits make of the same scene to the device: materials, lights and places.
    pub fn update(&mut self, gpu: &Gpu, drawn: &Drawn) -> Result<(), RenderError> {
        if self.resident.update(gpu, drawn)? {
            self.surfaces.rebind(&gpu.device, &self.resident);
        }
        self.blended.update(drawn, &self.resident.draws);
        Ok(())
    }

    /// What is to be built, and handed to [`Self::receive`], before the scene as it is drawn has its shadows; none where it has
    /// them, where there are to be none, or where the device can have none, which [`Self::notice`] then says.
    pub fn blockers(&mut self, gpu: &Gpu, drawn: &Drawn) -> Option<Blockers> {
        self.shadows.gather(&gpu.device.limits(), drawn)
    }

    /// Takes what stands in the way of light to the device. Until something else is received, shadows are its.
    pub fn receive(&mut self, gpu: &Gpu, built: Built) {
        self.shadows.receive(gpu, &self.surfaces.blockers_layout, built);
    }

    /// Whether pictures with these settings have shadows now.
    pub fn has_shadows(&self, settings: &Settings) -> bool {
        settings.shadows && self.shadows.bound().is_some()
    }

    /// Whether pipelines are to be made before a sample can be drawn with these settings: that takes long, or the first frame does.
    pub fn lacks_pipelines(&self, settings: &Settings, sample: &Sample) -> bool {
        match self.shadows.bound().filter(|_| settings.shadows) {
            Some((_, opacities)) => self.surfaces.lacks(&self.resident, &[Stage::Depth, sample.stage(opacities)]),
            None => self.surfaces.lacks(&self.resident, &[Stage::Unshadowed]),
        }
    }

    /// The first pass: draws the view's radiance, exposed for `showing`, into targets of this size, which are kept for
    /// `show`. With shadows that is a sample, which is added to those before it; without them there is but one.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        size: [u32; 2],
        frame: (&View, &Settings, Showing),
        sample: &Sample,
    ) {
        self.draw_rows(gpu, encoder, size, frame, sample, 0..size[1]);
    }

    /// The same in parts, for samples that take long: it draws these rows. The first part starts at row 0; with the last one, which ends
    /// at the height, the sample is there. Until then what was drawn before is shown, or, without shadows, what is there of the
    /// rows. Parts of one sample are drawn with the same values of everything.
    pub fn draw_rows(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        size: [u32; 2],
        (view, settings, showing): (&View, &Settings, Showing),
        sample: &Sample,
        rows: Range<u32>,
    ) {
        self.blended.prepare(gpu, &self.resident.draws, view);
        let things = (&self.resident, &self.blended);
        if let Some((blockers, opacities)) = self.shadows.bound().filter(|_| settings.shadows) {
            let stage = sample.stage(opacities);
            self.surfaces.prepare(gpu, &self.resident, &[Stage::Depth, stage]);
            let (targets, gain) = self.shadowed.begin(gpu, (view, size), (sample.index, &rows), showing.gain());
            let frame = (view, settings, gain, sample);
            self.surfaces.encode_shadowed(&gpu.queue, encoder, (targets, stage, blockers), things, frame, &rows);
            if rows.end == size[1] {
                self.shadowed.add(gpu, encoder);
                self.latest = Latest::Shadowed;
            }
            return;
        }
        self.draw_unshadowed(gpu, encoder, size, (view, settings, showing), &rows);
        self.latest = Latest::Unshadowed;
    }

    /// Draws without shadows what is shown with those of the last picture that has its own: looked up where they were seen, which is
    /// quick, and right as long as neither lights nor things have moved. What was not seen there is shaded as what was seen nearest to
    /// it. Where [`Self::remembers`] says no it must not be called.
    pub fn draw_remembering(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        size: [u32; 2],
        frame: (&View, &Settings, Showing),
    ) {
        self.blended.prepare(gpu, &self.resident.draws, frame.0);
        self.draw_unshadowed(gpu, encoder, size, frame, &(0..size[1]));
        let varied = self.resident.draws.has_patterns();
        if let (Some(seen), Some(targets)) = (self.shadowed.seen(gpu, encoder, varied), &self.targets) {
            let reprojection = self.reprojection.get_or_insert_with(|| Reprojection::new(&gpu.device));
            reprojection.encode((&gpu.device, &gpu.queue), encoder, (frame.0, targets), &seen);
            self.latest = Latest::Remembering { gain: frame.2.gain() };
        }
    }

    /// Whether there is a picture with shadows that can be looked up: the adapter has to draw what it takes, and pictures have to have
    /// one sample a pixel.
    pub fn remembers(&self, settings: &Settings) -> bool {
        self.has_shadows(settings) && self.format.radiance.samples == 1 && self.shadowed.is_seen()
    }

    fn draw_unshadowed(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        size: [u32; 2],
        (view, settings, showing): (&View, &Settings, Showing),
        rows: &Range<u32>,
    ) {
        let targets = match self.targets.take() {
            Some(targets) if targets.size == size => targets,
            _ => {
                self.targets_made += 1;
                Targets::new(&gpu.device, size, self.format.radiance)
            }
        };
        let things = (&self.resident, &self.blended);
        self.surfaces.prepare(gpu, &self.resident, &[Stage::Unshadowed]);
        self.surfaces.encode(&gpu.queue, encoder, &targets, things, (view, settings, showing.gain()), rows);
        self.targets = Some(targets);
    }

    /// What is to be said of the view that was drawn last: why it has no shadows, or where so much is blended that it could not be
    /// sorted exactly.
    pub fn notice(&self) -> Option<&str> {
        self.shadows.lack.as_deref().or(self.blended.notice.as_deref())
    }

    /// Samples of the picture that was drawn last.
    pub fn samples(&self) -> u32 {
        if self.latest == Latest::Unshadowed { 1 } else { self.shadowed.samples() }
    }

    /// How many pipelines and targets there have been so far: where it grows, a frame took longer than others will.
    pub fn made(&self) -> usize {
        self.surfaces.made() + self.display.made() + self.targets_made + self.shadowed.made()
    }

    /// The last pass: shows what was drawn last, which was exposed for the same `showing`, in a rectangle of the output, which may be of
    /// another size unless it is measured. Other pixels of the output become black.
    pub fn show(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        output: (&wgpu::TextureView, Rect),
        showing: Showing,
    ) {
        if self.latest == Latest::Shadowed {
            let varied = self.resident.draws.has_patterns();
            return self.shadowed.show(gpu, encoder, output, (showing, varied));
        }
        let Some(targets) = &self.targets else { return };
        let shares = self.reprojection.as_ref().and_then(Reprojection::shares);
        let drawn = match (self.latest, shares) {
            (Latest::Remembering { gain }, Some(shares)) => {
                display::Drawn::Shared { targets, shares, gain: showing.gain() / gain }
            }
            _ => display::Drawn::Targets(targets),
        };
        self.display.encode((&gpu.device, &gpu.queue), encoder, &drawn, output, showing);
    }

    /// Draws the outline of what `view` shows of a material over a picture that is shown in a rectangle of the output.
    pub fn outline(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        output: (&wgpu::TextureView, Rect),
        view: &View,
        material: usize,
    ) {
        let outline = self.outline.get_or_insert_with(|| OutlinePass::new(&gpu.device, self.format.output));
        let pieces = (material, self.surfaces.triangles_a_pass);
        outline.encode(gpu, encoder, output, (&self.resident, view), pieces);
    }
}
