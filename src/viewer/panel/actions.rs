//! The strip at the panel's bottom: what the program has to say, what it is doing, and what is done with the whole.

use egui::{Button, Label, ScrollArea, Ui};

use super::super::history::is_settled;
use super::super::opening::Opening;
use super::super::request::Request;
use super::super::state::State;
use super::super::widgets::{About, button};

/// The greatest height of the messages, in points: more of them scroll.
const MESSAGES: f32 = 84.0;

pub fn show(ui: &mut Ui, state: &mut State) -> Option<Request> {
    ui.add_space(4.0);
    messages(ui, &mut state.messages);
    let mut request = offer(ui, state);
    let status = status(state);
    ui.add(Label::new(egui::RichText::new(&status).small()).truncate().selectable(false)).on_hover_text(&status);
    ui.horizontal(|ui| {
        let undo = About::unless(
            "Takes back the last change; the view stays (Ctrl-Z).",
            (!state.can_undo()).then_some("There is nothing to undo."),
        );
        if button(ui, undo, Button::new("Undo")) && is_settled(ui) {
            state.undo();
        }
        let redo = About::unless(
            "Does again what was undone last (Ctrl-Shift-Z).",
            (!state.can_redo()).then_some("There is nothing to redo."),
        );
        if button(ui, redo, Button::new("Redo")) && is_settled(ui) {
            state.redo();
        }
        let about = "Puts scene, view and settings back as they were loaded.";
        if button(ui, about, Button::new("Reset")) {
            state.reset();
        }
        if button(ui, "Lists all keys, and what the mouse does in the picture.", Button::new("?")) {
            state.keys_shown = !state.keys_shown;
        }
        if button(ui, "Opens another scene, or a state of this one (Ctrl-O).", Button::new("Open")) {
            Opening::toggle(&mut state.opening);
        }
    });
    ui.horizontal(|ui| {
        let about = "Saves the picture, without the panel, in any size (Ctrl-Shift-S). P saves it at once, as the last one was saved: at \
                     first as it is shown, as a .png in the current folder.";
        if button(ui, about, Button::new("Save picture...")) {
            state.saving.open();
        }
        let about = "Saves what is changed here as a small text in the current folder. velour view, render and reference take \
                     it with --state.";
        if button(ui, about, Button::new("Save state")) {
            request = Some(Request::SaveState);
        }
        let about = "Copies a command for a shell that makes the picture which P saves: velour render with all that is changed here \
                     (Ctrl-Shift-C).";
        if button(ui, about, Button::new("Copy command")) {
            request = Some(Request::CopyCommand);
        }
    });
    ui.add_space(2.0);
    request
}

/// Changes of an earlier run, which the user may want, or not.
fn offer(ui: &mut Ui, state: &State) -> Option<Request> {
    let offer = state.offer.as_ref()?;
    let mut request = None;
    ui.horizontal_top(|ui| {
        if button(ui, "Leaves the scene as it is, and forgets those changes.", Button::new("x").small()) {
            request = Some(Request::Decline);
        }
        let about = "Takes over what you had changed in this scene when it was last shown, and from where you saw it. Undo takes that \
                     back.";
        if button(ui, about, Button::new("Bring back").small()) {
            request = Some(Request::BringBack);
        }
        ui.add(Label::new(&offer.said).wrap());
    });
    request
}

/// Messages stand until each has been dismissed.
fn messages(ui: &mut Ui, messages: &mut Vec<String>) {
    let mut dismissed = None;
    ScrollArea::vertical().id_salt("messages").max_height(MESSAGES).stick_to_bottom(true).show(ui, |ui| {
        for (index, message) in messages.iter().enumerate() {
            ui.horizontal_top(|ui| {
                if button(ui, "Dismisses this message.", Button::new("x").small()) {
                    dismissed = Some(index);
                }
                ui.add(Label::new(message).wrap());
            });
        }
    });
    if let Some(index) = dismissed {
        messages.remove(index);
    }
}

/// What the program is busy with, how long a frame takes, and how fine the picture is by now.
fn status(state: &State) -> String {
    let time = state.frame_time.map(|time| format!("frame {:.1} ms", 1e3 * time.as_secs_f64()));
    let samples = state.samples.map(|[samples, of]| format!("{samples} of {of} samples"));
    [state.loading.clone(), state.doing.map(str::to_owned), time, samples]
        .into_iter()
        .flatten()
        .collect::<Vec<_>>()
        .join(", ")
}
