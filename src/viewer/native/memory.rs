//! What is remembered from one run to the next: small texts under names, in the folder that the system has for a program's state
//! (on Linux `$XDG_STATE_HOME/velour`, or `~/.local/state/velour`).

use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use etcetera::BaseStrategy;

use crate::file::{TEMPORARY, write_atomically};

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

/// How long ago the text under this name was kept; none where there is none, or where the clock has been set back since.
pub fn age(name: &str) -> Option<Duration> {
    fs::metadata(folder()?.join(name)).and_then(|file| file.modified()).ok()?.elapsed().ok()
}

/// Forgets the oldest of the names that begin so, until there are no more than `most`; and what a run has left that was ended while it
/// wrote.
pub fn tidy(beginning: &str, most: usize) {
    folder().iter().for_each(|folder| tidy_in(folder, beginning, most));
}

fn tidy_in(folder: &Path, beginning: &str, most: usize) {
    /// Nothing takes so long to write.
    const LEFT: Duration = Duration::from_secs(600);
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let files = entries.filter_map(|entry| {
        let written = entry.metadata().and_then(|file| file.modified()).ok()?;
        Some((written, entry.file_name().to_str()?.to_owned()))
    });
    let (left, kept): (Vec<_>, Vec<_>) = files.partition(|(_, name)| name.starts_with(TEMPORARY));
    let is_left = |written: &SystemTime| written.elapsed().is_ok_and(|age| age > LEFT);
    let left = left.into_iter().filter(|(written, _)| is_left(written));
    let mut kept: Vec<_> = kept.into_iter().filter(|(_, name)| name.starts_with(beginning)).collect();
    kept.sort();
    let surplus = kept.len().saturating_sub(most);
    for (_, name) in left.chain(kept.into_iter().take(surplus)) {
        // Another window may have done it already.
        let _ = fs::remove_file(folder.join(name));
    }
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
    fn the_oldest_are_forgotten_and_what_was_left_half_written() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, minutes: u64| {
            let file = fs::File::create(folder.path().join(name)).unwrap();
            file.set_modified(SystemTime::now() - Duration::from_secs(60 * minutes)).unwrap();
        };
        for (name, minutes) in [("kept-b", 3), ("kept-a", 2), ("kept-c", 1), ("recent.toml", 500)] {
            write(name, minutes);
        }
        write(".velour-old", 20);
        write(".velour-new", 0);
        tidy_in(folder.path(), "kept-", 2);
        let mut names: Vec<_> = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        assert_eq!(names, [".velour-new", "kept-a", "kept-c", "recent.toml"]);
        tidy_in(&folder.path().join("none"), "kept-", 2);
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
