//! A window to explore a scene in: winit and egui around the renderer.
//!
//! The picture is beside the panel, never under it, and is drawn only when something has changed.

mod adding;
mod aim;
mod change;
mod clerk;
mod commands;
mod easel;
mod events;
mod facts;
mod files;
mod frame;
mod frame_time;
mod gizmo;
mod grab;
mod hands;
mod health;
mod history;
mod kept;
mod keys;
mod lamp;
mod lamps;
mod layout;
mod lens;
mod listing;
mod loading;
mod mirror;
mod native;
mod navigate;
mod offer;
mod open;
mod opening;
mod order;
mod pace;
mod painter;
mod panel;
mod pick;
mod picture;
mod recent;
mod request;
mod resting;
mod saving;
mod screen;
#[cfg(all(unix, not(target_vendor = "apple"), not(target_os = "android")))]
mod server;
mod sheet;
mod sheet_view;
mod shelf;
mod state;
mod sweep;
#[cfg(test)]
mod tests;
mod theme;
mod widgets;
mod window;
mod window_size;
mod wishes;

use winit::error::EventLoopError;
use winit::event_loop::EventLoop;

pub use files::{Files, Pictured};
pub use loading::Loading;

use crate::renderer::{DeviceError, RenderError};
use crate::table::SheenTable;

/// The window could not be opened, or could not go on.
#[derive(Debug, thiserror::Error)]
pub enum ViewerError {
    /// There is no display to open a window on.
    #[error("no display ({0})")]
    NoDisplay(String),
    /// The display does not give the window what it needs: an event loop, a surface, a format.
    #[error("the window cannot be used ({0}): use `velour render`")]
    Window(String),
    /// No graphics device could be opened.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// The scene could not be taken to the device or drawn.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The device is lost, for this reason, and no other one has come in its place.
    #[error("the graphics device was lost ({0}), and none came back: start again, or use `velour render`")]
    Lost(String),
    /// There is no scene to show, for the reason that whoever loads it gives.
    #[error("{0}")]
    Scene(String),
}

/// What a scene is called in the window: its path's last part.
fn file_name(name: &str) -> &str {
    std::path::Path::new(name).file_name().and_then(|name| name.to_str()).unwrap_or(name)
}

/// Connects to the display; [`ViewerError::NoDisplay`] where there is none.
pub fn event_loop() -> Result<EventLoop<()>, ViewerError> {
    let no_server = || ViewerError::NoDisplay("no Wayland or X11 server answers".to_owned());
    let mut builder = native::event_loop_builder().ok_or_else(no_server)?;
    // winit's own message names a line of its source.
    builder.build().map_err(|error| match error {
        EventLoopError::NotSupported(error) => ViewerError::NoDisplay(error.to_string()),
        EventLoopError::Os(_) | EventLoopError::RecreationAttempt | EventLoopError::ExitFailure(_) => no_server(),
    })
}

/// Shows the scene, at first with the edits that come with it, until the window is closed. The window does not wait for it. Other
/// files are read by `files`.
pub fn run(
    event_loop: EventLoop<()>,
    loading: Loading,
    files: Box<dyn Files>,
    table: SheenTable,
) -> Result<(), ViewerError> {
    let mut app = window::App::new((loading, files), table, event_loop.create_proxy());
    event_loop.run_app(&mut app).map_err(|error| ViewerError::Window(error.to_string()))?;
    app.failure.map_or(Ok(()), Err)
}
