//! One frame of the window: the scene's passes, and egui over them.

use egui::TextureId;
use egui::epaint::textures::TexturesDelta;
use egui_wgpu::ScreenDescriptor;
use wgpu::{CurrentSurfaceTexture, TextureView};

use super::change::Change;
use super::screen::Screen;
use super::state::State;
use super::{ViewerError, native};
use crate::picture::{Blank, DisplayImage};
use crate::renderer::{Format, Gpu, Offscreen, RadianceFormat, Rect, Renderer, Showing, View};
use crate::table::SheenTable;

/// Samples per pixel of screenshots, and of the window where there is hardware to draw it.
const SAMPLES: u32 = 4;

/// Samples per pixel of the window on a software driver, where four cost twice as much and following a drag comes
/// first.
const SAMPLES_IN_SOFTWARE: u32 = 1;

/// What became of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Presented {
    Yes(Redraw),
    /// The surface had changed: draw again.
    Again,
    /// Nobody can see the window: draw when something happens.
    Hidden,
}

/// What of the scene was drawn for a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Redraw {
    /// Nothing: what had been drawn before was shown again.
    Nothing,
    /// All of it, with something that was not there before: pipelines, which drivers compile when they draw with them
    /// first, or targets of a new size.
    First,
    /// All of it, with what was there already.
    Again,
}

/// The surface and what draws on it.
pub(super) struct Frame {
    surface: wgpu::Surface<'static>,
    configuration: wgpu::SurfaceConfiguration,
    gpu: Gpu,
    renderer: Renderer,
    egui: egui_wgpu::Renderer,
    /// Textures that egui has no use for after its last pass.
    freed: Vec<TextureId>,
    /// `Renderer::made` when the scene was drawn last.
    made: usize,
    /// Whether the first picture has been looked at.
    is_checked: bool,
    /// Where the picture was drawn last.
    place: Rect,
}

impl Frame {
    pub fn new(
        surface: wgpu::Surface<'static>,
        gpu: Gpu,
        size: [u32; 2],
        state: &State,
        table: &SheenTable,
    ) -> Result<Self, ViewerError> {
        let configuration = surface
            .get_default_config(&gpu.adapter, size[0].max(1), size[1].max(1))
            .ok_or_else(|| ViewerError::Window("the adapter cannot present to it".to_owned()))?;
        let formats = surface.get_capabilities(&gpu.adapter).formats;
        // The shaders encode sRGB themselves, as egui expects it.
        let plain = [wgpu::TextureFormat::Bgra8Unorm, wgpu::TextureFormat::Rgba8Unorm];
        let plain = plain.into_iter().find(|format| formats.contains(format));
        let configuration =
            wgpu::SurfaceConfiguration { format: plain.unwrap_or(configuration.format), ..configuration };
        surface.configure(&gpu.device, &configuration);
        let software = gpu.adapter.get_info().device_type == wgpu::DeviceType::Cpu;
        let samples = if software { SAMPLES_IN_SOFTWARE } else { SAMPLES };
        let radiance = RadianceFormat::nearest_display(&gpu.adapter, samples);
        let radiance = radiance.ok_or_else(|| ViewerError::Window("the adapter cannot draw floats".to_owned()))?;
        let format = Format { radiance, output: configuration.format, measured: false };
        let renderer = Renderer::new(&gpu, format, table, &state.drawn())?;
        let egui = egui_wgpu::Renderer::new(&gpu.device, configuration.format, Default::default());
        let place = Rect::full([0, 0]);
        Ok(Self { surface, configuration, gpu, renderer, egui, freed: Vec::new(), made: 0, is_checked: false, place })
    }

    /// What is to be said of the view that was drawn last.
    pub fn notice(&self) -> Option<&str> {
        self.renderer.notice()
    }

    pub fn max_texture_side(&self) -> usize {
        self.gpu.device.limits().max_texture_dimension_2d as usize
    }

    pub fn resize(&mut self, size: [u32; 2]) {
        let limit = self.gpu.device.limits().max_texture_dimension_2d;
        [self.configuration.width, self.configuration.height] = size.map(|side| side.clamp(1, limit));
        self.surface.configure(&self.gpu.device, &self.configuration);
    }

    /// Brings egui's textures to where a pass wants them.
    pub fn update_textures(&mut self, mut delta: TexturesDelta) {
        // The pass that frees a texture may still paint with it, the next one does not.
        for id in std::mem::replace(&mut self.freed, delta.free.drain().collect()) {
            self.egui.free_texture(&id);
        }
        for (id, deltas) in delta.set.drain() {
            for delta in deltas {
                self.egui.update_texture(&self.gpu.device, &self.gpu.queue, id, &delta);
            }
        }
    }

