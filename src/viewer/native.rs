//! What the viewer asks of the machine that it runs on: the time, waiting, and files. All of it stands here, so that a build for a
//! browser, where none of it is to be had, replaces this file alone.

use std::path::PathBuf;
use std::time::Duration;

use crate::file::write_atomically;
use crate::picture::DisplayImage;
use crate::renderer::Gpu;

use super::state::State;

/// A point in time.
pub(super) use std::time::Instant;

/// The time now.
pub(super) fn now() -> Instant {
    Instant::now()
}

/// The time after a delay; none where it lies beyond what the clock counts.
pub(super) fn after(delay: Duration) -> Option<Instant> {
    now().checked_add(delay)
}

/// Runs a future that needs no device to its end.
pub(super) fn block_on<T>(future: impl Future<Output = T>) -> T {
    pollster::block_on(future)
}

/// Runs a future that waits for the device to its end.
pub(super) fn block_on_device<T>(gpu: &Gpu, future: impl Future<Output = T>) -> T {
    gpu.block_on(future)
}

/// Waits until the device has done all that it was asked for.
pub(super) fn finish(gpu: &Gpu) {
    // A lost device shows in the next frame.
    let _ = gpu.device.poll(wgpu::PollType::wait_indefinitely());
}

/// Saves a picture in the current folder under the first free name; says where.
pub(super) fn save(picture: &DisplayImage) -> Result<String, String> {
    save_as("png", &picture.to_png().map_err(|error| error.to_string())?)
}

/// Saves what the user has changed as a text in the current folder; says where, or why not.
pub(super) fn save_state(state: &State) -> String {
    let text = format!("# Changes to {}, for --state.\n{}", one_line(&state.name), state.edits.to_text(&state.scene));
    save_as("toml", text.as_bytes()).unwrap_or_else(|error| error)
}

/// Control characters would end the comment that a name stands in.
fn one_line(name: &str) -> String {
    name.chars().filter(|character| !character.is_control()).collect()
}

/// Writes a file in the current folder under the first free name; says where.
fn save_as(extension: &str, bytes: &[u8]) -> Result<String, String> {
    let taken = || format!("velour-001.{extension} to velour-999.{extension} are taken");
    let path = free_name(extension).ok_or_else(taken)?;
    write_atomically(&path, bytes).map_err(|error| error.to_string())?;
    Ok(format!("saved {}", path.display()))
}

/// The first of velour-001 to velour-999 with this extension that is not there.
fn free_name(extension: &str) -> Option<PathBuf> {
    (1..1000).map(|number| PathBuf::from(format!("velour-{number:03}.{extension}"))).find(|path| !path.exists())
}
