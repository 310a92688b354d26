//! What is remembered of the hands from pass to pass.

use std::collections::HashSet;

use egui::{Key, Pos2};
use glam::Vec3;

use super::grab::Grab;
use super::lamps::LightId;
use crate::scene::Orbit;

/// What the pointer and the keys are about in the picture.
#[derive(Clone, Debug, Default)]
pub struct Hands {
    /// The instance that was clicked last.
    pub clicked: Option<usize>,
    /// The light that is being moved, turned or scaled.
    pub grab: Option<Grab>,
    /// Whether a reflection is being put somewhere.
    pub aims: bool,
    /// The light whose section in the panel is to be opened.
    pub revealed: Option<LightId>,
    /// When the outline of what was clicked ends, in egui's time.
    pub outlined_until: f64,
    /// Where the pointer was when something was zoomed to, what that is, and the view that has come of it.
    pub zoomed: Option<(Pos2, Vec3, Orbit)>,
    /// How far away what a pan drags along is, metres.
    pub held: Option<f32>,
    /// The keys that are held, by their place on a US keyboard.
    pub keys: HashSet<Key>,
    /// Since when the last part of a flight has not been flown, in egui's time; none where there is no flight.
    pub flying: Option<f64>,
    /// Whether the window was too narrow for panel and picture.
    pub is_narrow: bool,
}
