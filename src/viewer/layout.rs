//! Where panel and picture stand, and what dragging in the picture does.

use egui::{PointerButton, Rect, Sense, Ui};
use glam::Vec2;

use super::panel;
use super::state::{Change, State};

/// What a pass over the user interface has found.
pub struct Layout {
    /// Where the picture is, in points.
    pub picture: Rect,
    pub change: Change,
    pub screenshot: bool,
}

impl Default for Layout {
    fn default() -> Self {
        Self { picture: Rect::ZERO, change: Change::None, screenshot: false }
    }
}

/// Lays out the window's content and takes over what the user does.
pub fn show(ui: &mut Ui, state: &mut State) -> Layout {
    let panel = egui::Panel::right("panel").exact_size(panel::WIDTH).resizable(false);
    let outcome = panel.show(ui, |ui| panel::show(ui, state)).inner;
    let picture = ui.available_rect_before_wrap();
    let change = outcome.change.max(navigate(ui, picture, state));
    Layout { picture, change, screenshot: outcome.screenshot }
}

fn navigate(ui: &mut Ui, picture: Rect, state: &mut State) -> Change {
    let response = ui.interact(picture, ui.scope_id().with("picture"), Sense::drag());
    let delta = response.drag_delta();
    let drag = Vec2::new(delta.x, delta.y) / picture.height().max(1.0);
    let (shift, scroll, pinch) =
        ui.input(|input| (input.modifiers.shift, input.smooth_scroll_delta(), input.zoom_delta()));
    let before = state.orbit.clone();
    if drag != Vec2::ZERO {
        if response.dragged_by(PointerButton::Primary) && !shift {
            state.orbit.turn(drag);
        } else {
            state.orbit.pan(drag);
        }
    }
    if response.hovered() {
        // A notch of a wheel is about 50 points.
        state.orbit.zoom((0.004 * scroll.y).exp() * pinch);
    }
    if state.orbit == before { Change::None } else { Change::Drawn }
}
