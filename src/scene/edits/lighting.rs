//! Lights of a scene together with those that are added, by one index.

use super::{AddedLight, Edits, LightEdits, LightShape, PunctualEdits};
use crate::scene::{Light, Scene};

impl Edits {
    /// How many polygon lights there are: those of the scene, then those that are added.
    pub fn light_count(&self, scene: &Scene) -> usize {
        scene.lights.len() + self.added_lights.len()
    }

    /// How many lights without extent there are: those of the scene, then those that are added.
    pub fn punctual_count(&self, scene: &Scene) -> usize {
        scene.punctual_lights.len() + self.added_punctual.len()
    }

    /// How many corners all polygon lights have together.
    pub fn corner_count(&self, scene: &Scene) -> usize {
        let corners = |light: &Light| light.polygons.iter().flat_map(|polygon| &polygon.contours).map(Vec::len).sum();
        let loaded: usize = scene.lights.iter().map(corners).sum();
        let added = |added: &AddedLight| match added.shape {
            LightShape::Copy(of) => corners(&scene.lights[of]),
            shape => shape.corners().map_or(0, |corners| corners.len()),
        };
        loaded + self.added_lights.iter().map(added).sum::<usize>()
    }

    /// What is changed in the polygon light of this index.
    pub fn of_light(&self, scene: &Scene, index: usize) -> LightEdits {
        match index.checked_sub(scene.lights.len()) {
            Some(added) => self.added_lights[added].changes,
            None => self.lights.get(&index).copied().unwrap_or_default(),
        }
    }

    /// Changes the polygon light of this index: these are all its changes from now on.
    pub fn set_light(&mut self, scene: &Scene, index: usize, changes: LightEdits) {
        match index.checked_sub(scene.lights.len()) {
            Some(added) => self.added_lights[added].changes = changes,
            None if changes == LightEdits::default() => _ = self.lights.remove(&index),
            None => _ = self.lights.insert(index, changes),
        }
    }

    /// Takes the polygon light of this index away; those that are added after it count one less from then on.
    pub fn remove_light(&mut self, scene: &Scene, index: usize) {
        match index.checked_sub(scene.lights.len()) {
            Some(added) => _ = self.added_lights.remove(added),
            None => self.lights.entry(index).or_default().removed = Some(true),
        }
    }

    /// What is changed in the light without extent of this index.
    pub fn of_punctual(&self, scene: &Scene, index: usize) -> PunctualEdits {
        match index.checked_sub(scene.punctual_lights.len()) {
            Some(added) => self.added_punctual[added].changes,
            None => self.punctual.get(&index).copied().unwrap_or_default(),
        }
    }

    /// Changes the light without extent of this index: these are all its changes from now on.
    pub fn set_punctual(&mut self, scene: &Scene, index: usize, changes: PunctualEdits) {
        match index.checked_sub(scene.punctual_lights.len()) {
            Some(added) => self.added_punctual[added].changes = changes,
            None if changes == PunctualEdits::default() => _ = self.punctual.remove(&index),
            None => _ = self.punctual.insert(index, changes),
        }
    }

    /// Takes the light without extent of this index away; those that are added after it count one less from then on.
    pub fn remove_punctual(&mut self, scene: &Scene, index: usize) {
        match index.checked_sub(scene.punctual_lights.len()) {
            Some(added) => _ = self.added_punctual.remove(added),
            None => self.punctual.entry(index).or_default().removed = Some(true),
        }
    }

    /// Whether they make the same of all lights.
    pub fn has_lights_of(&self, other: &Self) -> bool {
        self.lights == other.lights
            && self.added_lights == other.added_lights
            && self.punctual == other.punctual
            && self.added_punctual == other.added_punctual
    }

    /// Whether some lights alone are lit.
    pub fn any_solo(&self) -> bool {
        let area = self.lights.values().chain(self.added_lights.iter().map(|light| &light.changes));
        let punctual = self.punctual.values().chain(self.added_punctual.iter().map(|light| &light.changes));
        // One that is away says nothing.
        let is_solo = |[solo, removed]: [Option<bool>; 2]| solo == Some(true) && removed != Some(true);
        let mut all = area.map(|own| [own.solo, own.removed]).chain(punctual.map(|own| [own.solo, own.removed]));
        all.any(is_solo)
    }
}
