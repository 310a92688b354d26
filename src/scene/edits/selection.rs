//! Which things of a scene a name or an index stands for.

use crate::scene::Scene;

/// Kinds of things that are told apart by name or by index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// `Scene::materials`
    Material,
    /// `Scene::lights`
    Light,
    /// `Scene::punctual_lights`
    Punctual,
    /// `Scene::cameras`
    Camera,
}

/// A name or an index that stands for nothing in the scene.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the scene has no such {kind}; it has {has}")]
pub struct UnknownThing {
    kind: &'static str,
    has: String,
}

/// Most characters of names in a message.
const NAMES_SHOWN: usize = 200;

impl Kind {
    pub(super) fn noun(self) -> &'static str {
        match self {
            Self::Material => "material",
            Self::Light => "light",
            Self::Punctual => "punctual-light",
            Self::Camera => "camera",
        }
    }

    /// The names of all things of the kind, by index; they may repeat, or be empty.
    pub(super) fn names(self, scene: &Scene) -> Vec<&str> {
        match self {
            Self::Material => scene.materials.iter().map(|material| material.name.as_str()).collect(),
            Self::Light => scene.lights.iter().map(|light| light.name.as_str()).collect(),
            Self::Punctual => scene.punctual_lights.iter().map(|light| light.name.as_str()).collect(),
            Self::Camera => scene.cameras.iter().map(|camera| camera.name.as_str()).collect(),
        }
    }

    /// What to say where nothing fits.
    fn unknown(self, names: &[&str]) -> UnknownThing {
        let all: Vec<String> = names.iter().enumerate().map(|(index, name)| format!("{index} ({name})")).collect();
        let all = if all.is_empty() { "none".to_owned() } else { all.join(", ") };
        let shown: String = all.chars().take(NAMES_SHOWN).collect();
        let rest = if shown.len() < all.len() { "..." } else { "" };
        UnknownThing { kind: self.noun(), has: format!("{shown}{rest}") }
    }
}

/// The indices of the things that `wanted` stands for, at least one: a name stands for all that bear it; where none
/// does, a number is an index from 0.
pub fn select(scene: &Scene, kind: Kind, wanted: &str) -> Result<Vec<usize>, UnknownThing> {
    named(scene, kind, wanted).or_else(|unknown| match wanted.parse() {
        Ok(index) => indexed(scene, kind, index).map(|index| vec![index]),
        Err(_) => Err(unknown),
    })
}

/// The indices of the things of this name, at least one.
pub(super) fn named(scene: &Scene, kind: Kind, name: &str) -> Result<Vec<usize>, UnknownThing> {
    let names = kind.names(scene);
    let found: Vec<usize> = (0..names.len()).filter(|&index| names[index] == name).collect();
    if found.is_empty() { Err(kind.unknown(&names)) } else { Ok(found) }
}

/// The index, where there is such a thing.
pub(super) fn indexed(scene: &Scene, kind: Kind, index: usize) -> Result<usize, UnknownThing> {
    let names = kind.names(scene);
    if index < names.len() { Ok(index) } else { Err(kind.unknown(&names)) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Material;
    use glam::Vec3;

    fn scene(names: &[&str]) -> Scene {
        let materials = names.iter().map(|&name| Material::matte(name, Vec3::ONE));
        Scene { materials: materials.collect(), ..Scene::default() }
    }

    #[test]
    fn names_stand_for_all_that_bear_them_and_go_before_indices() {
        let scene = scene(&["felt", "felt.002", "", "felt", "1"]);
        for (wanted, indices) in
            [("felt", &[0, 3][..]), ("felt.002", &[1]), ("", &[2]), ("0", &[0]), ("3", &[3]), ("1", &[4])]
        {
            assert_eq!(select(&scene, Kind::Material, wanted).unwrap(), indices, "{wanted}");
        }
    }

    #[test]
    fn what_is_unknown_is_told_with_what_is_there() {
        let unknown = |names: &[&str], wanted: &str| {
            select(&scene(names), Kind::Material, wanted).map(|_| ()).unwrap_err().to_string()
        };
        let expected = "the scene has no such material; it has 0 (felt), 1 (wool)";
        assert_eq!(unknown(&["felt", "wool"], "silk"), expected);
        assert_eq!(unknown(&["felt", "wool"], "2"), expected);
        assert_eq!(unknown(&[], "silk"), "the scene has no such material; it has none");
        let long = unknown(&["grün"; 1000], "silk");
        assert!(long.ends_with("...") && long.len() < 400, "{long}");
    }
}
