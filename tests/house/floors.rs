//! Files of a folder stand on floors: none uses another that, by whatever way, uses it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use proc_macro2::{Delimiter, TokenStream, TokenTree};

use super::imports::{climb, is_ident, is_path_separator, named};
use super::{files, read, root};

/// Folders in which this holds.
const FOLDERS: [&str; 18] = [
    "src/bin/velour",
    "src/figures",
    "src/figures/fibres",
    "src/figures/plates",
    "src/fit",
    "src/fit/ggx",
    "src/fit/sheen",
    "src/math",
    "src/models",
    "src/physics",
    "src/physics/transport",
    "src/picture",
    "src/reference/render",
    "src/renderer",
    "src/scene",
    "src/scene/gltf",
    "src/table",
    "src/viewer",
];

/// The names that tokens find in the folder of their file: by climbing out of `depth` modules with `super::`, or, where
/// the folder is a crate's root, by `crate::` too.
fn names(tokens: TokenStream, depth: usize, is_root: bool) -> BTreeSet<String> {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut found = BTreeSet::new();
    let mut at = 0;
    while at < tokens.len() {
        let (levels, climbed) = climb(&tokens[at..]);
        let from_root = is_root && is_ident(&tokens[at], "crate") && is_path_separator(&tokens[at + 1..]);
        if levels == depth || from_root {
            let after = at + if from_root { 3 } else { climbed };
            found.extend(named(&tokens[after..]).into_iter().map(|(_, name)| name));
        }
        if let TokenTree::Group(group) = &tokens[at] {
            let is_module = group.delimiter() == Delimiter::Brace && at >= 2 && is_ident(&tokens[at - 2], "mod");
            found.extend(names(group.stream(), depth + usize::from(is_module), is_root));
        }
        at += climbed.max(1);
    }
    found
}

/// Which files of a folder use which; `mod.rs` and `main.rs`, which stand on top, are left out.
type Uses = BTreeMap<String, BTreeSet<String>>;

fn uses(folder: &Path) -> Uses {
    let stem = |file: &Path| file.file_stem().and_then(|stem| stem.to_str()).expect("a name in UTF-8").to_owned();
    let files = files(folder, "rs").into_iter().filter(|file| file.parent() == Some(folder));
    let files: Vec<_> = files.filter(|file| !["mod", "main"].contains(&stem(file).as_str())).collect();
    let siblings: BTreeSet<String> = files.iter().map(|file| stem(file)).collect();
    let is_root = folder.join("main.rs").exists();
    let of_file = |file: &std::path::PathBuf| {
        let tokens = read(file).parse().unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        let mut found = names(tokens, 1, is_root);
        found.remove(&stem(file));
        (stem(file), found.intersection(&siblings).cloned().collect())
    };
    files.iter().map(of_file).collect()
}

/// Files that stand on no floor, with what they use of each other; empty where all do.
fn circles(mut uses: Uses) -> Uses {
    loop {
        let standing: Vec<String> =
            uses.iter().filter(|(_, used)| used.is_empty()).map(|(file, _)| file.clone()).collect();
        if standing.is_empty() {
            return uses;
        }
        for file in standing {
            uses.remove(&file);
            uses.values_mut().for_each(|used| _ = used.remove(&file));
        }
    }
}

#[test]
fn files_stand_on_floors() {
    let mut users = 0;
    for folder in FOLDERS {
        let uses = uses(&root().join(folder));
        users += uses.values().filter(|used| !used.is_empty()).count();
        let circles = circles(uses);
        assert!(circles.is_empty(), "{folder} has files that use each other: {circles:?}");
    }
    assert!(users > 80, "only {users} files are seen to use others");
}

#[test]
fn circles_are_found_whatever_the_spelling() {
    let of = |source: &str, is_root| names(source.parse().unwrap(), 1, is_root).into_iter().collect::<Vec<_>>();
    assert_eq!(of("use super::{a::A, b::{self, c}};\nfn f() { super::d::g() }", false), ["a", "b", "d"]);
    assert_eq!(of("mod tests { use super::super::a; use super::b; } // super::c", false), ["a"]);
    assert_eq!(of("use crate::a::A; use super::super::b;", false), [""; 0]);
    assert_eq!(of("use crate::a::A; use super::b;", true), ["a", "b"]);
    let set = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<BTreeSet<_>>();
    let graph = |edges: &[(&str, &[&str])]| edges.iter().map(|(file, used)| ((*file).to_owned(), set(used))).collect();
    assert!(circles(graph(&[("a", &["b", "c"]), ("b", &["c"]), ("c", &[])])).is_empty());
    let found = circles(graph(&[("a", &["b"]), ("b", &["c"]), ("c", &["b", "d"]), ("d", &[])]));
    assert_eq!(found.keys().collect::<Vec<_>>(), ["a", "b", "c"]);
}
