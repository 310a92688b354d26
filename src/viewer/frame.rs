//! One frame of the window: the picture where it belongs, and egui over it.

use egui::TextureId;
use egui::epaint::ClippedPrimitive;
use egui::epaint::textures::TexturesDelta;
use egui_wgpu::ScreenDescriptor;
use wgpu::{CommandEncoder, CurrentSurfaceTexture, TextureFormat, TextureView};

use super::ViewerError;
use super::order::Unseen;
use crate::renderer::{Format, Gpu, RadianceFormat, Rect};

/// Samples per pixel of the window where there is hardware to draw it.
const SAMPLES: u32 = 4;
/// On a software driver four cost twice as much, and following a drag comes first.
const SAMPLES_IN_SOFTWARE: u32 = 1;

/// The window's surface, and what egui paints on it.
pub(super) struct Frame {
    surface: wgpu::Surface<'static>,
    configuration: wgpu::SurfaceConfiguration,
    egui: egui_wgpu::Renderer,
    /// Textures that egui has no use for after its last pass.
    freed: Vec<TextureId>,
    primitives: Vec<ClippedPrimitive>,
    pixels_per_point: f32,
}

/// What a frame is drawn into.
pub(super) struct Canvas {
    texture: wgpu::SurfaceTexture,
    pub view: TextureView,
}

impl Frame {
    pub fn new(surface: wgpu::Surface<'static>, gpu: &Gpu, size: [u32; 2]) -> Result<Self, ViewerError> {
        let configuration = surface
            .get_default_config(&gpu.adapter, size[0].max(1), size[1].max(1))
            .ok_or_else(|| ViewerError::Window("the adapter cannot present to it".to_owned()))?;
        let formats = surface.get_capabilities(&gpu.adapter).formats;
        // The shaders encode sRGB themselves, as egui expects it.
        let plain = [TextureFormat::Bgra8Unorm, TextureFormat::Rgba8Unorm];
        let plain = plain.into_iter().find(|format| formats.contains(format));
        let configuration =
            wgpu::SurfaceConfiguration { format: plain.unwrap_or(configuration.format), ..configuration };
        surface.configure(&gpu.device, &configuration);
        // Greys that are dithered would have to be painted anew with each frame.
        let options = egui_wgpu::RendererOptions { dithering: false, ..Default::default() };
        let egui = egui_wgpu::Renderer::new(&gpu.device, configuration.format, options);
        Ok(Self { surface, configuration, egui, freed: Vec::new(), primitives: Vec::new(), pixels_per_point: 1.0 })
    }

    /// In which formats the picture is kept and shown.
    pub fn format(&self, gpu: &Gpu) -> Result<Format, ViewerError> {
        let samples = if gpu.is_software() { SAMPLES_IN_SOFTWARE } else { SAMPLES };
        let radiance = RadianceFormat::nearest_display(&gpu.adapter, samples);
        let radiance = radiance.ok_or_else(|| ViewerError::Window("the adapter cannot draw floats".to_owned()))?;
        Ok(Format { radiance, output: self.configuration.format, measured: false })
    }

    /// Makes the surface of this size, in pixels.
    pub fn resize(&mut self, gpu: &Gpu, size: [u32; 2]) {
        let limit = gpu.device.limits().max_texture_dimension_2d;
        let [width, height] = size.map(|side| side.clamp(1, limit));
        if [width, height] != [self.configuration.width, self.configuration.height] {
            [self.configuration.width, self.configuration.height] = [width, height];
            self.surface.configure(&gpu.device, &self.configuration);
        }
    }

    /// Brings egui's textures to where a pass wants them.
    pub fn update_textures(&mut self, gpu: &Gpu, mut delta: TexturesDelta) {
        // The pass that frees a texture may still paint with it, the next one does not.
        for id in std::mem::replace(&mut self.freed, delta.free.drain().collect()) {
            self.egui.free_texture(&id);
        }
        for (id, deltas) in delta.set.drain() {
            for delta in deltas {
                self.egui.update_texture(&gpu.device, &gpu.queue, id, &delta);
            }
        }
    }

