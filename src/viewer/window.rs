//! The window: its events, its surface, and when something is drawn.

use std::sync::Arc;
use std::time::Duration;

use egui::ViewportId;
use winit::application::ApplicationHandler;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, ControlFlow};
use winit::monitor::MonitorHandle;
use winit::window::{Fullscreen, Window, WindowId};

use super::ViewerError;
use super::frame::{Frame, Presented, Redraw};
use super::frame_time::FrameTimes;
use super::layout::{self, Layout};
use super::native::{self, Instant};
use super::request::Request;
use super::screen::Screen;
use super::state::State;
use super::{theme, window_size};
use crate::renderer::device;
use crate::table::SheenTable;

/// The least time between two passes for a pointer that only hovers: a mouse may tell of its moves a thousand times a
/// second, a display shows sixty pictures.
const PACE: Duration = Duration::from_millis(16);

/// How long egui waits for its next pass after one that has led to nothing. It asks for two more after all input, so that
/// what lags behind can settle, and no frame makes it wait.
const REST: Duration = Duration::from_millis(100);

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
    screen: Screen,
    frame_times: FrameTimes,
    /// When egui had its last pass.
    passed: Instant,
    /// When it gets its next; never while nothing happens.
    due: Option<Instant>,
}

impl Open {
    /// The next pass comes at this time, or when it was due before, if that is earlier.
    fn wake(&mut self, at: Instant) {
        self.due = Some(self.due.map_or(at, |due| due.min(at)));
    }

    fn is_due(&self) -> bool {
        self.due.is_some_and(|due| due <= native::now())
    }

    /// Over all of the screen, or back as it was.
    fn toggle_fullscreen(&self) {
        let is_full = self.window.fullscreen().is_some();
        self.window.set_fullscreen((!is_full).then_some(Fullscreen::Borderless(None)));
    }

    /// When egui hears of an event.
    fn when_to_tell(&self, event: &WindowEvent) -> Instant {
        let is_move = matches!(event, WindowEvent::CursorMoved { .. });
        let is_hover = is_move && !self.egui.egui_ctx().input(|input| input.pointer.any_down());
        if is_hover { self.passed + PACE } else { native::now() }
    }
}

impl App {
    pub fn new(state: State, table: SheenTable) -> Self {
        Self { state, table, open: None, failure: None }
    }

    fn open(&mut self, event_loop: &ActiveEventLoop) -> Result<Open, ViewerError> {
        // Where the system names no first monitor, the window may appear on any.
        let mut monitors: Vec<MonitorHandle> = event_loop.primary_monitor().into_iter().collect();
        if monitors.is_empty() {
            monitors.extend(event_loop.available_monitors());
        }
        let [size, least] = window_size::sizes(monitors.iter().map(|monitor| (monitor.size(), monitor.scale_factor())));
        let attributes = Window::default_attributes()
            .with_title(format!("Velour - {}", self.state.name))
            .with_inner_size(size)
            .with_min_inner_size(least);
        let window = event_loop.create_window(attributes).map_err(|error| ViewerError::Window(error.to_string()))?;
        let window = Arc::new(window);
        let (surface, gpu) = native::block_on(open_surface(&window))?;
        let frame = Frame::new(surface, gpu, window.inner_size().into(), &self.state, &self.table)?;
        let context = egui::Context::default();
        theme::apply(&context);
        context.set_zoom_factor(window_size::zoom(window.inner_size().to_logical(window.scale_factor())));
        let egui = egui_winit::State::new(
            context,
            ViewportId::ROOT,
            &window,
            Some(window.scale_factor() as f32),
            window.theme(),
            Some(frame.max_texture_side()),
        );
        window.request_redraw();
        let now = native::now();
        let (screen, frame_times) = (Screen::new(), FrameTimes::default());
        Ok(Open { window, frame, egui, screen, frame_times, passed: now, due: Some(now) })
    }

