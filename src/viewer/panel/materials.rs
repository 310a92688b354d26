//! The list of materials.

use egui::{ComboBox, PopupCloseBehavior, ScrollArea, TextEdit, Ui};

use super::super::state::State;
use super::super::widgets::{row, short};

/// A list of more materials than this has a box to search it.
const MANY: usize = 12;

/// Most characters of a name in the list.
const NAME_SHOWN: usize = 40;

const ABOUT: &str =
    "The material of the scene that is shown and changed below. Its name stays, whatever it is made to look like.";

/// Lets the user pick a material, where there are several. Its name is the scene's, whatever it is made to look like.
pub fn show(ui: &mut Ui, state: &mut State) {
    if state.scene.materials.len() <= 1 {
        return;
    }
    let before = state.material;
    row(ui, "in the scene", ABOUT, |ui| list(ui, state));
    if state.material != before {
        // It shows the other one.
        state.sheet = None;
    }
}

fn list(ui: &mut Ui, state: &mut State) {
    let names: Vec<&str> = state.scene.materials.iter().map(|material| material.name.as_str()).collect();
    let before = state.material;
    let title = |index: usize| title(&names, index);
    let list = ComboBox::from_id_salt("materials").width(ui.available_width()).truncate();
    let list = list.selected_text(short(&title(before), NAME_SHOWN));
    let list = list.close_behavior(PopupCloseBehavior::CloseOnClickOutside).show_ui(ui, |ui| {
        let search = ui.scope_id().with("search");
        let mut wanted: String = ui.data(|data| data.get_temp(search)).unwrap_or_default();
        if names.len() > MANY {
            let hint = format!("search {} materials", names.len());
            let entry = ui.add(TextEdit::singleline(&mut wanted).hint_text(hint).desired_width(f32::INFINITY));
            entry.on_hover_text("Shows the materials whose names or numbers hold this text.");
            ui.data_mut(|data| data.insert_temp(search, wanted.clone()));
        }
        let found = found(&names, &wanted);
        let height = ui.text_style_height(&egui::TextStyle::Button) + 2.0 * ui.spacing().button_padding.y;
        ScrollArea::vertical().max_height(220.0).show_rows(ui, height, found.len(), |ui, rows| {
            for &index in &found[rows] {
                let name = ui.selectable_label(index == state.material, short(&title(index), NAME_SHOWN));
                if name.on_hover_text(names[index]).clicked() {
                    state.material = index;
                    ui.close();
                }
            }
        });
        if found.is_empty() {
            ui.weak("none has this in its name");
        }
    });
    list.response.on_hover_text(format!("{}\n{ABOUT}", names[before]));
}

/// What a material is called: names may repeat, or be empty, and then its number says which it is.
fn title(names: &[&str], index: usize) -> String {
    let is_told_apart = !names[index].is_empty() && names.iter().filter(|name| **name == names[index]).count() == 1;
    if is_told_apart { names[index].to_owned() } else { format!("{index} {}", names[index]) }
}

/// The materials whose number and name hold a text, whatever its case.
fn found(names: &[&str], wanted: &str) -> Vec<usize> {
    let wanted = wanted.trim().to_lowercase();
    let holds = |&index: &usize| format!("{index} {}", names[index]).to_lowercase().contains(&wanted);
    (0..names.len()).filter(holds).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_for_those_that_names_do_not_tell_apart() {
        let names = ["velvet", "felt", "velvet", ""];
        assert_eq!([0, 1, 2, 3].map(|index| title(&names, index)), ["0 velvet", "felt", "2 velvet", "3 "]);
    }

    #[test]
    fn what_is_wanted_is_found_whatever_its_case() {
        let names = ["Velvet", "felt.001", "felt", "", "GRÜN velvet"];
        for (wanted, expected) in [
            ("", vec![0, 1, 2, 3, 4]),
            ("velvet ", vec![0, 4]),
            ("FELT", vec![1, 2]),
            ("grün", vec![4]),
            ("3", vec![3]),
        ] {
            assert_eq!(found(&names, wanted), expected, "{wanted}");
        }
        assert!(found(&names, "silk").is_empty());
    }
}