    /// Takes what egui paints from now on.
    pub fn take(&mut self, primitives: Vec<ClippedPrimitive>, pixels_per_point: f32) {
        (self.primitives, self.pixels_per_point) = (primitives, pixels_per_point);
    }

    /// A texture that egui can paint, and that pictures can be shown in.
    pub fn add_texture(&mut self, gpu: &Gpu, size: [u32; 2]) -> (TextureId, TextureView) {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("tile"),
            size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: self.configuration.format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let view = texture.create_view(&Default::default());
        (self.egui.register_native_texture(&gpu.device, &view, wgpu::FilterMode::Linear), view)
    }

    /// Forgets such a texture.
    pub fn remove_texture(&mut self, id: TextureId) {
        self.egui.free_texture(&id);
    }

    /// What the next frame is drawn into.
    pub fn begin(&mut self, gpu: &Gpu) -> Result<Result<Canvas, Unseen>, ViewerError> {
        let texture = match self.surface.get_current_texture() {
            CurrentSurfaceTexture::Success(texture) | CurrentSurfaceTexture::Suboptimal(texture) => texture,
            CurrentSurfaceTexture::Outdated => {
                self.surface.configure(&gpu.device, &self.configuration);
                return Ok(Err(Unseen::Again));
            }
            CurrentSurfaceTexture::Timeout => return Ok(Err(Unseen::Again)),
            CurrentSurfaceTexture::Occluded => return Ok(Err(Unseen::Hidden)),
            CurrentSurfaceTexture::Lost => return Err(ViewerError::Lost("the window's surface is gone".to_owned())),
            CurrentSurfaceTexture::Validation => {
                return Err(ViewerError::Lost("the window's surface is not valid".to_owned()));
            }
        };
        let view = texture.texture.create_view(&Default::default());
        Ok(Ok(Canvas { texture, view }))
    }

    /// Paints egui's part over what is drawn, or over black, and presents it.
    pub fn end(&mut self, gpu: &Gpu, mut encoder: CommandEncoder, canvas: Canvas, is_drawn: bool) {
        let size_in_pixels = [self.configuration.width, self.configuration.height];
        let screen = ScreenDescriptor { size_in_pixels, pixels_per_point: self.pixels_per_point };
        // No paint callbacks are used, so that there are no command buffers from them to submit.
        self.egui.update_buffers(&gpu.device, &gpu.queue, &mut encoder, &self.primitives, &screen);
        let load = if is_drawn { wgpu::LoadOp::Load } else { wgpu::LoadOp::Clear(wgpu::Color::BLACK) };
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("egui"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &canvas.view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        });
        self.egui.render(&mut pass.forget_lifetime(), &self.primitives, &screen);
        gpu.queue.submit([encoder.finish()]);
        gpu.queue.present(canvas.texture);
    }

    /// A rectangle in points as pixels: at least one, none outside the surface.
    pub fn in_pixels(&self, place: egui::Rect) -> Rect {
        pixels_within(place, self.pixels_per_point, [self.configuration.width, self.configuration.height])
    }
}

/// Width and height in pixels of a rectangle in points.
pub(super) fn pixel_size(place: egui::Rect, pixels_per_point: f32) -> [u32; 2] {
    let Rect { width, height, .. } = pixels_within(place, pixels_per_point, [u32::MAX; 2]);
    [width, height]
}

/// A rectangle in points as pixels: at least one, none outside of this size.
fn pixels_within(place: egui::Rect, pixels_per_point: f32, [width, height]: [u32; 2]) -> Rect {
    let pixels = |points: f32, limit: u32| (points * pixels_per_point).round().clamp(0.0, limit as f32) as u32;
    let (x, y) = (pixels(place.min.x, width - 1), pixels(place.min.y, height - 1));
    Rect {
        x,
        y,
        width: pixels(place.max.x, width).saturating_sub(x).max(1),
        height: pixels(place.max.y, height).saturating_sub(y).max(1),
    }
}