    /// Lets egui see the events so far and keeps what they lead to.
    fn pass(&mut self) {
        let Some(open) = &mut self.open else { return };
        let input = open.egui.take_egui_input(&open.window);
        let context = open.egui.egui_ctx().clone();
        let mut layout = Layout::default();
        let mut output = context.run_ui(input, |ui| {
            let last = layout::show(ui, &mut self.state);
            // egui may want to do it all over with the sizes that it has found, and without the events.
            let (change, request) = (layout.change.max(last.change), layout.request.or(last.request));
            layout = Layout { change, request, ..last };
        });
        open.egui.handle_platform_output(&open.window, std::mem::take(&mut output.platform_output));
        let delay = output.viewport_output.get(&ViewportId::ROOT).map_or(Duration::MAX, |root| root.repaint_delay);
        let textures = open.screen.take(&layout, output);
        open.frame.update_textures(textures);
        let delay = if open.screen.is_stale() { delay } else { delay.max(REST) };
        (open.passed, open.due) = (native::now(), native::after(delay));
        if let Some(request) = layout.request {
            let said = match request {
                Request::Screenshot => open.frame.screenshot(&self.state, &self.table),
                Request::SaveState => native::save_state(&self.state),
                Request::Fullscreen => return open.toggle_fullscreen(),
            };
            self.state.say(said);
            open.wake(open.passed);
        }
    }

    /// A pass, and a frame if that has led to something new.
    fn follow(&mut self) {
        self.pass();
        if let Some(open) = &mut self.open {
            let (is_building, is_built) = open.frame.building();
            if is_built {
                open.screen.lose();
            } else if is_building && let Some(later) = native::after(REST) {
                open.wake(later);
            }
        }
        if let Some(open) = self.open.as_ref().filter(|open| open.screen.is_stale()) {
            open.window.request_redraw();
        }
    }

    /// Presents a frame, whatever has changed: the system may have lost the last one.
    fn redraw(&mut self) -> Result<(), ViewerError> {
        let start = native::now();
        if self.open.as_ref().is_some_and(Open::is_due) {
            self.pass();
        }
        let Some(open) = &mut self.open else { return Ok(()) };
        if open.frame.building().0
            && let Some(later) = native::after(REST)
        {
            open.wake(later);
        }
        open.screen.lose();
        let shown = open.window.inner_size();
        if shown.width == 0 || shown.height == 0 {
            // Minimised: what has changed is drawn when the window comes back.
            return Ok(());
        }
        let (metered, notices) = (self.state.metered, self.state.notices.len());
        let presented = open.frame.draw(open.egui.egui_ctx(), &open.screen, &mut self.state)?;
        if (metered, notices) != (self.state.metered, self.state.notices.len()) {
            // The panel shows both.
            open.wake(native::now());
        }
        match presented {
            Presented::Yes(drawn) => {
                open.screen.presented();
                if self.state.notice.as_deref() != open.frame.notice() {
                    self.state.notice = open.frame.notice().map(str::to_owned);
                    open.wake(native::now());
                }
                let samples = open.frame.samples(&self.state);
                if self.state.samples != samples {
                    self.state.samples = samples;
                    open.wake(native::now());
                }
                if !open.frame.is_at_rest(&self.state) {
                    open.window.request_redraw();
                }
                if drawn == Redraw::Again {
                    open.frame_times.add(start.elapsed());
                    self.state.frame_time = open.frame_times.median();
                    // The panel shows it.
                    open.wake(native::now());
                }
            }
            Presented::Again => open.window.request_redraw(),
            Presented::Hidden => {}
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
            self.follow();
        }
        let Some(open) = &mut self.open else { return };
        match event {
            WindowEvent::CloseRequested => event_loop.exit(),
            WindowEvent::RedrawRequested => {
                if let Err(failure) = self.redraw() {
                    self.failure = Some(failure);
                    event_loop.exit();
                }
            }
            WindowEvent::Resized(size) => {
                open.frame.resize(size.into());
                open.screen.lose();
                open.wake(native::now());
            }
            // egui answers every RedrawRequested by asking for a repaint: heeding that, the window would never rest.
            _ if response.repaint => open.wake(open.when_to_tell(&event)),
            _ => {}
        }
    }

    /// All events so far have been seen.
    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        if self.open.as_ref().is_some_and(Open::is_due) {
            self.follow();
        }
        let due = self.open.as_ref().and_then(|open| open.due);
        event_loop.set_control_flow(due.map_or(ControlFlow::Wait, ControlFlow::WaitUntil));
    }
}
