//! What a file leaves to whoever copies it.

use velour::export::shaders::{Language, Source, translate};

/// By buffers, as the examples do it.
pub fn by_buffers(language: Language) -> &'static str {
    match language {
        Language::GlslEs300 | Language::Glsl450 => include_str!("../../examples/lights_buffers.glsl"),
        Language::Hlsl => include_str!("../../examples/lights_buffers.hlsl"),
        Language::Msl => include_str!("../../examples/lights_buffers.metal"),
    }
}

/// In a language.
pub fn theirs(source: &Source, language: Language) -> String {
    if source.theirs.is_empty() {
        return String::new();
    }
    translate(source.theirs, "", &[], language).unwrap_or_else(|refusal| panic!("{}, {refusal}", source.stem))
}
