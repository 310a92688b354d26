//! What the viewer asks of the machine that it runs on: the time, waiting, and files. All of it stands here, so that a build for a
//! browser, where none of it is to be had, replaces this file alone.

use std::path::PathBuf;
use std::time::Duration;

use crate::file::write_atomically;
use crate::picture::DisplayImage;
use crate::renderer::Gpu;

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
    let path = free_name().ok_or("velour-001.png to velour-999.png are taken")?;
    let bytes = picture.to_png().map_err(|error| error.to_string())?;
    write_atomically(&path, &bytes).map_err(|error| error.to_string())?;
    Ok(format!("saved {}", path.display()))
}

/// The first of velour-001.png to velour-999.png that is not there.
fn free_name() -> Option<PathBuf> {
    (1..1000).map(|number| PathBuf::from(format!("velour-{number:03}.png"))).find(|path| !path.exists())
}
