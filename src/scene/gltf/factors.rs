//! Factors of materials past their range: a file that holds them breaks the specification, but every viewer draws it
//! and what was meant is plain. They are mended in the JSON, as the numbers that the file has, before any is rounded.

use serde_json::{Map, Value};

use crate::scene::error::label;
use crate::scene::notices::Notices;

/// A number of a material, or a list of them: where it is in the material, and its range.
struct Factor {
    pointer: &'static str,
    max: f64,
}

const fn up_to(max: f64, pointer: &'static str) -> Factor {
    Factor { pointer, max }
}

/// All are from 0 up.
const FACTORS: [Factor; 14] = [
    up_to(1.0, "/pbrMetallicRoughness/baseColorFactor"),
    up_to(1.0, "/pbrMetallicRoughness/metallicFactor"),
    up_to(1.0, "/pbrMetallicRoughness/roughnessFactor"),
    up_to(1.0, "/occlusionTexture/strength"),
    up_to(1.0, "/extensions/KHR_materials_specular/specularFactor"),
    up_to(1.0, "/extensions/KHR_materials_sheen/sheenColorFactor"),
    up_to(1.0, "/extensions/KHR_materials_sheen/sheenRoughnessFactor"),
    up_to(1.0, "/extensions/KHR_materials_fuzz/fuzzFactor"),
    up_to(1.0, "/extensions/KHR_materials_fuzz/fuzzColorFactor"),
    up_to(1.0, "/extensions/KHR_materials_fuzz/fuzzRoughnessFactor"),
    up_to(f64::INFINITY, "/alphaCutoff"),
    up_to(f64::INFINITY, "/emissiveFactor"),
    up_to(f64::INFINITY, "/extensions/KHR_materials_emissive_strength/emissiveStrength"),
    up_to(f64::INFINITY, "/extensions/KHR_materials_specular/specularColorFactor"),
];

/// Brings the factors of all materials of a file's JSON into their ranges, with one notice; another for an
/// emissiveFactor past 1, which is left as it is: it is a strength from before there was an extension for that.
pub fn mend(root: &mut Map<String, Value>, notices: &mut Notices) {
    let materials = root.get_mut("materials").and_then(Value::as_array_mut).into_iter().flatten();
    for (index, material) in materials.enumerate() {
        let name = material.get("name").and_then(Value::as_str).map(str::to_owned);
        let place = || label("material", index, name.as_deref());
        for Factor { pointer, max } in &FACTORS {
            let Some(factor) = material.pointer_mut(pointer) else { continue };
            let member = pointer.rsplit('/').next().unwrap_or_default();
            if let Some(value) = clamp(factor, *max) {
                let kind = "factors past their range are taken as the nearest in it";
                notices.add(kind, || format!("{member} {value} of {}", place()));
            }
            if member == "emissiveFactor" && numbers(factor).any(|number| number.as_f64() > Some(1.0)) {
                notices.add("an emissiveFactor past 1 is taken as a strength", place);
            }
        }
    }
}

/// Brings numbers into [0, `max`]; one that was not there, if any.
fn clamp(factor: &mut Value, max: f64) -> Option<f64> {
    let mut found = None;
    for number in numbers(factor) {
        let Some(value) = number.as_f64().filter(|value| !(0.0..=max).contains(value)) else { continue };
        found = Some(value);
        *number = value.clamp(0.0, max).into();
    }
    found
}

/// The value itself, or those of a list.
fn numbers(value: &mut Value) -> impl Iterator<Item = &mut Value> {
    match value {
        Value::Array(list) => list.iter_mut(),
        single => std::slice::from_mut(single).iter_mut(),
    }
}
