//! Colours: a swatch with a picker, sRGB in hexadecimal, and linear numbers.

use egui::{Rgba, Ui, vec2};
use glam::Vec3;

use super::control::{About, Touch, double_click_control};
use super::number::{number_box, typed_box};
use super::picker::color_button;
use super::{LABEL, row};

/// A colour, linear Rec. 709 in [0, 1]: a row with its name, a swatch and a box for sRGB, and one with linear numbers.
pub fn color_rows<'a>(ui: &mut Ui, label: &str, about: impl Into<About<'a>>, color: Vec3) -> Touch<Vec3> {
    let about = about.into();
    let first = row(ui, label, about.text, |ui| {
        let swatched = swatch(ui, about, color);
        swatched.or(hex_box(ui, about, color))
    });
    let numbers = ui.horizontal(|ui| {
        ui.add_space(LABEL + ui.spacing().item_spacing.x);
        let mut touched = Touch::Nothing;
        for (channel, name) in ["red", "green", "blue"].into_iter().enumerate() {
            let text = format!("The share of {name} in [0, 1], as light is added up (linear, not sRGB).");
            let about = About { text: &text, ..about };
            let number = number_box(ui, about, color[channel], 0.0..=1.0, 0.003);
            let with = |share: f32| {
                let mut color = color;
                color[channel] = share;
                color
            };
            touched = touched.or(number.map(with));
        }
        touched
    });
    first.or(numbers.inner)
}

/// A button that shows a colour and opens a picker.
fn swatch(ui: &mut Ui, about: About, color: Vec3) -> Touch<Vec3> {
    let text = format!("{}\nClick to pick a colour; the swatch shows it as it is picked.", about.text);
    double_click_control(ui, About { text: &text, ..about }, &color, color_button)
}

/// A box for the colour as the web writes it.
fn hex_box(ui: &mut Ui, about: About, color: Vec3) -> Touch<Vec3> {
    let text = "The same colour in sRGB as the web writes it, say #a0c030 or a0c030 or #ac3: type or paste it.";
    // The number that the digits are: egui's box of numbers brings all that typing takes.
    let before = packed(color);
    let parse = |text: &str| match packed_from_hex(text) {
        Some(typed) => Ok(Some(f64::from(typed)).filter(|_| typed != before)),
        None => Err(format!("\"{}\" is no colour: give three or six digits, say #a0c030", text.trim())),
    };
    let touch = typed_box(ui, About { text, ..about }, before, parse, |hex| {
        hex.speed(0.0).min_size(vec2(72.0, 0.0)).custom_formatter(|value, _| format!("#{:06x}", value as u32))
    });
    touch.map(unpacked)
}

/// The sRGB digits of a linear colour as one number: red is the greatest byte.
fn packed(color: Vec3) -> u32 {
    let [r, g, b, _] = Rgba::from_rgb(color.x, color.y, color.z).to_srgba_unmultiplied();
    u32::from_be_bytes([0, r, g, b])
}

/// The linear colour of such a number.
fn unpacked(packed: u32) -> Vec3 {
    let [_, r, g, b] = packed.to_be_bytes();
    let color = Rgba::from_srgba_unmultiplied(r, g, b, 255);
    Vec3::new(color.r(), color.g(), color.b())
}

/// The number of `#a0c030`, `a0c030`, `#ac3` or `ac3`.
fn packed_from_hex(text: &str) -> Option<u32> {
    let digits = text.trim();
    let digits = digits.strip_prefix('#').unwrap_or(digits);
    // A sign would be read as part of a number.
    if !digits.chars().all(|digit| digit.is_ascii_hexdigit()) {
        return None;
    }
    let long = match digits.len() {
        3 => digits.chars().flat_map(|digit| [digit, digit]).collect(),
        6 => digits.to_owned(),
        _ => return None,
    };
    u32::from_str_radix(&long, 16).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_read_in_all_spellings_and_come_back_the_same() {
        for (text, expected) in [
            ("#a0c030", Some(0xa0_c030)),
            ("A0C030", Some(0xa0_c030)),
            (" #ac3 ", Some(0xaa_cc33)),
            ("fff", Some(0xff_ffff)),
            ("#", None),
            ("#abcd", None),
            ("+abcde", None),
            ("#12345g", None),
            ("grün", None),
            ("", None),
        ] {
            assert_eq!(packed_from_hex(text), expected, "{text}");
        }
        for value in (0..0x100_0000).step_by(4099) {
            assert_eq!(packed(unpacked(value)), value, "{value:06x}");
        }
        // sRGB 128 is the linear ((128/255 + 0.055) / 1.055)^2.4.
        let half = ((128.0f64 / 255.0 + 0.055) / 1.055).powf(2.4) as f32;
        assert!(unpacked(0x80_0000).abs_diff_eq(half * Vec3::X, 1e-5));
    }
}
