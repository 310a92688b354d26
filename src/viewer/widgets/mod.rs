//! Widgets that several parts of the panel have.

mod color;
mod control;
mod glow;
mod number;
mod picker;
mod sum;

use egui::{Align, CollapsingHeader, ComboBox, Label, Layout, RichText, Ui, vec2};

pub use color::color_rows;
pub use control::{About, Touch, button, control, refused};
pub use glow::Glow;
pub use number::{count_box, number_box, share_row, slider, slider_row, written};

/// The width of the column of names, in points.
pub const LABEL: f32 = 92.0;

/// A row with a name in the left column.
pub fn row<R>(ui: &mut Ui, label: &str, about: &str, add: impl FnOnce(&mut Ui) -> R) -> R {
    ui.horizontal(|ui| {
        let size = vec2(LABEL, ui.spacing().interact_size.y);
        ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
            ui.set_min_size(size);
            ui.add(Label::new(label).truncate().selectable(false)).on_hover_text(about);
        });
        add(ui)
    })
    .inner
}

/// A part of the panel that folds under its title, and stays as the user leaves it.
pub fn fold(ui: &mut Ui, title: &str, is_open: bool, add: impl FnOnce(&mut Ui)) {
    let header = CollapsingHeader::new(RichText::new(title).strong()).id_salt(title).default_open(is_open);
    let response = header.show_unindented(ui, add).header_response;
    response.on_hover_text("Click to fold this part of the panel away, or to open it.");
}

/// A switch.
pub fn switch<'a>(ui: &mut Ui, label: &str, about: impl Into<About<'a>>, is_on: bool) -> Touch<bool> {
    control(ui, about, &is_on, |ui, is_on| ui.checkbox(is_on, label))
}

/// A value of several, with its name and what it does.
pub type Choice<'a, T> = (&'a str, T, &'a str);

/// A few values beside each other.
pub fn choice<T: Copy + PartialEq>(ui: &mut Ui, value: T, choices: &[Choice<T>]) -> Touch<T> {
    choices.iter().fold(Touch::Nothing, |touch, &(name, listed, about)| {
        touch.or(control(ui, about, &value, |ui, value| ui.selectable_value(value, listed, name)))
    })
}

/// A list of values that opens.
pub fn list<'a, T: Copy + PartialEq>(
    ui: &mut Ui,
    id: &str,
    about: impl Into<About<'a>>,
    value: T,
    choices: &[Choice<T>],
) -> Touch<T> {
    let shown = choices.iter().find(|(_, listed, _)| *listed == value).map_or("", |(name, ..)| name);
    control(ui, about, &value, |ui, value| {
        let list = ComboBox::from_id_salt(id).width(ui.available_width()).selected_text(shown);
        let list = list.show_ui(ui, |ui| {
            for &(name, listed, about) in choices {
                ui.selectable_value(value, listed, name).on_hover_text(about);
            }
        });
        list.response
    })
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
    fn long_names_keep_both_ends() {
        assert_eq!(short("velvet", 6), "velvet");
        assert_eq!(short("velvet.001", 7), "vel…001");
        assert_eq!(short("grün-grün-grün", 5).chars().count(), 5);
    }
}
