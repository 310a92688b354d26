//! Writing a file so that it appears whole or not at all.

use std::io::Write;
use std::path::{Path, PathBuf};

/// How the names of files begin that have not got their own yet.
pub(crate) const TEMPORARY: &str = ".velour-";

/// A file could not be written.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The system refuses.
    #[error("{}: cannot be written ({source}): choose another place", path.display())]
    Path {
        /// Where it was to be written.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// There is no such folder; none is made.
    #[error("{}: its folder is not there: make it first", path.display())]
    NoFolder {
        /// Where it was to be written.
        path: PathBuf,
    },
    /// There is a file that is not to be written over.
    #[error("{}: is there already: choose another name", path.display())]
    Taken {
        /// Where it was to be written.
        path: PathBuf,
    },
    /// A folder stands in its place.
    #[error("{}: is a folder: give a file's name", path.display())]
    Folder {
        /// Where it was to be written.
        path: PathBuf,
    },
}

/// Says whether `path` can be written, before the work is done: its folder exists and takes a new file, and it is no
/// folder itself.
pub fn check_writable(path: &Path) -> Result<(), WriteError> {
    if path.is_dir() {
        return Err(WriteError::Folder { path: path.to_owned() });
    }
    temporary_beside(path).map(drop)
}

/// Writes a file that appears whole or not at all: beside its place first, then renamed.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    if path.is_dir() {
        return Err(WriteError::Folder { path: path.to_owned() });
    }
    let error = |source| WriteError::Path { path: path.to_owned(), source };
    let mut file = temporary_beside(path)?;
    file.write_all(bytes).map_err(error)?;
    file.persist(path).map_err(|persist| error(persist.error))?;
    Ok(())
}

/// The same where there is no file yet: what is there is left as it is.
pub fn write_new(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    let mut file = temporary_beside(path)?;
    file.write_all(bytes).map_err(|source| WriteError::Path { path: path.to_owned(), source })?;
    match file.persist_noclobber(path) {
        Ok(_) => Ok(()),
        Err(persist) if persist.error.kind() == std::io::ErrorKind::AlreadyExists => {
            Err(WriteError::Taken { path: path.to_owned() })
        }
        Err(persist) => Err(WriteError::Path { path: path.to_owned(), source: persist.error }),
    }
}

fn temporary_beside(path: &Path) -> Result<tempfile::NamedTempFile, WriteError> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        return Err(WriteError::NoFolder { path: path.to_owned() });
    }
    let mut builder = tempfile::Builder::new();
    builder.prefix(TEMPORARY);
    // Like any new file: what the user's umask leaves of it, not tempfile's owner-only default.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder).map_err(|source| WriteError::Path { path: path.to_owned(), source })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_appear_whole_in_folders_that_exist() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("picture.png");
        check_writable(&path).unwrap();
        assert!(!path.exists());
        write_atomically(&path, b"first").unwrap();
        write_atomically(&path, b"second").unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"second");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn what_is_there_is_not_written_over() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("picture.png");
        write_new(&path, b"first").unwrap();
        assert!(matches!(write_new(&path, b"second"), Err(WriteError::Taken { .. })));
        assert!(write_new(folder.path(), b"x").is_err());
        assert_eq!(std::fs::read(&path).unwrap(), b"first");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn folders_and_missing_folders_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        for path in [folder.path().to_owned(), folder.path().join("missing/picture.png")] {
            let said = check_writable(&path).unwrap_err().to_string();
            assert!(said.contains(&path.display().to_string()) && !said.contains('\n'), "{said}");
            assert!(write_atomically(&path, b"x").is_err());
        }
    }
}
