//! Which module may import which.
//!
//! Files are read as tokens, so that comments and strings hold no paths and macros hide none.

use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, TokenStream, TokenTree};

use super::{files, read, root};

/// Each module at the top of the library, and those that it may import. The binary sees all.
pub const MAY_IMPORT: [(&str, &[&str]); 14] = [
    ("math", &[]),
    ("file", &[]),
    ("table", &["math"]),
    ("picture", &["math"]),
    ("scene", &["math", "picture"]),
    ("bvh", &["math", "scene"]),
    ("physics", &["math"]),
    ("fit", &["math", "table", "physics"]),
    ("models", &["math", "table", "physics"]),
    ("reference", &["math", "table", "scene", "picture", "models", "bvh"]),
    ("renderer", &["math", "table", "scene", "picture", "bvh"]),
    ("export", &["math", "table", "models", "picture", "reference"]),
    ("viewer", &["math", "table", "scene", "picture", "models", "reference", "renderer", "bvh", "file"]),
    (
        "figures",
        &["math", "table", "scene", "picture", "physics", "fit", "models", "reference", "renderer", "bvh", "file"],
    ),
];

/// Where a file of the library stands in its tree of modules: `scene/gltf/mod.rs` is `scene::gltf`. None for the binary's.
fn module_of(file: &Path) -> Option<Vec<String>> {
    let mut path: Vec<String> =
        file.with_extension("").iter().map(|part| part.to_str().expect("a name in UTF-8").to_owned()).collect();
    if path[0] == "bin" {
        return None;
    }
    if path.last().is_some_and(|last| last == "mod" || last == "lib") {
        path.pop();
    }
    Some(path)
}

/// What is named directly below the crate's root: by `crate::`, or by climbing there with `super::`.
#[derive(Debug, PartialEq)]
struct Import {
    line: usize,
    /// `*`, `self` or nothing at all are no modules either.
    name: String,
}

/// All imports in the tokens of the module at `depth` below the root.
fn imports(tokens: TokenStream, depth: usize) -> Vec<Import> {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut found = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        if let Some(after) = past_root(&tokens, at, depth) {
            found.extend(named(&tokens[after..]).into_iter().map(|(line, name)| Import { line, name }));
        }
        if let TokenTree::Group(group) = &tokens[at] {
            let is_module = group.delimiter() == Delimiter::Brace && at >= 2 && is_ident(&tokens[at - 2], "mod");
            found.extend(imports(group.stream(), depth + usize::from(is_module)));
        }
        at += if is_ident(&tokens[at], "super") { climb(&tokens[at..]).1.max(1) } else { 1 };
    }
    found
}

/// Where a path that starts at token `at` and reaches the crate's root goes on.
fn past_root(tokens: &[TokenTree], at: usize, depth: usize) -> Option<usize> {
    if is_ident(&tokens[at], "crate") {
        let alone = !is_path_separator(&tokens[at + 1..]);
        let renamed = tokens.get(at + 1).is_some_and(|next| is_ident(next, "as"));
        return (!alone || renamed).then_some(at + if alone { 1 } else { 3 });
    }
    let (levels, length) = climb(&tokens[at..]);
    (levels > 0 && levels >= depth).then_some(at + length)
}

/// How many `super::` these tokens start with, and how many tokens they are.
pub fn climb(tokens: &[TokenTree]) -> (usize, usize) {
    let mut levels = 0;
    let mut rest = tokens;
    while rest.first().is_some_and(|first| is_ident(first, "super")) && is_path_separator(&rest[1..]) {
        levels += 1;
        rest = &rest[3..];
    }
    (levels, tokens.len() - rest.len())
}

/// The first names of a path that goes on with these tokens, or of all paths of a group.
pub fn named(tokens: &[TokenTree]) -> Vec<(usize, String)> {
    match tokens.first() {
        Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Brace => {
            let tokens: Vec<TokenTree> = group.stream().into_iter().collect();
            tokens.split(is_comma).filter(|path| !path.is_empty()).flat_map(named).collect()
        }
        Some(first) => vec![(first.span().start().line, first.to_string())],
        None => Vec::new(),
    }
}

pub fn is_ident(token: &TokenTree, text: &str) -> bool {
    matches!(token, TokenTree::Ident(ident) if ident == text)
}

fn is_comma(token: &TokenTree) -> bool {
    matches!(token, TokenTree::Punct(punct) if punct.as_char() == ',')
}

