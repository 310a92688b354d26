//! The part of the panel that shows one material.

use egui::{Align, Layout, Ui};
use glam::Vec3;

use super::state::{Change, State};
use super::widgets::{color_button, slider};
use crate::scene::{Layering, Overrides, RoughnessMap, Sheen, SheenModel};

/// Share of the base that is left when layering is first made manual.
const MANUAL: f32 = 0.5;

/// The sheen of the material that the user has picked, and how it lies on the base.
pub fn show(ui: &mut Ui, state: &mut State) -> Change {
    ui.strong("Sheen");
    if state.scene.materials.len() > 1 {
        // Names may repeat, or be empty.
        let name = |index: usize| format!("{index} {}", state.scene.materials[index].name);
        let width = ui.available_width() - 60.0;
        let list = egui::ComboBox::from_label("material").width(width).truncate();
        list.show_index(ui, &mut state.material, state.scene.materials.len(), name);
    }
    sheen(ui, state).max(overrides(ui, state))
}

/// The material's own parameters.
fn sheen(ui: &mut Ui, state: &mut State) -> Change {
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
    // A material without sheen stays without until it is given a colour.
    if Some(sheen) == before || (before.is_none() && sheen.color == Vec3::ZERO) {
        return Change::None;
    }
    // With a weight of 0 nobody would see the change.
    if sheen.weight == 0.0 {
        sheen.weight = 1.0;
    }
    state.scene.materials[state.material].sheen = Some(sheen);
    Change::Scene
}

/// What the settings change in the material. What the user does not touch is left unset.
fn overrides(ui: &mut Ui, state: &mut State) -> Change {
    let index = state.material;
    let before = state.settings.overrides_of(index);
    let mut map = before.roughness_map.unwrap_or_default();
    ui.horizontal(|ui| {
        ui.label("roughness map");
        pick(ui, "roughness map", &mut map, &ROUGHNESS_MAPS);
    });
    let mut layering = state.settings.layering_of(index);
    ui.horizontal(|ui| {
        ui.label("layering");
        // Picking manual from the list keeps the share that is set already.
        let manual = if let Layering::Manual(share) = layering { share } else { MANUAL };
        let layerings = [
            ("glTF", Layering::Gltf),
            ("OpenPBR", Layering::OpenPbr),
            ("reciprocal", Layering::Reciprocal),
            ("manual", Layering::Manual(manual)),
            ("none", Layering::None),
        ];
        pick(ui, "layering", &mut layering, &layerings);
    });
    if let Layering::Manual(share) = &mut layering {
        ui.horizontal(|ui| {
            ui.label("base's share");
            slider(ui, egui::Slider::new(share, 0.0..=1.0).fixed_decimals(2));
        });
    }
    let mut model = before.sheen_model.unwrap_or_default();
    ui.horizontal(|ui| {
        ui.label("sheen model");
        let models = SheenModel::NAMES.into_iter().filter(|(_, model)| model.is_real_time());
        pick(ui, "sheen model", &mut model, &models.collect::<Vec<_>>());
    });
    let mut changed = Overrides::default();
    if map != before.roughness_map.unwrap_or_default() {
        changed.roughness_map = Some(map);
    }
    if layering != state.settings.layering_of(index) {
        changed.layering = Some(layering);
    }
    if model != before.sheen_model.unwrap_or_default() {
        changed.sheen_model = Some(model);
    }
    if changed == Overrides::default() {
        return Change::None;
    }
    let own = state.settings.material_overrides.entry(index).or_default();
    *own = changed.or(*own);
    Change::Scene
}

const ROUGHNESS_MAPS: [(&str, RoughnessMap); 3] =
    [("identity", RoughnessMap::Identity), ("square", RoughnessMap::Square), ("square root", RoughnessMap::Sqrt)];

/// A list of values by their names.
fn pick<T: Copy + PartialEq>(ui: &mut Ui, id: &str, value: &mut T, values: &[(&str, T)]) {
    let shown = values.iter().find(|(_, listed)| listed == value).map_or("", |(name, _)| name);
    egui::ComboBox::from_id_salt(id).selected_text(shown).show_ui(ui, |ui| {
        for (name, listed) in values {
            ui.selectable_value(value, *listed, *name);
        }
    });
}
