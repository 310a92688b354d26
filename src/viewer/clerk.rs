//! Errands to files that are done aside, one after another, so that the window waits for no disk.

use std::path::{Path, PathBuf};

use super::kept::{self, Kept};
use super::{native, recent};

/// What is to be done.
pub enum Errand {
    /// Keep the changes of a scene.
    Keep(Kept),
    /// Forget them.
    Forget(String),
    /// Forget what was offered under this name, unless it has been kept anew meanwhile.
    Decline(String, String),
    /// A scene has been opened: list it with those that were opened last.
    Opened(PathBuf),
    /// List what may be meant by what has been typed.
    List(String),
}

/// What has come of it.
#[derive(Debug, PartialEq)]
pub enum Done {
    Well,
    /// It could not be done.
    Badly(String),
    Listed(Listing),
}

/// Scenes, states and folders to choose from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Listing {
    /// For what has been typed; for nothing those scenes that were opened last.
    pub typed: String,
    pub entries: Vec<Entry>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    pub path: PathBuf,
    pub is_folder: bool,
    pub is_there: bool,
}

/// Most entries that are shown.
const MOST: usize = 200;

/// Does an errand.
pub fn run(errand: Errand) -> Done {
    let kept = match errand {
        Errand::Keep(kept) => {
            let done = native::remember(&kept.name, &kept.text());
            native::tidy(kept::BEGINNING, kept::MOST);
            done.map_err(|why| format!("your changes cannot be kept for the next time: {why}"))
        }
        Errand::Forget(name) => {
            native::forget(&name);
            Ok(())
        }
        Errand::Decline(name, text) => {
            if native::remembered(&name) == Some(text) {
                native::forget(&name);
            }
            Ok(())
        }
        // That nothing is listed is no news to whoever opens scenes.
        Errand::Opened(path) => {
            let _ = recent::add(&path);
            Ok(())
        }
        Errand::List(typed) => return Done::Listed(list(typed)),
    };
    kept.map_or_else(Done::Badly, |()| Done::Well)
}

fn list(typed: String) -> Listing {
    let entries = if typed.trim().is_empty() {
        let entry = |path: PathBuf| Entry { is_there: path.is_file(), is_folder: false, path };
        recent::read().into_iter().map(entry).collect()
    } else {
        let found = native::listed(&typed).into_iter();
        let can_be_opened = found.filter(|(path, is_folder)| *is_folder || is_known(path));
        can_be_opened.take(MOST).map(|(path, is_folder)| Entry { path, is_folder, is_there: true }).collect()
    };
    Listing { typed, entries }
}

/// What files are called that can be opened: scenes, and states.
pub const KINDS: [&str; 3] = ["glb", "gltf", "toml"];

fn is_known(path: &Path) -> bool {
    path.extension().is_some_and(|found| KINDS.iter().any(|kind| found.eq_ignore_ascii_case(kind)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_and_what_can_be_opened_are_listed() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        for name in ["b.GLB", "a.gltf", "c.toml", "d.png", "e"] {
            std::fs::write(at(name), "").unwrap();
        }
        std::fs::create_dir(at("z.d")).unwrap();
        let typed = format!("{}/", folder.path().display());
        let Done::Listed(listing) = run(Errand::List(typed.clone())) else { panic!("nothing is listed") };
        assert_eq!(listing.typed, typed);
        let found: Vec<_> = listing.entries.iter().map(|entry| (entry.path.clone(), entry.is_folder)).collect();
        let expected = [("z.d", true), ("a.gltf", false), ("b.GLB", false), ("c.toml", false)];
        assert_eq!(found, expected.map(|(name, is_folder)| (at(name), is_folder)));
    }
}
