//! Edits as a file that people read and write: TOML, with the flags' names for keys.

use std::fmt::Write as _;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::selection::{indexed, named};
use super::text_added::{ADDED, write_added};
use super::{CameraEdit, Edits, Keyed, Kind, MaterialEdits, Value, select};
use crate::scene::error::one_line;
use crate::scene::{Orbit, Projection, Scene};

/// Why a text holds no edits of a scene: `line 7, alpha of material "velvet": give a number in [0,1]`. Always one line.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}{place}: {what}")]
pub struct EditsError {
    /// Counted from 1.
    pub line: usize,
    place: String,
    what: String,
}

impl Edits {
    /// A text that [`Edits::from_text`] takes back to the same edits of the same scene.
    pub fn to_text(&self, scene: &Scene) -> String {
        let mut text = String::new();
        write_keys(&mut text, self.entries());
        if let Some(CameraEdit::Loaded(index)) = self.camera {
            let (_, value) = reference_to(scene, Kind::Camera, index);
            write_keys(&mut text, vec![("camera", value)]);
        }
        write_keys(&mut text, self.every_material.entries());
        if let Some(CameraEdit::Orbit(orbit)) = self.camera {
            text.push_str("\n[view]\n");
            write_keys(&mut text, orbit.entries());
        }
        for (&index, edits) in &self.materials {
            write_thing(&mut text, Kind::Material, reference_to(scene, Kind::Material, index), edits);
        }
        for (&index, edits) in &self.lights {
            write_thing(&mut text, Kind::Light, reference_to(scene, Kind::Light, index), edits);
        }
        for (&index, edits) in &self.punctual {
            write_thing(&mut text, Kind::Punctual, reference_to(scene, Kind::Punctual, index), edits);
        }
        write_added(&mut text, self, scene);
        text
    }

    /// The edits of `scene` in a text: keys of the picture, `camera`, and keys of all materials at the top; `[view]`; a
    /// `[[material]]`, a `[[light]]` and a `[[punctual-light]]` with a `name` or an `index` for each thing that is changed by
    /// itself; and an `[[added-light]]` for each that is added.
    pub fn from_text(text: &str, scene: &Scene) -> Result<Self, EditsError> {
        let reader = Reader { text, scene };
        let root = DeTable::parse(text).map_err(|error| {
            let at = error.span().map_or(0, |span| span.start);
            reader.error(at, String::new(), error.message())
        })?;
        reader.edits(root.get_ref())
    }
}

pub(super) fn write_keys(text: &mut String, entries: Vec<(&str, Value)>) {
    for (key, value) in entries {
        // Writing to a string does not fail.
        let _ = writeln!(text, "{key} = {}", written(&value));
    }
}

fn write_thing(text: &mut String, kind: Kind, (key, value): (&'static str, Value), edits: &impl Keyed) {
    let entries = edits.entries();
    if !entries.is_empty() {
        let _ = writeln!(text, "\n[[{}]]", kind.noun());
        write_keys(text, vec![(key, value)]);
        write_keys(text, entries);
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
        Value::Text(text) => toml::Value::String(text.clone()).to_string(),
        Value::Switch(switch) => switch.to_string(),
    }
}

/// What is read, and the scene that it is for.
pub(super) struct Reader<'a> {
    text: &'a str,
    pub(super) scene: &'a Scene,
}

