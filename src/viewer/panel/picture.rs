//! The part of the panel that shows how the picture is made.

use egui::{Button, Ui};

use super::super::state::State;
use super::super::widgets::{About, Glow, Touch, button, choice, color_rows, row, slider_row, switch};
use crate::picture::{Exposure, ToneCurve};
use crate::scene::{Edits, Lobes, Settings};

/// The strongest ambient light that can be set.
const AMBIENT_MAX: f32 = 10.0;

pub fn show(ui: &mut Ui, state: &mut State) {
    exposure(ui, state);
    let edits = &mut state.edits;
    let settings = edits.settings();
    let about = "How brightness that a screen cannot show is folded into what it can.";
    let tones = [
        (
            "neutral",
            ToneCurve::Neutral,
            "Keeps colours as they are, and rolls off what is very bright. Good to judge materials.",
        ),
        ("AgX", ToneCurve::Agx, "Softer, as film is: bright colours fade to white."),
        ("none", ToneCurve::None, "No curve: what is brighter than white is cut off."),
    ];
    row(ui, "tone curve", about, |ui| choice(ui, settings.tone, &tones)).apply(&mut edits.tone);
    ambient(ui, edits);
    lobes(ui, edits, &settings);
    let about = "Whether lamps themselves are seen in the picture. They light the scene all the same.";
    switch(ui, "lights visible", about, settings.lights_visible).apply(&mut edits.lights_visible);
    let about = "What stands between a surface and a light stops it. While the view rests shadows grow finer, and edges \
                 smoother.";
    switch(ui, "shadows", about, settings.shadows).apply(&mut edits.shadows);
}

/// A number, or metered: at the start, when that is switched on, and when it is asked for again, so that neither turning
/// nor a brighter lamp changes it behind the user's back.
fn exposure(ui: &mut Ui, state: &mut State) {
    let (before, edited) = (state.settings().exposure, state.edits.exposure);
    let about = "How bright the picture is shown, in stops: one more is twice as bright.";
    let stops = slider_row(ui, "exposure", about, before, -16.0..=16.0, |slider| slider);
    stops.map(Exposure::Stops).apply(&mut state.edits.exposure);
    ui.horizontal(|ui| {
        let is_auto = state.edits.exposure == Some(Exposure::Auto);
        let about = "Meters what is seen, the middle most. It then stays as the view turns and lights change.";
        match switch(ui, "auto exposure", about, is_auto) {
            Touch::Nothing => {}
            // Switched off, what it took stays.
            Touch::Set(is_auto) => {
                state.edits.exposure = Some(if is_auto { Exposure::Auto } else { before.into() });
                state.metered = None;
            }
            Touch::Reset => state.edits.exposure = None,
        }
        let why_not = (!is_auto).then_some("Nothing is metered: switch auto exposure on.");
        if button(ui, About::unless("Meters what is seen now.", why_not), Button::new("meter again")) {
            state.metered = None;
        }
    });
    if state.edits.exposure != edited {
        // What the notices say of the exposure, and so a message, is no more so.
        let notices = &state.notices;
        state.messages.retain(|message| !notices.contains(message));
    }
}

/// Strength and hue of the ambient light.
fn ambient(ui: &mut Ui, edits: &mut Edits) {
    let loaded = Glow::new(Settings::default().ambient, None);
    let before = Glow::new(edits.ambient.unwrap_or_default(), edits.ambient_strength);
    let mut glow = before;
    let about = "Light that comes from everywhere alike, with no shadows: its radiance. 0 is none.";
    let strength = slider_row(ui, "ambient light", about, glow.strength, 0.0..=AMBIENT_MAX, |slider| {
        slider.logarithmic(true).smallest_positive(1e-3)
    });
    glow.strength = strength.value(glow.strength, loaded.strength);
    let color = color_rows(ui, "its hue", "The hue of the light that comes from everywhere.", glow.hue);
    glow = glow.with_color(color.value(glow.hue, loaded.hue));
    if glow != before {
        let (hue, strength) = if glow == loaded { (None, None) } else { (Some(glow.hue), Some(glow.strength)) };
        (edits.ambient, edits.ambient_strength) = (hue, strength);
    }
}

/// Which parts of the light that surfaces send are summed.
fn lobes(ui: &mut Ui, edits: &mut Edits, settings: &Settings) {
    let mut lobes = settings.lobes;
    let abouts = [
        "Light that the layer of fibres or dust scatters. Off, one sees what the layer leaves of the surface below.",
        "Light that the surface below the layer scatters to all sides.",
        "Light that the surface below the layer reflects: its highlights.",
        "Light that surfaces send out by themselves.",
    ];
    let mut touched = Touch::Nothing;
    row(ui, "shown", "Which parts of the light that surfaces send are added up.", |ui| {
        egui::Grid::new("lobes").num_columns(2).show(ui, |ui| {
            for (index, ((name, is_on), about)) in lobes.switches().into_iter().zip(abouts).enumerate() {
                let touch = switch(ui, name, about, *is_on);
                *is_on = touch.value(*is_on, true);
                touched = touched.or(touch);
                if index % 2 == 1 {
                    ui.end_row();
                }
            }
        });
    });
    match touched {
        Touch::Nothing => {}
        Touch::Reset if lobes == Lobes::default() => edits.lobes = None,
        Touch::Set(_) | Touch::Reset => edits.lobes = Some(lobes),
    }
}
