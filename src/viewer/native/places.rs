//! Where pictures and states are written: nothing that is there is written over.

use std::path::{Path, PathBuf};

use super::super::saving::{Settings, extension};
use super::folders::in_full;
use crate::file::{WriteError, write_new};

/// The folder that the user has named, in full; the current one where there is no name.
pub fn folder(named: Option<&str>) -> PathBuf {
    let named = named.map_or("", str::trim);
    // Whoever opened the window from a desktop does not know which folder is the current one.
    in_full(if named.is_empty() { "." } else { named })
}

/// The first of velour-001 to velour-999 that is free in the settings' folder, without its extension.
pub fn free_name(settings: &Settings) -> Option<String> {
    numbered(&folder(settings.folder.as_deref()), extension(settings.format))
}

/// Where a picture of this name will be: under the next free name where this one is taken; or why there is no such place.
pub fn place(settings: &Settings, name: &str) -> Result<PathBuf, String> {
    let folder = folder(settings.folder.as_deref());
    if !folder.is_dir() {
        return Err(format!("{}: there is no such folder", folder.display()));
    }
    if name.trim().is_empty() {
        return Err("the file has no name".to_owned());
    }
    if name.contains(|character: char| std::path::is_separator(character) || character.is_control()) {
        return Err(format!("\"{}\" is no file's name", name.escape_debug()));
    }
    let path = folder.join(settings.file_name(name));
    let (stem, extension) = (path.file_stem().unwrap_or_default(), extension(settings.format));
    let other = |number: u32| folder.join(format!("{}-{number}.{extension}", stem.display()));
    let free = |path: &PathBuf| !is_there(path);
    let all = std::iter::once(path.clone()).chain((2..1000).map(other));
    all.into_iter().find(free).ok_or_else(|| format!("{} is there already", path.display()))
}

/// Writes a file to a free place; where that is. `place` names a place, which another program may take before it is written.
pub fn write(place: impl Fn() -> Result<PathBuf, String>, bytes: &[u8]) -> Result<PathBuf, String> {
    loop {
        let path = place()?;
        match write_new(&path, bytes) {
            Ok(()) => return Ok(path),
            Err(WriteError::Taken { .. }) => {}
            Err(error) => return Err(error.to_string()),
        }
    }
}

/// The first free numbered place in a folder.
pub fn numbered_place(folder: &Path, extension: &str) -> Result<PathBuf, String> {
    let taken = || format!("velour-001.{extension} to velour-999.{extension} are taken in {}", folder.display());
    numbered(folder, extension).map(|name| folder.join(format!("{name}.{extension}"))).ok_or_else(taken)
}

fn numbered(folder: &Path, extension: &str) -> Option<String> {
    let names = (1..1000).map(|number| format!("velour-{number:03}"));
    names.into_iter().find(|name| !is_there(&folder.join(format!("{name}.{extension}"))))
}

/// Links that lead nowhere are there, too.
fn is_there(path: &Path) -> bool {
    path.symlink_metadata().is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settings(folder: &Path) -> Settings {
        Settings { folder: Some(folder.to_str().unwrap().to_owned()), ..Settings::default() }
    }

    #[test]
    fn free_names_are_found() {
        let folder = tempfile::tempdir().unwrap();
        let (path, settings) = (|name: &str| folder.path().join(name), settings(folder.path()));
        assert_eq!(free_name(&settings).as_deref(), Some("velour-001"));
        assert_eq!(place(&settings, "a"), Ok(path("a.png")));
        for name in ["velour-001.png", "velour-002.png", "velour-003.exr", "a.png", "a-2.png"] {
            std::fs::write(path(name), "").unwrap();
        }
        assert_eq!(free_name(&settings).as_deref(), Some("velour-003"));
        for (name, expected) in [("a", "a-3.png"), ("a.png", "a-3.png"), ("a.exr", "a-3.png"), ("b.c", "b.c.png")] {
            assert_eq!(place(&settings, name), Ok(path(expected)));
        }
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(path("nowhere"), path("d.png")).unwrap();
            assert_eq!(place(&settings, "d"), Ok(path("d-2.png")));
        }
    }

    #[test]
    fn what_is_no_place_says_why() {
        let folder = tempfile::tempdir().unwrap();
        let of = |name: &str| place(&settings(folder.path()), name).unwrap_err();
        for name in ["", "  ", "a/b", "a\nb", "\0"] {
            assert!(of(name).contains("name"), "{}", of(name));
        }
        let missing = place(&settings(&folder.path().join("missing")), "a").unwrap_err();
        assert!(missing.contains("missing: there is no such folder"), "{missing}");
    }

    #[test]
    fn folders_are_named_in_full() {
        let here = std::env::current_dir().unwrap();
        assert_eq!([None, Some(""), Some(" ")].map(folder), [&here; 3].map(Clone::clone));
        assert_eq!(folder(Some("a/b")), here.join("a/b"));
        assert_eq!(folder(Some("/a b ")), Path::new("/a b"));
        let home = std::env::home_dir().unwrap();
        assert_eq!(folder(Some("~")), home.join(""));
        assert_eq!(folder(Some("~/x")), home.join("x"));
        assert_eq!(folder(Some("~x")), here.join("~x"));
    }

    #[test]
    fn a_place_that_is_taken_meanwhile_is_left_alone() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("velour-001.toml"), "first").unwrap();
        let tries = std::cell::Cell::new(0);
        let places = || {
            tries.set(tries.get() + 1);
            Ok(folder.path().join(format!("velour-{:03}.toml", tries.get())))
        };
        assert_eq!(write(places, b"x"), Ok(folder.path().join("velour-002.toml")));
        assert_eq!(std::fs::read(folder.path().join("velour-001.toml")).unwrap(), b"first");
        assert_eq!(write(|| numbered_place(folder.path(), "toml"), b"y"), Ok(folder.path().join("velour-003.toml")));
    }
}