    /// Draws what has changed and presents it.
    pub fn draw(
        &mut self,
        context: &egui::Context,
        screen: &Screen,
        state: &mut State,
    ) -> Result<Presented, ViewerError> {
        let surface_texture = match self.surface.get_current_texture() {
            CurrentSurfaceTexture::Success(texture) | CurrentSurfaceTexture::Suboptimal(texture) => texture,
            CurrentSurfaceTexture::Outdated | CurrentSurfaceTexture::Lost => {
                self.surface.configure(&self.gpu.device, &self.configuration);
                return Ok(Presented::Again);
            }
            CurrentSurfaceTexture::Timeout => return Ok(Presented::Again),
            CurrentSurfaceTexture::Occluded => return Ok(Presented::Hidden),
            CurrentSurfaceTexture::Validation => {
                return Err(ViewerError::Window("its surface is not valid".to_owned()));
            }
        };
        let view = surface_texture.texture.create_view(&Default::default());
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let drawn = self.draw_scene(&mut encoder, &view, state, screen)?;
        let jobs = context.tessellate(screen.shapes.clone(), screen.pixels_per_point);
        self.draw_egui(&mut encoder, &view, &jobs, screen.pixels_per_point);
        self.gpu.queue.submit([encoder.finish()]);
        self.gpu.queue.present(surface_texture);
        // Never more than one frame ahead, so that a slow driver still answers to the latest drag; and the frame time is
        // the frame's.
        native::finish(&self.gpu);
        Ok(Presented::Yes(drawn))
    }

    fn draw_scene(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        output: &TextureView,
        state: &mut State,
        screen: &Screen,
    ) -> Result<Redraw, ViewerError> {
        let place = self.place_in_pixels(screen.picture, screen.pixels_per_point);
        if screen.change == Change::Scene {
            self.renderer.update(&self.gpu, &state.drawn())?;
        }
        let size = [place.width, place.height];
        self.expose(state, size)?;
        let settings = state.settings();
        let showing = Showing::Shown { exposure: settings.exposure, tone: settings.tone };
        let mut drawn = Redraw::Nothing;
        if screen.change >= Change::Drawn || size != [self.place.width, self.place.height] {
            let view = View::new(&state.camera(), size, Rect::full(size));
            self.renderer.draw(&self.gpu, encoder, size, (&view, &settings, showing));
            drawn = Redraw::Again;
        }
        self.place = place;
        self.renderer.show(&self.gpu, encoder, (output, [place.x, place.y]), showing);
        let made = self.renderer.made();
        if drawn == Redraw::Again && made != self.made {
            drawn = Redraw::First;
        }
        self.made = made;
        Ok(drawn)
    }

    /// Meters where that is asked for; and looks, once, whether the first picture shows anything.
    fn expose(&mut self, state: &mut State, size: [u32; 2]) -> Result<(), ViewerError> {
        let camera = state.camera();
        if state.needs_metering() {
            let settings = state.settings();
            let metered = self.renderer.meter(&self.gpu, &camera, size, &settings);
            state.metered = Some(native::block_on_device(&self.gpu, metered)?.unwrap_or(0.0));
        }
        if std::mem::replace(&mut self.is_checked, true) {
            return Ok(());
        }
        let settings = state.settings();
        let seen = self.renderer.glance(&self.gpu, &camera, size, &settings);
        let seen = native::block_on_device(&self.gpu, seen)?.display(0.0, settings.tone);
        if let Some(blank) = Blank::of(&seen) {
            let metered = self.renderer.meter(&self.gpu, &camera, size, &settings);
            let advice = blank.advice(settings.exposure, native::block_on_device(&self.gpu, metered)?);
            state.message = advice.clone().unwrap_or_default();
            state.notices.extend(advice);
        }
        Ok(())
    }

    fn draw_egui(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        output: &TextureView,
        jobs: &[egui::ClippedPrimitive],
        pixels_per_point: f32,
    ) {
        let size_in_pixels = [self.configuration.width, self.configuration.height];
        let screen = ScreenDescriptor { size_in_pixels, pixels_per_point };
        // No paint callbacks are used, so that there are no command buffers from them to submit.
        self.egui.update_buffers(&self.gpu.device, &self.gpu.queue, encoder, jobs, &screen);
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("egui"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: output,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        });
        self.egui.render(&mut pass.forget_lifetime(), jobs, &screen);
    }

    /// The picture's pixels: at least one, none outside the surface.
    fn place_in_pixels(&self, picture: egui::Rect, pixels_per_point: f32) -> Rect {
        let pixels = |points: f32, limit: u32| (points * pixels_per_point).round().clamp(0.0, limit as f32) as u32;
        let (width, height) = (self.configuration.width, self.configuration.height);
        let (x, y) = (pixels(picture.min.x, width - 1), pixels(picture.min.y, height - 1));
        Rect {
            x,
            y,
            width: pixels(picture.max.x, width).saturating_sub(x).max(1),
            height: pixels(picture.max.y, height).saturating_sub(y).max(1),
        }
    }

    /// Saves the picture as it is shown, without the panel, into the current folder; says where, or why not.
    pub fn screenshot(&self, state: &State, table: &SheenTable) -> String {
        self.picture(state, table).and_then(|picture| native::save(&picture, state)).unwrap_or_else(|error| error)
    }

    fn picture(&self, state: &State, table: &SheenTable) -> Result<DisplayImage, String> {
        let size = [self.place.width, self.place.height];
        let (drawn, settings) = (state.drawn(), state.settings());
        let renderer = Offscreen::nearest_for_display(&self.gpu, SAMPLES, table, &drawn);
        let mut renderer = renderer.map_err(|error| error.to_string())?;
        let camera = state.camera();
        let picture = renderer.display(&self.gpu, &camera, size, &settings);
        native::block_on_device(&self.gpu, picture).map_err(|error| error.to_string())
    }
}
