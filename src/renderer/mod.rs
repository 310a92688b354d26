//! wgpu: device, targets, passes. The same passes draw offscreen and on a window's surface.
//!
//! A frame goes through two passes. The first draws every surface's radiance, lit by the polygon lights in closed form,
//! into floating-point targets; the second shows it (exposure, tone curve, sRGB) or measures it (plain linear radiance).

pub mod device;
mod display;
#[cfg(test)]
mod layout;
mod offscreen;
mod resident;
mod surfaces;
mod targets;
mod view;

pub use device::{DeviceError, Gpu};
pub use display::Showing;
pub use offscreen::Offscreen;
pub use surfaces::SURFACES_WGSL;
pub use targets::RadianceFormat;
pub use view::{Rect, View};

use display::DisplayPass;
use resident::Resident;
use surfaces::SurfacesPass;
use targets::Targets;

use crate::scene::{Camera, Scene, Settings};
use crate::table::LtcTable;

/// A picture could not be made.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    #[error(
        "{what} take {bytes} bytes on the device, which holds at most {limit} in one piece: split the mesh or use another adapter"
    )]
    TooLarge { what: String, bytes: u64, limit: u64 },
    #[error("size {}x{} is past what this adapter draws: use 1x1 to {limit}x{limit}", size[0], size[1])]
    Size { size: [u32; 2], limit: u32 },
    #[error("the device did not hand the picture over ({0}): try a smaller --size or another --adapter")]
    Readback(String),
}

/// What is drawn, and how it is kept and shown.
#[derive(Clone, Copy, Debug)]
pub struct Format {
    pub radiance: RadianceFormat,
    pub output: wgpu::TextureFormat,
    /// The output is plain linear radiance (`Showing::Measured`).
    pub measured: bool,
}

/// A scene on a device, ready to be drawn from any view.
pub struct Renderer {
    format: Format,
    resident: Resident,
    surfaces: SurfacesPass,
    display: DisplayPass,
    targets: Option<Targets>,
}

impl Renderer {
    /// Uploads the scene and makes the pipelines. Drivers may put off compiling them until the first frame.
    pub fn new(
        gpu: &Gpu,
        format: Format,
        table: &LtcTable,
        scene: &Scene,
        settings: &Settings,
    ) -> Result<Self, RenderError> {
        let resident = Resident::new(&gpu.device, scene, settings)?;
        let surfaces = SurfacesPass::new(&gpu.device, &gpu.queue, format.radiance, table, &resident);
        let display = DisplayPass::new(&gpu.device, format.radiance, format.output, format.measured);
        Ok(Self { format, resident, surfaces, display, targets: None })
    }

    /// Takes over changed materials, lights, places and settings of the same scene.
    pub fn update(&mut self, gpu: &Gpu, scene: &Scene, settings: &Settings) {
        self.resident.update(&gpu.queue, scene, settings);
        self.surfaces.prepare(&gpu.device, &self.resident);
    }

    /// Draws the view into the rectangle `place` of the output, whose other pixels become black.
    pub fn encode(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        (output, place): (&wgpu::TextureView, Rect),
        (view, settings, showing): (&View, &Settings, Showing),
    ) {
        let size = [place.width, place.height];
        let targets = match self.targets.take() {
            Some(targets) if targets.size == size => targets,
            _ => Targets::new(&gpu.device, size, self.format.radiance),
        };
        self.surfaces.encode(&gpu.queue, encoder, &targets, &self.resident, (view, settings));
        self.display.encode((&gpu.device, &gpu.queue), encoder, &targets, (output, place), showing);
        self.targets = Some(targets);
    }

    /// What the camera sees in the whole of a picture of this size.
    pub fn view(camera: &Camera, size: [u32; 2]) -> View {
        View::new(camera, size, Rect::full(size))
    }
}
