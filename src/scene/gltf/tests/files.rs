//! Files and the files beside them.

use std::fs;
use std::path::Path;

use serde_json::json;

use super::builder::{Builder, check};
use crate::scene::gltf::load;

/// A .gltf in a folder whose buffer is at `uri`, and its bytes in `file`.
fn write(folder: &Path, uri: &str, file: &str) -> std::path::PathBuf {
    let mut square = Builder::square();
    square.json["buffers"][0]["uri"] = json!(uri);
    let path = folder.join("square.gltf");
    fs::write(&path, square.json.to_string()).unwrap();
    if let Some(parent) = folder.join(file).parent() {
        fs::create_dir_all(parent).unwrap();
    }
    fs::write(folder.join(file), &square.bytes).unwrap();
    path
}

#[test]
fn buffers_are_found_beside_the_file() {
    for (uri, file) in [
        ("square.bin", "square.bin"),
        ("./square.bin", "square.bin"),
        ("parts/square.bin", "parts/square.bin"),
        ("my%20square.bin", "my square.bin"),
        ("pl%C3%BCsch.bin", "plüsch.bin"),
        ("a/b:c.bin", "a/b:c.bin"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let scene = load(&write(folder.path(), uri, file)).unwrap();
        check(&scene);
        assert_eq!(scene.instances[0].name, "square");
    }
}

#[test]
fn other_buffers_are_refused() {
    let outer = tempfile::tempdir().unwrap();
    fs::write(outer.path().join("square.bin"), [0; 1000]).unwrap();
    let folder = outer.path().join("scene");
    fs::create_dir(&folder).unwrap();
    let absolute = outer.path().join("square.bin").display().to_string();
    for (uri, expected) in [
        ("missing.bin", "missing.bin: can't be read"),
        ("folder", "is a folder"),
        ("http://example.org/square.bin", "has a scheme"),
        ("file:///square.bin", "has a scheme"),
        ("C:\\square.bin", "has a scheme"),
        ("../square.bin", "leads out of the scene's folder"),
        ("..%2Fsquare.bin", "leads out of the scene's folder"),
        ("folder/../../square.bin", "leads out of the scene's folder"),
        (&absolute, "leads out of the scene's folder"),
        ("", "leads out of the scene's folder"),
        ("nul%00.bin", "leads out of the scene's folder"),
        ("%FF.bin", "is not UTF-8"),
    ] {
        let path = write(&folder, uri, "folder/square.bin");
        let error = load(&path).unwrap_err().to_string();
        assert!(error.contains("square.gltf: buffer 0: ") && error.contains(expected), "{uri}: {error}");
        assert_eq!(error.lines().count(), 1);
    }
    let path = write(&folder, "short.bin", "short.bin");
    fs::write(folder.join("short.bin"), [0; 40]).unwrap();
    assert!(load(&path).unwrap_err().to_string().contains("its data is 40 bytes long"));
}

#[test]
fn what_is_no_file_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (path, expected) in [
        (folder.path().join("missing.glb"), "missing.glb: can't be read"),
        (folder.path().join("nowhere").join("missing.glb"), "missing.glb: can't be read"),
        (folder.path().to_owned(), "is a folder"),
        ("".into(), "can't be read"),
        #[cfg(unix)]
        ("/dev/zero".into(), "/dev/zero: is no ordinary file"),
    ] {
        let error = load(&path).unwrap_err().to_string();
        assert!(error.contains(expected) && error.lines().count() == 1, "{error}");
    }
}
