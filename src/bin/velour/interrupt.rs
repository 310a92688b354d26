//! Ctrl-C: asked once, long work ends with what it has; asked twice, the program ends.

use std::sync::atomic::{AtomicBool, Ordering};

/// Set once the user has asked for an end.
pub static ENDING: AtomicBool = AtomicBool::new(false);

/// Listens from now on. Where that is not possible, Ctrl-C ends the program as usual.
pub fn listen() {
    let _ = ctrlc::set_handler(|| {
        if ENDING.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    });
}
