//! How long a file may grow.

use std::path::PathBuf;

use super::{files, read, root};

/// Longest Rust file, in lines.
const RUST_LINES: usize = 400;
/// Longest shader of those that people copy, in lines.
const SHADER_LINES: usize = 200;

fn too_long(folder: &str, extension: &str, most: usize) -> Vec<String> {
    let lines = |file: &PathBuf| read(file).lines().count();
    let long = files(&root().join(folder), extension).into_iter().filter(|file| lines(file) > most);
    long.map(|file| format!("{}: {} lines", file.display(), lines(&file))).collect()
}

#[test]
fn files_stay_short() {
    let mut long = too_long("src", "rs", RUST_LINES);
    long.extend(too_long("tests", "rs", RUST_LINES));
    long.extend(too_long("shaders", "wgsl", SHADER_LINES));
    assert!(long.is_empty(), "more than {RUST_LINES} lines of Rust or {SHADER_LINES} of WGSL:\n{}", long.join("\n"));
    assert!(!too_long("src", "rs", 10).is_empty(), "the ruler measures nothing");
}
