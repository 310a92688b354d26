//! Lights that the user adds: new ones, copies, and the rig of a studio.

use glam::{Quat, Vec2, Vec3};

use super::lamps::{Changes, LightId};
use super::state::State;
use crate::scene::{
    Added, AddedLight, AddedPunctual, LightEdits, LightShape, MOST_CORNERS, MOST_PUNCTUAL, PunctualEdits, PunctualShape,
};

/// The radiance that a white surface has that a new light shines at, where that is in the middle of the scene.
const LEVEL: f32 = 0.5;

/// A light that can be added.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum New {
    Area(LightShape),
    Punctual(PunctualShape),
}

impl New {
    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Area(LightShape::Rectangle) => "rectangle",
            Self::Area(LightShape::Disk) => "disk",
            Self::Area(LightShape::Polygon(3)) => "triangle",
            Self::Area(LightShape::Polygon(5)) => "pentagon",
            Self::Area(LightShape::Polygon(_)) => "polygon",
            Self::Punctual(PunctualShape::Point) => "point",
            Self::Punctual(PunctualShape::Spot) => "spot",
            Self::Punctual(PunctualShape::Directional) => "sun",
            Self::Area(LightShape::Copy(_)) | Self::Punctual(PunctualShape::Copy(_)) => "copy",
        }
    }
}

impl State {
    /// Adds a light where it shows: beside the eye, above, towards what is seen; and chooses it.
    pub fn add_light(&mut self, new: New) {
        let (subject, axes) = (self.foreground(), self.camera().world_from_camera);
        let [right, up, back] = [axes.x_axis, axes.y_axis, axes.z_axis].map(|axis| axis.truncate().normalize_or_zero());
        let (center, radius) = (subject.center(), subject.radius().max(1e-6));
        let from = (0.6 * right + up + 0.8 * back).normalize_or(Vec3::Y);
        let position = center + 2.0 * radius * from;
        // Its upper edge stays level.
        let x = Vec3::Y.cross(from).normalize_or(Vec3::X);
        let rotation = Quat::from_mat3(&glam::Mat3::from_cols(-x, (-from).cross(-x), -from));
        let name = self.free_name(new.name());
        let distance = 2.0 * radius;
        match new {
            New::Area(shape) => {
                let size = Vec2::splat(0.8 * radius);
                // A matte white surface has the radiance of the light times its form factor.
                let form_factor = size.x * size.y / (std::f32::consts::PI * distance * distance);
                let changes = LightEdits {
                    radiance: Some(Vec3::ONE),
                    strength: Some(rounded(LEVEL / form_factor)),
                    position: Some(position),
                    rotation: Some(rotation.normalize()),
                    size: Some(size),
                    ..LightEdits::default()
                };
                self.push_light(Added { name, shape, changes });
            }
            New::Punctual(shape) => {
                // The same by the irradiance, which is pi times that.
                let irradiance = std::f32::consts::PI * LEVEL;
                let is_far = shape == PunctualShape::Directional;
                let intensity = if is_far { irradiance } else { irradiance * distance * distance };
                let changes = PunctualEdits {
                    intensity: Some(Vec3::ONE),
                    strength: Some(rounded(intensity)),
                    position: (!is_far).then_some(position),
                    direction: (shape != PunctualShape::Point).then_some(-from),
                    ..PunctualEdits::default()
                };
                self.push_punctual(Added { name, shape, changes });
            }
        }
    }

