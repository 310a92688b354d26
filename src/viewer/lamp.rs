//! Lights of all kinds by one name, and where they stand.

use glam::{Quat, Vec2, Vec3};

use crate::scene::{LightEdits, PunctualEdits};

/// A light of the scene, or one that is added.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LightId {
    /// Index into `Drawn::lights`.
    Area(usize),
    /// Index into `Drawn::punctual_lights`.
    Punctual(usize),
}

/// What is changed in a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Changes {
    Area(LightEdits),
    Punctual(PunctualEdits),
}

/// Where a light stands, and what can be done about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placing {
    /// Metres; of a light from infinitely far away: where its direction is shown.
    pub position: Vec3,
    /// Turns the light's own axes into the world's; it shines along z.
    pub rotation: Quat,
    /// Along its own x and y, metres; none without extent.
    pub size: Option<Vec2>,
    /// Whether both are changed each for itself.
    pub is_flat: bool,
    pub can_move: bool,
    pub can_turn: bool,
}

impl Placing {
    /// The direction in which it shines, unit.
    pub fn normal(&self) -> Vec3 {
        self.rotation * Vec3::Z
    }
}
