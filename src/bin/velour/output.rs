//! Places where files are to be written, checked before the work.

use std::fs;
use std::path::{Path, PathBuf};

use velour::file::check_writable;
use velour::scene::Scene;

use crate::failure::Failure;

/// Makes `folder` if it is not there, and checks that files can be written to `paths` in it.
pub fn prepare(folder: &Path, paths: &[PathBuf]) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(|error| {
        Failure::input(format!("{}: the folder cannot be made ({error}): choose another place", folder.display()))
    })?;
    paths.iter().try_for_each(|path| check_writable(path)).map_err(Failure::input)
}

/// Whether both paths lead to the same file, which is there: by links too.
pub fn is_same_file(one: &Path, other: &Path) -> bool {
    identity(one).is_some_and(|one| identity(other) == Some(one))
}

/// What a file's names have in common.
#[cfg(unix)]
fn identity(path: &Path) -> Option<(u64, u64)> {
    use std::os::unix::fs::MetadataExt;
    fs::metadata(path).ok().map(|metadata| (metadata.dev(), metadata.ino()))
}

/// What a file's names have in common; links to one file count as files of their own.
#[cfg(not(unix))]
fn identity(path: &Path) -> Option<PathBuf> {
    path.canonicalize().ok()
}

/// Refuses to write over what the picture is made from: the scene, its buffers and images, and `others`, each with what it is.
pub fn check_apart(output: &Path, scene: &Scene, others: &[(&str, &Path)]) -> Result<(), Failure> {
    let what = match scene.files.iter().position(|file| is_same_file(output, file)) {
        Some(0) => "the scene itself",
        Some(_) => "a file of the scene",
        None => match others.iter().find(|(_, file)| is_same_file(output, file)) {
            Some((what, _)) => what,
            None => return Ok(()),
        },
    };
    Err(Failure::input(format!("{}: is {what}: choose another place", output.display())))
}