impl Reader<'_> {
    pub(super) fn error(&self, at: usize, place: String, what: impl ToString) -> EditsError {
        let line = 1 + self.text.bytes().take(at).filter(|&byte| byte == b'\n').count();
        EditsError { line, place: one_line(&place), what: one_line(&what.to_string()) }
    }

    /// The edits in the whole text.
    fn edits(&self, root: &DeTable) -> Result<Edits, EditsError> {
        let mut edits = Edits::default();
        for (key, value) in root.iter() {
            let at = key.span().start;
            let of_key = |what: String| self.error(at, format!(", {}", key.get_ref()), what);
            match key.get_ref().as_ref() {
                "view" => edits.camera = Some(CameraEdit::Orbit(self.view(value)?)),
                "material" => self.things(value, Kind::Material, &mut edits.materials)?,
                "light" => self.things(value, Kind::Light, &mut edits.lights)?,
                "punctual-light" => self.things(value, Kind::Punctual, &mut edits.punctual)?,
                ADDED => self.added(value, &mut edits)?,
                "camera" if root.contains_key("view") => {
                    return Err(of_key("[view] says from where, too; keep one of them".to_owned()));
                }
                "camera" => {
                    let found = match self.value(value, ", camera")? {
                        Value::Number(index) if index >= 0.0 && index.fract() == 0.0 => {
                            indexed(self.scene, Kind::Camera, index as usize)
                        }
                        Value::Text(name) => select(self.scene, Kind::Camera, &name).map(|found| found[0]),
                        _ => return Err(of_key("give a name, or an index from 0 up".to_owned())),
                    };
                    edits.camera = Some(CameraEdit::Loaded(found.map_err(|unknown| of_key(unknown.to_string()))?));
                }
                name if MaterialEdits::KEYS.contains(&name) => self.set(&mut edits.every_material, key, value, "")?,
                name if Edits::KEYS.contains(&name) => self.set(&mut edits, key, value, "")?,
                _ => {
                    let keys = [Edits::KEYS, &["camera"], MaterialEdits::KEYS].concat().join(", ");
                    return Err(of_key(format!(
                        "the keys are {keys}, and [view], [[material]], [[light]], [[punctual-light]] and [[{ADDED}]]"
                    )));
                }
            }
        }
        Ok(edits)
    }

    /// A view; what it leaves open is the first camera's.
    fn view(&self, value: &Spanned<DeValue>) -> Result<Orbit, EditsError> {
        let of_view = |what: &str| self.error(value.span().start, ", view".to_owned(), what);
        let table = value.get_ref().as_table().ok_or_else(|| of_view("give a table: [view]"))?;
        let camera = self.scene.cameras.first().ok_or_else(|| of_view("the scene has no camera to start from"))?;
        let mut orbit = Orbit::new(camera, self.scene.subject().center());
        for (key, value) in table.iter() {
            self.set(&mut orbit, key, value, " of the view")?;
        }
        if table.contains_key("yfov") && table.contains_key("ymag") {
            return Err(of_view("yfov and ymag exclude each other; keep one of them"));
        }
        match orbit.projection {
            Projection::Perspective { near, far, .. } if near > 0.0 && near < far => Ok(orbit),
            Projection::Orthographic { near, far, .. } if near < far && far.is_finite() => Ok(orbit),
            Projection::Perspective { .. } => Err(of_view("give near above 0, and far above near")),
            Projection::Orthographic { .. } => Err(of_view("give far above near, and finite")),
        }
    }

    /// Tables of things of one kind; later ones win.
    fn things<T: Keyed + Copy + Default>(
        &self,
        value: &Spanned<DeValue>,
        kind: Kind,
        edits: &mut std::collections::BTreeMap<usize, T>,
    ) -> Result<(), EditsError> {
        let noun = kind.noun();
        let wrong = |at: &Spanned<DeValue>| {
            self.error(at.span().start, format!(", {noun}"), format!("give tables: [[{noun}]]"))
        };
        for thing in value.get_ref().as_array().ok_or_else(|| wrong(value))?.iter() {
            let table = thing.get_ref().as_table().ok_or_else(|| wrong(thing))?;
            let (indices, place) = self.selected(table, kind, thing.span().start)?;
            for (key, value) in table.iter().filter(|(key, _)| !SELECTORS.contains(&key.get_ref().as_ref())) {
                for &index in &indices {
                    self.set(edits.entry(index).or_default(), key, value, &place)?;
                }
            }
        }
        Ok(())
    }

    /// The indices of the things that a table is about, and how messages call them.
    fn selected(&self, table: &DeTable, kind: Kind, start: usize) -> Result<(Vec<usize>, String), EditsError> {
        let noun = kind.noun();
        let found = SELECTORS.map(|key| table.get_key_value(key));
        let (key, value) = match found {
            [Some(one), None] | [None, Some(one)] => one,
            _ => return Err(self.error(start, format!(", {noun}"), "give either its name or its index")),
        };
        let at = key.span().start;
        let of_key = |what: String| self.error(at, format!(", {} of a {noun}", key.get_ref()), what);
        let wanted = self.value(value, &format!(", {} of a {noun}", key.get_ref()))?;
        match (key.get_ref().as_ref(), &wanted) {
            ("name", Value::Text(name)) => {
                let indices = named(self.scene, kind, name).map_err(|unknown| of_key(unknown.to_string()))?;
                Ok((indices, format!(" of {noun} \"{}\"", name.chars().take(NAME_SHOWN).collect::<String>())))
            }
            ("index", Value::Number(index)) if *index >= 0.0 && index.fract() == 0.0 => {
                let index = indexed(self.scene, kind, *index as usize);
                let index = index.map_err(|unknown| of_key(unknown.to_string()))?;
                Ok((vec![index], format!(" of {noun} {index}")))
            }
            ("name", _) => Err(of_key("give a name in quotes".to_owned())),
            _ => Err(of_key("give a whole number from 0 up".to_owned())),
        }
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

/// The keys that say which thing a table is about.
const SELECTORS: [&str; 2] = ["name", "index"];

/// Most characters of a name in a message.
const NAME_SHOWN: usize = 60;

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

#[cfg(test)]
#[path = "text_tests.rs"]
mod tests;
