//! `--set MATERIAL.KEY=VALUE`.

use velour::scene::{Edits, Keyed, Kind, MaterialEdits, Scene, UnknownThing, Value, select};

/// One `--set`; its material is still a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Assignment {
    material: String,
    edits: MaterialEdits,
}

/// Most characters of a name in a message.
const NAME_SHOWN: usize = 200;

/// `MATERIAL.KEY=VALUE`: the key starts after the last dot before the first equals sign, so that names may have dots.
pub fn assignment(text: &str) -> Result<Assignment, String> {
    let parts = text.split_once('=').and_then(|(place, value)| Some((place.rsplit_once('.')?, value)));
    let Some(((material, key), value)) = parts else {
        return Err("give MATERIAL.KEY=VALUE, say felt.alpha=0.3".to_owned());
    };
    let mut edits = MaterialEdits::default();
    edits.set(key, &Value::of_flag(value)).map_err(|what| format!("{key}: {what}"))?;
    Ok(Assignment { material: material.to_owned(), edits })
}

/// What assignments change in a scene; where two set the same key of a material, the later one wins.
pub fn resolve(assignments: &[Assignment], scene: &Scene) -> Result<Edits, String> {
    let mut edits = Edits::default();
    for assignment in assignments {
        let name: String = assignment.material.chars().take(NAME_SHOWN).collect();
        let unknown = |unknown: UnknownThing| format!("--set {name}: {unknown}");
        for index in select(scene, Kind::Material, &assignment.material).map_err(unknown)? {
            let own = edits.materials.entry(index).or_default();
            *own = assignment.edits.or(*own);
        }
    }
    Ok(edits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;
    use std::collections::BTreeMap;
    use velour::scene::{Layering, Material, RoughnessMap};

    #[test]
    fn assignments_say_what_is_wrong_with_them() {
        for (text, what) in [
            ("felt", "MATERIAL.KEY=VALUE"),
            ("felt=0.3", "MATERIAL.KEY=VALUE"),
            ("felt.alpha", "MATERIAL.KEY=VALUE"),
            (
                "felt.colour=1,1,1",
                "colour: the keys are sheen, alpha, sheen-color, sheen-weight, roughness-map, sheen-model, layering,",
            ),
            ("felt.alpha=2", "alpha: give a number in [0,1]"),
            ("felt.sheen-color=1", "sheen-color: give three numbers in [0,1]"),
            ("felt.layering=manual=2", "layering: give gltf, openpbr"),
            ("felt.roughness-map=cube", "roughness-map: give one of identity"),
            ("felt.sheen-model=felt", "sheen-model: give one of ltc, slab, walk"),
        ] {
            let error = assignment(text).unwrap_err();
            assert!(error.contains(what), "{text}: {error}");
        }
    }

    #[test]
    fn assignments_find_their_materials() {
        let materials = ["felt", "felt.002", "felt"].map(|name| Material::matte(name, Vec3::ONE));
        let scene = Scene { materials: materials.to_vec(), ..Scene::default() };
        let alpha = |alpha| MaterialEdits { alpha: Some(alpha), ..MaterialEdits::default() };
        let resolved = |texts: &[&str]| {
            let assignments: Vec<Assignment> = texts.iter().map(|text| assignment(text).unwrap()).collect();
            resolve(&assignments, &scene).map(|edits| edits.materials)
        };
        assert_eq!(resolved(&["felt.002.alpha=0.5"]), Ok(BTreeMap::from([(1, alpha(0.5))])));
        let several = ["felt.alpha=0.5", "2.alpha=0.75", "0.layering=manual=0.5", "felt.roughness-map=sqrt"];
        let map = Some(RoughnessMap::Sqrt);
        let first = MaterialEdits { layering: Some(Layering::Manual(0.5)), roughness_map: map, ..alpha(0.5) };
        let last = MaterialEdits { roughness_map: map, ..alpha(0.75) };
        assert_eq!(resolved(&several), Ok(BTreeMap::from([(0, first), (2, last)])));
        let error = resolved(&["silk.alpha=0.5"]).unwrap_err();
        assert_eq!(error, "--set silk: the scene has no such material; it has 0 (felt), 1 (felt.002), 2 (felt)");
    }
}
