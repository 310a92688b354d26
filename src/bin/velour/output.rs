//! What commands that fill a folder have in common.

use std::fs;
use std::path::{Path, PathBuf};

use indicatif::{ProgressBar, ProgressStyle};
use velour::file::check_writable;

use crate::Failure;

/// Makes `folder` if it is not there and sees that files can be written to `paths` in it: what can go wrong does so before the work.
pub fn prepare(folder: &Path, paths: &[PathBuf]) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(|error| {
        Failure::input(format!("{}: the folder cannot be made ({error}): choose another place", folder.display()))
    })?;
    paths.iter().try_for_each(|path| check_writable(path)).map_err(Failure::input)
}

/// Whether both names stand for one file that is there.
pub fn is_same_file(one: &Path, other: &Path) -> bool {
    one.canonicalize().is_ok_and(|one| other.canonicalize().is_ok_and(|other| one == other))
}

/// Does `work`, which tells of its (done, all) steps, under a bar that is drawn on a terminal only.
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
