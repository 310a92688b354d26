//! A window to explore a scene in: winit and egui around the renderer.
//!
//! The picture stands beside the panel, never under it, and is drawn only when something has changed.

mod frame;
mod layout;
mod material;
mod native;
mod orbit;
mod panel;
mod state;
mod window;

use winit::error::EventLoopError;
use winit::event_loop::EventLoop;

use crate::renderer::{DeviceError, RenderError};
use crate::scene::Scene;
use crate::table::SheenTable;

/// The window could not be opened, or not kept.
#[derive(Debug, thiserror::Error)]
pub enum ViewerError {
    #[error("no display ({0})")]
    NoDisplay(String),
    #[error("the window cannot be used ({0}): use `velour render`")]
    Window(String),
    #[error(transparent)]
    Device(#[from] DeviceError),
    #[error(transparent)]
    Render(#[from] RenderError),
}

/// Connects to the display.
pub fn event_loop() -> Result<EventLoop<()>, ViewerError> {
    // winit's own words name the line of its source.
    EventLoop::new().map_err(|error| match error {
        EventLoopError::NotSupported(error) => ViewerError::NoDisplay(error.to_string()),
        EventLoopError::Os(_) | EventLoopError::RecreationAttempt | EventLoopError::ExitFailure(_) => {
            ViewerError::NoDisplay("no Wayland or X11 server answers".to_owned())
        }
    })
}

/// Shows the scene, which is called `name`, until the window is closed.
pub fn run(event_loop: EventLoop<()>, name: &str, scene: Scene, table: SheenTable) -> Result<(), ViewerError> {
    let mut app = window::App::new(state::State::new(name, scene), table);
    event_loop.run_app(&mut app).map_err(|error| ViewerError::Window(error.to_string()))?;
    app.failure.map_or(Ok(()), Err)
}
