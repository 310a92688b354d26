//! What a user changes in a scene, by flags, in a file or in the viewer's panel: one value for all of them.
//!
//! The scene as loaded is never changed: what is drawn is a function of both ([`Drawn`](super::Drawn)). Edits are small
//! (they hold what differs, and no more), so that a history of them costs next to nothing.

mod carried;
mod keys;
mod light;
mod light_keys;
mod lighting;
mod reading;
mod selection;
mod text;
mod text_added;
mod value;
mod writing;

use std::collections::BTreeMap;

use glam::Vec3;

use super::{Camera, Layering, Lobes, Orbit, RoughnessMap, Scene, Settings, SheenModel};
use crate::picture::{Exposure, ToneCurve};

pub use carried::Carrier;
pub use keys::Keyed;
pub use light::{
    Added, AddedLight, AddedPunctual, LightEdits, LightShape, MOST_CORNERS, MOST_PUNCTUAL, PunctualEdits, PunctualShape,
};
pub use reading::EditsError;
pub use selection::{Kind, UnknownThing, select};
pub use value::Value;

/// Everything that a user may change in a scene; what is `None`, or not there, stays as it was loaded.
///
/// Indices are those of the scene that the edits were made for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Edits {
    /// Which lobes are summed.
    pub lobes: Option<Lobes>,
    /// Whether emitters that light the scene are drawn.
    pub lights_visible: Option<bool>,
    /// Whether surfaces stand in the way of light.
    pub shadows: Option<bool>,
    /// Radiance that arrives from everywhere, linear Rec. 709, >= 0.
    pub ambient: Option<Vec3>,
    /// A factor of that radiance, >= 0; at 0 its hue is kept.
    pub ambient_strength: Option<f32>,
    /// Exposure of a picture that is shown: stops, or what metering takes.
    pub exposure: Option<Exposure>,
    /// Tone curve of a picture that is shown.
    pub tone: Option<ToneCurve>,
    /// From where the scene is seen.
    pub camera: Option<CameraEdit>,
    /// What is changed in all materials; what gives a sheen only in those that have one, unless none has.
    pub every_material: MaterialEdits,
    /// What is changed in single materials, by their index into `Scene::materials`; it takes precedence over
    /// `every_material`.
    pub materials: BTreeMap<usize, MaterialEdits>,
    /// What is changed in single lights, by their index into `Scene::lights`.
    pub lights: BTreeMap<usize, LightEdits>,
    /// Polygon lights that the scene does not have. Where lights are counted they follow those of the scene.
    pub added_lights: Vec<AddedLight>,
    /// What is changed in single lights without extent, by their index into `Scene::punctual_lights`.
    pub punctual: BTreeMap<usize, PunctualEdits>,
    /// Lights without extent that the scene does not have. Where they are counted they follow those of the scene.
    pub added_punctual: Vec<AddedPunctual>,
}

/// From where the scene is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CameraEdit {
    /// The scene's camera of this index.
    Loaded(usize),
    /// A view that circles a target.
    Orbit(Orbit),
}

/// What is changed in a material.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MaterialEdits {
    /// Whether there is a sheen: off takes away the one that is there, whatever else is set of it, and on gives one where
    /// there is none, white and of alpha 0.5 but for what else is set.
    pub sheen: Option<bool>,
    /// The sheen's alpha itself, in [0, 1], whatever the roughness map and the textures.
    pub alpha: Option<f32>,
    /// The sheen's colour, linear Rec. 709, each in [0, 1], whatever the textures; the layer then covers all of the
    /// surface, unless `sheen_weight` says how much.
    pub sheen_color: Option<Vec3>,
    /// How much of the surface the sheen covers, in [0, 1], whatever the texture of that. It scales the sheen's colour,
    /// and is the F of OpenPBR's layering.
    pub sheen_weight: Option<f32>,
    /// How alpha follows from the sheen's roughness.
    pub roughness_map: Option<RoughnessMap>,
    /// What the sheen's lobe is.
    pub sheen_model: Option<SheenModel>,
    /// What the sheen leaves of the base.
    pub layering: Option<Layering>,
    /// Linear Rec. 709, each in [0, 1]; multiplied by the material's texture.
    pub base_color: Option<Vec3>,
    /// In [0, 1]; multiplied by the material's texture.
    pub metallic: Option<f32>,
    /// The base's roughness in [0, 1]; multiplied by the material's texture.
    pub roughness: Option<f32>,
}

