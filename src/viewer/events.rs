//! What the window hears from the system.

use std::time::Duration;

use winit::application::ApplicationHandler;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, ControlFlow};
use winit::window::WindowId;

use super::window::App;

impl ApplicationHandler for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.window().is_none() {
            let opened = self.open(event_loop);
            self.heed(event_loop, opened);
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _window: WindowId, event: WindowEvent) {
        // egui sees only the result of what happens between two passes. That may be a whole drag, or a number with the key that
        // leaves its box, so each press and each release gets a pass of its own.
        let is_press = matches!(event, WindowEvent::MouseInput { .. } | WindowEvent::KeyboardInput { .. });
        if is_press {
            self.pass();
        }
        let Some(open) = self.window() else { return };
        let response = open.egui.on_window_event(&open.window, &event);
        if is_press {
            self.pass();
        }
        let Some(open) = self.window() else { return };
        match event {
            WindowEvent::CloseRequested => self.close(event_loop),
            // The system may have lost what it had. egui answers by asking for a repaint: heeding that, the window would never rest.
            WindowEvent::RedrawRequested => open.expose(),
            // Nothing is drawn that nobody sees.
            WindowEvent::Occluded(true) => open.hide(),
            WindowEvent::Resized(_) | WindowEvent::ScaleFactorChanged { .. } | WindowEvent::Occluded(false) => {
                open.fit();
                open.expose();
                open.wake_in(Duration::ZERO);
            }
            WindowEvent::CursorMoved { .. } if response.repaint => open.follow_pointer(),
            _ if response.repaint => open.wake_in(Duration::ZERO),
            _ => {}
        }
    }

    /// The painter has something to tell.
    fn user_event(&mut self, _event_loop: &ActiveEventLoop, (): ()) {}

    /// All events so far have been seen.
    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        let done = self.follow();
        self.heed(event_loop, done);
        let due = self.next();
        event_loop.set_control_flow(due.map_or(ControlFlow::Wait, ControlFlow::WaitUntil));
    }
}
