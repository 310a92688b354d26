//! The program in a real window: a display of its own (Xvfb), hands on mouse and keys, and what is seen.
//!
//! `scripts/setup window` installs the display, `cargo test --test window` runs these; `cargo test` alone does not.
#![cfg(target_os = "linux")]

mod clipboard;
mod desk;
mod dragging;
mod feel;
mod files;
mod hands;
mod kept;
mod lost;
mod panel;
mod pictures;
mod places;
mod plates;
mod saved;
mod shot;
mod small;

use std::sync::{Mutex, MutexGuard, PoisonError};

/// One program at a time: what it takes is measured.
fn alone() -> MutexGuard<'static, ()> {
    static ALONE: Mutex<()> = Mutex::new(());
    ALONE.lock().unwrap_or_else(PoisonError::into_inner)
}
