//! Under which licences the project stands, and those that it is built from.

use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;
use spdx::{Expression, ParseMode};

use super::{files, read, root};

/// First lines of what is made to be copied, after the signs that begin a comment.
const COPIED: [&str; 2] =
    ["SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD", "SPDX-FileCopyrightText: 2026 The Velour authors"];

/// Licences that code may be under; where a dependency offers a choice, one of these is enough. None is copyleft, which asks for the source of
/// what is built with it.
const CODE: [&str; 7] = ["Apache-2.0", "BSD-3-Clause", "BSL-1.0", "ISC", "MIT", "Unicode-3.0", "Zlib"];

/// The crate that holds the window's fonts, and what these may be under. `NOTICE-fonts` goes with them.
const FONTS: (&str, [&str; 2]) = ("epaint_default_fonts", ["OFL-1.1", "Ubuntu-font-1.0"]);
/// Texts of that crate's which the notice holds: those of the fonts that are built in.
const FONT_TEXTS: [&str; 3] = ["UFL.txt", "Hack-Regular.txt", "emoji-icon-font-mit-license.txt"];

/// What is wrong with the licence of a package, if anything. `OR` leaves the choice, `AND` does not; an old slash is an `OR`.
fn fault(package: &str, licence: Option<&str>) -> Option<String> {
    let Some(licence) = licence else { return Some(format!("{package}: names no licence")) };
    let expression = match Expression::parse_mode(licence, ParseMode::LAX) {
        Ok(expression) => expression,
        Err(error) => return Some(format!("{package}: {licence}: {}", error.reason)),
    };
    let (holds_fonts, fonts) = FONTS;
    let allowed = |name: &str| CODE.contains(&name) || (package == holds_fonts && fonts.contains(&name));
    let holds = expression.evaluate(|requirement| allowed(&requirement.to_string()));
    (!holds).then(|| format!("{package}: {licence} is not on the list"))
}

fn cargo(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO")).args(arguments).current_dir(root()).output().expect("cargo runs")
}

/// The package and all that it depends on, on every platform; where some of these cannot be fetched, on this machine's.
fn metadata() -> Value {
    let arguments = ["metadata", "--format-version", "1", "--locked"];
    let mut output = cargo(&arguments);
    if !output.status.success() {
        let about = cargo(&["-vV"]).stdout;
        let about = String::from_utf8(about).expect("cargo speaks UTF-8");
        let host = about.lines().find_map(|line| line.strip_prefix("host: ")).expect("cargo says its platform");
        output = cargo(&[&arguments[..], &["--offline", "--filter-platform", host]].concat());
    }
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("metadata are JSON")
}

fn packages(metadata: &Value) -> &[Value] {
    metadata["packages"].as_array().expect("metadata list packages")
}

fn name(package: &Value) -> &str {
    package["name"].as_str().expect("a package has a name")
}

#[test]
fn dependencies_are_under_licences_of_the_list() {
    let metadata = metadata();
    let packages = packages(&metadata);
    assert!(packages.len() > 100, "only {} packages", packages.len());
    let faults: Vec<String> =
        packages.iter().filter_map(|package| fault(name(package), package["license"].as_str())).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn licences_off_the_list_are_found() {
    for licence in [
        "GPL-3.0-only",
        "GPL-2.0",
        "MIT AND GPL-2.0",
        "(MIT/GPL-2.0) AND LGPL-3.0-or-later",
        "(MIT OR Apache-2.0) AND AGPL-3.0-only",
        "MPL-2.0",
        "Apache-2.0 WITH Classpath-exception-2.0",
        "OFL-1.1",
        "MIT and so on",
        "",
    ] {
        assert!(fault("some", Some(licence)).is_some(), "{licence}");
    }
    assert_eq!(fault("some", None).as_deref(), Some("some: names no licence"));
}

#[test]
fn licences_on_the_list_are_let_pass() {
    for licence in [
        "MIT",
        "MIT OR GPL-3.0-only",
        "MIT/Apache-2.0",
        "LGPL-2.1/MIT",
        "MIT AND (Zlib OR LGPL-2.1-only)",
        "Apache-2.0 WITH LLVM-exception OR Apache-2.0",
    ] {
        assert_eq!(fault("some", Some(licence)), None, "{licence}");
    }
    assert_eq!(fault(FONTS.0, Some("(MIT OR Apache-2.0) AND OFL-1.1 AND Ubuntu-font-1.0")), None);
}

#[test]
fn the_notice_of_the_fonts_is_whole() {
    let metadata = metadata();
    let package = packages(&metadata).iter().find(|package| name(package) == FONTS.0).expect("the window has fonts");
    let manifest = Path::new(package["manifest_path"].as_str().expect("a package has a manifest"));
    let notice = read(&root().join("NOTICE-fonts"));
    for text in FONT_TEXTS {
        let text = read(&manifest.with_file_name("fonts").join(text));
        assert!(notice.contains(text.trim()), "NOTICE-fonts lacks the text that begins {:?}", text.lines().next());
    }
    // Noto Emoji comes with a feature of the crate's, and has a licence of its own.
    let nodes = metadata["resolve"]["nodes"].as_array().expect("metadata hold what is built");
    let node = nodes.iter().find(|node| node["id"] == package["id"]).expect("the fonts are built");
    let features = node["features"].as_array().expect("and with which features");
    assert_eq!(*features, ["default"], "other fonts may be built in: NOTICE-fonts has to name them");
}

#[test]
fn what_is_made_to_be_copied_says_so() {
    let top = |path: &Path| path.parent() == Some(&root().join("shaders"));
    let shaders = files(&root().join("shaders"), "wgsl").into_iter().filter(|path| top(path));
    let tables = files(&root().join("tables"), "csv");
    let both = shaders.map(|path| ("// ", path)).chain(tables.into_iter().map(|path| ("# ", path)));
    let mut count = 0;
    for (comment, path) in both {
        let text = read(&path);
        let first: Vec<&str> = text.lines().take(COPIED.len()).collect();
        assert_eq!(first, COPIED.map(|line| format!("{comment}{line}")), "{}", path.display());
        count += 1;
    }
    assert!(count >= 5, "{count} files");
}

#[test]
fn the_licences_are_there_whole() {
    for (name, begin, lines) in [
        ("LICENSE-MIT", "MIT License\n\nCopyright (c) 2026 The Velour authors\n", 21),
        ("LICENSE-APACHE", "\n                                 Apache License\n", 202),
        ("LICENSE-0BSD", "BSD Zero Clause License\n\nCopyright (C) 2026 The Velour authors\n", 14),
        ("LICENSE-CC0", "Creative Commons Legal Code\n\nCC0 1.0 Universal\n", 121),
    ] {
        let text = read(&root().join(name));
        assert!(text.starts_with(begin), "{name}");
        assert_eq!(text.lines().count(), lines, "{name}");
    }
    let metadata = metadata();
    let own = packages(&metadata).iter().find(|package| name(package) == "velour").expect("the package itself");
    assert_eq!(own["license"], "MIT OR Apache-2.0");
}
