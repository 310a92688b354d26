//! What is wrong with a scene's file, in one line.

use std::fmt::Display;

/// Why a scene could not be loaded. Reads `FILE: PLACE: what is wrong; what to do`: always one line, whatever the file
/// holds.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file}: {fault}")]
pub struct SceneError {
    file: String,
    fault: Fault,
}

impl SceneError {
    pub(super) fn new(file: &str, fault: Fault) -> Self {
        Self { file: one_line(file), fault }
    }
}

/// What is wrong; the caller knows in which file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub(super) struct Fault(String);

impl Fault {
    /// Something about the file as a whole.
    pub fn new(what: impl Display) -> Self {
        Self(one_line(&what.to_string()))
    }

    /// Something at a place within the file, say `mesh 3 "sleeve"`.
    pub fn at(place: impl Display, what: impl Display) -> Self {
        Self::new(format_args!("{place}: {what}"))
    }
}

/// The text with control characters escaped, line ends above all: what comes from a file must not break the one line.
pub(super) fn one_line(text: &str) -> String {
    let mut line = String::with_capacity(text.len());
    for character in text.chars() {
        match character.is_control() || matches!(character, '\u{2028}' | '\u{2029}') {
            true => line.extend(character.escape_default()),
            false => line.push(character),
        }
    }
    line
}

/// Names a thing in the file by its kind, index and name: `mesh 3 "sleeve"`. Long names are cut short.
pub(super) fn label(kind: &str, index: usize, name: Option<&str>) -> String {
    const SHOWN: usize = 60;
    match name {
        None | Some("") => format!("{kind} {index}"),
        Some(name) => match name.char_indices().nth(SHOWN) {
            None => format!("{kind} {index} \"{name}\""),
            Some((cut, _)) => format!("{kind} {index} \"{}...\"", &name[..cut]),
        },
    }
}
