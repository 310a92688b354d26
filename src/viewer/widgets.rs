//! Widgets that several parts of the panel have.

use std::ops::RangeInclusive;

use egui::Ui;
use glam::Vec3;

/// Digits of a number that its box shows.
const DIGITS: i32 = 4;

/// Numbers of magnitudes outside of this range are shown with an exponent, so that boxes stay narrow.
const PLAIN: std::ops::Range<i32> = -3..6;

/// A slider that changes nothing until it is touched: values from a file are not rounded, and what is typed into its
/// box stands as it was typed.
pub fn slider(
    ui: &mut Ui,
    value: &mut f32,
    range: RangeInclusive<f32>,
    change: impl FnOnce(egui::Slider) -> egui::Slider,
) {
    let before = f64::from(*value);
    let slider = change(egui::Slider::new(value, range)).clamping(egui::SliderClamping::Edits);
    ui.add(slider.custom_formatter(|value, _| written(value)).custom_parser(move |text| typed(text, before)));
}

/// A slider for a number in [0, 1].
pub fn share_slider(ui: &mut Ui, share: &mut f32) {
    slider(ui, share, 0.0..=1.0, |slider| slider);
}

/// A box with a number; a drag over a point of the screen changes it by `speed`. It changes nothing until it is
/// touched, as a slider does.
pub fn number_box(ui: &mut Ui, value: &mut f32, range: RangeInclusive<f32>, speed: f32) {
    let before = *value;
    let number = egui::DragValue::new(value).range(range).clamp_existing_to_range(false).speed(speed);
    let number = number.custom_formatter(|value, _| written(value));
    let response = ui.add(number.custom_parser(move |text| typed(text, before.into())));
    if !response.has_focus() {
        response.on_hover_text(before.to_string());
    }
}

/// A number as its box shows it.
fn written(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let magnitude = value.abs().log10().floor() as i32;
    if !PLAIN.contains(&magnitude) {
        return format!("{:.*e}", 2, value);
    }
    let decimals = (DIGITS - 1 - magnitude).max(0) as usize;
    let digits = format!("{value:.decimals$}");
    match digits.contains('.') {
        true => digits.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => digits,
    }
}

/// The number that a box's text stands for. `None` where it is still what the box showed for `before`, which may be
/// more precise.
fn typed(text: &str, before: f64) -> Option<f64> {
    let text = text.trim().replace('\u{2212}', "-");
    if text == written(before) { None } else { text.parse().ok().filter(|number: &f64| number.is_finite()) }
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

/// A colour button on the hue of a glow.
pub fn hue_button(ui: &mut Ui, glow: &mut Glow) {
    let mut color = glow.hue;
    color_button(ui, &mut color);
    if color != glow.hue {
        glow.set_color(color);
    }
}

/// A radiance as users set it: its greatest channel, and its hue. The hue stays when the radiance goes to 0 and back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glow {
    pub strength: f32,
    /// The greatest channel is 1.
    pub hue: Vec3,
}

impl Glow {
    /// Of the radiance `strength` times `radiance`. The hue of black is white.
    pub fn new(radiance: Vec3, strength: Option<f32>) -> Self {
        let greatest = radiance.max_element();
        let hue = if greatest > 0.0 { radiance / greatest } else { Vec3::ONE };
        Self { strength: strength.unwrap_or(1.0) * greatest, hue }
    }

    /// The hue of the colour that a picker gives, which may be darker. Black has none.
    fn set_color(&mut self, color: Vec3) {
        if color != Vec3::ZERO {
            self.hue = Self::new(color, None).hue;
        }
    }
}

/// A name of at most `most` characters, cut in its middle: what tells names apart is often at their ends.
pub fn short(name: &str, most: usize) -> String {
    let count = name.chars().count();
    if count <= most {
        return name.to_owned();
    }
    let (front, back) = (most / 2, most - most / 2 - 1);
    name.chars().take(front).chain(['…']).chain(name.chars().skip(count - back)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_glow_is_its_radiance_and_black_keeps_its_hue() {
        let radiance = Vec3::new(0.5, 2.0, 1.0);
        let glow = Glow::new(radiance, None);
        assert_eq!((glow.strength, glow.strength * glow.hue), (2.0, radiance));
        // As edits keep it: the hue, and its strength.
        let dark = Glow::new(glow.hue, Some(0.0));
        assert_eq!((dark.strength, dark.hue), (0.0, glow.hue));
        assert_eq!(Glow::new(dark.hue, Some(3.3)), Glow { strength: 3.3, hue: glow.hue });
        assert_eq!(Glow::new(Vec3::ZERO, None), Glow { strength: 0.0, hue: Vec3::ONE });
        let mut picked = glow;
        picked.set_color(Vec3::ZERO);
        assert_eq!(picked, glow);
        picked.set_color(Vec3::new(0.0, 0.5, 0.25));
        assert_eq!(picked, Glow { hue: Vec3::new(0.0, 1.0, 0.5), ..glow });
    }

    #[test]
    fn boxes_are_narrow_and_what_they_show_changes_nothing() {
        for (value, shown) in [
            (0.0, "0"),
            (0.3f32, "0.3"),
            (-0.001_234_56, "-0.001235"),
            (1234.567, "1235"),
            (-999_999.0, "-999999"),
            (1e6, "1.00e6"),
            (-3.333e-4, "-3.33e-4"),
            (9.9999, "10"),
        ] {
            let value = f64::from(value);
            assert_eq!(written(value), shown);
            assert_eq!(typed(shown, value), None);
            assert_eq!(typed(shown, 7.0), shown.parse().ok());
        }
        assert_eq!((typed(" \u{2212}2.5 ", 1.0), typed("2..", 1.0), typed("nan", 1.0)), (Some(-2.5), None, None));
    }

    #[test]
    fn long_names_keep_both_ends() {
        assert_eq!(short("velvet", 6), "velvet");
        assert_eq!(short("velvet.001", 7), "vel…001");
        assert_eq!(short("grün-grün-grün", 5).chars().count(), 5);
    }
}