pub fn is_path_separator(tokens: &[TokenTree]) -> bool {
    let colons = tokens.iter().take(2).filter(|token| matches!(token, TokenTree::Punct(p) if p.as_char() == ':'));
    colons.count() == 2
}

/// What in a file of the library is against the order, in lines for the reader. `file` is relative to `src/`.
fn violations(file: &Path, source: &str) -> Vec<String> {
    let Some(module) = module_of(file) else { return Vec::new() };
    let tokens = source.parse::<TokenStream>().unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    let imports = imports(tokens, module.len());
    let Some(owner) = module.first() else { return Vec::new() };
    let Some((_, allowed)) = MAY_IMPORT.iter().find(|(name, _)| name == owner) else {
        return vec![format!("src/{}: the order has no module `{owner}`", file.display())];
    };
    let wrong = imports.into_iter().filter(|import| import.name != *owner && !allowed.contains(&import.name.as_str()));
    wrong
        .map(|import| format!("src/{}:{}: `{owner}` may not import `{}`", file.display(), import.line, import.name))
        .collect()
}

#[test]
fn modules_import_what_they_may() {
    let src = root().join("src");
    let files = files(&src, "rs");
    assert!(files.len() > 20, "only {} files under {}", files.len(), src.display());
    let relative = |file: &PathBuf| file.strip_prefix(&src).expect("found below it").to_owned();
    let found: Vec<String> = files.iter().flat_map(|file| violations(&relative(file), &read(file))).collect();
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn the_order_has_no_cycle() {
    let mut standing: Vec<&str> = Vec::new();
    while standing.len() < MAY_IMPORT.len() {
        let ready = |(name, needs): &&(&str, &[&str])| {
            !standing.contains(name) && needs.iter().all(|need| standing.contains(need))
        };
        let next = MAY_IMPORT.iter().find(ready).unwrap_or_else(|| panic!("a cycle beyond {standing:?}"));
        standing.push(next.0);
    }
}

#[test]
fn planted_violations_are_found() {
    for (file, source) in [
        ("math/mod.rs", "use crate::table::SheenTable;"),
        ("math/deep/er.rs", "use crate::{\n    math::warp,\n    fit::{self, lobe}};"),
        ("math/mod.rs", "use {std::fs, crate::fit as tailor};"),
        ("table/csv.rs", "fn f() -> crate :: renderer :: Gpu { todo!() }"),
        ("table/csv.rs", "use super::super::physics;"),
        ("table/csv.rs", "mod tests { use super::super::super::{physics::slab, table}; }"),
        ("table/mod.rs", "use super::scene;"),
        ("scene/mod.rs", "fn f() { println!(\"{}\", crate::table::MAX_SIDE) }"),
        ("scene/mod.rs", "macro_rules! m { () => { $crate::viewer::run() } }"),
        ("renderer/mod.rs", "use crate::models; // whatever"),
        ("renderer/mod.rs", "use crate::*;"),
        ("renderer/mod.rs", "use crate as velour;"),
        ("viewer/mod.rs", "use crate::{figures};"),
        ("figures/mod.rs", "use crate::export;"),
        ("novel/mod.rs", ""),
        ("novel.rs", "fn f() {}"),
    ] {
        assert_eq!(violations(Path::new(file), source).len(), 1, "{file}: {source}");
    }
    let [line] = &violations(Path::new("math/mod.rs"), "\n\nuse crate::{\n    fit};")[..] else { panic!("one line") };
    assert_eq!(line, "src/math/mod.rs:4: `math` may not import `fit`");
}

#[test]
fn what_the_order_allows_is_let_pass() {
    for (file, source) in [
        ("fit/mod.rs", "use crate::{math::warp, physics, table::{SheenTable, MAX_SIDE}};"),
        ("fit/lobe.rs", "use super::grid; use super::super::physics; pub(crate) fn f() {} pub(super) fn g() {}"),
        ("fit/lobe.rs", "mod tests { use super::*; use super::super::grid; }"),
        (
            "math/mod.rs",
            "/* crate::fit */ // crate::fit\nconst S: &str = \"crate::fit\"; /// crate::fit\nfn f<'a>() { 'x'; }",
        ),
        ("math/mod.rs", "const R: &str = r#\"use crate::\"fit\";\"#; const C: char = '\"';"),
        ("bin/velour/main.rs", "use crate::anything;"),
        ("bin/velour/draw.rs", "use crate::anything;"),
        ("lib.rs", "pub mod fit;"),
    ] {
        assert_eq!(violations(Path::new(file), source), [""; 0], "{file}: {source}");
    }
}
