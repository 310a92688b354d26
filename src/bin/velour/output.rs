//! Places where files are to be written, checked before the work.

use std::fs;
use std::path::{Path, PathBuf};

use velour::file::check_writable;

use crate::failure::Failure;

/// Makes `folder` if it is not there, and checks that files can be written to `paths` in it.
pub fn prepare(folder: &Path, paths: &[PathBuf]) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(|error| {
        Failure::input(format!("{}: the folder cannot be made ({error}): choose another place", folder.display()))
    })?;
    paths.iter().try_for_each(|path| check_writable(path)).map_err(Failure::input)
}

/// Whether both paths lead to the same file, which is there.
pub fn is_same_file(one: &Path, other: &Path) -> bool {
    one.canonicalize().is_ok_and(|one| other.canonicalize().is_ok_and(|other| one == other))
}

/// Refuses to write over the scene.
pub fn check_apart(output: &Path, scene: &Path) -> Result<(), Failure> {
    let message = || format!("{}: is the scene itself: choose another place", output.display());
    if is_same_file(output, scene) { Err(Failure::input(message())) } else { Ok(()) }
}
