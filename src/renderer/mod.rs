//! wgpu: device, targets, passes. The same passes draw offscreen and on a window's surface.
//!
//! A frame goes through two passes. The first draws every surface's radiance, lit by the polygon lights in closed form,
//! and exposed, into floating-point targets; the second shows it (tone curve, sRGB) or measures it (plain linear radiance).

mod blended;
#[cfg(test)]
mod branches;
mod calls;
pub mod device;
mod display;
mod draws;
#[cfg(test)]
mod layout;
mod lights;
mod materials;
mod meter;
mod offscreen;
pub mod paint_order;
mod pipelines;
mod prior_sheens;
mod readback;
mod resident;
mod shader;
mod surfaces;
mod tables;
mod targets;
mod textures;
mod tracked_buffer;
mod view;

pub use device::{DeviceError, Gpu};
pub use display::Showing;
pub use offscreen::Offscreen;
pub use shader::SURFACES_WGSL;
pub use targets::RadianceFormat;
pub use view::{Rect, View};

use blended::Blended;
use display::DisplayPass;
use resident::Resident;
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

/// A scene on a device, ready to be drawn from any view.
pub struct Renderer {
    format: Format,
    resident: Resident,
    blended: Blended,
    surfaces: SurfacesPass,
    display: DisplayPass,
    targets: Option<Targets>,
    targets_made: usize,
}

impl Renderer {
    /// Uploads the scene and makes the pipelines. Drivers may put off compiling them until the first frame.
    pub fn new(gpu: &Gpu, format: Format, table: &SheenTable, drawn: &Drawn) -> Result<Self, RenderError> {
        let resident = Resident::new(gpu, drawn)?;
        let mut blended = Blended::default();
        blended.update(drawn, &resident.draws);
        let surfaces = SurfacesPass::new(gpu, format.radiance, table, &resident);
        let display = DisplayPass::new(&gpu.device, format.radiance, format.output, format.measured);
        Ok(Self { format, resident, blended, surfaces, display, targets: None, targets_made: 0 })
    }

    /// Sends what other edits make of the same scene to the device: materials, lights and places.
    pub fn update(&mut self, gpu: &Gpu, drawn: &Drawn) -> Result<(), RenderError> {
        if self.resident.update(gpu, drawn)? {
            self.surfaces.rebind(&gpu.device, &self.resident);
        }
        self.blended.update(drawn, &self.resident.draws);
        self.surfaces.prepare(gpu, &self.resident);
        Ok(())
    }

    /// The first pass: draws the view's radiance, exposed for `showing`, into targets of this size, which are kept for
    /// `show`.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        size: [u32; 2],
        (view, settings, showing): (&View, &Settings, Showing),
    ) {
        let targets = match self.targets.take() {
            Some(targets) if targets.size == size => targets,
            _ => {
                self.targets_made += 1;
                Targets::new(&gpu.device, size, self.format.radiance)
            }
        };
        self.blended.prepare(gpu, &self.resident.draws, view);
        let things = (&self.resident, &self.blended);
        self.surfaces.encode(&gpu.queue, encoder, &targets, things, (view, settings, showing.gain()));
        self.targets = Some(targets);
    }

    /// What is to be said of the view that was drawn last: where so much is blended that it could not be sorted exactly.
    pub fn notice(&self) -> Option<&str> {
        self.blended.notice.as_deref()
    }

    /// How many pipelines and targets there have been so far: where it grows, a frame took longer than others will.
    pub fn made(&self) -> usize {
        self.surfaces.made() + self.display.made() + self.targets_made
    }

    /// The second pass: shows what was drawn last, which was exposed for the same `showing`, in the output from the
    /// pixel `origin` on. Other pixels of the output become black.
    pub fn show(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        (output, origin): (&wgpu::TextureView, [u32; 2]),
        showing: Showing,
    ) {
        let Some(targets) = &self.targets else { return };
        let place = Rect { x: origin[0], y: origin[1], width: targets.size[0], height: targets.size[1] };
        self.display.encode((&gpu.device, &gpu.queue), encoder, targets, (output, place), showing);
    }
}
