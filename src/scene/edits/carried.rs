//! Edits of a scene in place of which another version of it has come: its file has changed.

use std::collections::{BTreeMap, HashMap};

use super::{Added, CameraEdit, Edits, Kind, LightShape, PunctualShape};
use crate::scene::Scene;
use crate::scene::error::one_line;

/// Which things of a scene are which in another version of it.
///
/// A thing is found again by its name where no other has it in either version, else under its index where the name there is the same.
pub struct Carrier<'a> {
    from: &'a Scene,
    materials: Vec<Option<usize>>,
    lights: Vec<Option<usize>>,
    punctual: Vec<Option<usize>>,
    cameras: Vec<Option<usize>>,
}

impl<'a> Carrier<'a> {
    /// Compares two versions.
    pub fn new(from: &'a Scene, to: &Scene) -> Self {
        let found = |kind: Kind| found(&kind.names(from), &kind.names(to));
        Self {
            from,
            materials: found(Kind::Material),
            lights: found(Kind::Light),
            punctual: found(Kind::Punctual),
            cameras: found(Kind::Camera),
        }
    }

    /// Edits of the one as edits of the other; and what of them has nothing to apply to there, as messages name it: `material felt`.
    pub fn carry(&self, edits: &Edits) -> (Edits, Vec<String>) {
        let mut lost = Vec::new();
        let materials = self.moved(&edits.materials, Kind::Material, &self.materials, &mut lost);
        let lights = self.moved(&edits.lights, Kind::Light, &self.lights, &mut lost);
        let punctual = self.moved(&edits.punctual, Kind::Punctual, &self.punctual, &mut lost);
        let added_lights = added(&edits.added_lights, &mut lost, |shape| match shape {
            LightShape::Copy(index) => at(&self.lights, index).map(LightShape::Copy),
            other => Some(other),
        });
        let added_punctual = added(&edits.added_punctual, &mut lost, |shape| match shape {
            PunctualShape::Copy(index) => at(&self.punctual, index).map(PunctualShape::Copy),
            other => Some(other),
        });
        let camera = match edits.camera {
            Some(CameraEdit::Loaded(index)) => {
                let found = at(&self.cameras, index);
                if found.is_none() {
                    lost.push(self.called(Kind::Camera, index));
                }
                found.map(CameraEdit::Loaded)
            }
            view => view,
        };
        let carried = Edits { materials, lights, punctual, added_lights, added_punctual, camera, ..edits.clone() };
        (carried, lost)
    }

    /// The index of a material in the other version; none where it is there no more.
    pub fn material(&self, index: usize) -> Option<usize> {
        at(&self.materials, index)
    }

    fn moved<T: Clone>(
        &self,
        edits: &BTreeMap<usize, T>,
        kind: Kind,
        found: &[Option<usize>],
        lost: &mut Vec<String>,
    ) -> BTreeMap<usize, T> {
        let mut moved = BTreeMap::new();
        for (&index, own) in edits {
            match at(found, index) {
                Some(there) => _ = moved.insert(there, own.clone()),
                None => lost.push(self.called(kind, index)),
            }
        }
        moved
    }

    /// What messages call a thing of the first version.
    fn called(&self, kind: Kind, index: usize) -> String {
        match kind.names(self.from).get(index) {
            Some(name) if !name.is_empty() => one_line(&format!("{} {name}", kind.noun())),
            _ => format!("{} {index}", kind.noun()),
        }
    }
}

/// The index that has been found for one.
fn at(found: &[Option<usize>], index: usize) -> Option<usize> {
    found.get(index).copied().flatten()
}

/// Added lights; those that are copies of something need it still.
fn added<Shape: Copy, Changes: Clone>(
    lights: &[Added<Shape, Changes>],
    lost: &mut Vec<String>,
    moved: impl Fn(Shape) -> Option<Shape>,
) -> Vec<Added<Shape, Changes>> {
    let mut carried = Vec::new();
    for light in lights {
        match moved(light.shape) {
            Some(shape) => carried.push(Added { shape, ..light.clone() }),
            None => lost.push(one_line(&format!("added light {}", light.name))),
        }
    }
    carried
}

/// For each name of one list its index in another.
fn found(from: &[&str], to: &[&str]) -> Vec<Option<usize>> {
    let [unique_from, unique_to] = [unique(from), unique(to)];
    let find = |(index, name): (usize, &&str)| {
        let alone = unique_from.contains_key(name).then(|| unique_to.get(name).copied()).flatten();
        alone.or_else(|| (to.get(index) == Some(name)).then_some(index))
    };
    from.iter().enumerate().map(find).collect()
}

