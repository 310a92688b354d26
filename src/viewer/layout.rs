//! Where panel and picture are placed.

use egui::{Align2, Area, Id, Rect, Ui};

use super::change::Change;
use super::commands::Command;
use super::frame::pixel_size;
use super::request::Request;
use super::state::State;
use super::{files, keys, navigate, opening, panel, saving, sheet_view};

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
    let outlined = state.outlined;
    // Before the panel, where a key may end what is typed.
    let mut commands = if state.hands.grab.is_some() { Vec::new() } else { keys::pressed(ui) };
    if state.opening.is_some() {
        // The box has the keyboard to itself.
        commands.retain(|command| matches!(command, Command::Open | Command::Close));
    }
    panel::sweep(ui, state);
    let area = ui.available_rect_before_wrap();
    fold(area, state);
    // egui may make the panel a little narrower than it is meant to be, with its content: the picture stays where it is.
    let width = if state.panel_hidden { 0.0 } else { panel::WIDTH };
    let picture = area.with_max_x((area.max.x - width).max(area.min.x));
    navigate::take_focus(ui, picture);
    let mut request = None;
    if !state.panel_hidden {
        let panel = egui::Panel::right("panel").exact_size(panel::WIDTH).resizable(false);
        request = panel.show(ui, |ui| panel::show(ui, state)).inner;
    }
    navigate::show(ui, picture, state);
    sheet_view::show(ui, picture, state);
    keep(ui, state);
    for command in commands {
        request = command.run(ui, picture, state).or(request);
    }
    request = saved(ui, picture, state).or(request);
    if state.keys_shown {
        state.keys_shown = keys::show(ui);
    }
    request = opening::show(ui, picture, &mut state.opening).or(request);
    request = files::show(ui).or(request);
    if is_narrow(area) {
        fold_button(ui, picture, state);
    }
    let mut change = changed(state);
    if state.needs_metering() {
        change = change.max(Change::Drawn);
    }
    if state.outlined != outlined {
        change = change.max(Change::Shown);
    }
    Layout { picture, change, request }
}

/// The box for pictures that are to be saved, and how far one is.
fn saved(ui: &Ui, picture: Rect, state: &mut State) -> Option<Request> {
    let size = pixel_size(picture, ui.pixels_per_point());
    let stop = state.saving.progress.as_ref().and_then(|progress| saving::show_bar(ui, picture, progress));
    stop.or(saving::show_form(ui, &mut state.saving, size).map(Request::SavePicture))
}

/// What has changed since the last pass. Edits may be many: they are copied only where there is something.
fn changed(state: &mut State) -> Change {
    let change = Change::between(&state.shown, &state.edits);
    if change > Change::None {
        state.shown.clone_from(&state.edits);
    }
    change
}

/// Once a change has come to its end, it can be undone.
fn keep(ui: &Ui, state: &mut State) {
    if state.is_settled(ui) {
        state.history.keep(&state.edits, state.metered);
    }
}

/// Whether the panel leaves the picture less than half of the width.
fn is_narrow(area: Rect) -> bool {
    area.width() < 2.0 * panel::WIDTH
}

/// Hides the panel where the window has become too narrow for both, and brings it back where it has become wide enough.
fn fold(area: Rect, state: &mut State) {
    let is_narrow = is_narrow(area);
    if std::mem::replace(&mut state.hands.is_narrow, is_narrow) != is_narrow {
        state.panel_hidden = is_narrow;
    }
}

/// A button at the picture's edge for the panel.
fn fold_button(ui: &Ui, picture: Rect, state: &mut State) {
    let at = picture.right_top() + egui::vec2(-4.0, 4.0);
    Area::new(Id::unique("fold")).fixed_pos(at).pivot(Align2::RIGHT_TOP).show(ui, |ui| {
        let (text, about) = if state.panel_hidden { ("<", "Show the panel") } else { (">", "Hide the panel") };
        if ui.button(text).on_hover_text(about).clicked() {
            state.panel_hidden = !state.panel_hidden;
        }
    });
}
