//! From text to glTF's JSON: the version, and the types of all values, however they are spelled.

use gltf::json::Root;
use serde_json::{Map, Number, Value};

use super::exact::Exact;
use super::{Fault, factors};
use crate::scene::notices::Notices;

/// The most entries of any list in a file: a few bytes of JSON become hundreds in memory.
const COUNT_MAX: usize = 1 << 20;

/// Members whose numbers are indices or codes. Their type in `Root` is 32 bits wide, in which wider numbers would wrap.
const INDICES: [&str; 24] = [
    "buffer",
    "bufferView",
    "camera",
    "children",
    "componentType",
    "index",
    "indices",
    "input",
    "joints",
    "magFilter",
    "material",
    "mesh",
    "minFilter",
    "mode",
    "node",
    "nodes",
    "output",
    "sampler",
    "scene",
    "skeleton",
    "skin",
    "source",
    "wrapS",
    "wrapT",
];

/// Beyond it, neighbouring `f64` are more than 1 apart.
const WHOLE_MAX: f64 = (1u64 << 53) as f64;

/// Under this name a primitive's morph targets are kept among its extensions: `Root` drops the texture coordinates and
/// colours in them.
pub const TARGETS: &str = "targets";

/// A file's JSON.
pub struct Parsed {
    pub root: Root,
    pub exact: Exact,
    /// How many animations there are.
    pub animations: usize,
}

/// Parses in two steps, so that errors can name the place by its path rather than by a column in a line of a megabyte.
pub fn parse_json(text: &[u8], notices: &mut Notices) -> Result<Parsed, Fault> {
    let json = bare(text);
    let mut value: Value = serde_json::from_slice(json).map_err(|error| match is_object(json) {
        true => Fault::new(format_args!("its JSON is broken ({error}); correct it or export the file again")),
        false => Fault::new(format_args!("not a glTF file ({error}); give a .gltf or .glb file")),
    })?;
    let Value::Object(root) = &mut value else {
        return Err(Fault::new("not a glTF file (its JSON is no object); give a .gltf or .glb file"));
    };
    check_version(root)?;
    // These are not played, and `Root` demands more of them than glTF does.
    let animations = root.remove("animations").as_ref().and_then(Value::as_array).map_or(0, Vec::len);
    check_counts(root)?;
    for scene in root.get_mut("scenes").and_then(Value::as_array_mut).into_iter().flatten() {
        // glTF allows a scene to be empty; `Root` does not.
        scene.as_object_mut().map(|scene| scene.entry("nodes").or_insert_with(|| Value::Array(Vec::new())));
    }
    for (key, value) in root.iter_mut() {
        prepare(key, value)?;
    }
    factors::mend(root, notices);
    keep_targets(root);
    let wrong = |error| Fault::new(format_args!("{error}; correct it or export the file again"));
    let root = serde_path_to_error::deserialize(&value).map_err(wrong)?;
    let exact = serde_path_to_error::deserialize(value).map_err(wrong)?;
    Ok(Parsed { root, exact, animations })
}

/// The text without a byte order mark, which readers may ignore (RFC 8259, section 8.1), and without zeros at its end,
/// by which some pad the JSON of a .glb in place of spaces.
fn bare(text: &[u8]) -> &[u8] {
    let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
    let padding = text.iter().rev().take_while(|byte| **byte == 0 || byte.is_ascii_whitespace()).count();
    &text[..text.len() - padding]
}

/// Moves morph targets to where they are kept whole. What is of the wrong type is left for `Root` to refuse.
fn keep_targets(root: &mut Map<String, Value>) {
    let meshes = root.get_mut("meshes").and_then(Value::as_array_mut).into_iter().flatten();
    let primitives = meshes.filter_map(|mesh| mesh.get_mut("primitives")?.as_array_mut()).flatten();
    for primitive in primitives.filter_map(Value::as_object_mut) {
        let Some(targets) = primitive.remove("targets") else { continue };
        let extensions = primitive.entry("extensions").or_insert_with(|| Value::Object(Map::new()));
        if let Some(extensions) = extensions.as_object_mut() {
            extensions.insert(TARGETS.to_owned(), targets);
        }
    }
}

/// Whether the text begins like a JSON object, and so is meant to be one.
fn is_object(json: &[u8]) -> bool {
    json.trim_ascii_start().starts_with(b"{")
}

/// Checks for glTF 2.x, before anything else: a file of glTF 1 is wrong in many other ways too.
fn check_version(root: &Map<String, Value>) -> Result<(), Fault> {
    let Some(asset) = root.get("asset") else {
        return Err(Fault::new("not a glTF file (no asset in its JSON); give a .gltf or .glb file"));
    };
    let text = |key: &str| asset.get(key).and_then(Value::as_str);
    let Some(version) = text("version") else {
        return Err(Fault::at("asset.version", "missing or no text; export the file as glTF 2.0"));
    };
    if version.split('.').next() != Some("2") {
        return Err(Fault::at("asset.version", format_args!("the file is glTF {version}; export it as glTF 2.0")));
    }
    match text("minVersion") {
        None | Some("2.0") => Ok(()),
        Some(needed) => {
            Err(Fault::at("asset.minVersion", format_args!("needs glTF {needed}; export the file as glTF 2.0")))
        }
    }
}

fn check_counts(root: &Map<String, Value>) -> Result<(), Fault> {
    let counts = root.iter().map(|(key, value)| (key, value.as_array().map_or(0, Vec::len)));
    match counts.into_iter().find(|&(_, count)| count > COUNT_MAX) {
        None => Ok(()),
        Some((key, count)) => {
            Err(Fault::at(key, format_args!("{count} entries; split the file: at most {COUNT_MAX} are served")))
        }
    }
}

/// Drops what is never read, spells integers as such, and refuses indices that would wrap. Recurses as deep as the
/// JSON, which its parser limits to 128.
fn prepare(key: &str, value: &mut Value) -> Result<(), Fault> {
    match value {
        Value::Object(members) => {
            members.remove("extras");
            for (name, member) in members {
                prepare(if key == "attributes" { "index" } else { name }, member)?;
            }
        }
        Value::Array(elements) => {
            for element in elements {
                prepare(key, element)?;
            }
        }
        Value::Number(number) => {
            *number = integer(number).unwrap_or_else(|| number.clone());
            if INDICES.contains(&key) && number.as_u64().is_some_and(|index| index > u32::MAX.into()) {
                return Err(Fault::at(key, format_args!("the index {number} is out of range; export the file again")));
            }
        }
        _ => {}
    }
    Ok(())
}

/// The integer that a number is though it has a decimal point or an exponent, as 4.0 and 1e2 (glTF 2.0, section 2.7).
fn integer(number: &Number) -> Option<Number> {
    let value = number.as_f64().filter(|_| number.is_f64())?;
    let is_whole = value.fract() == 0.0 && value.abs() <= WHOLE_MAX;
    is_whole.then(|| Number::from(value as i64))
}
