//! Files on disk and what stands beside them.

use std::fs;
use std::path::Path;

use serde_json::json;

use super::builder::{Builder, check};
use crate::scene::Scene;
use crate::scene::gltf::{Options, load};

fn error(path: &Path) -> String {
    let error = load(path, &Options::default()).expect_err("this is read").to_string();
    assert_eq!(error.lines().count(), 1, "{error}");
    error
}

/// A scene file in `folder` whose buffer stands at `uri`.
fn with_buffer(folder: &Path, uri: &str) -> Result<Scene, String> {
    let mut file = Builder::studio();
    file.json["buffers"][0]["uri"] = json!(uri);
    let path = folder.join("scene.gltf");
    fs::write(&path, file.json.to_string()).unwrap();
    load(&path, &Options::default()).map_err(|error| error.to_string())
}

#[test]
fn paths_to_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("no\nsuch.glb");
    let error_of_missing = error(&missing);
    assert!(error_of_missing.contains("no\\nsuch.glb: can't be read"), "{error_of_missing}");
    assert!(error(folder.path()).contains("is a folder"));
    assert!(error(Path::new("")).contains("can't be read"));
}

#[cfg(unix)]
#[test]
fn files_that_never_end() {
    assert!(error(Path::new("/dev/zero")).contains("is no ordinary file"));
    let folder = tempfile::tempdir().unwrap();
    let socket = folder.path().join("scene.glb");
    let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
    assert!(error(&socket).contains("is no ordinary file"));
    std::os::unix::fs::symlink("/dev/zero", folder.path().join("zero.bin")).unwrap();
    let error = with_buffer(folder.path(), "zero.bin").unwrap_err();
    assert!(error.contains("buffer 0") && error.contains("zero.bin: is no ordinary file"), "{error}");
}

#[test]
fn a_file_larger_than_any_glb_is_not_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("huge.glb");
    fs::File::create(&path).unwrap().set_len(1 << 33).unwrap();
    assert!(error(&path).contains("8589934592 bytes long"));
}

#[test]
fn buffers_beside_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let bytes = Builder::studio().bytes;
    fs::create_dir(folder.path().join("parts")).unwrap();
    for name in ["cloth.bin", "parts/two words.bin", "parts/ünï.bin"] {
        fs::write(folder.path().join(name), &bytes).unwrap();
    }
    fs::write(folder.path().join("short.bin"), &bytes[..bytes.len() - 1]).unwrap();
    for uri in ["cloth.bin", "./cloth.bin", "parts/two%20words.bin", "parts/two words.bin", "parts/%C3%BCn%C3%AF.bin"] {
        check(&with_buffer(folder.path(), uri).unwrap());
    }
    for (uri, what) in [
        ("missing.bin", "missing.bin: can't be read"),
        ("parts", "parts: is a folder"),
        ("short.bin", "bytes long"),
        ("", "names no file"),
        ("../cloth.bin", "leads out"),
        ("/etc/passwd", "leads out"),
        ("cloth.bin%00", "names no file"),
        ("%ff.bin", "not UTF-8"),
        ("https://example.com/cloth.bin", "scheme"),
        ("file:///etc/passwd", "scheme"),
        ("data:application/octet-stream,abc", "3 bytes long"),
        ("data:application/octet-stream;base64", "no comma"),
        ("data:application/octet-stream;base64,A*", "data URI is broken"),
        ("data:application/octet-stream;base64,AAAA", "3 bytes long"),
    ] {
        let error = with_buffer(folder.path(), uri).unwrap_err();
        assert_eq!(error.lines().count(), 1, "{error}");
        assert!(error.contains("scene.gltf: buffer 0") && error.contains(what), "{uri}: {error}");
    }
}

#[test]
fn many_buffers_of_one_file_are_read_once() {
    let folder = tempfile::tempdir().unwrap();
    let file = Builder::studio();
    let mut bytes = file.bytes.clone();
    bytes.resize(1 << 24, 0);
    fs::write(folder.path().join("cloth.bin"), bytes).unwrap();
    let mut json = file.json;
    json["buffers"] = json!(vec![json!({ "uri": "cloth.bin", "byteLength": 1 << 24 }); 10_000]);
    fs::write(folder.path().join("scene.gltf"), json.to_string()).unwrap();
    // Held apart these would be 160 GB.
    check(&load(&folder.path().join("scene.gltf"), &Options::default()).unwrap());
}

#[test]
fn a_scene_without_a_folder_reads_no_files() {
    let mut file = Builder::studio();
    file.json["buffers"][0]["uri"] = json!("cloth.bin");
    let error = crate::scene::gltf::from_slice(file.json.to_string().as_bytes(), "memory", &Options::default());
    let error = error.unwrap_err().to_string();
    assert!(error.contains("memory: buffer 0") && error.contains("no folder"), "{error}");
}

#[test]
fn the_scene_knows_its_files() {
    let folder = tempfile::tempdir().unwrap();
    let mut file = Builder::studio();
    let (path, data) = (folder.path().join("scene.gltf"), folder.path().join("data.bin"));
    fs::write(&data, &file.bytes).unwrap();
    file.json["buffers"][0]["uri"] = json!("data.bin");
    // Whether it is read or not.
    file.json["images"] =
        json!([{ "uri": "maps/cl%6fth.png" }, { "uri": "data:image/png;base64,AAAA" }, { "uri": "data.bin" }]);
    fs::write(&path, file.json.to_string()).unwrap();
    let cloth = folder.path().join("maps/cloth.png");
    assert_eq!(load(&path, &Options::default()).unwrap().files, [path, data, cloth]);
}
