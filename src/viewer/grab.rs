//! A light in the hand: moved, turned or scaled with the pointer, along an axis, or by a number that is typed.

use egui::Pos2;
use glam::{Quat, Vec2, Vec3};

use super::lamps::{Changes, LightId, Placing};
use super::lens::Lens;
use super::state::State;

/// What is done with a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tool {
    Move,
    Turn,
    Scale,
    /// Turns it so that it shines to where the pointer is.
    Point,
    /// Draws a corner of the box around it to where the pointer is.
    Corner,
}

/// A light that is being moved, turned or scaled.
#[derive(Clone, Debug, PartialEq)]
pub struct Grab {
    pub light: LightId,
    pub tool: Tool,
    /// Of the world; of the light itself where it is scaled.
    pub axis: Option<usize>,
    /// Where the pointer was at the start.
    pub from: Pos2,
    /// What is typed.
    pub typed: String,
    /// Whether it ends when the button is released; else by a click.
    pub is_drag: bool,
    /// Whether it has been put down, by a button that is still held.
    pub is_over: bool,
    /// How the light stood, and what was changed in it.
    before: (Placing, Changes),
}

/// What a light is turned by where its middle is out of sight: a height of the view is half a turn.
const TURN: f32 = std::f32::consts::PI;

impl Grab {
    /// Takes a light in the hand; none where it cannot be done with it.
    pub fn new(state: &State, light: LightId, tool: Tool, from: Pos2, is_drag: bool) -> Option<Self> {
        let placing = state.placing(light);
        let can = match tool {
            Tool::Move => placing.can_move,
            Tool::Turn | Tool::Point => placing.can_turn,
            Tool::Scale | Tool::Corner => placing.size.is_some(),
        };
        let before = (placing, state.changes(light));
        can.then(|| Self { light, tool, axis: None, from, typed: String::new(), is_drag, is_over: false, before })
    }

    /// The same along an axis.
    pub fn along(self, axis: Option<usize>) -> Self {
        Self { axis, ..self }
    }

    /// Puts the light back.
    pub fn cancel(&self, state: &mut State) {
        state.set_changes(self.light, self.before.1);
    }

    /// Along the axis only, or freely again.
    pub fn toggle_axis(&mut self, axis: usize) {
        self.axis = if self.axis == Some(axis) { None } else { Some(axis) };
    }

    /// What is typed as a number.
    fn number(&self) -> Option<f32> {
        self.typed.parse().ok().filter(|number: &f32| number.is_finite())
    }

    /// Puts the light where the pointer has brought it.
    pub fn follow(&self, state: &mut State, lens: &Lens, pointer: Pos2) {
        state.set_changes(self.light, self.before.1);
        if pointer == self.from && self.number().is_none() {
            return;
        }
        let place = &self.before.0;
        match self.tool {
            Tool::Move => state.move_light(self.light, place.position + self.moved(lens, pointer)),
            Tool::Turn => state.turn_light(self.light, self.turned(lens, pointer)),
            Tool::Scale => {
                let factor = self.scaled(lens, pointer);
                // An axis is one of its own two.
                let factors = match self.axis {
                    Some(0) => Vec2::new(factor, 1.0),
                    Some(1) => Vec2::new(1.0, factor),
                    _ => Vec2::splat(factor),
                };
                state.resize_light(self.light, place.size.unwrap_or(Vec2::ONE) * factors);
            }
            Tool::Point => {
                let to = pointed(lens, place, pointer);
                state.turn_light(self.light, Quat::from_rotation_arc(place.normal(), to));
            }
            Tool::Corner => {
                if let Some(size) = self.stretched(lens, pointer) {
                    state.resize_light(self.light, size);
                }
            }
        }
    }

    /// By how much it is moved, metres: with the pointer in the view's plane, or along an axis.
    fn moved(&self, lens: &Lens, pointer: Pos2) -> Vec3 {
        let position = self.before.0.position;
        if let Some(number) = self.number() {
            return number * Vec3::AXES[self.axis.unwrap_or(0)];
        }
        let [right, up, _] = lens.axes();
        let delta = pointer - self.from;
        let free = lens.metres_a_point(position) * (delta.x * right - delta.y * up);
        let Some(axis) = self.axis.map(|axis| Vec3::AXES[axis]) else { return free };
        let along = |at: Pos2| lens.ray(at).along(position, axis);
        match (along(self.from), along(pointer)) {
            (Some(from), Some(to)) => (to - from) * axis,
            // It leads to the eye.
            _ => free.dot(axis) * axis,
        }
    }

