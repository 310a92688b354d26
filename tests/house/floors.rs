//! Files of a folder stand on floors: no file uses another that, directly or not, uses it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, TokenStream, TokenTree};

use super::imports::{climb, is_ident, is_path_separator, named};
use super::{files, read, root};

/// A folder of the source, relative to it: `scene/gltf`; and whether it is a crate's root.
struct Folder {
    path: PathBuf,
    is_root: bool,
}

impl Folder {
    /// Where a path goes on that starts with token `at` and leads into the folder: by climbing out of `depth` modules with
    /// `super::`, or from the crate's root.
    fn entered(&self, tokens: &[TokenTree], at: usize, depth: usize) -> Option<usize> {
        let (levels, climbed) = climb(&tokens[at..]);
        if levels == depth {
            return Some(at + climbed);
        }
        let segments: Vec<&str> = self.path.iter().filter_map(|part| part.to_str()).collect();
        let names = ["crate"].into_iter().chain(segments.into_iter().filter(|_| !self.is_root));
        let mut next = at;
        for name in names {
            let is_next = tokens.get(next).is_some_and(|token| is_ident(token, name));
            if !is_next || !is_path_separator(&tokens[next + 1..]) {
                return None;
            }
            next += 3;
        }
        Some(next)
    }

    /// The names that tokens find in the folder of their file, `depth` modules above them.
    fn names(&self, tokens: TokenStream, depth: usize) -> BTreeSet<String> {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let mut found = BTreeSet::new();
        let mut at = 0;
        while at < tokens.len() {
            if let Some(after) = self.entered(&tokens, at, depth) {
                found.extend(named(&tokens[after..]).into_iter().map(|(_, name)| name));
            }
            if let TokenTree::Group(group) = &tokens[at] {
                let is_module = group.delimiter() == Delimiter::Brace && at >= 2 && is_ident(&tokens[at - 2], "mod");
                found.extend(self.names(group.stream(), depth + usize::from(is_module)));
            }
            at += climb(&tokens[at..]).1.max(1);
        }
        found
    }
}

/// All folders of the source, but for those of tests.
fn folders() -> Vec<Folder> {
    let src = root().join("src");
    let of_file = |file: PathBuf| file.parent().and_then(|folder| folder.strip_prefix(&src).ok()).map(Path::to_owned);
    let paths: BTreeSet<PathBuf> = files(&src, "rs").into_iter().filter_map(of_file).collect();
    let paths = paths.into_iter().filter(|path| !path.ends_with("tests") && !path.as_os_str().is_empty());
    paths.map(|path| Folder { is_root: src.join(&path).join("main.rs").exists(), path }).collect()
}

/// Which files of a folder use which; `mod.rs` and `main.rs`, which stand on top, are left out.
type Uses = BTreeMap<String, BTreeSet<String>>;

fn uses(folder: &Folder) -> Uses {
    let path = root().join("src").join(&folder.path);
    let stem = |file: &Path| file.file_stem().and_then(|stem| stem.to_str()).expect("a name in UTF-8").to_owned();
    let files = files(&path, "rs").into_iter().filter(|file| file.parent() == Some(&path));
    let files: Vec<_> = files.filter(|file| !["mod", "main"].contains(&stem(file).as_str())).collect();
    let siblings: BTreeSet<String> = files.iter().map(|file| stem(file)).collect();
    let of_file = |file: &PathBuf| {
        let tokens = read(file).parse().unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        let mut found = folder.names(tokens, 1);
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
    for folder in folders() {
        let uses = uses(&folder);
        users += uses.values().filter(|used| !used.is_empty()).count();
        let circles = circles(uses);
        assert!(circles.is_empty(), "src/{} has files that use each other: {circles:?}", folder.path.display());
    }
    assert!(users > 80, "only {users} files are seen to use others");
}

#[test]
fn circles_are_found_whatever_the_spelling() {
    let of = |source: &str, path: &str, is_root| {
        let folder = Folder { path: path.into(), is_root };
        folder.names(source.parse().unwrap(), 1).into_iter().collect::<Vec<_>>()
    };
    let within = |source| of(source, "fit/sheen", false);
    assert_eq!(within("use super::{a::A, b::{self, c}};\nfn f() { super::d::g() }"), ["a", "b", "d"]);
    assert_eq!(within("mod tests { use super::super::a; use super::b; } // super::c"), ["a"]);
    assert_eq!(within("use crate::fit::sheen::{a::A, b}; use crate::fit::sheen::c;"), ["a", "b", "c"]);
    assert_eq!(within("use crate::a::A; use super::super::b; use crate::fit::c; use crate::sheen::d;"), [""; 0]);
    assert_eq!(of("use crate::a::A; use super::b;", "bin/velour", true), ["a", "b"]);
    let set = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<BTreeSet<_>>();
    let graph = |edges: &[(&str, &[&str])]| edges.iter().map(|(file, used)| ((*file).to_owned(), set(used))).collect();
    assert!(circles(graph(&[("a", &["b", "c"]), ("b", &["c"]), ("c", &[])])).is_empty());
    let found = circles(graph(&[("a", &["b"]), ("b", &["c"]), ("c", &["b", "d"]), ("d", &[])]));
    assert_eq!(found.keys().collect::<Vec<_>>(), ["a", "b", "c"]);
}
