//! Progress of long work.

use indicatif::{ProgressBar, ProgressStyle};

/// Does `work`, which reports its (done, all) steps, under a bar that only a terminal shows.
pub fn with_progress<T>(name: &'static str, work: impl FnOnce(&(dyn Fn(usize, usize) + Sync)) -> T) -> T {
    let bar = ProgressBar::new(0).with_message(name);
    if let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} {pos}/{len} steps, {eta} left") {
        bar.set_style(style);
    }
    let done = work(&|done, all| {
        bar.set_length(all as u64);
        bar.set_position(done as u64);
    });
    bar.finish_and_clear();
    done
}
