//! What commands that fill a folder have in common.

use std::fs;
use std::path::{Path, PathBuf};

use indicatif::{ProgressBar, ProgressStyle};
use velour::picture::check_writable;

use crate::Failure;

/// Where files of these names go in `folder`, which is made if it is not there. What can go wrong with it does so here, before the work.
pub fn paths<const N: usize>(folder: &Path, names: [&str; N]) -> Result<[PathBuf; N], Failure> {
    fs::create_dir_all(folder).map_err(|error| {
        Failure::input(format!("{}: the folder cannot be made ({error}): choose another place", folder.display()))
    })?;
    let paths = names.map(|name| folder.join(name));
    paths.iter().try_for_each(|path| check_writable(path)).map_err(Failure::input)?;
    Ok(paths)
}

/// A bar of steps; drawn on a terminal only.
pub fn progress_bar() -> ProgressBar {
    let bar = ProgressBar::new(0);
    if let Ok(style) = ProgressStyle::with_template("{wide_bar} {pos}/{len} steps, {eta} left") {
        bar.set_style(style);
    }
    bar
}
