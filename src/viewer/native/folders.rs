//! Paths as users write them, and what lies in a folder.

use std::path::{MAIN_SEPARATOR, Path, PathBuf};

use etcetera::BaseStrategy;

/// Most entries of a folder that are looked at: longer lists help nobody.
const MOST: usize = 100_000;

/// The path from the root.
pub fn absolute(path: &Path) -> PathBuf {
    // A folder that is gone has no name from the root any more.
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}

/// How long a file is, in bytes.
pub fn length(path: &Path) -> Option<u64> {
    std::fs::metadata(path).ok().map(|file| file.len())
}

/// The path that a user means: from the current folder, and `~` is the home folder.
pub fn in_full(typed: &str) -> PathBuf {
    let home = || etcetera::choose_base_strategy().ok().map(|folders| folders.home_dir().to_owned());
    from_home(typed, home)
}

fn from_home(typed: &str, home: impl FnOnce() -> Option<PathBuf>) -> PathBuf {
    let typed = typed.trim();
    let below = typed.strip_prefix('~').filter(|rest| rest.is_empty() || rest.starts_with(std::path::is_separator));
    match below.and_then(|below| Some((below, home()?))) {
        Some((below, home)) => home.join(below.trim_start_matches(std::path::is_separator)),
        None => absolute(Path::new(typed)),
    }
}

/// What begins as the user has typed, and whether it is a folder; by name. What is hidden shows where a dot is typed.
pub fn listed(typed: &str) -> Vec<(PathBuf, bool)> {
    let typed = typed.trim();
    let (folder, begun) = match typed.rfind(std::path::is_separator) {
        _ if typed == "~" => (typed, ""),
        Some(at) => (&typed[..=at], &typed[at + 1..]),
        None => (".", typed),
    };
    let (folder, begun) = (in_full(folder), begun.to_lowercase());
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().take(MOST);
    let fits =
        |name: &str| name.to_lowercase().starts_with(&begun) && (!name.starts_with('.') || begun.starts_with('.'));
    let found = entries.filter(|entry| entry.file_name().to_str().is_some_and(fits));
    let mut found: Vec<_> = found.map(|entry| (entry.path(), entry.path().is_dir())).collect();
    found.sort_by_cached_key(|(path, is_folder)| (!is_folder, path.to_string_lossy().to_lowercase()));
    found
}

/// A folder's path as it is typed on from.
pub fn entered(folder: &Path) -> String {
    format!("{}{MAIN_SEPARATOR}", folder.display())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tilde_is_the_home_folder_and_the_rest_is_from_the_current_one() {
        let home = || Some(PathBuf::from("/home/ada"));
        let here = std::env::current_dir().unwrap();
        for (typed, expected) in [
            ("~", PathBuf::from("/home/ada/")),
            (" ~/a b.glb ", PathBuf::from("/home/ada/a b.glb")),
            ("~ada/x.glb", here.join("~ada/x.glb")),
            ("x.glb", here.join("x.glb")),
            ("/x/y.glb", PathBuf::from("/x/y.glb")),
        ] {
            assert_eq!(from_home(typed, home), expected, "{typed}");
        }
        assert_eq!(from_home("~/x", || None), here.join("~/x"));
    }

    #[test]
    fn what_begins_so_is_listed_folders_first() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["moss.glb", "Mud.gltf", "felt.glb", ".moss"] {
            std::fs::write(folder.path().join(name), "").unwrap();
        }
        std::fs::create_dir(folder.path().join("mz")).unwrap();
        let names = |typed: &str| -> Vec<String> {
            let found = listed(&format!("{}/{typed}", folder.path().display()));
            found.iter().map(|(path, _)| path.file_name().unwrap().to_str().unwrap().to_owned()).collect()
        };
        assert_eq!(names("m"), ["mz", "moss.glb", "Mud.gltf"]);
        assert_eq!(names(""), ["mz", "felt.glb", "moss.glb", "Mud.gltf"]);
        assert_eq!(names("MO"), ["moss.glb"]);
        assert_eq!(names("."), [".moss"]);
        assert!(names("none/x").is_empty() && listed("\0").is_empty());
        assert_eq!(entered(Path::new("/a")), format!("/a{MAIN_SEPARATOR}"));
    }
}
