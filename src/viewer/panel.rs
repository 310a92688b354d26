//! The panel beside the picture.

use egui::Ui;
use glam::Vec3;

use super::material;
use super::notices;
use super::state::{Change, State};
use super::widgets::{color_button, slider};
use crate::picture::ToneCurve;

/// The panel's width in points, enough for the longest row.
pub const WIDTH: f32 = 270.0;

/// The strongest ambient light that can be set.
const AMBIENT_MAX: f32 = 10.0;

/// What the user did with the panel.
#[derive(Default)]
pub struct Outcome {
    pub change: Change,
    pub screenshot: bool,
}

/// Lays the panel out and applies what is changed in it to `state`.
pub fn show(ui: &mut Ui, state: &mut State) -> Outcome {
    let mut outcome = Outcome::default();
    egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        ui.add_space(6.0);
        ui.add(egui::Label::new(egui::RichText::new(&state.name).heading()).truncate());
        notices::show(ui, &state.scene.notices);
        ui.separator();
        let change = material::show(ui, state).max(picture(ui, state)).max(lights(ui, state));
        outcome.change = change;
        ui.separator();
        ui.horizontal(|ui| {
            if ui.button("Reset").on_hover_text("Scene, view and settings as they were loaded").clicked() {
                state.reset();
                outcome.change = Change::Scene;
            }
            outcome.screenshot = ui.button("Save screenshot").clicked();
        });
        if !state.message.is_empty() {
            ui.label(&state.message);
        }
        let milliseconds = state.frame_time.map(|time| format!("frame {:.1} ms", 1e3 * time.as_secs_f64()));
        ui.label(milliseconds.unwrap_or_default());
        ui.weak("drag: turn; right or Shift drag: pan; wheel: zoom");
    });
    outcome
}

fn picture(ui: &mut Ui, state: &mut State) -> Change {
    ui.separator();
    ui.strong("Picture");
    let (exposure_before, tone_before) = (state.settings.exposure, state.tone);
    ui.horizontal(|ui| {
        ui.label("exposure");
        slider(ui, egui::Slider::new(&mut state.settings.exposure, -8.0..=8.0).suffix(" EV").fixed_decimals(1));
    });
    ui.horizontal(|ui| {
        ui.label("tone curve");
        ui.selectable_value(&mut state.tone, ToneCurve::Neutral, "neutral");
        ui.selectable_value(&mut state.tone, ToneCurve::Agx, "AgX");
        ui.selectable_value(&mut state.tone, ToneCurve::None, "none");
    });
    let ambient_before = state.settings.ambient;
    ambient(ui, &mut state.settings.ambient);
    let lobes_before = state.settings.lobes;
    ui.horizontal_wrapped(|ui| {
        let lobes = &mut state.settings.lobes;
        ui.checkbox(&mut lobes.sheen, "sheen");
        ui.checkbox(&mut lobes.diffuse, "diffuse");
        ui.checkbox(&mut lobes.specular, "specular");
        ui.checkbox(&mut lobes.emission, "emission");
    });
    let visible_before = state.settings.lights_visible;
    ui.checkbox(&mut state.settings.lights_visible, "lights visible");
    if visible_before != state.settings.lights_visible {
        Change::Scene
    } else if (lobes_before, exposure_before, ambient_before)
        != (state.settings.lobes, state.settings.exposure, state.settings.ambient)
    {
        Change::Drawn
    } else if tone_before != state.tone {
        Change::Shown
    } else {
        Change::None
    }
}

/// Strength and hue of the ambient light.
fn ambient(ui: &mut Ui, radiance: &mut Vec3) {
    let before = *radiance;
    let (mut strength, mut color) = strength_and_color(before);
    ui.horizontal(|ui| {
        ui.label("ambient");
        // Room for its box and the colour.
        ui.spacing_mut().slider_width = 80.0;
        let value = egui::Slider::new(&mut strength, 0.0..=AMBIENT_MAX).logarithmic(true).smallest_positive(1e-3);
        slider(ui, value);
        color_button(ui, &mut color);
    });
    *radiance = changed_radiance(before, strength, color);
}

/// A radiance as its greatest channel and its hue, whose greatest channel is 1. The hue of black is white.
fn strength_and_color(radiance: Vec3) -> (f32, Vec3) {
    let strength = radiance.max_element();
    (strength, if strength > 0.0 { radiance / strength } else { Vec3::ONE })
}

/// The radiance of this strength and hue; `before` where it differs from that by no more than the rounding of a round
/// trip.
fn changed_radiance(before: Vec3, strength: f32, color: Vec3) -> Vec3 {
    let radiance = strength * color / color.max_element().max(1e-6);
    if (radiance - before).abs().max_element() > 1e-5 * strength.max(1e-6) { radiance } else { before }
}

fn lights(ui: &mut Ui, state: &mut State) -> Change {
    ui.separator();
    ui.strong("Lights");
    let mut change = Change::None;
    for index in 0..state.scene.lights.len() {
        let name = match state.scene.lights[index].name.as_str() {
            "" => "light",
            name => name,
        };
        let title = format!("{name} ({})", index + 1);
        let few = state.scene.lights.len() <= 4;
        let section = egui::CollapsingHeader::new(title).id_salt(index).default_open(few);
        section.show(ui, |ui| change = change.max(light(ui, state, index)));
    }
    change
}

fn light(ui: &mut Ui, state: &mut State, index: usize) -> Change {
    let before = state.scene.lights[index].radiance;
    let (mut strength, mut color) = strength_and_color(before);
    ui.horizontal(|ui| {
        ui.label("radiance");
        let speed = 0.02 * strength.max(0.05);
        let value = egui::DragValue::new(&mut strength).range(0.0..=1e6).clamp_existing_to_range(false);
        ui.add(value.speed(speed).max_decimals(3));
        color_button(ui, &mut color);
    });
    let position_before = state.scene.lights[index].position();
    let mut position = position_before;
    ui.horizontal(|ui| {
        ui.label("position");
        for coordinate in [&mut position.x, &mut position.y, &mut position.z] {
            ui.add(egui::DragValue::new(coordinate).range(-1e10..=1e10).speed(0.01).fixed_decimals(2));
        }
    });
    let radiance = changed_radiance(before, strength, color);
    let mut change = Change::None;
    if radiance != before {
        state.scene.lights[index].radiance = radiance;
        change = Change::Scene;
    }
    if position != position_before {
        state.scene.move_light(index, position - position_before);
        change = Change::Scene;
    }
    change
}
