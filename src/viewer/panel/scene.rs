//! The part of the panel about the scene as a whole: its file, its cameras, what is in it.

use egui::{Button, Label, Ui};

use super::super::native::one_line;
use super::super::request::Request;
use super::super::state::State;
use super::super::widgets::{About, Choice, Touch, button, list, row, short};
use crate::scene::CameraEdit;

/// Most characters of a camera's name.
const NAME_SHOWN: usize = 24;

pub fn show(ui: &mut Ui, state: &mut State) -> Option<Request> {
    let why_not = state.scene.files.is_empty().then_some("This scene comes with the program: it has no file.");
    let about = "Loads the scene's file again (Ctrl-R), as the program does by itself where it changes. What you have changed stays.";
    let request = button(ui, About::unless(about, why_not), Button::new("Reload")).then_some(Request::Reload);
    if state.scene.cameras.len() > 1 {
        cameras(ui, state);
    }
    for (name, value, about) in &state.facts {
        row(ui, name, about, |ui| ui.add(Label::new(value).truncate().selectable(false)));
    }
    request
}

/// The file's cameras; a view that has been turned is none of them.
fn cameras(ui: &mut Ui, state: &mut State) {
    let shown = match state.edits.camera {
        None => Some(0),
        Some(CameraEdit::Loaded(index)) => Some(index),
        Some(CameraEdit::Orbit(_)) => None,
    };
    let cameras = state.scene.cameras.iter().enumerate();
    let names: Vec<String> =
        cameras.map(|(index, camera)| short(&one_line(&format!("{index} {}", camera.name)), NAME_SHOWN)).collect();
    let seen = "Shows the scene as this camera sees it.";
    let mut choices: Vec<Choice<Option<usize>>> =
        names.iter().enumerate().map(|(index, name)| (name.as_str(), Some(index), seen)).collect();
    if shown.is_none() {
        choices.push(("as turned", None, "The view that you have turned."));
    }
    let about = "From where the scene is seen: one of the file's cameras. Home goes back to the first.";
    let touch = row(ui, "camera", about, |ui| list(ui, "cameras", about, shown, &choices));
    match touch {
        Touch::Set(Some(index)) => state.edits.camera = Some(CameraEdit::Loaded(index)),
        Touch::Reset => state.edits.camera = None,
        Touch::Nothing | Touch::Set(None) => {}
    }
}
