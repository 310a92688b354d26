//! How bright a light is, and in which hue.

use egui::Ui;
use glam::Vec3;

use super::super::super::widgets::{Glow, Touch, color_rows, number_box, row, switch};
use crate::scene::black_body;

/// What is changed in how a light shines.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shine {
    pub color: Option<Vec3>,
    pub strength: Option<f32>,
    pub temperature: Option<f32>,
    pub power: Option<f32>,
}

/// The temperature of a light that is given one, kelvin: a halogen lamp's.
const TEMPERATURE: f32 = 3000.0;

/// Rows for brightness, power and hue. `loaded` is the colour that it was loaded with; a power of `unit` makes its strongest channel 1.
/// What is touched last of brightness and power stands, and so with hue and temperature.
pub fn shine_rows(ui: &mut Ui, before: Shine, loaded: Vec3, unit: Option<f32>, (name, about): (&str, &str)) -> Shine {
    let mut shine = before;
    let glow_loaded = Glow::new(loaded, None);
    let glow = Glow::new(before.color.unwrap_or(loaded), before.strength);
    let by_power = before.power.zip(unit.filter(|unit| *unit > 0.0)).map(|(power, unit)| power / unit);
    let shown = by_power.unwrap_or(glow.strength);
    let speed = |shown: f32| 0.02 * shown.max(1e-3);
    let mut set = glow;
    match row(ui, name, about, |ui| number_box(ui, about, shown, 0.0..=f32::MAX, speed(shown))) {
        Touch::Nothing => {}
        Touch::Set(strength) => (set.strength, shine.power) = (strength, None),
        Touch::Reset => (set.strength, shine.power) = (glow_loaded.strength, None),
    }
    if let Some(unit) = unit {
        let about = "What the light sends out in all, in watts, of the strongest of red, green and blue. What is set here stays, however \
                     large the light is made.";
        let power = shown * unit;
        let touch = row(ui, "power", about, |ui| number_box(ui, about, power, 0.0..=f32::MAX, speed(power)));
        touch.apply(&mut shine.power);
    }
    let hue = before.temperature.map_or(glow.hue, black_body::color);
    match color_rows(ui, "hue", "The light's hue. It stays when the light is turned off and on again.", hue) {
        Touch::Nothing => {}
        Touch::Set(color) => (set, shine.temperature) = (set.with_color(color), None),
        Touch::Reset => (set.hue, shine.temperature) = (glow_loaded.hue, None),
    }
    temperature(ui, &mut shine.temperature);
    if set == glow_loaded {
        (shine.color, shine.strength) = (None, None);
    } else if set != glow {
        (shine.color, shine.strength) = (Some(set.hue), Some(set.strength));
    }
    shine
}

/// A hue by temperature, where that is wanted.
fn temperature(ui: &mut Ui, edit: &mut Option<f32>) {
    let about = "Gives the light the hue of a black body so hot, in kelvin: a candle has 1900, a bulb 2700, the sun at noon 5500, a blue \
                 sky 12000.";
    row(ui, "temperature", about, |ui| {
        match switch(ui, "", about, edit.is_some()) {
            Touch::Nothing => {}
            Touch::Set(is_on) => *edit = is_on.then_some(TEMPERATURE),
            Touch::Reset => *edit = None,
        }
        if let Some(kelvin) = *edit {
            number_box(ui, about, kelvin, black_body::RANGE, 20.0).apply(edit);
            ui.weak("K");
        }
    });
}
