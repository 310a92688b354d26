//! What runs the golden numbers in each language: the shipped files, and the calls of `golden.wgsl`; a shell goes around it.

use velour::export::shaders::{Language, SOURCES, Source, translate};

/// What the shell of each language brings.
const SHELL: &str = "fn golden_number(index: u32) -> f32 { return 0.0; } fn golden_put(index: u32, value: f32) {}";

/// The calls, in WGSL.
const CALLS: &str = include_str!("../shaders/golden.wgsl");

/// The files of which functions are called.
fn called() -> impl Iterator<Item = &'static Source> {
    SOURCES.iter().filter(|source| source.theirs.is_empty())
}

/// The files as they are shipped in a language, and the calls.
pub fn rows(language: Language) -> String {
    let shipped: String =
        called().map(|source| source.in_language(language).expect("shipped files are translated")).collect();
    let known: Vec<&str> = called().map(|source| source.text).chain([SHELL]).collect();
    let calls = translate(CALLS, "", &known, language).unwrap_or_else(|refusal| panic!("golden.wgsl, {refusal}"));
    shipped + &calls
}