    /// Adds a copy of a light beside it, and chooses it.
    pub fn duplicate_light(&mut self, id: LightId) {
        let placing = self.placing(id);
        let name = self.free_name(self.light_name(id));
        let beside = 0.1 * self.foreground().radius() * (placing.rotation * Vec3::X);
        let copy = match (id, self.changes(id)) {
            (LightId::Area(index), Changes::Area(changes)) => {
                let shape = match index.checked_sub(self.scene.lights.len()) {
                    Some(added) => self.edits.added_lights[added].shape,
                    None => LightShape::Copy(index),
                };
                self.push_light(Added { name, shape, changes })
            }
            (LightId::Punctual(index), Changes::Punctual(changes)) => {
                let shape = match index.checked_sub(self.scene.punctual_lights.len()) {
                    Some(added) => self.edits.added_punctual[added].shape,
                    None => PunctualShape::Copy(index),
                };
                self.push_punctual(Added { name, shape, changes })
            }
            _ => unreachable!("changes are of their light's kind"),
        };
        if let Some(id) = copy.filter(|_| placing.can_move) {
            self.move_light(id, placing.position + beside);
        }
    }

    /// Whether the lights of a studio are on: those that the scene was loaded with, or that were added.
    pub fn has_rig(&self) -> bool {
        let loaded = self.scene.rig.clone().any(|index| !self.is_removed(LightId::Area(index)));
        loaded || self.added_rig().next().is_some()
    }

    /// Turns them on or off. They are lights like others: what has been changed in them is gone with them.
    pub fn set_rig(&mut self, is_on: bool) {
        for index in self.scene.rig.clone() {
            let removed = LightEdits { removed: Some(true), ..LightEdits::default() };
            self.edits.set_light(&self.scene, index, if is_on { LightEdits::default() } else { removed });
        }
        let added: Vec<usize> = self.added_rig().collect();
        for index in added.into_iter().rev() {
            self.edits.added_lights.remove(index);
        }
        self.chosen_light = None;
        if is_on && self.scene.rig.is_empty() {
            for light in self.scene.studio_rig() {
                let name = format!("{RIG}{}", light.name);
                self.push_light(Added { name, ..light });
            }
            self.chosen_light = None;
        }
    }

    /// Their places among the lights that are added.
    fn added_rig(&self) -> impl Iterator<Item = usize> {
        let added = self.edits.added_lights.iter().enumerate();
        added.filter(|(_, light)| light.name.starts_with(RIG)).map(|(index, _)| index)
    }

    /// Adds a light and chooses it, where there is room for it.
    fn push_light(&mut self, light: AddedLight) -> Option<LightId> {
        self.edits.added_lights.push(light);
        if self.edits.corner_count(&self.scene) > MOST_CORNERS {
            self.edits.added_lights.pop();
            self.say(format!("all lights have at most {MOST_CORNERS} corners together: delete one first"));
            return None;
        }
        self.chosen_light = Some(LightId::Area(self.edits.light_count(&self.scene) - 1));
        self.chosen_light
    }

    fn push_punctual(&mut self, light: AddedPunctual) -> Option<LightId> {
        if self.edits.added_punctual.len() >= MOST_PUNCTUAL {
            self.say(format!("at most {MOST_PUNCTUAL} lights without extent are added: delete one first"));
            return None;
        }
        self.edits.added_punctual.push(light);
        self.chosen_light = Some(LightId::Punctual(self.edits.punctual_count(&self.scene) - 1));
        self.chosen_light
    }

    /// A name like this one that no light has: with the first number that is free, if need be.
    fn free_name(&self, like: &str) -> String {
        let stem = like.trim_end_matches(|last: char| last.is_ascii_digit()).trim_end();
        let stem = if stem.is_empty() { "light" } else { stem };
        let taken: std::collections::HashSet<&str> = self.lights().map(|id| self.light_name(id)).collect();
        let numbered = (2..).map(|number| format!("{stem} {number}"));
        std::iter::once(stem.to_owned()).chain(numbered).find(|name| !taken.contains(name.as_str())).unwrap_or_default()
    }
}

/// What the names of the studio's lights begin with.
const RIG: &str = "studio ";

/// To two digits: what a user may go on from.
fn rounded(number: f32) -> f32 {
    let unit = 10f32.powf(number.log10().floor() - 1.0);
    let rounded = (number / unit).round() * unit;
    if rounded.is_finite() && rounded > 0.0 { rounded } else { number }
}
