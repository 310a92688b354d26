//! Sources that run the golden numbers: the shipped files, the calls of `golden.wgsl`, and a language's own shell.

use velour::export::shaders::{Language, SOURCES, Source, translate};

/// What the shell of each language brings.
const SHELL: &str = "fn golden_number(index: u32) -> f32 { return 0.0; } fn golden_put(index: u32, value: f32) {}";

const CALLS: &str = include_str!("../shaders/golden.wgsl");

/// All files that functions are called of, as they are shipped in a language.
pub fn shipped(language: Language) -> String {
    let files = SOURCES.iter().filter(|source| source.theirs.is_empty());
    files.map(|source| source.in_language(language).expect("shipped files are translated")).collect()
}

/// The same and the calls, in a language.
pub fn rows(language: Language) -> String {
    let mut known: Vec<&str> =
        SOURCES.iter().filter(|source| source.theirs.is_empty()).map(|source| source.text).collect();
    known.push(SHELL);
    let calls = translate(CALLS, "", &known, language).unwrap_or_else(|refusal| panic!("golden.wgsl, {refusal}"));
    format!("{}{calls}", shipped(language))
}

/// WGSL, as it is.
pub fn wgsl() -> String {
    let files = SOURCES.iter().filter(|source| source.theirs.is_empty());
    let shipped: String = files.map(|source| source.text).collect();
    format!("{shipped}{CALLS}{}", include_str!("shells/shell.wgsl"))
}

pub fn glsl() -> String {
    let (before, after) = (include_str!("shells/before.glsl"), include_str!("shells/after.glsl"));
    format!("{before}{}{after}", rows(Language::Glsl450))
}

pub fn hlsl() -> String {
    let (before, after) = (include_str!("shells/before.hlsl"), include_str!("shells/after.hlsl"));
    format!("{before}{}{after}", rows(Language::Hlsl))
}

pub fn metal() -> String {
    let (before, after) = (include_str!("shells/before.metal"), include_str!("shells/after.metal"));
    format!("{before}{}{after}", rows(Language::Msl))
}

/// What a file leaves to whoever copies it, in a language.
pub fn theirs(source: &Source, language: Language) -> String {
    if source.theirs.is_empty() {
        return String::new();
    }
    translate(source.theirs, "", &[], language).unwrap_or_else(|refusal| panic!("{}, {refusal}", source.stem))
}
