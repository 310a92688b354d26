//! What adds lights.

use egui::{Button, Ui};

use super::super::super::adding::New;
use super::super::super::state::State;
use super::super::super::widgets::{button, number_box};
use crate::scene::{LightShape, PunctualShape};

/// What the menu offers, with what each is for.
const OFFERED: [(New, &str); 7] = [
    (New::Area(LightShape::Rectangle), "A rectangle, as windows and softboxes are."),
    (New::Area(LightShape::Disk), "A disk."),
    (New::Area(LightShape::Polygon(3)), "A triangle."),
    (New::Area(LightShape::Polygon(5)), "A pentagon."),
    (New::Punctual(PunctualShape::Point), "A point that shines in all directions."),
    (New::Punctual(PunctualShape::Spot), "A point that shines into a cone."),
    (New::Punctual(PunctualShape::Directional), "A sun: light from infinitely far away."),
];

pub fn show(ui: &mut Ui, state: &mut State) {
    ui.horizontal(|ui| {
        let menu = ui.menu_button("Add light", |ui| {
            for (new, about) in OFFERED {
                if button(ui, about, Button::new(new.name())) {
                    add(ui, state, new);
                }
            }
            ui.horizontal(|ui| polygon(ui, state));
        });
        menu.response.on_hover_text("Adds a light that shines at what is seen.");
        super::rig_switch(ui, state);
    });
}

/// A regular polygon of any number of corners.
fn polygon(ui: &mut Ui, state: &mut State) {
    let id = egui::Id::unique("corners");
    let before: f32 = ui.data(|data| data.get_temp(id)).unwrap_or(6.0);
    let is_wanted = button(ui, "A regular polygon of so many corners.", Button::new("polygon"));
    let about = "How many corners the polygon has, 3 to 64.";
    let range = 3.0..=f32::from(LightShape::MOST_CORNERS);
    let corners = number_box(ui, about, before, range.clone(), 0.1).value(before, 6.0).round();
    let corners = corners.clamp(*range.start(), *range.end());
    ui.data_mut(|data| data.insert_temp(id, corners));
    if is_wanted {
        add(ui, state, New::Area(LightShape::Polygon(corners as u16)));
    }
}

fn add(ui: &mut Ui, state: &mut State, new: New) {
    state.add_light(new);
    state.reveal_chosen();
    ui.close();
}