    /// By what it is turned: about the view's direction, or an axis.
    fn turned(&self, lens: &Lens, pointer: Pos2) -> Quat {
        let position = self.before.0.position;
        let to_eye = lens.to_eye(position);
        let axis = self.axis.map_or(to_eye, |axis| Vec3::AXES[axis]);
        if let Some(number) = self.number() {
            return Quat::from_axis_angle(axis, number.to_radians());
        }
        let angle = match lens.project(position) {
            Some(middle) => {
                let [from, to] = [self.from, pointer].map(|at| at - middle);
                // The screen's y points down.
                -(to.y.atan2(to.x) - from.y.atan2(from.x))
            }
            None => TURN * (pointer.x - self.from.x) / lens.height(),
        };
        let sign = if axis.dot(to_eye) < 0.0 { -1.0 } else { 1.0 };
        Quat::from_axis_angle(axis, sign * angle)
    }

    /// The factor by which it is made larger: that of the pointer's distances to its middle.
    fn scaled(&self, lens: &Lens, pointer: Pos2) -> f32 {
        if let Some(number) = self.number() {
            return number.abs();
        }
        match lens.project(self.before.0.position) {
            Some(middle) => pointer.distance(middle).max(1.0) / self.from.distance(middle).max(1.0),
            None => (2.0 * (pointer.x - self.from.x) / lens.height()).exp(),
        }
    }

    /// The size at which the corner that was taken is below the pointer: the light's middle stays. None where the light is seen
    /// edge-on.
    fn stretched(&self, lens: &Lens, pointer: Pos2) -> Option<Vec2> {
        let place = &self.before.0;
        let own = |at: Pos2| -> Option<Vec2> {
            let point = lens.ray(at).on_plane(place.position, place.normal())?;
            Some((place.rotation.inverse() * (point - place.position)).truncate())
        };
        let (from, to, size) = (own(self.from)?, own(pointer)?, place.size?);
        let factors = to.abs() / from.abs().max(1e-3 * size);
        Some(if place.is_flat { size * factors } else { size * (to.length() / from.length().max(1e-9)) })
    }

    /// What it does, for the user.
    pub fn said(&self, state: &State) -> String {
        let now = state.placing(self.light);
        let before = &self.before.0;
        let what = match self.tool {
            Tool::Move => {
                let by = now.position - before.position;
                format!("move {:.4}, {:.4}, {:.4} m", by.x, by.y, by.z)
            }
            Tool::Turn | Tool::Point => {
                format!("turn {:.1}°", before.rotation.angle_between(now.rotation).to_degrees())
            }
            Tool::Scale | Tool::Corner => {
                let size = now.size.unwrap_or_default();
                format!("size {:.4} x {:.4} m", size.x, size.y)
            }
        };
        let axis = self.axis.map(|axis| format!(" along {}", ["X", "Y", "Z"][axis])).unwrap_or_default();
        let typed = if self.typed.is_empty() { String::new() } else { format!("  [{}]", self.typed) };
        format!("{what}{axis}{typed}")
    }
}

/// The length of the arrow along which a light shines, in points of the screen.
pub const ARROW: f32 = 70.0;

/// The direction from a light to where the pointer is on a sphere about it: the near side's, or its rim.
fn pointed(lens: &Lens, place: &Placing, pointer: Pos2) -> Vec3 {
    let radius = ARROW * lens.metres_a_point(place.position);
    let (middle, to_eye) = (place.position, lens.to_eye(place.position));
    let Some(point) = lens.ray(pointer).on_plane(middle, to_eye) else { return place.normal() };
    let beside = (point - middle) / radius;
    // What has been behind stays there: the arrow does not turn over when it is touched.
    let side = if place.normal().dot(to_eye) < 0.0 { -1.0 } else { 1.0 };
    let height = side * (1.0 - beside.length_squared()).max(0.0).sqrt();
    (beside + height * to_eye).normalize_or(place.normal())
}
