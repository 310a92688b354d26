//! Added lights in a text: an `[[added-light]]` each, with a `shape` or what it is a copy of, and the keys of its kind.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::selection::{indexed, named};
use super::text::{EditsError, Reader, reference_to, write_keys};
use super::{Added, Edits, Keyed, Kind, LightShape, MOST_CORNERS, MOST_PUNCTUAL, PunctualShape, Value};
use crate::scene::Scene;

/// The table of such a light, and how messages call one.
pub(super) const ADDED: &str = "added-light";

/// What is read before the keys of its kind.
const SHAPE_KEYS: [&str; 5] = ["name", "shape", "corners", "copy-of", "copy-of-punctual"];

/// Shapes without further numbers, by name.
const SHAPES: [(&str, Shape); 5] = [
    ("rectangle", Shape::Area(LightShape::Rectangle)),
    ("disk", Shape::Area(LightShape::Disk)),
    ("point", Shape::Punctual(PunctualShape::Point)),
    ("spot", Shape::Punctual(PunctualShape::Spot)),
    ("directional", Shape::Punctual(PunctualShape::Directional)),
];
const POLYGON: &str = "polygon";

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shape {
    Area(LightShape),
    Punctual(PunctualShape),
}

/// All lights that are added.
pub(super) fn write_added(text: &mut String, edits: &Edits, scene: &Scene) {
    for Added { name, shape, changes } in &edits.added_lights {
        write_light(text, scene, name, Shape::Area(*shape), changes);
    }
    for Added { name, shape, changes } in &edits.added_punctual {
        write_light(text, scene, name, Shape::Punctual(*shape), changes);
    }
}

fn write_light(text: &mut String, scene: &Scene, name: &str, shape: Shape, changes: &impl Keyed) {
    text.push_str(&format!("\n[[{ADDED}]]\n"));
    write_keys(text, vec![("name", name.into())]);
    let entries = match shape {
        Shape::Area(LightShape::Polygon(corners)) => {
            vec![("shape", POLYGON.into()), ("corners", f32::from(corners).into())]
        }
        Shape::Area(LightShape::Copy(of)) => vec![("copy-of", reference_to(scene, Kind::Light, of).1)],
        Shape::Punctual(PunctualShape::Copy(of)) => {
            vec![("copy-of-punctual", reference_to(scene, Kind::Punctual, of).1)]
        }
        plain => {
            let found = SHAPES.iter().find(|(_, shape)| *shape == plain);
            found.map(|(name, _)| ("shape", Value::from(*name))).into_iter().collect()
        }
    };
    write_keys(text, entries);
    write_keys(text, changes.entries());
}

impl Reader<'_> {
    /// The lights that are added by a list of tables.
    pub(super) fn added(&self, value: &Spanned<DeValue>, edits: &mut Edits) -> Result<(), EditsError> {
        let place = || format!(", {ADDED}");
        let wrong = |at: &Spanned<DeValue>| self.error(at.span().start, place(), format!("give tables: [[{ADDED}]]"));
        for one in value.get_ref().as_array().ok_or_else(|| wrong(value))?.iter() {
            let table = one.get_ref().as_table().ok_or_else(|| wrong(one))?;
            let start = one.span().start;
            let name = match self.found(table, "name")? {
                None => String::new(),
                Some((_, Value::Text(name))) => name,
                Some((at, _)) => return Err(self.error(at, place(), "give a name in quotes")),
            };
            match self.shape(table, start)? {
                Shape::Area(shape) => {
                    let changes = self.changes(table)?;
                    edits.added_lights.push(Added { name, shape, changes });
                    if edits.corner_count(self.scene) > MOST_CORNERS {
                        let what = format!("all lights have at most {MOST_CORNERS} corners together; leave some out");
                        return Err(self.error(start, place(), what));
                    }
                }
                Shape::Punctual(shape) => {
                    let changes = self.changes(table)?;
                    edits.added_punctual.push(Added { name, shape, changes });
                    if edits.added_punctual.len() > MOST_PUNCTUAL {
                        let what = format!("at most {MOST_PUNCTUAL} lights without extent are added; leave some out");
                        return Err(self.error(start, place(), what));
                    }
                }
            }
        }
        Ok(())
    }

    /// A key's place and value, where the table has it.
    fn found(&self, table: &DeTable, key: &str) -> Result<Option<(usize, Value)>, EditsError> {
        let Some((found, value)) = table.get_key_value(key) else { return Ok(None) };
        let value = self.value(value, &format!(", {key} of an {ADDED}"))?;
        Ok(Some((found.span().start, value)))
    }

    fn changes<T: Keyed + Default>(&self, table: &DeTable) -> Result<T, EditsError> {
        let mut changes = T::default();
        for (key, value) in table.iter().filter(|(key, _)| !SHAPE_KEYS.contains(&key.get_ref().as_ref())) {
            self.set(&mut changes, key, value, &format!(" of an {ADDED}"))?;
        }
        Ok(changes)
    }

    fn shape(&self, table: &DeTable, start: usize) -> Result<Shape, EditsError> {
        let fault = |at: usize, what: String| self.error(at, format!(", {ADDED}"), what);
        let keys = ["shape", "copy-of", "copy-of-punctual"].map(|key| self.found(table, key));
        let [shape, area, punctual] = keys;
        let corners = self.found(table, "corners")?;
        match (shape?, area?, punctual?) {
            (Some((at, Value::Text(name))), None, None) if name == POLYGON => {
                let most = LightShape::MOST_CORNERS;
                let in_range = |number: f32| number.fract() == 0.0 && (3.0..=f32::from(most)).contains(&number);
                match corners {
                    Some((_, Value::Number(number))) if in_range(number) => {
                        Ok(Shape::Area(LightShape::Polygon(number as u16)))
                    }
                    _ => Err(fault(at, format!("give the polygon's corners, a whole number in [3,{most}]"))),
                }
            }
            (Some((at, value)), None, None) => {
                let found = SHAPES.iter().find(|(name, _)| value == Value::from(*name));
                let names = || SHAPES.map(|(name, _)| name).join(", ");
                found.map(|(_, shape)| *shape).ok_or_else(|| fault(at, format!("give one of {POLYGON}, {}", names())))
            }
            (None, Some((at, of)), None) => {
                Ok(Shape::Area(LightShape::Copy(self.copied(Kind::Light, &of).map_err(|what| fault(at, what))?)))
            }
            (None, None, Some((at, of))) => {
                let of = self.copied(Kind::Punctual, &of).map_err(|what| fault(at, what))?;
                Ok(Shape::Punctual(PunctualShape::Copy(of)))
            }
            _ => Err(fault(start, "give one of shape, copy-of and copy-of-punctual".to_owned())),
        }
    }

    /// The index of what is copied, by its name where only one has it, or its index.
    fn copied(&self, kind: Kind, of: &Value) -> Result<usize, String> {
        let unknown = |error: super::UnknownThing| error.to_string();
        match of {
            Value::Text(name) => named(self.scene, kind, name).map(|found| found[0]).map_err(unknown),
            Value::Number(index) if *index >= 0.0 && index.fract() == 0.0 => {
                indexed(self.scene, kind, *index as usize).map_err(unknown)
            }
            _ => Err("give a name in quotes, or an index from 0 up".to_owned()),
        }
    }
}
