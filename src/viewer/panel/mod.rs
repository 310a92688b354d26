//! The panel beside the picture.

mod actions;
mod alpha;
mod lights;
mod material;
mod materials;
mod notices;
mod picture;
mod presets;
mod scene;

use egui::Ui;

use super::file_name;
use super::request::Request;
use super::state::State;
use super::widgets::{fold, refused};

pub use alpha::sweep;

/// The panel's width in points, enough for the longest row.
pub const WIDTH: f32 = 300.0;

/// Lays the panel out and applies what is changed in it to the state's edits.
pub fn show(ui: &mut Ui, state: &mut State) -> Option<Request> {
    // However long the rest is, this stays in sight.
    let strip = egui::Panel::bottom("actions").resizable(false).frame(egui::Frame::NONE);
    let mut request = strip.show(ui, |ui| actions::show(ui, state)).inner;
    egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        ui.add_space(6.0);
        let name = egui::RichText::new(file_name(&state.name)).heading();
        ui.add(egui::Label::new(name).truncate().selectable(false)).on_hover_text(&state.name);
        notices::show(ui, state.notices.iter().chain(&state.notice));
        ui.separator();
        fold(ui, "Material", true, |ui| material::show(ui, state));
        ui.separator();
        fold(ui, "Picture", true, |ui| picture::show(ui, state));
        ui.separator();
        fold(ui, "Lights", true, |ui| lights::show(ui, state));
        ui.separator();
        fold(ui, "Scene", false, |ui| request = scene::show(ui, state).or(request.take()));
        ui.add_space(6.0);
    });
    if let Some(what) = refused(ui) {
        state.say(what);
    }
    request
}
