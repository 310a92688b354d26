//! Ctrl-C: asked once, long work ends with what it has; asked twice, the program ends.

use std::sync::atomic::{AtomicBool, Ordering};

/// Set once the user has asked for an end.
pub static ENDING: AtomicBool = AtomicBool::new(false);

/// From now on. Where that cannot be, Ctrl-C ends the program as ever.
pub fn listen() {
    let _ = ctrlc::set_handler(|| {
        if ENDING.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    });
}
