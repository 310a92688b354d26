//! The keys by which flags and files name what is changed. Reading and writing go through the same lists.

use super::{Edits, MaterialEdits, Value};
use crate::scene::{Orbit, Projection};

/// A group of things that are changed by key.
pub trait Keyed {
    /// All keys, as messages list them.
    const KEYS: &'static [&'static str];

    /// Sets what `key` names; the error says what to give instead.
    fn set(&mut self, key: &str, value: &Value) -> Result<(), String>;

    /// The keys that are set, with their values: setting them again gives the same.
    fn entries(&self) -> Vec<(&'static str, Value)>;

    /// What to say of a key that is not known.
    fn unknown_key() -> String {
        let (last, others) = Self::KEYS.split_last().unwrap_or((&"", &[]));
        format!("the keys are {} and {last}", others.join(", "))
    }
}

/// A key with its value where that is set.
pub(super) fn entry<T: Into<Value>>(key: &'static str, value: Option<T>) -> Option<(&'static str, Value)> {
    value.map(|value| (key, value.into()))
}

impl Keyed for MaterialEdits {
    const KEYS: &'static [&'static str] = &[
        "sheen",
        "alpha",
        "sheen-color",
        "sheen-weight",
        "roughness-map",
        "sheen-model",
        "layering",
        "base-color",
        "metallic",
        "roughness",
    ];

    fn set(&mut self, key: &str, value: &Value) -> Result<(), String> {
        match key {
            "sheen" => self.sheen = Some(value.on_or_off()?),
            "alpha" => self.alpha = Some(value.share()?),
            "sheen-color" => self.sheen_color = Some(value.color()?),
            "sheen-weight" => self.sheen_weight = Some(value.share()?),
            "roughness-map" => self.roughness_map = Some(value.roughness_map()?),
            "sheen-model" => self.sheen_model = Some(value.sheen_model()?),
            "layering" => self.layering = Some(value.layering()?),
            "base-color" => self.base_color = Some(value.color()?),
            "metallic" => self.metallic = Some(value.share()?),
            "roughness" => self.roughness = Some(value.share()?),
            _ => return Err(Self::unknown_key()),
        }
        Ok(())
    }

    fn entries(&self) -> Vec<(&'static str, Value)> {
        let entries = [
            entry("sheen", self.sheen.map(Value::Switch)),
            entry("alpha", self.alpha),
            entry("sheen-color", self.sheen_color),
            entry("sheen-weight", self.sheen_weight),
            entry("roughness-map", self.roughness_map.map(|map| map.name())),
            entry("sheen-model", self.sheen_model.map(|model| model.name())),
            entry("layering", self.layering.map(|rule| Value::Text(rule.name()))),
            entry("base-color", self.base_color),
            entry("metallic", self.metallic),
            entry("roughness", self.roughness),
        ];
        entries.into_iter().flatten().collect()
    }
}

/// What is no thing's but the picture's. A camera's name is of the scene and read elsewhere.
impl Keyed for Edits {
    const KEYS: &'static [&'static str] =
        &["lobes", "lights-visible", "shadows", "ambient", "ambient-strength", "exposure", "tonemap"];

    fn set(&mut self, key: &str, value: &Value) -> Result<(), String> {
        match key {
            "lobes" => self.lobes = Some(value.lobes()?),
            "lights-visible" => self.lights_visible = Some(value.switch()?),
            "shadows" => self.shadows = Some(value.switch()?),
            "ambient" => self.ambient = Some(value.radiance()?),
            "ambient-strength" => self.ambient_strength = Some(value.strength()?),
            "exposure" => self.exposure = Some(value.exposure()?),
            "tonemap" => self.tone = Some(value.tone()?),
            _ => return Err(Self::unknown_key()),
        }
        Ok(())
    }

    fn entries(&self) -> Vec<(&'static str, Value)> {
        let entries = [
            entry("lobes", self.lobes),
            entry("lights-visible", self.lights_visible.map(Value::Switch)),
            entry("shadows", self.shadows.map(Value::Switch)),
            entry("ambient", self.ambient),
            entry("ambient-strength", self.ambient_strength),
            entry("exposure", self.exposure),
            entry("tonemap", self.tone.map(|tone| tone.name())),
        ];
        entries.into_iter().flatten().collect()
    }
}

impl Keyed for Orbit {
    const KEYS: &'static [&'static str] =
        &["target", "azimuth", "elevation", "distance", "yfov", "ymag", "near", "far"];

    /// Either `yfov` or `ymag` says what the projection is; before it, near and far have nowhere to go.
    fn set(&mut self, key: &str, value: &Value) -> Result<(), String> {
        let (Projection::Perspective { near, far, .. } | Projection::Orthographic { near, far, .. }) = self.projection;
        match key {
            "target" => self.target = value.point()?,
            "azimuth" => self.azimuth = value.finite()?,
            "elevation" => self.elevation = elevation(value)?,
            "distance" => self.distance = value.length()?,
            "yfov" => self.projection = Projection::Perspective { yfov: field_of_view(value)?, near, far },
            "ymag" => self.projection = Projection::Orthographic { ymag: value.length()?, near, far },
            "near" => self.set_planes(value.strength()?, far),
            "far" => self.set_planes(near, value.far()?),
            _ => return Err(Self::unknown_key()),
        }
        Ok(())
    }

    fn entries(&self) -> Vec<(&'static str, Value)> {
        let (size, near, far) = match self.projection {
            Projection::Perspective { yfov, near, far } => (("yfov", yfov.into()), near, far),
            Projection::Orthographic { ymag, near, far } => (("ymag", ymag.into()), near, far),
        };
        vec![
            ("target", self.target.into()),
            ("azimuth", self.azimuth.into()),
            ("elevation", self.elevation.into()),
            ("distance", self.distance.into()),
            size,
            ("near", near.into()),
            ("far", far.into()),
        ]
    }
}

/// An elevation short of straight up and down.
fn elevation(value: &Value) -> Result<f32, String> {
    let angle = value.finite().ok().filter(|angle| angle.abs() <= Orbit::STEEPEST);
    angle.ok_or_else(|| format!("give an angle in radians in [-{0},{0}]", Orbit::STEEPEST))
}

/// A vertical field of view: an angle between none and half a turn.
fn field_of_view(value: &Value) -> Result<f32, String> {
    let angle = value.finite().ok().filter(|angle| *angle > 0.0 && *angle < std::f32::consts::PI);
    angle.ok_or_else(|| "give an angle in radians above 0 and below 3.14159".to_owned())
}
