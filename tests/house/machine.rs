//! The library leaves the machine alone: it reads no clock, writes no file and waits for nothing behind its caller's back. The viewer does, in
//! one file and what lies below it, which a build for a browser replaces.

use std::path::{Path, PathBuf};

use proc_macro2::{TokenStream, TokenTree};

use super::{files, read, root};

/// The one file of the viewer, and its folder; the room that writes files for whoever asks it to; and `Gpu::block_on`, which waits for whoever asks it to.
const MAY: [&str; 4] = ["viewer/native.rs", "viewer/native/", "file.rs", "renderer/device.rs"];

/// Paths that reach for the machine: a name, and what follows it after `::`, if that matters.
const REACHES: [(&str, &str); 9] = [
    ("Instant", "now"),
    ("SystemTime", "now"),
    ("thread", "sleep"),
    ("pollster", ""),
    ("PollType", "wait_indefinitely"),
    ("fs", "write"),
    ("File", "create"),
    ("OpenOptions", "new"),
    ("tempfile", ""),
];

/// Lines of a file that reach for the machine, but for its tests.
fn reaches(tokens: TokenStream) -> Vec<usize> {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let ident = |at: usize| match tokens.get(at) {
        Some(TokenTree::Ident(ident)) => ident.to_string(),
        _ => String::new(),
    };
    let mut lines = Vec::new();
    for (at, token) in tokens.iter().enumerate() {
        match token {
            TokenTree::Ident(name) => {
                let reaches =
                    |&(first, then): &(&str, &str)| name == first && (then.is_empty() || ident(at + 3) == then);
                if REACHES.iter().any(reaches) {
                    lines.push(name.span().start().line);
                }
            }
            TokenTree::Group(group) => {
                let is_test = at >= 2 && ident(at - 2) == "mod" && ident(at - 1).ends_with("tests");
                if !is_test {
                    lines.extend(self::reaches(group.stream()));
                }
            }
            _ => {}
        }
    }
    lines
}

fn reaches_of(source: &str) -> Vec<usize> {
    reaches(source.parse().expect("Rust"))
}

/// Files of the library that make it up, but for the binary's and those of tests alone.
fn sources() -> Vec<PathBuf> {
    let src = root().join("src");
    let is_test = |path: &Path| path.iter().any(|part| part == "bin" || part == "tests" || part == "flip_tests.rs");
    files(&src, "rs").into_iter().filter(|path| !is_test(path.strip_prefix(&src).expect("below it"))).collect()
}

#[test]
fn only_the_rooms_for_it_reach_for_the_machine() {
    let src = root().join("src");
    let mut found = Vec::new();
    for path in sources() {
        let name = path.strip_prefix(&src).expect("below it").to_str().expect("UTF-8").to_owned();
        if !MAY.iter().any(|may| name == *may || may.ends_with('/') && name.starts_with(may)) {
            found.extend(reaches_of(&read(&path)).into_iter().map(|line| format!("src/{name}:{line}")));
        }
    }
    assert!(found.is_empty(), "these read the clock, wait or write files:\n{}", found.join("\n"));
}

#[test]
fn what_reaches_for_the_machine_is_found() {
    for source in [
        "fn f() { let start = std::time::Instant::now(); }",
        "fn f() { pollster::block_on(g()) }",
        "use pollster as p;",
        "fn f() { { [std::fs::write(a, b)] } }",
        "fn f() { gpu.device.poll(wgpu::PollType::wait_indefinitely()) }",
        "fn f() { std::fs::File::create(path) }",
    ] {
        assert_eq!(reaches_of(source), [1], "{source}");
    }
    for source in [
        "mod tests { fn f() { Instant::now(); } }",
        "// Instant::now()",
        "use std::time::Instant;",
        "fn f() { File::open(p) }",
    ] {
        assert!(reaches_of(source).is_empty(), "{source}");
    }
}
