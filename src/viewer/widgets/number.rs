//! Boxes and sliders of numbers.

use std::cell::Cell;
use std::ops::RangeInclusive;

use egui::emath::Numeric;
use egui::{Align, DragValue, Id, Key, Layout, Sense, Slider, SliderClamping, Ui, vec2};

use super::control::{About, Touch, control, double_click_control, refuse};
use super::row;
use super::sum::evaluate;

/// Digits of a number that its box shows.
const DIGITS: i32 = 4;

/// Numbers of magnitudes outside of this range are shown with an exponent, so that boxes stay narrow.
const PLAIN: std::ops::Range<i32> = -3..6;

/// The least width of a box, in points.
pub const BOX: f32 = 54.0;

/// A box with a number; a drag over a point of the screen changes it by `speed`. It changes nothing until it is touched:
/// values from a file are not rounded, and what is typed stands as it was typed.
pub fn number_box<'a>(
    ui: &mut Ui,
    about: impl Into<About<'a>>,
    value: f32,
    range: RangeInclusive<f32>,
    speed: f32,
) -> Touch<f32> {
    let before = f64::from(value);
    let parse = |text: &str| match typed(text, before) {
        Typed::Unchanged => Ok(None),
        Typed::Number(number) => Ok(Some(number)),
        Typed::Nonsense => Err(format!("\"{}\" is no number: {} stays", text.trim(), written(before))),
    };
    typed_box(ui, about.into(), value, parse, |number| {
        let number = number.range(range).clamp_existing_to_range(false).speed(speed).min_size(vec2(BOX, 0.0));
        number.custom_formatter(|value, _| written(value))
    })
}

/// A box with a whole number.
pub fn count_box<'a>(ui: &mut Ui, about: impl Into<About<'a>>, value: u32, range: RangeInclusive<u32>) -> Touch<u32> {
    let parse = |text: &str| match typed(text, value.into()) {
        Typed::Unchanged => Ok(None),
        Typed::Number(number) => Ok(Some(number.round())),
        Typed::Nonsense => Err(format!("\"{}\" is no number: {value} stays", text.trim())),
    };
    typed_box(ui, about.into(), value, parse, |number| number.range(range).min_size(vec2(BOX, 0.0)))
}

/// A box of a number that is typed in any form, and taken once the box is left by any key but Esc. `parse` makes a number
/// of its text, or none where that is as it was; what it refuses is said.
pub fn typed_box<T: Numeric>(
    ui: &mut Ui,
    about: About,
    value: T,
    parse: impl Fn(&str) -> Result<Option<f64>, String>,
    change: impl FnOnce(DragValue) -> DragValue,
) -> Touch<T> {
    let is_left_by_esc = is_left_by_esc(ui);
    let refusal = Cell::new(None);
    let parse = |text: &str| match parse(text) {
        Ok(number) => number.filter(|_| !is_left_by_esc),
        Err(what) => {
            refusal.set(Some(what));
            None
        }
    };
    let touch = control(ui, about, &value, |ui, value| {
        ui.add(change(DragValue::new(value)).update_while_editing(false).custom_parser(parse))
    });
    if let Some(what) = refusal.take().filter(|_| !is_left_by_esc) {
        refuse(ui, what);
    }
    touch
}

/// Whether Esc was pressed in this pass or the last two: so long egui says that a box has just lost the focus, but not by
/// which key, and takes what was typed.
fn is_left_by_esc(ui: &Ui) -> bool {
    let (id, pass) = (Id::unique("Esc"), ui.ctx().cumulative_pass_nr());
    if ui.input(|input| input.key_pressed(Key::Escape)) {
        ui.data_mut(|data| data.insert_temp(id, pass));
    }
    ui.data(|data| data.get_temp::<u64>(id)).is_some_and(|pressed| pass <= pressed + 2)
}

/// A slider without its box. It changes nothing until it is touched, either.
pub fn slider<'a>(
    ui: &mut Ui,
    about: impl Into<About<'a>>,
    value: f32,
    range: RangeInclusive<f32>,
    change: impl FnOnce(Slider) -> Slider,
) -> Touch<f32> {
    double_click_control(ui, about, &value, |ui, value| {
        let slider = change(Slider::new(value, range)).show_value(false).clamping(SliderClamping::Edits);
        // By itself a slider knows of drags alone.
        ui.add(slider).interact(Sense::click_and_drag())
    })
}

/// A row with a number's name, a slider over what is left, and a box.
pub fn slider_row<'a>(
    ui: &mut Ui,
    label: &str,
    about: impl Into<About<'a>>,
    value: f32,
    range: RangeInclusive<f32>,
    change: impl FnOnce(Slider) -> Slider,
) -> Touch<f32> {
    let about = about.into();
    row(ui, label, about.text, |ui| {
        let from_right = Layout::right_to_left(Align::Center);
        ui.with_layout(from_right, |ui| {
            let speed = (range.end() - range.start()) / 400.0;
            let typed = number_box(ui, about, value, range.clone(), speed);
            ui.spacing_mut().slider_width = ui.available_width();
            typed.or(slider(ui, about, value, range, change))
        })
        .inner
    })
}

/// A row for a number in [0, 1].
pub fn share_row<'a>(ui: &mut Ui, label: &str, about: impl Into<About<'a>>, share: f32) -> Touch<f32> {
    slider_row(ui, label, about, share, 0.0..=1.0, |slider| slider)
}

/// A number as its box shows it.
pub fn written(value: f64) -> String {
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

/// What the text of a box stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Typed {
    /// It is still what the box showed, which may be more precise.
    Unchanged,
    Number(f64),
    Nonsense,
}

fn typed(text: &str, before: f64) -> Typed {
    if text.trim() == written(before) {
        return Typed::Unchanged;
    }
    evaluate(text).map_or(Typed::Nonsense, Typed::Number)
}

#[cfg(test)]
mod tests {
    use super::*;

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
            assert_eq!(typed(shown, value), Typed::Unchanged);
            assert_eq!(typed(shown, 7.0), Typed::Number(shown.parse().unwrap()));
        }
        assert_eq!((typed("1/4", 1.0), typed("2..", 1.0)), (Typed::Number(0.25), Typed::Nonsense));
    }
}