/// The indices of the names that occur once and are not empty.
fn unique<'a>(names: &[&'a str]) -> HashMap<&'a str, usize> {
    let mut found: HashMap<&str, Option<usize>> = HashMap::new();
    for (index, &name) in names.iter().enumerate().filter(|(_, name)| !name.is_empty()) {
        found.entry(name).and_modify(|found| *found = None).or_insert(Some(index));
    }
    found.into_iter().filter_map(|(name, index)| index.map(|index| (name, index))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Camera, Light, LightEdits, Material, MaterialEdits, Projection};
    use glam::{Mat4, Vec3};

    fn scene(materials: &[&str], lights: &[&str], cameras: &[&str]) -> Scene {
        let projection = Projection::Perspective { yfov: 0.7, near: 0.1, far: f32::INFINITY };
        let camera = |name: &&str| Camera { name: (*name).to_owned(), world_from_camera: Mat4::IDENTITY, projection };
        Scene {
            materials: materials.iter().map(|&name| Material::matte(name, Vec3::ONE)).collect(),
            lights: lights.iter().map(|&name| Light { name: name.into(), ..Light::default() }).collect(),
            cameras: cameras.iter().map(camera).collect(),
            ..Scene::default()
        }
    }

    /// Each material and light of the edits has a number of its own.
    fn edits(materials: &[usize], lights: &[usize], camera: Option<usize>) -> Edits {
        let material =
            |&index: &usize| (index, MaterialEdits { alpha: Some(0.01 * index as f32), ..MaterialEdits::default() });
        let light = |&index: &usize| (index, LightEdits { strength: Some(index as f32), ..LightEdits::default() });
        Edits {
            exposure: Some(1.0.into()),
            materials: materials.iter().map(material).collect(),
            lights: lights.iter().map(light).collect(),
            camera: camera.map(CameraEdit::Loaded),
            ..Edits::default()
        }
    }

    /// Where the edits of the materials end up, by the numbers that they had.
    fn places(edits: &Edits) -> Vec<(usize, f32)> {
        edits
            .materials
            .iter()
            .map(|(&index, own)| ((100.0 * own.alpha.unwrap()).round() as usize, index as f32))
            .collect()
    }

    #[test]
    fn things_are_found_again_by_name_and_else_in_their_place() {
        for (from, to, edited, expected) in [
            // Another order.
            (&["felt", "moss"][..], &["moss", "felt"][..], &[0, 1][..], vec![(1, 0.0), (0, 1.0)]),
            // One that has come before them.
            (&["felt", "moss"], &["new", "felt", "moss"], &[1], vec![(1, 2.0)]),
            // Twins go by their places, as far as the names there are the same.
            (&["felt", "felt"], &["felt", "felt"], &[0, 1], vec![(0, 0.0), (1, 1.0)]),
            (&["felt", "felt"], &["felt", "moss"], &[0, 1], vec![(0, 0.0)]),
            (&["felt"], &["moss", "felt", "felt"], &[0], vec![]),
            (&["felt", "moss"], &["felt", "felt"], &[0, 1], vec![(0, 0.0)]),
            // So do those without a name.
            (&["", "moss"], &["", "silk"], &[0, 1], vec![(0, 0.0)]),
            (&["", "moss"], &["moss"], &[0, 1], vec![(1, 0.0)]),
            // What another has been made of is no more.
            (&["felt"], &["silk"], &[0], vec![]),
            (&["felt"], &["felt"], &[7], vec![]),
        ] {
            let (from, to) = (scene(from, &[], &[]), scene(to, &[], &[]));
            let (carried, lost) = Carrier::new(&from, &to).carry(&edits(edited, &[], None));
            assert_eq!(places(&carried), expected, "{edited:?}");
            assert_eq!(lost.len(), edited.len() - expected.len());
            assert_eq!(carried.exposure, Some(1.0.into()));
        }
    }

    #[test]
    fn what_has_nothing_to_apply_to_is_named() {
        let from = scene(&["felt", "", "moss"], &["key", "rim"], &["front", "side"]);
        let to = scene(&["moss"], &["rim"], &["front"]);
        let carrier = Carrier::new(&from, &to);
        let (carried, lost) = carrier.carry(&edits(&[0, 1, 2], &[0, 1], Some(1)));
        assert_eq!(lost, ["material felt", "material 1", "light key", "camera side"]);
        assert_eq!(carried.lights, [(0, LightEdits { strength: Some(1.0), ..LightEdits::default() })].into());
        assert_eq!((places(&carried), carried.camera), (vec![(2, 0.0)], None));
        assert_eq!([0, 2].map(|index| carrier.material(index)), [None, Some(0)]);
    }

    #[test]
    fn added_lights_stay_unless_they_are_copies_of_what_is_gone() {
        let from = scene(&[], &["key", "rim"], &[]);
        let to = scene(&[], &["new", "rim"], &[]);
        let light = |name: &str, shape| Added { name: name.into(), shape, changes: LightEdits::default() };
        let added_lights =
            vec![light("a", LightShape::Disk), light("b", LightShape::Copy(0)), light("c", LightShape::Copy(1))];
        let (carried, lost) = Carrier::new(&from, &to).carry(&Edits { added_lights, ..Edits::default() });
        assert_eq!(carried.added_lights, [light("a", LightShape::Disk), light("c", LightShape::Copy(1))]);
        assert_eq!(lost, ["added light b"]);
    }

    #[test]
    fn an_unchanged_scene_keeps_all_edits() {
        let from = scene(&["felt", "felt", ""], &["key"], &["front", "side"]);
        let before = edits(&[0, 1, 2], &[0], Some(1));
        assert_eq!(Carrier::new(&from, &from.clone()).carry(&before), (before, vec![]));
    }
}
