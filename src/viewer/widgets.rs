//! Widgets that several parts of the panel have.

use egui::Ui;
use glam::Vec3;

/// A slider that changes nothing until it is touched: values from a file are not rounded.
pub fn slider(ui: &mut Ui, slider: egui::Slider) {
    ui.add(slider.clamping(egui::SliderClamping::Edits));
}

/// What egui's picker may add to a channel by rounding on the way through hue, saturation and value; the least that a
/// user can change is thirty times as much.
const ROUNDING: f32 = 1e-5;

/// A button that opens a colour picker on a linear Rec. 709 colour in [0, 1].
pub fn color_button(ui: &mut Ui, color: &mut Vec3) {
    let mut channels = color.to_array();
    // egui also calls a colour changed that its open picker has only rounded.
    if ui.color_edit_button_rgb(&mut channels).changed() {
        let picked = Vec3::from_array(channels).clamp(Vec3::ZERO, Vec3::ONE);
        if !picked.abs_diff_eq(*color, ROUNDING) {
            *color = picked;
        }
    }
}
