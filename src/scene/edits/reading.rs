//! Values in a text, and what is said where they are wrong.

use toml::Spanned;
use toml::de::DeValue;

use super::{Keyed, Value};
use crate::scene::Scene;
use crate::scene::error::one_line;

/// Why a text holds no edits of a scene: `line 7, alpha of material "velvet": give a number in [0,1]`. Always one line.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}{place}: {what}")]
pub struct EditsError {
    /// Counted from 1.
    pub line: usize,
    place: String,
    what: String,
}

/// What is read, and the scene that it is for.
pub(super) struct Reader<'a> {
    pub(super) text: &'a str,
    pub(super) scene: &'a Scene,
}

impl Reader<'_> {
    pub(super) fn error(&self, at: usize, place: String, what: impl ToString) -> EditsError {
        let line = 1 + self.text.bytes().take(at).filter(|&byte| byte == b'\n').count();
        EditsError { line, place: one_line(&place), what: one_line(&what.to_string()) }
    }

    pub(super) fn set(
        &self,
        group: &mut impl Keyed,
        key: &Spanned<std::borrow::Cow<str>>,
        value: &Spanned<DeValue>,
        of: &str,
    ) -> Result<(), EditsError> {
        let place = format!(", {}{of}", key.get_ref());
        let read = self.value(value, &place)?;
        group.set(key.get_ref(), &read).map_err(|what| self.error(key.span().start, place, what))
    }

    /// A value of the text, whatever it is for.
    pub(super) fn value(&self, value: &Spanned<DeValue>, place: &str) -> Result<Value, EditsError> {
        let found = match value.get_ref() {
            DeValue::String(text) => Some(Value::Text(text.to_string())),
            DeValue::Boolean(switch) => Some(Value::Switch(*switch)),
            DeValue::Array(several) => {
                several.iter().map(|one| number(one.get_ref())).collect::<Option<_>>().map(Value::Numbers)
            }
            one => number(one).map(Value::Number),
        };
        let wrong = || self.error(value.span().start, place.to_owned(), "give a number, a list of numbers, or a text");
        found.ok_or_else(wrong)
    }
}

/// The number nearest to what is written. `None` where it is none.
fn number(value: &DeValue) -> Option<f32> {
    let written = match value {
        DeValue::Float(float) => float.as_str(),
        DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str(),
        DeValue::Integer(integer) => {
            return i64::from_str_radix(integer.as_str(), integer.radix()).ok().map(|number| number as f32);
        }
        _ => return None,
    };
    written.replace('_', "").parse().ok()
}
