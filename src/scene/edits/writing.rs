//! Keys and values as a text has them.

use std::fmt::Write as _;

use super::selection::named;
use super::{Kind, Value};
use crate::scene::Scene;

pub(super) fn write_keys(text: &mut String, entries: Vec<(&str, Value)>) {
    for (key, value) in entries {
        // Writing to a string does not fail.
        let _ = writeln!(text, "{key} = {}", written(&value));
    }
}

/// The key and the value by which a file names a thing: its name where no other has it, else its index.
pub(super) fn reference_to(scene: &Scene, kind: Kind, index: usize) -> (&'static str, Value) {
    let name = kind.names(scene)[index];
    match named(scene, kind, name) {
        Ok(all) if all.len() == 1 && !name.is_empty() => ("name", name.into()),
        _ => ("index", Value::Number(index as f32)),
    }
}

/// A value in TOML.
fn written(value: &Value) -> String {
    // The shortest decimals that are read back as the same number; whole ones without a point.
    let number = |number: &f32| match number.fract() == 0.0 && number.abs() < 1e6 {
        true => format!("{number}"),
        false => format!("{number:?}"),
    };
    match value {
        Value::Number(one) => number(one),
        Value::Numbers(several) => format!("[{}]", several.iter().map(number).collect::<Vec<_>>().join(", ")),
        Value::Text(text) => quoted(text),
        Value::Switch(switch) => switch.to_string(),
    }
}

/// A text as a basic string of TOML, in one line whatever is in it: a name must not be able to end what the text stands in.
fn quoted(text: &str) -> String {
    let escaped = text.chars().map(|character| match character {
        '"' | '\\' => format!("\\{character}"),
        // TOML knows no more ends of lines, but programs do.
        _ if character.is_control() || matches!(character, '\u{2028}' | '\u{2029}') => {
            format!("\\u{:04x}", u32::from(character))
        }
        _ => character.to_string(),
    });
    format!("\"{}\"", escaped.collect::<String>())
}
