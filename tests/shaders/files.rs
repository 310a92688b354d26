//! The shipped files as text: what people who copy them rely on before anything runs.

use std::path::Path;
use velour::export::shaders::{SOURCES, Source};
use wgpu::naga::{self, TypeInner};

use super::reserved::reserved;

const HEADER: [&str; 8] = [
    "// SPDX-License-Identifier: ",
    "// SPDX-FileCopyrightText: ",
    "// ",
    "// Copy with it: ",
    "// Frame: ",
    "// Example: ",
    "// Ranges: ",
    "// Greatest error: ",
];

/// The text of a file at the top of `shaders/`.
pub fn source(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders").join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

pub fn compile(source: &str) -> Result<naga::Module, String> {
    let module = naga::front::wgsl::parse_str(source).map_err(|error| error.emit_to_string(source))?;
    let (flags, capabilities) = (naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty());
    let validated = naga::valid::Validator::new(flags, capabilities).validate(&module);
    validated.map_err(|error| error.emit_to_string(source))?;
    Ok(module)
}

/// Breaches of the rules for files that people copy; `stem` is the file's name without its extension, and it compiles behind `before`.
fn problems(stem: &str, before: &str, source: &str) -> Vec<String> {
    let mut problems = Vec::new();
    let lines: Vec<&str> = source.lines().collect();
    if lines.len() > 200 {
        problems.push(format!("{} lines", lines.len()));
    }
    let headed = HEADER.iter().zip(&lines).all(|(begin, line)| line.starts_with(begin));
    if !headed || lines.get(HEADER.len()) != Some(&"") {
        problems.push("header".to_owned());
    }
    // WGSL has no preprocessor; those that people add use '#'.
    if source.contains('#')
        || ["enable", "requires", "diagnostic"].iter().any(|word| lines.iter().any(|line| line.starts_with(word)))
    {
        problems.push("preprocessor or directive".to_owned());
    }
    let module = match compile(&format!("{before}{source}")) {
        Ok(module) => module,
        Err(error) => return vec![error],
    };
    if !module.global_variables.is_empty() {
        problems.push("binding or global".to_owned());
    }
    if !module.entry_points.is_empty() {
        problems.push("entry point".to_owned());
    }
    if module.types.iter().any(|(_, kind)| matches!(kind.inner, TypeInner::Array { .. })) {
        problems.push("array".to_owned());
    }
    problems.extend(names(source).filter(|name| !has_stem(name, stem)).map(|name| format!("name {name}")));
    problems.extend(reserved(source).into_iter().map(|name| format!("reserved word {name}")));
    problems
}

/// Every name at the top level, where declarations begin their line. (naga forgets constants that have no type of their own.)
fn names(source: &str) -> impl Iterator<Item = &str> {
    source.lines().filter_map(|line| {
        let (keyword, rest) = line.split_once(' ')?;
        let declares = ["fn", "const", "struct", "alias", "override"].contains(&keyword);
        declares.then(|| rest.split(|letter: char| !letter.is_alphanumeric() && letter != '_').next())?
    })
}

fn has_stem(name: &str, stem: &str) -> bool {
    let capital: String = stem.split('_').map(|word| word[..1].to_uppercase() + &word[1..]).collect();
    let prefixes = [format!("{stem}_"), format!("{}_", stem.to_uppercase()), capital];
    prefixes.iter().any(|prefix| name.starts_with(prefix))
}

#[test]
fn each_file_compiles_alone_and_is_made_to_be_copied() {
    for file in SOURCES {
        assert_eq!(problems(file.stem, &file.before(), file.text), Vec::<String>::new(), "{}.wgsl", file.stem);
    }
}

#[test]
fn the_examples_in_the_headers_compile() {
    for file in SOURCES {
        let Source { stem: name, text: source, given, .. } = file;
        let examples: Vec<&str> = source.lines().filter_map(|line| line.strip_prefix("// Example: ")).collect();
        assert_eq!(examples.len(), 1, "{name}");
        let whole = format!("{}{source}\n{given}\n{}\n}}\n", file.before(), examples[0]);
        compile(&whole).unwrap_or_else(|error| panic!("{name}: {error}"));
        let misspelt = whole
            .replace("let radiance", "let radiance = nobody; let x")
            .replace("= ltc_next(", "= ltc_walk(")
            .replace("= ltc_sample_point(", "= ltc_sample_spot(");
        assert!(compile(&misspelt).is_err(), "{name}");
    }
}

/// A test renders that file.
#[test]
fn the_readme_shows_the_loop_over_lights() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let readme = std::fs::read_to_string(root.join("README.md")).unwrap();
    let (_, rest) = readme.split_once("```wgsl\n").expect("the README shows how the files are used");
    let (example, _) = rest.split_once("```").expect("the example ends");
    let lights = std::fs::read_to_string(root.join("examples/lights.wgsl")).unwrap();
    assert!(lights.contains(example), "README.md shows other lines than examples/lights.wgsl has");
}

#[test]
fn a_file_that_breaks_a_rule_is_found_out() {
    let good =
        HEADER.map(|begin| format!("{begin}some words\n")).concat() + "\nfn ltc_one() -> f32 {\n    return 1.0;\n}\n";
    assert_eq!(problems("ltc", "", &good), Vec::<String>::new());
    for (addition, problem) in [
        ("fn other() {}", "name other"),
        ("struct Other { x: f32 }", "name Other"),
        ("const OTHER = 1.0;", "name OTHER"),
        ("const OTHER: f32 = 1.0;", "name OTHER"),
        ("alias other = f32;", "name other"),
        ("@group(0) @binding(0) var<storage> ltc_data: vec4<f32>;", "binding or global"),
        ("var<private> ltc_state: f32;", "binding or global"),
        ("@compute @workgroup_size(1) fn ltc_main() {}", "entry point"),
        ("fn ltc_more(vertex: f32) {}", "reserved word vertex"),
        ("fn ltc_list() { var list: array<f32, 4>; }", "array"),
        ("// #define LTC", "preprocessor or directive"),
        (&"\n".repeat(200), "213 lines"),
    ] {
        assert_eq!(problems("ltc", "", &format!("{good}{addition}\n")), [problem], "{addition}");
    }
    assert_eq!(problems("ltc", "", &good.replace("// Ranges", "// Extent")), ["header"]);
    assert_eq!(problems("ltc", "", &good.replace("return 1.0", "return 1u")).len(), 1);
}
