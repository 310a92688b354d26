//! What the pointer does in the picture: it turns, pans, zooms, flies, and picks things.

use std::ops::RangeInclusive;

use egui::{PointerButton, Pos2, Rect, Response, Sense, Ui};
use glam::{Vec2, Vec3};

use super::commands::{Command, edit_view};
use super::lamps::LightId;
use super::pick::{Picked, Ray, bounds, pick};
use super::state::State;
use super::{aim, gizmo, keys};
use crate::scene::Bounds;

/// For how long the outline of what was clicked is shown, seconds.
const OUTLINED: f64 = 0.8;

/// How near a view may go, and how far, in diagonals of the scene.
const NEAREST: f32 = 1e-4;
const FARTHEST: f32 = 1e4;
/// Where nothing is seen under the pointer, the wheel goes to what is at least so far, in diagonals of the scene: however
/// near the target is, it does not stop there.
const EMPTY: f32 = 1e-3;
/// What is flown in a second, in distances from which the scene is seen at first, and how much faster that is with Shift.
const SPEED: f32 = 0.5;
const FASTER: f32 = 4.0;
/// The longest time between two passes that is flown in full, seconds: where pictures take longer, nobody sees where a flight
/// leads in time to end it.
const LONGEST: f64 = 0.25;

impl State {
    /// The box of what was clicked last, as it is drawn; none where nothing was.
    pub fn clicked_bounds(&self) -> Option<Bounds> {
        let drawn = self.drawn();
        let there = self.hands.clicked.filter(|instance| *instance < drawn.instances.len());
        there.map(|instance| bounds(&drawn, instance))
    }

    /// What is seen at a point of the picture.
    fn picked(&self, picture: Rect, at: Pos2) -> Option<Picked> {
        pick(&self.drawn(), &Ray::new(&self.camera(), picture.aspect_ratio(), place(picture, at)))
    }

    /// How near the view may go, and how far, metres.
    fn range(&self) -> RangeInclusive<f32> {
        NEAREST * self.size()..=FARTHEST * self.size()
    }
}

/// A point of the picture in shares of its width and height.
fn place(picture: Rect, at: Pos2) -> Vec2 {
    let share = (at - picture.min) / picture.size();
    Vec2::new(share.x, share.y)
}

/// Applies what the pointer does in the picture.
pub fn show(ui: &Ui, picture: Rect, state: &mut State) {
    let response = ui.interact(picture, ui.scope_id().with("picture"), Sense::click_and_drag());
    keys::follow_held(ui, &mut state.hands.keys);
    // A light in the hand has the pointer to itself.
    if !gizmo::show(ui, &response, picture, state) && !aim::show(ui, &response, picture, state) {
        if !fly(ui, &response, picture, state) {
            drag(ui, &response, picture, state);
        }
        click(ui, &response, picture, state);
    }
    wheel(ui, &response, picture, state);
    end_outline(ui, state);
}

/// Takes the focus from where it is once the picture is pressed: keys are meant for it then. What has lost it, hears of that
/// where it is shown after this.
pub fn take_focus(ui: &Ui, picture: Rect) {
    let pressed = ui.input(|input| input.pointer.interact_pos().filter(|_| input.pointer.any_pressed()));
    if pressed.is_some_and(|at| picture.contains(at) && ui.layer_id_at(at) == Some(ui.layer_id())) {
        ui.memory_mut(|memory| memory.stop_text_input());
    }
}

/// Flies while the right button and keys are held; from the first key on the pointer looks around, until the button is
/// released. Whether it does.
fn fly(ui: &Ui, response: &Response, picture: Rect, state: &mut State) -> bool {
    let is_held = response.is_pointer_button_down_on() && ui.input(|input| input.pointer.secondary_down());
    let step = keys::flight(ui, &state.hands.keys);
    let now = ui.input(|input| input.time);
    if !is_held || (step.is_none() && state.hands.flying.is_none()) {
        state.hands.flying = None;
        return false;
    }
    let seconds = now - state.hands.flying.replace(now).unwrap_or(now);
    let (moved, shift) = ui.input(|input| (input.pointer.delta(), input.modifiers.shift));
    let moved = Vec2::new(moved.x, moved.y) / picture.height().max(1.0);
    let seconds = seconds.min(LONGEST);
    let speed = SPEED * state.distance() * if shift { FASTER } else { 1.0 };
    let flown = step.map(|step| step.map(|step| step * speed * seconds as f32));
    if moved != Vec2::ZERO || flown.is_some_and(|flown| flown != [0.0; 3]) {
        edit_view(state, |orbit| {
            orbit.look(moved);
            orbit.fly(flown.unwrap_or_default());
        });
    }
    if step.is_some() {
        ui.request_repaint();
    }
    true
}

