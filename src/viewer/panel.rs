//! The panel beside the picture.

use egui::Ui;

use super::request::Request;
use super::state::State;
use super::widgets::{Glow, hue_button, slider};
use super::{lights, material, notices};
use crate::picture::{Exposure, ToneCurve};
use crate::scene::Edits;

/// The panel's width in points, enough for the longest row.
pub const WIDTH: f32 = 270.0;

/// The strongest ambient light that can be set.
const AMBIENT_MAX: f32 = 10.0;

/// Lays the panel out and applies what is changed in it to the state's edits.
pub fn show(ui: &mut Ui, state: &mut State) -> Option<Request> {
    // However long the rest is, this stays in sight.
    let strip = egui::Panel::bottom("actions").resizable(false).frame(egui::Frame::NONE);
    let request = strip.show(ui, |ui| actions(ui, state)).inner;
    egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        ui.add_space(6.0);
        ui.add(egui::Label::new(egui::RichText::new(&state.name).heading()).truncate());
        notices::show(ui, state.notices.iter().chain(&state.notice));
        ui.separator();
        material::show(ui, state);
        picture(ui, state);
        lights::show(ui, state);
    });
    request
}

/// What is done with the whole, and above it what became of that: the buttons stay where they are.
fn actions(ui: &mut Ui, state: &mut State) -> Option<Request> {
    let mut request = None;
    ui.add_space(4.0);
    if !state.message.is_empty() {
        ui.label(&state.message);
    }
    let milliseconds = state.frame_time.map(|time| format!("frame {:.1} ms", 1e3 * time.as_secs_f64()));
    ui.label(state.doing.map(str::to_owned).or(milliseconds).unwrap_or_default());
    ui.weak("drag: turn; right or Shift drag: pan; wheel: zoom");
    ui.horizontal(|ui| {
        if ui.button("Reset").on_hover_text("Scene, view and settings as they were loaded").clicked() {
            state.reset();
        }
        if ui.button("Save screenshot").clicked() {
            request = Some(Request::Screenshot);
        }
        let about = "What is changed here, in a file: velour view, render and reference take it with --state";
        if ui.button("Save state").on_hover_text(about).clicked() {
            request = Some(Request::SaveState);
        }
    });
    request
}

fn picture(ui: &mut Ui, state: &mut State) {
    ui.separator();
    ui.strong("Picture");
    exposure(ui, state);
    let edits = &mut state.edits;
    let before = edits.settings();
    let mut settings = before;
    ui.horizontal(|ui| {
        ui.label("tone curve");
        ui.selectable_value(&mut settings.tone, ToneCurve::Neutral, "neutral");
        ui.selectable_value(&mut settings.tone, ToneCurve::Agx, "AgX");
        ui.selectable_value(&mut settings.tone, ToneCurve::None, "none");
    });
    ambient(ui, edits);
    ui.horizontal_wrapped(|ui| {
        let lobes = &mut settings.lobes;
        ui.checkbox(&mut lobes.sheen, "sheen");
        ui.checkbox(&mut lobes.diffuse, "diffuse");
        ui.checkbox(&mut lobes.specular, "specular");
        ui.checkbox(&mut lobes.emission, "emission");
    });
    ui.checkbox(&mut settings.lights_visible, "lights visible");
    ui.horizontal(|ui| {
        let about = "What stands between a surface and a light stops it. While the view rests shadows grow finer, and edges smoother";
        ui.checkbox(&mut settings.shadows, "shadows").on_hover_text(about);
        if let Some([samples, of]) = state.samples {
            ui.weak(format!("{samples} of {of} samples"));
        }
    });
    // What is not touched is left unset.
    if settings.tone != before.tone {
        edits.tone = Some(settings.tone);
    }
    if settings.lobes != before.lobes {
        edits.lobes = Some(settings.lobes);
    }
    if settings.shadows != before.shadows {
        edits.shadows = Some(settings.shadows);
    }
    if settings.lights_visible != before.lights_visible {
        edits.lights_visible = Some(settings.lights_visible);
    }
}

/// A number, or metered: at the start, when that is switched on, and when it is asked for again, so that neither turning
/// nor a brighter lamp changes it behind the user's back.
fn exposure(ui: &mut Ui, state: &mut State) {
    let (before, edited) = (state.settings().exposure, state.edits.exposure);
    let mut stops = before;
    ui.horizontal(|ui| {
        ui.label("exposure");
        slider(ui, &mut stops, -16.0..=16.0, |slider| slider.suffix(" EV"));
    });
    if stops != before {
        state.edits.exposure = Some(stops.into());
    }
    ui.horizontal(|ui| {
        let mut is_auto = state.edits.exposure == Some(Exposure::Auto);
        let about = "Meters what is seen, the middle most; it stays as the view turns and lights change";
        if ui.checkbox(&mut is_auto, "auto exposure").on_hover_text(about).changed() {
            // Switched off, what it took stays.
            state.edits.exposure = Some(if is_auto { Exposure::Auto } else { before.into() });
            state.metered = None;
        }
        if is_auto && ui.button("meter again").clicked() {
            state.metered = None;
        }
    });
    if state.edits.exposure != edited {
        // What was said of the exposure before is no more so.
        state.message.clear();
    }
}

/// Strength and hue of the ambient light.
fn ambient(ui: &mut Ui, edits: &mut Edits) {
    let mut glow = Glow::new(edits.ambient.unwrap_or_default(), edits.ambient_strength);
    let before = glow;
    ui.horizontal(|ui| {
        ui.label("ambient");
        // Room for its box and the colour.
        ui.spacing_mut().slider_width = 80.0;
        slider(ui, &mut glow.strength, 0.0..=AMBIENT_MAX, |slider| slider.logarithmic(true).smallest_positive(1e-3));
        hue_button(ui, &mut glow);
    });
    if glow != before {
        (edits.ambient, edits.ambient_strength) = (Some(glow.hue), Some(glow.strength));
    }
}