impl Edits {
    /// Edits and then `later` ones, which win. What is changed later in all materials is changed in those, too, that
    /// had been changed by themselves.
    pub fn then(mut self, later: &Self) -> Self {
        let every = later.every_material;
        for own in self.materials.values_mut() {
            *own = every.where_set(own).or(*own);
        }
        self.every_material = every.or(self.every_material);
        for (&index, &edits) in &later.materials {
            let own = self.materials.entry(index).or_default();
            *own = edits.or(*own);
        }
        for (&index, &edits) in &later.lights {
            let own = self.lights.entry(index).or_default();
            *own = edits.or(*own);
        }
        for (&index, &edits) in &later.punctual {
            let own = self.punctual.entry(index).or_default();
            *own = edits.or(*own);
        }
        self.added_lights.extend_from_slice(&later.added_lights);
        self.added_punctual.extend_from_slice(&later.added_punctual);
        Self {
            lobes: later.lobes.or(self.lobes),
            lights_visible: later.lights_visible.or(self.lights_visible),
            shadows: later.shadows.or(self.shadows),
            ambient: later.ambient.or(self.ambient),
            ambient_strength: later.ambient_strength.or(self.ambient_strength),
            exposure: later.exposure.or(self.exposure),
            tone: later.tone.or(self.tone),
            camera: later.camera.or(self.camera),
            ..self
        }
    }

    /// What they make of the settings.
    pub fn settings(&self) -> Settings {
        let default = Settings::default();
        Settings {
            lobes: self.lobes.unwrap_or(default.lobes),
            lights_visible: self.lights_visible.unwrap_or(default.lights_visible),
            shadows: self.shadows.unwrap_or(default.shadows),
            ambient: scaled(self.ambient.unwrap_or(default.ambient), self.ambient_strength),
            exposure: match self.exposure {
                Some(Exposure::Stops(stops)) => stops,
                Some(Exposure::Auto) | None => default.exposure,
            },
            tone: self.tone.unwrap_or(default.tone),
        }
    }

    /// The camera through which `scene` is seen. Panics where it has none.
    pub fn camera(&self, scene: &Scene) -> Camera {
        match self.camera {
            None => scene.cameras[0].clone(),
            Some(CameraEdit::Loaded(index)) => scene.cameras[index].clone(),
            Some(CameraEdit::Orbit(orbit)) => orbit.camera(),
        }
    }

    /// What is changed in the material of this index: what is changed in it alone, else what is changed in all.
    pub fn of_material(&self, index: usize) -> MaterialEdits {
        self.materials.get(&index).copied().unwrap_or_default().or(self.every_material)
    }
}

impl MaterialEdits {
    /// These, and `others` where these are `None`.
    pub fn or(self, others: Self) -> Self {
        Self {
            sheen: self.sheen.or(others.sheen),
            alpha: self.alpha.or(others.alpha),
            sheen_color: self.sheen_color.or(others.sheen_color),
            sheen_weight: self.sheen_weight.or(others.sheen_weight),
            roughness_map: self.roughness_map.or(others.roughness_map),
            sheen_model: self.sheen_model.or(others.sheen_model),
            layering: self.layering.or(others.layering),
            base_color: self.base_color.or(others.base_color),
            metallic: self.metallic.or(others.metallic),
            roughness: self.roughness.or(others.roughness),
        }
    }

    /// Those of these that `others` have, too.
    fn where_set(self, others: &Self) -> Self {
        Self {
            sheen: self.sheen.filter(|_| others.sheen.is_some()),
            alpha: self.alpha.filter(|_| others.alpha.is_some()),
            sheen_color: self.sheen_color.filter(|_| others.sheen_color.is_some()),
            sheen_weight: self.sheen_weight.filter(|_| others.sheen_weight.is_some()),
            roughness_map: self.roughness_map.filter(|_| others.roughness_map.is_some()),
            sheen_model: self.sheen_model.filter(|_| others.sheen_model.is_some()),
            layering: self.layering.filter(|_| others.layering.is_some()),
            base_color: self.base_color.filter(|_| others.base_color.is_some()),
            metallic: self.metallic.filter(|_| others.metallic.is_some()),
            roughness: self.roughness.filter(|_| others.roughness.is_some()),
        }
    }

    /// Whether they give a material a sheen that has none.
    pub fn gives_sheen(&self) -> bool {
        let is_set = self.alpha.is_some() || self.sheen_color.is_some() || self.sheen_weight.is_some();
        self.sheen.unwrap_or(is_set)
    }
}

/// A radiance times its strength, kept finite.
fn scaled(radiance: Vec3, strength: Option<f32>) -> Vec3 {
    (strength.unwrap_or(1.0) * radiance).min(Vec3::MAX)
}
