//! The panel beside the picture.

use egui::{Align, Layout, Ui};
use glam::Vec3;

use super::state::{Change, State};
use crate::picture::ToneCurve;
use crate::scene::Sheen;

/// Points; wide enough for the longest row.
pub const WIDTH: f32 = 270.0;

/// What the user did with the panel.
#[derive(Default)]
pub struct Outcome {
    pub change: Change,
    pub screenshot: bool,
}

/// Lays the panel out and takes over what was changed in it.
pub fn show(ui: &mut Ui, state: &mut State) -> Outcome {
    let mut outcome = Outcome::default();
    egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        ui.add_space(6.0);
        ui.add(egui::Label::new(egui::RichText::new(&state.name).heading()).truncate());
        ui.separator();
        let change = sheen(ui, state).max(picture(ui, state)).max(lights(ui, state));
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

fn sheen(ui: &mut Ui, state: &mut State) -> Change {
    ui.strong("Sheen");
    if state.scene.materials.len() > 1 {
        let names: Vec<String> = state.scene.materials.iter().map(|material| material.name.clone()).collect();
        let width = ui.available_width() - 60.0;
        let list = egui::ComboBox::from_label("material").width(width).truncate();
        list.show_index(ui, &mut state.material, names.len(), |index| names[index].clone());
    }
    let before = state.scene.materials[state.material].sheen;
    let mut sheen = before.unwrap_or(Sheen::new(Vec3::ZERO, 0.5));
    ui.label("alpha");
    ui.horizontal(|ui| {
        ui.label("fuzz");
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.label("dust");
            // Its box, and room at the panel's edge.
            let value_width = 56.0;
            ui.spacing_mut().slider_width = ui.available_width() - value_width;
            slider(ui, egui::Slider::new(&mut sheen.roughness, 0.0..=1.0).fixed_decimals(2));
        });
    });
    ui.horizontal(|ui| {
        ui.label("C_sheen");
        color_button(ui, &mut sheen.color);
    });
    // A material that has no sheen keeps none until a colour is given to it.
    if Some(sheen) == before || (before.is_none() && sheen.color == Vec3::ZERO) {
        return Change::None;
    }
    state.scene.materials[state.material].sheen = Some(sheen);
    Change::Scene
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
        ui.selectable_value(&mut state.tone, ToneCurve::None, "none");
    });
    let lobes_before = state.settings.lobes;
    ui.horizontal(|ui| {
        let lobes = &mut state.settings.lobes;
        ui.checkbox(&mut lobes.sheen, "sheen");
        ui.checkbox(&mut lobes.diffuse, "diffuse");
        ui.checkbox(&mut lobes.emission, "emission");
    });
    let visible_before = state.settings.lights_visible;
    ui.checkbox(&mut state.settings.lights_visible, "lights visible");
    if visible_before != state.settings.lights_visible {
        Change::Scene
    } else if lobes_before != state.settings.lobes || exposure_before != state.settings.exposure {
        Change::Drawn
    } else if tone_before != state.tone {
        Change::Shown
    } else {
        Change::None
    }
}

fn lights(ui: &mut Ui, state: &mut State) -> Change {
    ui.separator();
    ui.strong("Lights");
    let mut change = Change::None;
    for index in 0..state.scene.lights.len() {
        let title = format!("{} ({})", state.scene.lights[index].name, index + 1);
        let few = state.scene.lights.len() <= 4;
        let section = egui::CollapsingHeader::new(title).id_salt(index).default_open(few);
        section.show(ui, |ui| change = change.max(light(ui, state, index)));
    }
    change
}

fn light(ui: &mut Ui, state: &mut State, index: usize) -> Change {
    let before = state.scene.lights[index].radiance;
    let mut strength = before.max_element();
    // The hue of a light that is turned off: what it was is not kept, so white.
    let mut color = if strength > 0.0 { before / strength } else { Vec3::ONE };
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
    let radiance = strength * color / color.max_element().max(1e-6);
    let mut change = Change::None;
    // Beyond a round trip through the colour's normalisation.
    if (radiance - before).abs().max_element() > 1e-5 * strength.max(1e-6) {
        state.scene.lights[index].radiance = radiance;
        change = Change::Scene;
    }
    if position != position_before {
        state.scene.move_light(index, position - position_before);
        change = Change::Scene;
    }
    change
}

/// A slider that changes nothing until it is touched: what a file says is not rounded.
fn slider(ui: &mut Ui, slider: egui::Slider) {
    ui.add(slider.clamping(egui::SliderClamping::Edits));
}

/// A button that opens a colour picker on a linear Rec. 709 colour in [0, 1].
fn color_button(ui: &mut Ui, color: &mut Vec3) {
    let mut channels = color.to_array();
    if ui.color_edit_button_rgb(&mut channels).changed() {
        *color = Vec3::from_array(channels).clamp(Vec3::ZERO, Vec3::ONE);
    }
}
