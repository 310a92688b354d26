//! What a file leaves to whoever copies it.

use velour::export::shaders::{Language, Source, translate};

/// In a language.
pub fn theirs(source: &Source, language: Language) -> String {
    if source.theirs.is_empty() {
        return String::new();
    }
    translate(source.theirs, "", &[], language).unwrap_or_else(|refusal| panic!("{}, {refusal}", source.stem))
}
