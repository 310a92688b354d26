//! Versions of dependencies that have to be one.

use super::{read, root};

/// The versions of a package in a lock file.
fn versions<'a>(lock: &'a str, package: &str) -> Vec<&'a str> {
    let name = format!("name = \"{package}\"");
    let lines = lock.lines().zip(lock.lines().skip(1));
    lines.filter(|(line, _)| *line == name).map(|(_, version)| version).collect()
}

/// It is named beside wgpu to switch its readers and writers on, which another version's would not be.
#[test]
fn naga_is_wgpus() {
    let lock = read(&root().join("Cargo.lock"));
    let [naga, wgpu] = ["naga", "wgpu"].map(|package| versions(&lock, package));
    assert_eq!((naga.len(), wgpu.len()), (1, 1), "naga {naga:?}, wgpu {wgpu:?}: name wgpu's naga in Cargo.toml");
    let two = "name = \"naga\"\nversion = \"1\"\n\nname = \"naga\"\nversion = \"2\"\n\nname = \"naga-types\"\nversion = \"2\"\n";
    assert_eq!(versions(two, "naga"), ["version = \"1\"", "version = \"2\""]);
}
