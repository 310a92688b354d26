//! What documents say of the house, and that their links lead somewhere.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use super::imports::MAY_IMPORT;
use super::passes::{FLOORS, stem};
use super::{files, read, root};

/// Most lines of the README, which is one page.
const README_LINES: usize = 140;

/// All documents of the repository.
fn documents() -> Vec<PathBuf> {
    let entries = fs::read_dir(root()).expect("the root is there").map(|entry| entry.expect("an entry").path());
    let is_ours = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        !name.starts_with('.') && name != "target"
    };
    let (folders, top): (Vec<PathBuf>, Vec<PathBuf>) = entries.filter(is_ours).partition(|path| path.is_dir());
    let top = top.into_iter().filter(|path| path.extension().is_some_and(|extension| extension == "md"));
    top.chain(folders.iter().flat_map(|folder| files(folder, "md"))).collect()
}

/// A document's lines outside of blocks of code.
fn prose(text: &str) -> impl Iterator<Item = &str> {
    let mut in_code = false;
    text.lines().filter(move |line| {
        let is_fence = line.trim_start().starts_with("```");
        in_code ^= is_fence;
        !in_code && !is_fence
    })
}

/// Where links and images of a document lead.
fn links(text: &str) -> Vec<&str> {
    let mut links = Vec::new();
    for line in prose(text) {
        for (begin, end) in [("](", ')'), ("src=\"", '"')] {
            links.extend(line.split(begin).skip(1).filter_map(|rest| Some(rest.split_once(end)?.0)));
        }
    }
    links
}

/// What `#` links to headings may name: lower case, hyphens for spaces, without other signs.
fn anchors(text: &str) -> BTreeSet<String> {
    let headings = prose(text).filter(|line| line.starts_with('#'));
    let anchor = |heading: &str| {
        let words = heading.trim_start_matches('#').trim().to_lowercase().replace(' ', "-");
        words.chars().filter(|sign| sign.is_alphanumeric() || matches!(sign, '-' | '_')).collect()
    };
    headings.map(anchor).collect()
}

/// The links of a document that lead nowhere within the repository.
fn broken(document: &Path, text: &str) -> Vec<String> {
    let is_broken = |link: &&str| {
        if link.starts_with("https://") {
            return false;
        }
        let (path, anchor) = link.split_once('#').unwrap_or((link, ""));
        let target = if path.is_empty() { document.to_owned() } else { document.with_file_name("").join(path) };
        !target.exists() || (!anchor.is_empty() && !anchors(&read(&target)).contains(anchor))
    };
    let name = document.strip_prefix(root()).unwrap_or(document).display();
    links(text).into_iter().filter(is_broken).map(|link| format!("{name}: {link}")).collect()
}

#[test]
fn links_lead_somewhere() {
    let documents = documents();
    assert!(documents.len() >= 8, "{documents:?}");
    let broken: Vec<String> = documents.iter().flat_map(|path| broken(path, &read(path))).collect();
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

#[test]
fn broken_links_are_found() {
    let document = root().join("docs/page.md");
    for text in
        ["[a](nowhere.md)", "![a](../docs/none.png)", "<img src=\"x.png\">", "[a](#none)", "[a](design.md#none)"]
    {
        assert_eq!(broken(&document, text).len(), 1, "{text}");
    }
    for text in ["[a](design.md#the-house)", "[a](../README.md)", "[a](https://example.org)", "```\n[a](b)\n```"] {
        assert_eq!(broken(&document, text), [""; 0], "{text}");
    }
}

#[test]
fn the_readme_is_one_page() {
    let lines = read(&root().join("README.md")).lines().count();
    assert!(lines <= README_LINES, "README.md has {lines} lines, of {README_LINES} at most: move some to docs/");
}

/// A module and what it may import, of each row of a table whose last column says so.
fn import_table(text: &str) -> Vec<(String, BTreeSet<String>)> {
    let (_, rest) = text.split_once("\n### Who may import whom\n").expect("the page has the order");
    let rows = rest.lines().take_while(|line| !line.starts_with('#')).filter(|line| line.starts_with("| `"));
    let row = |line: &str| {
        let names = |cell: &str| cell.split('`').skip(1).step_by(2).map(str::to_owned).collect::<Vec<_>>();
        let cells: Vec<&str> = line.trim_matches('|').split('|').collect();
        let [name, _, imports] = cells[..] else { panic!("three columns: {line}") };
        (names(name).concat(), names(imports).into_iter().collect())
    };
    rows.map(row).collect()
}

/// The names in the first column of the table under a heading.
fn floor_table(text: &str) -> Vec<Vec<&str>> {
    let (_, rest) = text.split_once("\n### Passes\n").expect("the page has the floors");
    let rows = rest.lines().take_while(|line| !line.starts_with('#')).filter(|line| line.starts_with("| `"));
    rows.map(|line| line.split('|').nth(1).unwrap_or_default().split('`').skip(1).step_by(2).collect()).collect()
}

#[test]
fn the_design_page_has_the_floors_of_the_passes() {
    let stems: Vec<Vec<&str>> = FLOORS.iter().map(|floor| floor.iter().map(|file| stem(file)).collect()).collect();
    assert_eq!(floor_table(&read(&root().join("docs/design.md"))), stems);
}

/// The modules that stand at the top of the library.
fn standing() -> Vec<String> {
    let entries =
        fs::read_dir(root().join("src")).expect("there is a source").map(|entry| entry.expect("an entry").path());
    let names =
        entries.map(|path| path.with_extension("").file_name().unwrap_or_default().to_string_lossy().into_owned());
    names.filter(|name| name != "lib" && name != "bin").collect()
}

#[test]
fn the_design_page_has_the_order_of_imports() {
    let table = import_table(&read(&root().join("docs/design.md")));
    for (name, imports) in &table {
        let order = MAY_IMPORT.iter().find(|(module, _)| module == name);
        let (_, allowed) = order.unwrap_or_else(|| panic!("docs/design.md: there is no module `{name}`"));
        let allowed: BTreeSet<String> = allowed.iter().map(|&import| import.to_owned()).collect();
        assert_eq!(*imports, allowed, "docs/design.md: what `{name}` may import, and what the test lets it");
    }
    for module in standing() {
        assert!(table.iter().any(|(name, _)| *name == module), "docs/design.md: the table lacks `{module}`");
    }
}

#[test]
fn the_readme_shows_a_test_that_runs() {
    let readme = read(&root().join("README.md"));
    let (_, rest) = readme.split_once("```rust\n").expect("the README shows a test");
    let (shown, _) = rest.split_once("```").expect("the test ends");
    let run = read(&root().join("examples/screenshot_test.rs"));
    assert!(run.contains(shown), "examples/screenshot_test.rs does not hold the README's test:\n{shown}");
}
