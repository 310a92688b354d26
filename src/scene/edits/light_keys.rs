//! The keys of what is changed in lights.

use std::f32::consts::FRAC_PI_2;

use glam::{Quat, Vec2, Vec3};

use super::keys::entry;
use super::{Keyed, LightEdits, PunctualEdits, Value};
use crate::scene::black_body;

impl Keyed for LightEdits {
    const KEYS: &'static [&'static str] = &[
        "radiance",
        "strength",
        "temperature",
        "power",
        "position",
        "rotation",
        "size",
        "two-sided",
        "on",
        "solo",
        "removed",
    ];

    fn set(&mut self, key: &str, value: &Value) -> Result<(), String> {
        match key {
            "radiance" => self.radiance = Some(value.radiance()?),
            "strength" => self.strength = Some(value.strength()?),
            "temperature" => self.temperature = Some(temperature(value)?),
            "power" => self.power = Some(value.strength()?),
            "position" => self.position = Some(value.point()?),
            "rotation" => self.rotation = Some(rotation(value)?),
            "size" => self.size = Some(size(value)?),
            "two-sided" => self.two_sided = Some(value.switch()?),
            "on" => self.on = Some(value.switch()?),
            "solo" => self.solo = Some(value.switch()?),
            "removed" => self.removed = Some(value.switch()?),
            _ => return Err(Self::unknown_key()),
        }
        Ok(())
    }

    fn entries(&self) -> Vec<(&'static str, Value)> {
        let rotation = self.rotation.map(|rotation| Value::Numbers(rotation.to_array().into()));
        let size = self.size.map(|size| Value::Numbers(size.to_array().into()));
        let entries = [
            entry("radiance", self.radiance),
            entry("strength", self.strength),
            entry("temperature", self.temperature),
            entry("power", self.power),
            entry("position", self.position),
            entry("rotation", rotation),
            entry("size", size),
            entry("two-sided", self.two_sided.map(Value::Switch)),
            entry("on", self.on.map(Value::Switch)),
            entry("solo", self.solo.map(Value::Switch)),
            entry("removed", self.removed.map(Value::Switch)),
        ];
        entries.into_iter().flatten().collect()
    }
}

impl Keyed for PunctualEdits {
    const KEYS: &'static [&'static str] = &[
        "intensity",
        "strength",
        "temperature",
        "power",
        "position",
        "direction",
        "range",
        "inner",
        "outer",
        "on",
        "solo",
        "removed",
    ];

    fn set(&mut self, key: &str, value: &Value) -> Result<(), String> {
        match key {
            "intensity" => self.intensity = Some(value.radiance()?),
            "strength" => self.strength = Some(value.strength()?),
            "temperature" => self.temperature = Some(temperature(value)?),
            "power" => self.power = Some(value.strength()?),
            "position" => self.position = Some(value.point()?),
            "direction" => self.direction = Some(direction(value)?),
            "range" => self.range = Some(value.far()?),
            "inner" => self.inner = Some(angle(value)?),
            "outer" => self.outer = Some(angle(value)?),
            "on" => self.on = Some(value.switch()?),
            "solo" => self.solo = Some(value.switch()?),
            "removed" => self.removed = Some(value.switch()?),
            _ => return Err(Self::unknown_key()),
        }
        Ok(())
    }

    fn entries(&self) -> Vec<(&'static str, Value)> {
        let entries = [
            entry("intensity", self.intensity),
            entry("strength", self.strength),
            entry("temperature", self.temperature),
            entry("power", self.power),
            entry("position", self.position),
            entry("direction", self.direction),
            entry("range", self.range),
            entry("inner", self.inner),
            entry("outer", self.outer),
            entry("on", self.on.map(Value::Switch)),
            entry("solo", self.solo.map(Value::Switch)),
            entry("removed", self.removed.map(Value::Switch)),
        ];
        entries.into_iter().flatten().collect()
    }
}

/// Kelvin that have a colour.
fn temperature(value: &Value) -> Result<f32, String> {
    let (least, most) = (black_body::RANGE.start(), black_body::RANGE.end());
    let kelvin = value.finite().ok().filter(|kelvin| black_body::RANGE.contains(kelvin));
    kelvin.ok_or_else(|| format!("give kelvin in [{least},{most}]"))
}

/// A unit quaternion x, y, z, w; what is nearly one is made one.
fn rotation(value: &Value) -> Result<Quat, String> {
    let quaternion = value.numbers::<4>().map(Quat::from_array);
    let near = quaternion.filter(|quaternion| (quaternion.length() - 1.0).abs() < 1e-3);
    let exact = near.map(|near| if near.is_normalized() { near } else { near.normalize() });
    exact.ok_or_else(|| "give a unit quaternion x,y,z,w, say [0, 0.7071068, 0, 0.7071068]".to_owned())
}

/// Two lengths.
fn size(value: &Value) -> Result<Vec2, String> {
    let lengths =
        value.numbers::<2>().filter(|numbers| numbers.map(Value::from).iter().all(|one| one.length().is_ok()));
    lengths.map(Vec2::from).ok_or_else(|| "give width and height in metres, above 0, say [1.5, 0.5]".to_owned())
}

/// Three numbers of which one is not 0.
fn direction(value: &Value) -> Result<Vec3, String> {
    let direction = value.numbers::<3>().map(Vec3::from).filter(|direction| direction.try_normalize().is_some());
    direction.ok_or_else(|| "give three numbers that are not all 0, say [0, -1, 0]".to_owned())
}

/// An angle between none and a quarter of a turn.
fn angle(value: &Value) -> Result<f32, String> {
    let angle = value.finite().ok().filter(|angle| (0.0..=FRAC_PI_2).contains(angle));
    angle.ok_or_else(|| format!("give an angle in radians in [0,{FRAC_PI_2}]"))
}
