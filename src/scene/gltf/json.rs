//! From text to glTF's JSON: the version, the types of all values, and that indices point to something.

use std::collections::HashMap;

use gltf::json::Root;
use serde_json::{Map, Number, Value};

use super::Fault;

/// The most of anything that a file may hold: a few bytes of JSON make hundreds in memory.
const COUNT_MAX: usize = 1 << 20;

/// Members that hold an index, or a list of them, and the root's list that they point into.
const INDICES: [(&str, &str); 19] = [
    ("attribute", "accessors"),
    ("buffer", "buffers"),
    ("bufferView", "bufferViews"),
    ("camera", "cameras"),
    ("children", "nodes"),
    ("index", "textures"),
    ("indices", "accessors"),
    ("input", "accessors"),
    ("inverseBindMatrices", "accessors"),
    ("joints", "nodes"),
    ("material", "materials"),
    ("mesh", "meshes"),
    ("node", "nodes"),
    ("nodes", "nodes"),
    ("output", "accessors"),
    ("scene", "scenes"),
    ("skeleton", "nodes"),
    ("skin", "skins"),
    ("source", "images"),
];

/// Members that stand for something by a number. `Root` takes 32 bits of them and would not see the rest.
const NUMBERS: [&str; 3] = ["componentType", "mode", "target"];

/// Parses in two steps, so that errors can name the place by its path rather than by a column in a line of a megabyte.
pub fn parse_json(json: &[u8]) -> Result<Root, Fault> {
    let not_gltf = |error| Fault::new(format_args!("not a glTF file ({error}); give a .gltf or .glb file"));
    let mut value: Value = serde_json::from_slice(json).map_err(not_gltf)?;
    let Value::Object(root) = &mut value else {
        return Err(Fault::new("not a glTF file (its JSON is no object); give a .gltf or .glb file"));
    };
    check_version(root)?;
    check_counts(root)?;
    for scene in root.get_mut("scenes").and_then(Value::as_array_mut).into_iter().flatten() {
        // glTF lets a scene be empty; `Root` doesn't.
        scene.as_object_mut().map(|scene| scene.entry("nodes").or_insert_with(|| Value::Array(Vec::new())));
    }
    let counts = root.iter().filter_map(|(key, value)| Some((key.clone(), value.as_array()?.len() as u64))).collect();
    for (key, value) in root.iter_mut() {
        prepare(&counts, key, value).map_err(|(path, what)| Fault::at(format_args!("{key}{path}"), what))?;
    }
    let wrong = |error| Fault::new(format_args!("{error}; correct it or export the file again"));
    serde_path_to_error::deserialize(&value).map_err(wrong)
}

/// glTF 2.x, told before anything else is: a file of glTF 1 is wrong in many other ways.
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

/// Drops what nobody reads and checks every index against the length of its list, outside of extensions. An error comes
/// with its path from here. Recurses as deep as the JSON, which its parser bounds to 128.
fn prepare(counts: &HashMap<String, u64>, key: &str, value: &mut Value) -> Result<(), (String, String)> {
    match value {
        Value::Object(members) => {
            members.remove("extras");
            // The members of these have names of the file's choice.
            let key = ["attributes", "targets"].contains(&key).then_some("attribute");
            for (name, member) in members.iter_mut().filter(|(name, _)| *name != "extensions") {
                prepare(counts, key.unwrap_or(name), member)
                    .map_err(|(path, what)| (format!(".{name}{path}"), what))?;
            }
        }
        Value::Array(elements) => {
            for (index, element) in elements.iter_mut().enumerate() {
                prepare(counts, key, element).map_err(|(path, what)| (format!("[{index}]{path}"), what))?;
            }
        }
        Value::Number(number) => return check_index(counts, key, number).map_err(|what| (String::new(), what)),
        _ => {}
    }
    Ok(())
}

fn check_index(counts: &HashMap<String, u64>, key: &str, number: &Number) -> Result<(), String> {
    // Numbers of other kinds are of the wrong type, which is told later.
    let Some(index) = number.as_u64() else { return Ok(()) };
    if NUMBERS.contains(&key) && index > u32::MAX.into() {
        return Err(format!("{index} is none of glTF's values; export the file again"));
    }
    let Some((_, list)) = INDICES.iter().find(|(name, _)| *name == key) else { return Ok(()) };
    match counts.get(*list).copied().unwrap_or(0) {
        count if index < count => Ok(()),
        count => Err(format!("index {index} is out of range (the file has {count} {list}); export the file again")),
    }
}
