//! What flags change in materials: their values, and `--set MATERIAL.KEY=VALUE`.

use std::collections::BTreeMap;

use glam::Vec3;
use velour::scene::{Layering, Material, Overrides, RoughnessMap, SheenModel};

/// One `--set`; its material is still a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Assignment {
    material: String,
    overrides: Overrides,
}

/// Most characters of names in a message.
const NAMES_SHOWN: usize = 200;

/// `MATERIAL.KEY=VALUE`: the key starts after the last dot before the first equals sign, so that names may have dots.
pub fn assignment(text: &str) -> Result<Assignment, String> {
    let parts = text.split_once('=').and_then(|(place, value)| Some((place.rsplit_once('.')?, value)));
    let Some(((material, key), value)) = parts else {
        return Err("give MATERIAL.KEY=VALUE, say felt.alpha=0.3".to_owned());
    };
    let mut overrides = Overrides::default();
    let set = match key {
        "alpha" => share(value).map(|alpha| overrides.alpha = Some(alpha)),
        "sheen-color" => color(value).map(|color| overrides.sheen_color = Some(color)),
        "roughness-map" => roughness_map(value).map(|map| overrides.roughness_map = Some(map)),
        "sheen-model" => sheen_model(value).map(|model| overrides.sheen_model = Some(model)),
        "layering" => layering(value).map(|layering| overrides.layering = Some(layering)),
        _ => Err("the keys are alpha, sheen-color, roughness-map, sheen-model and layering".to_owned()),
    };
    set.map_err(|what| format!("{key}: {what}"))?;
    Ok(Assignment { material: material.to_owned(), overrides })
}

/// The overrides of materials by index. A name stands for all materials that bear it; where none does, a number is an
/// index from 0. Where two set the same key, the later one wins.
pub fn resolve(assignments: &[Assignment], materials: &[Material]) -> Result<BTreeMap<usize, Overrides>, String> {
    let mut resolved = BTreeMap::new();
    for Assignment { material, overrides } in assignments {
        let named = materials.iter().enumerate().filter(|(_, own)| own.name == *material);
        let mut indices: Vec<usize> = named.map(|(index, _)| index).collect();
        if indices.is_empty() {
            let index = material.parse().ok().filter(|&index: &usize| index < materials.len());
            indices.push(index.ok_or_else(|| unknown(material, materials))?);
        }
        for index in indices {
            let before: &mut Overrides = resolved.entry(index).or_default();
            *before = overrides.or(*before);
        }
    }
    Ok(resolved)
}

fn unknown(wanted: &str, materials: &[Material]) -> String {
    let names: Vec<String> =
        materials.iter().enumerate().map(|(index, material)| format!("{index} ({})", material.name)).collect();
    let names = names.join(", ");
    let shown: String = names.chars().take(NAMES_SHOWN).collect();
    let rest = if shown.len() < names.len() { "..." } else { "" };
    let wanted: String = wanted.chars().take(NAMES_SHOWN).collect();
    format!("--set {wanted}: the scene has no such material; it has {shown}{rest}")
}

pub fn share(text: &str) -> Result<f32, String> {
    number(text).filter(|value| (0.0..=1.0).contains(value)).ok_or_else(|| "give a number in [0,1]".to_owned())
}

pub fn color(text: &str) -> Result<Vec3, String> {
    let in_range = |color: &Vec3| color.cmpge(Vec3::ZERO).all() && color.cmple(Vec3::ONE).all();
    triple(text).filter(in_range).ok_or_else(|| "give three numbers in [0,1], say 0.8,0.1,0.1".to_owned())
}

pub fn roughness_map(text: &str) -> Result<RoughnessMap, String> {
    match text {
        "identity" => Ok(RoughnessMap::Identity),
        "square" => Ok(RoughnessMap::Square),
        "sqrt" => Ok(RoughnessMap::Sqrt),
        _ => Err("give identity, square or sqrt".to_owned()),
    }
}

pub fn sheen_model(text: &str) -> Result<SheenModel, String> {
    let named = SheenModel::NAMES.into_iter().find(|(name, _)| *name == text);
    let names = SheenModel::NAMES.map(|(name, _)| name).join(", ");
    named.map(|(_, model)| model).ok_or_else(|| format!("give one of {names}"))
}

pub fn layering(text: &str) -> Result<Layering, String> {
    match text {
        "gltf" => Ok(Layering::Gltf),
        "openpbr" => Ok(Layering::OpenPbr),
        "reciprocal" => Ok(Layering::Reciprocal),
        "none" => Ok(Layering::None),
        "walk" => Ok(Layering::Walk),
        _ => {
            let manual = text.strip_prefix("manual=").and_then(|share_left| share(share_left).ok());
            let wrong = || "give gltf, openpbr, reciprocal, none, walk, or manual=S with S in [0,1]".to_owned();
            manual.map(Layering::Manual).ok_or_else(wrong)
        }
    }
}

/// Three finite numbers.
pub fn triple(text: &str) -> Option<Vec3> {
    let numbers = text.split(',').map(|text| number(text.trim())).collect::<Option<Vec<f32>>>()?;
    Some(Vec3::from(<[f32; 3]>::try_from(numbers).ok()?))
}

