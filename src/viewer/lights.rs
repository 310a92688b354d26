//! The part of the panel that shows the lights.

use egui::Ui;
use glam::Vec3;

use super::state::State;
use super::widgets::{Glow, hue_button, number_box, short};
use crate::scene::FARTHEST;

/// Most lights whose sections are open from the start.
const OPEN: usize = 4;

/// Most characters of a light's name.
const NAME_SHOWN: usize = 28;

/// All polygon lights, a section for each.
pub fn show(ui: &mut Ui, state: &mut State) {
    ui.separator();
    ui.strong("Lights");
    let few = state.scene.lights.len() <= OPEN;
    for index in 0..state.scene.lights.len() {
        let name = match state.scene.lights[index].name.as_str() {
            "" => "light",
            name => name,
        };
        let title = format!("{} ({})", short(name, NAME_SHOWN), index + 1);
        let section = egui::CollapsingHeader::new(title).id_salt(index).default_open(few);
        section.show(ui, |ui| light(ui, state, index));
    }
}

fn light(ui: &mut Ui, state: &mut State, index: usize) {
    let loaded = &state.scene.lights[index];
    let before = state.edits.of_light(index);
    let mut edits = before;
    let mut glow = Glow::new(before.radiance.unwrap_or(loaded.radiance), before.strength);
    let glow_before = glow;
    ui.horizontal(|ui| {
        ui.label("radiance");
        let speed = 0.02 * glow.strength.max(1e-3);
        number_box(ui, &mut glow.strength, 0.0..=f32::MAX, speed);
        hue_button(ui, &mut glow);
    });
    if glow != glow_before {
        (edits.radiance, edits.strength) = (Some(glow.hue), Some(glow.strength));
    }
    let position_before = before.position.unwrap_or_else(|| loaded.position());
    let position = position_boxes(ui, position_before, state.step());
    if position != position_before {
        edits.position = Some(position);
    }
    if edits != before {
        state.edits.lights.insert(index, edits);
    }
}

/// Three boxes, in metres; a drag of a point moves by `step`.
fn position_boxes(ui: &mut Ui, mut position: Vec3, step: f32) -> Vec3 {
    ui.label("position");
    ui.horizontal_wrapped(|ui| {
        for coordinate in [&mut position.x, &mut position.y, &mut position.z] {
            number_box(ui, coordinate, -FARTHEST..=FARTHEST, step);
        }
    });
    position
}
