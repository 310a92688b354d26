//! Words that mean something in other shading languages: people turn the shipped files into these, so that no name may
//! be one of them.

use velour::export::shaders::is_reserved;

/// What a source declares (functions, types, constants, variables, arguments, members) by a name that is such a word.
pub fn reserved(source: &str) -> Vec<&str> {
    declared(source).into_iter().filter(|name| is_reserved(name)).collect()
}

/// What follows a word that declares, or is followed by its type.
fn declared(source: &str) -> Vec<&str> {
    const DECLARING: [&str; 7] = ["alias", "const", "fn", "let", "override", "struct", "var"];
    let is_part = |letter: char| letter.is_alphanumeric() || letter == '_';
    let (mut found, mut before) = (Vec::new(), "");
    for line in source.lines() {
        let mut rest = line.split("//").next().unwrap_or_default();
        while let Some(start) = rest.find(is_part) {
            let from_word = &rest[start..];
            let (word, after) =
                from_word.split_at(from_word.find(|letter| !is_part(letter)).unwrap_or(from_word.len()));
            // Not what stands in brackets, as of `var<private> name`.
            let is_declared = DECLARING.contains(&before) && rest[..start].trim().is_empty();
            let is_typed = after.trim_start().starts_with(':') && word != "default";
            if is_declared || is_typed {
                found.push(word);
            }
            (before, rest) = (word, after);
        }
    }
    found
}

#[test]
fn reserved_words_are_found_wherever_they_are_declared() {
    for (source, word) in [
        ("fn f(p: vec3f, vertex: vec3f) {}", "vertex"),
        ("fn f() {\n    let lit = 1.0;\n}", "lit"),
        ("fn f() {\n    for (var sample = 0u; sample < 4u; sample++) {}\n}", "sample"),
        ("fn f() { const half = 0.5; }", "half"),
        ("fn f() { var<function> kernel: f32; }", "kernel"),
        ("struct S {\n    point : vec3f,\n}", "point"),
        ("fn noise() {}", "noise"),
        ("fn f(p: array<f32, 4>,\n    // one\n    level: f32) {}", "level"),
    ] {
        assert_eq!(reserved(source), [word], "{source}");
    }
    let fine =
        "// let lit = vertex: f32\nfn f(corner: vec3f) -> f32 {\n    return sqrt(length(corner)); // default: point\n}";
    assert_eq!(reserved(fine), [""; 0]);
    assert_eq!(reserved("var<private> state: f32; fn f() { switch 1 { default: {} } }"), [""; 0]);
}
