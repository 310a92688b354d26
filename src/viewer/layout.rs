//! Where panel and picture are placed, and what dragging in the picture does.

use egui::{PointerButton, Rect, Sense, Ui};
use glam::Vec2;

use super::change::Change;
use super::request::Request;
use super::state::State;
use super::{panel, sheet_view};
use crate::scene::CameraEdit;

/// The outcome of a pass over the user interface.
pub struct Layout {
    /// Where the picture is, in points.
    pub picture: Rect,
    /// What it takes to show what the user has changed.
    pub change: Change,
    pub request: Option<Request>,
}

impl Default for Layout {
    fn default() -> Self {
        Self { picture: Rect::ZERO, change: Change::None, request: None }
    }
}

/// Lays out the window's content and applies what the user does to the state's edits.
pub fn show(ui: &mut Ui, state: &mut State) -> Layout {
    let before = state.edits.clone();
    panel::sweep(ui, state);
    let area = ui.available_rect_before_wrap();
    let panel = egui::Panel::right("panel").exact_size(panel::WIDTH).resizable(false);
    let request = panel.show(ui, |ui| panel::show(ui, state)).inner;
    // egui may make the panel a little narrower than it is meant to be, with its content: the picture stays where it is.
    let picture = area.with_max_x((area.max.x - panel::WIDTH).max(area.min.x));
    navigate(ui, picture, state);
    sheet_view::show(ui, picture, state);
    let mut change = Change::between(&before, &state.edits);
    if state.needs_metering() {
        change = change.max(Change::Drawn);
    }
    Layout { picture, change, request }
}

fn navigate(ui: &mut Ui, picture: Rect, state: &mut State) {
    let response = ui.interact(picture, ui.scope_id().with("picture"), Sense::drag());
    let delta = response.drag_delta();
    let drag = Vec2::new(delta.x, delta.y) / picture.height().max(1.0);
    let (shift, scroll, pinch) =
        ui.input(|input| (input.modifiers.shift, input.smooth_scroll_delta(), input.zoom_delta()));
    let before = state.orbit();
    let mut orbit = before;
    if drag != Vec2::ZERO {
        if response.dragged_by(PointerButton::Primary) && !shift {
            orbit.turn(drag);
        } else {
            orbit.pan(drag);
        }
    }
    if response.hovered() {
        // A notch of a wheel is about 50 points.
        orbit.zoom((0.004 * scroll.y).clamp(-5.0, 5.0).exp() * pinch.clamp(0.1, 10.0));
    }
    if orbit != before {
        state.edits.camera = Some(CameraEdit::Orbit(orbit));
    }
}
