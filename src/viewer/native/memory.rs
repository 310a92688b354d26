//! What is remembered from one run to the next: small texts under names, in the folder that the system has for a program's state
//! (on Linux `$XDG_STATE_HOME/velour`, or `~/.local/state/velour`).

use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use etcetera::BaseStrategy;

use crate::file::write_atomically;

/// The longest text that is read, bytes: what is longer is not ours.
const LONGEST: u64 = 1 << 24;

/// The text under this name, of the form `name.toml`; none where there is none, or none that can be read.
pub fn remembered(name: &str) -> Option<String> {
    read(&folder()?.join(name))
}

/// Keeps a text under this name, whole or not at all; why not, where it cannot.
pub fn remember(name: &str, text: &str) -> Result<(), String> {
    let folder = folder().ok_or("the system has no folder for it")?;
    keep(&folder, name, text)
}

/// Keeps nothing under this name any more.
pub fn forget(name: &str) {
    // Where it cannot be removed it is offered once more, no worse.
    let _ = folder().map(|folder| fs::remove_file(folder.join(name)));
}

fn folder() -> Option<PathBuf> {
    let folders = etcetera::choose_base_strategy().ok()?;
    Some(folders.state_dir().unwrap_or(folders.data_dir()).join("velour"))
}

fn read(path: &Path) -> Option<String> {
    // A pipe of this name would be waited for.
    fs::metadata(path).ok().filter(|file| file.is_file() && file.len() <= LONGEST)?;
    let mut text = String::new();
    fs::File::open(path).and_then(|file| file.take(LONGEST).read_to_string(&mut text)).ok()?;
    Some(text)
}

fn keep(folder: &Path, name: &str, text: &str) -> Result<(), String> {
    let failed = |error: io::Error| format!("{}: {error}", folder.display());
    fs::create_dir_all(folder).map_err(failed)?;
    write_atomically(&folder.join(name), text.as_bytes()).map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_is_read_again() {
        let folder = tempfile::tempdir().unwrap();
        let inner = folder.path().join("a/b");
        assert_eq!(read(&inner.join("x.toml")), None);
        for text in ["", "alpha = 0.3\n", "grün"] {
            keep(&inner, "x.toml", text).unwrap();
            assert_eq!(read(&inner.join("x.toml")).as_deref(), Some(text));
        }
        assert_eq!(fs::read_dir(&inner).unwrap().count(), 1);
    }

    #[test]
    fn what_is_no_text_is_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::write(at("bytes"), [0xff, 0xfe, 0]).unwrap();
        fs::create_dir(at("folder")).unwrap();
        fs::File::create(at("long")).unwrap().set_len(LONGEST + 1).unwrap();
        assert_eq!(["bytes", "folder", "long", "none"].map(|name| read(&at(name))), [const { None }; 4]);
        let why = keep(&at("bytes"), "x", "").unwrap_err();
        assert!(why.contains("bytes"), "{why}");
    }
}