/// A finite number.
pub fn number(text: &str) -> Option<f32> {
    text.parse().ok().filter(|value: &f32| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn materials(names: &[&str]) -> Vec<Material> {
        names.iter().map(|&name| Material::matte(name, Vec3::ONE)).collect()
    }

    #[test]
    fn values_in_range_are_taken() {
        assert_eq!(share("0"), Ok(0.0));
        assert_eq!(color("1, 0.5,0"), Ok(Vec3::new(1.0, 0.5, 0.0)));
        assert_eq!(layering("manual=0.25"), Ok(Layering::Manual(0.25)));
        let names = ["gltf", "openpbr", "reciprocal", "none", "walk"];
        let layerings = [Layering::Gltf, Layering::OpenPbr, Layering::Reciprocal, Layering::None, Layering::Walk];
        assert_eq!(names.map(layering), layerings.map(Ok));
        let maps = [RoughnessMap::Identity, RoughnessMap::Square, RoughnessMap::Sqrt];
        assert_eq!(["identity", "square", "sqrt"].map(roughness_map), maps.map(Ok));
        assert_eq!(sheen_model("ltc"), Ok(SheenModel::Ltc));
        assert_eq!(sheen_model("conty-kulla"), Ok(SheenModel::ContyKulla));
    }

    #[test]
    fn values_out_of_range_are_refused() {
        for text in ["", "-0.1", "1.1", "nan", "inf", "word", "1e40"] {
            assert!(share(text).is_err(), "{text}");
            assert!(color(&format!("{text},0,0")).is_err(), "{text}");
            assert!(layering(&format!("manual={text}")).is_err(), "{text}");
            assert!(roughness_map(text).is_err() && sheen_model(text).is_err() && layering(text).is_err(), "{text}");
        }
        for text in ["1,1", "1,1,1,1", ",,"] {
            assert!(color(text).is_err(), "{text}");
        }
        assert!(layering("manual").is_err());
    }

    #[test]
    fn assignments_say_what_is_wrong_with_them() {
        for (text, what) in [
            ("felt", "MATERIAL.KEY=VALUE"),
            ("felt=0.3", "MATERIAL.KEY=VALUE"),
            ("felt.alpha", "MATERIAL.KEY=VALUE"),
            ("felt.colour=1,1,1", "colour: the keys are alpha, sheen-color, roughness-map, sheen-model and layering"),
            ("felt.alpha=2", "alpha: give a number in [0,1]"),
            ("felt.sheen-color=1", "sheen-color: give three numbers in [0,1]"),
            ("felt.layering=manual=2", "layering: give gltf, openpbr"),
            ("felt.roughness-map=cube", "roughness-map: give identity"),
            ("felt.sheen-model=felt", "sheen-model: give one of ltc, slab, walk"),
        ] {
            let error = assignment(text).unwrap_err();
            assert!(error.contains(what), "{text}: {error}");
        }
    }

    #[test]
    fn assignments_find_their_materials() {
        let materials = materials(&["felt", "felt.002", "", "felt", "1"]);
        let alpha = |alpha| Overrides { alpha: Some(alpha), ..Overrides::default() };
        for (text, indices) in [
            ("felt.alpha=0.5", &[0, 3][..]),
            ("felt.002.alpha=0.5", &[1]),
            (".alpha=0.5", &[2]),
            ("0.alpha=0.5", &[0]),
            ("3.alpha=0.5", &[3]),
            // Names take precedence over numbers.
            ("1.alpha=0.5", &[4]),
        ] {
            let resolved = resolve(&[assignment(text).unwrap()], &materials).unwrap();
            assert_eq!(resolved, indices.iter().map(|&index| (index, alpha(0.5))).collect(), "{text}");
        }
        let several = ["felt.alpha=0.5", "3.alpha=0.75", "0.layering=manual=0.5", "felt.roughness-map=sqrt"];
        let several = several.map(|text| assignment(text).unwrap());
        let resolved = resolve(&several, &materials).unwrap();
        let map = Some(RoughnessMap::Sqrt);
        let first = Overrides { layering: Some(Layering::Manual(0.5)), roughness_map: map, ..alpha(0.5) };
        assert_eq!(resolved, BTreeMap::from([(0, first), (3, Overrides { roughness_map: map, ..alpha(0.75) })]));
    }

    #[test]
    fn unknown_materials_are_told_with_those_that_are_there() {
        let silk = [assignment("silk.alpha=0.5").unwrap()];
        let error = resolve(&silk, &materials(&["felt", "wool"])).unwrap_err();
        assert_eq!(error, "--set silk: the scene has no such material; it has 0 (felt), 1 (wool)");
        assert!(resolve(&[assignment("2.alpha=0.5").unwrap()], &materials(&["felt", "wool"])).is_err());
        let error = resolve(&silk, &materials(&["grün"; 1000])).unwrap_err();
        assert!(error.ends_with("...") && error.len() < 400, "{error}");
    }
}