fn drag(ui: &Ui, response: &Response, picture: Rect, state: &mut State) {
    let buttons = [PointerButton::Primary, PointerButton::Middle, PointerButton::Secondary];
    let Some(button) = buttons.into_iter().find(|&button| response.dragged_by(button)) else {
        state.hands.held = None;
        return;
    };
    let delta = response.drag_delta();
    let moved = Vec2::new(delta.x, delta.y) / picture.height().max(1.0);
    let (modifiers, from) = ui.input(|input| (input.modifiers, input.pointer.press_origin()));
    let from = from.unwrap_or(picture.center());
    if moved == Vec2::ZERO {
        return;
    }
    match keys::drag(button, modifiers) {
        Some(Command::Turn) => edit_view(state, |orbit| orbit.turn(moved)),
        Some(Command::Pan) => {
            let held = state.hands.held.unwrap_or_else(|| state.orbit().depth(anchor(state, picture, from)));
            state.hands.held = Some(held);
            edit_view(state, |orbit| orbit.pan(moved, held));
        }
        // Up is nearer.
        Some(Command::Zoom) => zoom(state, picture, from, (-4.0 * moved.y).exp()),
        _ => {}
    }
}

fn wheel(ui: &Ui, response: &Response, picture: Rect, state: &mut State) {
    let Some(at) = response.hover_pos().filter(|_| response.hovered()) else { return };
    let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta(), input.zoom_delta()));
    // A notch of a wheel is about 50 points.
    let factor = (0.004 * scroll.y).clamp(-5.0, 5.0).exp() * pinch.clamp(0.1, 10.0);
    if factor != 1.0 {
        zoom(state, picture, at, factor);
    }
}

/// Zooms to what is seen at a point of the picture: the same thing while neither pointer nor view move otherwise, so that
/// the way back is the way there.
fn zoom(state: &mut State, picture: Rect, at: Pos2, factor: f32) {
    let (mut orbit, range) = (state.orbit(), state.range());
    let same = state.hands.zoomed.filter(|(place, _, view)| (*place, *view) == (at, orbit));
    let same = same.map(|(_, anchor, _)| anchor).filter(|anchor| orbit.depth(*anchor) > *range.start());
    let anchor = same.unwrap_or_else(|| anchor(state, picture, at));
    orbit.zoom(anchor, factor, &range);
    edit_view(state, |view| *view = orbit);
    state.hands.zoomed = Some((at, anchor, orbit));
}

/// What is seen at a point of the picture; where nothing is, a point about as far away as the target.
fn anchor(state: &State, picture: Rect, at: Pos2) -> Vec3 {
    let orbit = state.orbit();
    let ray = Ray::new(&orbit.camera(), picture.aspect_ratio(), place(picture, at));
    let seen = pick(&state.drawn(), &ray).map(|picked| picked.point);
    seen.unwrap_or_else(|| ray.at(orbit.distance.max(EMPTY * state.size())))
}

fn click(ui: &Ui, response: &Response, picture: Rect, state: &mut State) {
    let Some(at) = response.interact_pointer_pos().filter(|_| response.clicked()) else { return };
    let Some(picked) = state.picked(picture, at) else {
        (state.hands.clicked, state.outlined, state.chosen_light) = (None, None, None);
        return;
    };
    let light = state.drawn().light_index(picked.instance).map(LightId::Area);
    match light {
        Some(light) => state.choose(light),
        None => state.chosen_light = None,
    }
    if response.double_clicked() {
        let bounds = bounds(&state.drawn(), picked.instance);
        edit_view(state, |orbit| orbit.centre(picked.point, &bounds, picture.aspect_ratio()));
    }
    state.hands.clicked = Some(picked.instance);
    if picked.material >= state.scene.materials.len() {
        // An added light's, which is no material of the scene.
        return;
    }
    (state.material, state.outlined) = (picked.material, Some(picked.material));
    state.hands.outlined_until = ui.input(|input| input.time) + OUTLINED;
}

/// Takes the outline away once its time is over, and sees to it that there is a pass then.
fn end_outline(ui: &Ui, state: &mut State) {
    if state.outlined.is_none() {
        return;
    }
    let left = state.hands.outlined_until - ui.input(|input| input.time);
    if left > 0.0 {
        ui.request_repaint_after(std::time::Duration::from_secs_f64(left));
    } else {
        state.outlined = None;
    }
}
