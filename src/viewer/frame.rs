//! One frame of the window: the scene's passes, and egui over them.

use egui::TextureId;
use egui::epaint::textures::TexturesDelta;
use egui_wgpu::ScreenDescriptor;
use wgpu::{CurrentSurfaceTexture, TextureView};

use super::change::Change;
use super::native::Task;
use super::resting::{Resting, Step};
use super::screen::Screen;
use super::state::State;
use super::{ViewerError, native};
use crate::picture::{Blank, DisplayImage};
use crate::renderer::{Built, Format, Gpu, Offscreen, RadianceFormat, Rect, Renderer, Sample, Showing, View};
use crate::scene::Settings;
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
    /// One more sample of a picture at rest.
    Sample,
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
    /// What of a change has not been drawn yet.
    undrawn: Change,
    resting: Resting,
    /// Whether a frame takes so long that what moves is drawn in fewer pixels.
    is_slow: bool,
    /// What is built for shadows.
    building: Option<Task<Built>>,
}

/// Triangles that are sorted for shadows within a frame; more are on a thread of their own.
const QUICK: usize = 10_000;
/// What moves is drawn with so many times fewer pixels a side, where that is slow.
const COARSE: u32 = 2;

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
        Ok(Self {
            surface,
            configuration,
            gpu,
            renderer,
            egui,
            freed: Vec::new(),
            made: 0,
            is_checked: false,
            place,
            undrawn: Change::Scene,
            resting: Resting::default(),
            is_slow: software,
            building: None,
        })
    }

    /// Whether more is to be drawn although nothing changes.
    pub fn is_at_rest(&self, state: &State) -> bool {
        !self.renderer.has_shadows(&state.settings()) || self.resting.is_at_rest()
    }

    /// Whether something is being built, and whether that has come to its end: then the picture is to be drawn.
    pub fn building(&self) -> (bool, bool) {
        let task = self.building.as_ref();
        (task.is_some(), task.is_some_and(Task::is_done))
    }

    /// Samples of the picture that is shown, where it has shadows.
    pub fn samples(&self, state: &State) -> Option<u32> {
        self.renderer.has_shadows(&state.settings()).then(|| self.renderer.samples())
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
        let resized = size != [self.place.width, self.place.height];
        self.undrawn = self.undrawn.max(screen.change).max(if resized { Change::Drawn } else { Change::None });
        self.place = place;
        // What was drawn before is shown until shadows follow.
        let drawn =
            if self.build_shadows(state) { self.draw_picture(encoder, state, &settings) } else { Redraw::Nothing };
        let showing = Showing::Shown { exposure: settings.exposure, tone: settings.tone };
        self.renderer.show(&self.gpu, encoder, (output, place), showing);
        let made = std::mem::replace(&mut self.made, self.renderer.made());
        Ok(if drawn == Redraw::Again && made != self.made { Redraw::First } else { drawn })
    }

    fn draw_picture(&mut self, encoder: &mut wgpu::CommandEncoder, state: &State, settings: &Settings) -> Redraw {
        let has_shadows = self.renderer.has_shadows(settings);
        let least = if has_shadows { Change::Drawn } else { Change::Exposed };
        let moved = std::mem::take(&mut self.undrawn) >= least;
        let mut size = [self.place.width, self.place.height];
        let step = match has_shadows {
            true => self.resting.step(moved, self.is_slow),
            false if moved => Step::Sample(0),
            false => Step::Enough,
        };
        let index = match step {
            Step::Enough => return Redraw::Nothing,
            Step::Coarse => {
                size = size.map(|side| side.div_ceil(COARSE));
                0
            }
            Step::Sample(index) => index,
        };
        let full = [self.place.width, self.place.height];
        let view = View::new(&state.camera(), full, Rect::full(full));
        let showing = Showing::Shown { exposure: settings.exposure, tone: settings.tone };
        let sample = Sample { index, seed: 0, spread: true };
        self.renderer.draw(&self.gpu, encoder, size, (&view, settings, showing), &sample);
        if moved { Redraw::Again } else { Redraw::Sample }
    }

    /// Sees to what shadows take, and whether the picture may be drawn: where it is built on a thread of its own the first picture
    /// comes without shadows, others once it is there.
    fn build_shadows(&mut self, state: &State) -> bool {
        if let Some(task) = self.building.take_if(|task| task.is_done())
            && let Some(built) = task.outcome()
        {
            self.renderer.receive(&self.gpu, built);
            self.undrawn = Change::Scene;
        }
        // At rest nothing can have become stale.
        if self.building.is_none()
            && self.undrawn >= Change::Drawn
            && let Some(blockers) = self.renderer.blockers(&self.gpu, &state.drawn())
        {
            if blockers.triangles() > QUICK {
                self.building = Some(Task::start(|| blockers.build()));
            } else {
                self.renderer.receive(&self.gpu, blockers.build());
            }
        }
        self.building.is_none() || !self.renderer.has_shadows(&state.settings())
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
            if let Some(advice) = advice {
                state.notices.push(advice.clone());
                state.say(advice);
            }
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
