//! The window: its events, its surface, and when something is drawn.

use std::sync::Arc;
use std::time::Duration;

use egui::ViewportId;
use winit::application::ApplicationHandler;
use winit::dpi::LogicalSize;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow};
use winit::window::{Window, WindowId};

use super::change::Change;
use super::frame::{Frame, Presented};
use super::panel::Request;
use super::state::State;
use super::{ViewerError, native};
use crate::renderer::device;
use crate::table::SheenTable;

/// The program between its events.
pub(super) struct App {
    state: State,
    table: SheenTable,
    /// There from the first `resumed` on.
    open: Option<Open>,
    /// Why the loop was left, if that was not the user's doing.
    pub failure: Option<ViewerError>,
}

struct Open {
    window: Arc<Window>,
    frame: Frame,
    egui: egui_winit::State,
    /// The joint outcome of the passes over the user interface since the last frame.
    pending: Pending,
}

/// Passes over the user interface may come more often than frames: see `App::window_event`.
#[derive(Default)]
struct Pending {
    output: egui::FullOutput,
    change: Change,
    request: Option<Request>,
    picture: Option<egui::Rect>,
}

impl App {
    pub fn new(state: State, table: SheenTable) -> Self {
        Self { state, table, open: None, failure: None }
    }

    fn open(&mut self, event_loop: &ActiveEventLoop) -> Result<Open, ViewerError> {
        let attributes = Window::default_attributes()
            .with_title(format!("Velour - {}", self.state.name))
            .with_inner_size(LogicalSize::new(1280, 720))
            .with_min_inner_size(LogicalSize::new(480, 320));
        let window = event_loop.create_window(attributes).map_err(|error| ViewerError::Window(error.to_string()))?;
        let window = Arc::new(window);
        let (surface, gpu) = native::block_on(open_surface(&window))?;
        let frame = Frame::new(surface, gpu, window.inner_size().into(), &self.state, &self.table)?;
        let egui = egui_winit::State::new(
            egui::Context::default(),
            ViewportId::ROOT,
            &window,
            Some(window.scale_factor() as f32),
            window.theme(),
            Some(frame.max_texture_side()),
        );
        window.request_redraw();
        Ok(Open { window, frame, egui, pending: Pending { change: Change::Scene, ..Default::default() } })
    }

    /// Lets egui see the events so far and keeps what they lead to.
    fn pass(&mut self) {
        let Some(open) = &mut self.open else { return };
        let input = open.egui.take_egui_input(&open.window);
        let context = open.egui.egui_ctx().clone();
        let mut layout = None;
        let mut output = context.run_ui(input, |ui| layout = Some(super::layout::show(ui, &mut self.state)));
        open.egui.handle_platform_output(&open.window, std::mem::take(&mut output.platform_output));
        open.pending.output.append(output);
        if let Some(layout) = layout {
            open.pending.change = open.pending.change.max(layout.change);
            open.pending.request = layout.request.or(open.pending.request);
            open.pending.picture = Some(layout.picture);
        }
    }

    fn redraw(&mut self, event_loop: &ActiveEventLoop) -> Result<(), ViewerError> {
        let start = native::now();
        self.pass();
        let Some(open) = &mut self.open else { return Ok(()) };
        let shown = open.window.inner_size();
        if shown.width == 0 || shown.height == 0 {
            // Minimised: what has changed is drawn when the window comes back.
            return Ok(());
        }
        let Pending { output, change, request, picture } = std::mem::take(&mut open.pending);
        let delay = output.viewport_output.get(&ViewportId::ROOT).map_or(Duration::MAX, |root| root.repaint_delay);
        let place = picture.unwrap_or(egui::Rect::ZERO);
        let presented = open.frame.draw((open.egui.egui_ctx(), output), &self.state, place, change)?;
        if presented != Presented::Yes {
            open.pending.change = change;
        } else if change >= Change::Drawn {
            self.state.frame_time = Some(start.elapsed());
        }
        match request {
            Some(Request::Screenshot) => self.state.message = open.frame.screenshot(&self.state, &self.table),
            Some(Request::SaveState) => self.state.message = native::save_state(&self.state),
            None => {}
        }
        if presented == Presented::Again || delay.is_zero() || request.is_some() {
            open.window.request_redraw();
        } else {
            let wake = native::after(delay);
            event_loop.set_control_flow(wake.map_or(ControlFlow::Wait, ControlFlow::WaitUntil));
        }
        Ok(())
    }
}

/// A surface of the window and a device that presents to it.
async fn open_surface(window: &Arc<Window>) -> Result<(wgpu::Surface<'static>, device::Gpu), ViewerError> {
    let mut failure = ViewerError::Device(device::DeviceError::NoAdapter);
    for backends in device::BACKENDS {
        let instance = device::instance_for_window(backends, Box::new(Arc::clone(window)));
        let opened = match instance.create_surface(Arc::clone(window)) {
            Ok(surface) => device::open(&instance, None, Some(&surface)).await.map(|gpu| (surface, gpu)),
            Err(_) => continue,
        };
        match opened {
            Ok(opened) => return Ok(opened),
            Err(error) => failure = ViewerError::Device(error),
        }
    }
    Err(failure)
}

impl ApplicationHandler for App {
    fn new_events(&mut self, _event_loop: &ActiveEventLoop, cause: StartCause) {
        if let (StartCause::ResumeTimeReached { .. }, Some(open)) = (cause, &self.open) {
            open.window.request_redraw();
        }
    }

    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.open.is_some() {
            return;
        }
        match self.open(event_loop) {
            Ok(open) => self.open = Some(open),
            Err(failure) => {
                self.failure = Some(failure);
                event_loop.exit();
            }
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _window: WindowId, event: WindowEvent) {
        // egui sees only the result of what happens between two passes. On a slow driver that may be a whole drag, so
        // each press and each release gets a pass of its own.
        let button = matches!(event, WindowEvent::MouseInput { .. });
        if button {
            self.pass();
        }
        let Some(open) = &mut self.open else { return };
        let response = open.egui.on_window_event(&open.window, &event);
        if button {
            self.pass();
        }
        let Some(open) = &mut self.open else { return };
        match event {
            WindowEvent::CloseRequested => event_loop.exit(),
            WindowEvent::RedrawRequested => {
                if let Err(failure) = self.redraw(event_loop) {
                    self.failure = Some(failure);
                    event_loop.exit();
                }
            }
            WindowEvent::Resized(size) => {
                open.frame.resize(size.into());
                open.pending.change = open.pending.change.max(Change::Drawn);
                open.window.request_redraw();
            }
            // egui answers every RedrawRequested by asking for a repaint: heeding that, the window would never rest.
            _ if response.repaint => open.window.request_redraw(),
            _ => {}
        }
    }
}
