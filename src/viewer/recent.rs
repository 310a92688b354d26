//! The scenes that were opened last, from run to run.

use std::path::{Path, PathBuf};

use super::native;

/// So many are listed.
const MOST: usize = 12;
const NAME: &str = "recent.toml";
/// Longer lists are not ours.
const LONGEST: usize = 1 << 20;

#[derive(Default, serde::Deserialize, serde::Serialize)]
struct List {
    /// Paths from the root, the newest first.
    scenes: Vec<String>,
}

/// The paths, from the root, the newest first.
pub fn read() -> Vec<PathBuf> {
    native::remembered(NAME).map(|text| paths(&text)).unwrap_or_default()
}

/// Puts a path at the front, and keeps the list; why not, where that cannot be.
pub fn add(path: &Path) -> Result<(), String> {
    let list = with(read(), native::absolute(path));
    let before = native::remembered(NAME);
    let text = written(&list);
    if before.as_ref() == Some(&text) { Ok(()) } else { native::remember(NAME, &text) }
}

/// The paths in a text; none where it is no such list.
fn paths(text: &str) -> Vec<PathBuf> {
    if text.len() > LONGEST {
        return Vec::new();
    }
    let List { scenes } = toml::from_str(text).unwrap_or_default();
    let paths = scenes.into_iter().map(PathBuf::from).filter(|path| path.is_absolute());
    let mut unlike = Vec::new();
    for path in paths {
        if !unlike.contains(&path) && unlike.len() < MOST {
            unlike.push(path);
        }
    }
    unlike
}

fn with(mut paths: Vec<PathBuf>, path: PathBuf) -> Vec<PathBuf> {
    paths.retain(|listed| *listed != path);
    paths.insert(0, path);
    paths.truncate(MOST);
    paths
}

/// The list as a text; without paths that are none.
fn written(paths: &[PathBuf]) -> String {
    let scenes = paths.iter().filter_map(|path| path.to_str().map(str::to_owned)).collect();
    toml::to_string(&List { scenes }).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_is_first_and_each_is_there_once() {
        let mut list = Vec::new();
        for number in 0..20 {
            list = with(list, PathBuf::from(format!("/a/{number}.glb")));
        }
        list = with(list, PathBuf::from("/a/15.glb"));
        let numbers = [15, 19, 18, 17, 16, 14, 13, 12, 11, 10, 9, 8];
        assert_eq!(list, numbers.map(|number| PathBuf::from(format!("/a/{number}.glb"))));
        assert_eq!(paths(&written(&list)), list);
    }

    #[test]
    fn any_path_comes_back() {
        let list: Vec<PathBuf> = ["/a/grün \"x\".glb", "/a/\u{7}\n\u{1b}[31m.glb", "/\\'''"].map(PathBuf::from).into();
        assert_eq!(paths(&written(&list)), list);
    }

    #[test]
    fn what_is_no_list_is_empty() {
        let nested = format!("scenes = {}", "[".repeat(100_000));
        let long = format!("scenes = [\"/a\"]\n#{}", "x".repeat(LONGEST));
        for text in ["", "scenes = 3", "scenes = [1]", "scenes", "\0", "scenes = [\"a.glb\"]", &nested, &long] {
            assert!(paths(text).is_empty(), "{}", &text[..text.len().min(40)]);
        }
        assert_eq!(paths("scenes = [\"/a\", \"b\", \"/a\", \"/c\"]\nmore = 1"), ["/a", "/c"].map(PathBuf::from));
    }
}
