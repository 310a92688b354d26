//! What may be opened: for what is typed, or what was opened last.

use std::path::{Path, PathBuf};

use super::{native, recent};

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

/// What may be meant by a text.
pub fn list(typed: String) -> Listing {
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
        let listing = list(typed.clone());
        assert_eq!(listing.typed, typed);
        let found: Vec<_> = listing.entries.iter().map(|entry| (entry.path.clone(), entry.is_folder)).collect();
        let expected = [("z.d", true), ("a.gltf", false), ("b.GLB", false), ("c.toml", false)];
        assert_eq!(found, expected.map(|(name, is_folder)| (at(name), is_folder)));
    }
}
