//! The part of the panel that shows one material: its sheen, how that lies on the base, and the base.

use egui::{Align, Layout, Ui};
use glam::Vec3;

use super::state::State;
use super::widgets::{color_button, share_slider, short};
use crate::scene::{Drawn, Layering, Material, MaterialEdits, RoughnessMap, Sheen, SheenModel, TextureSlot};

/// Share of the base that is left when layering is first made manual.
const MANUAL: f32 = 0.5;

/// Most characters of a name in the list of materials.
const NAME_SHOWN: usize = 34;

/// The material that the user has picked. What is not touched is left unset.
pub fn show(ui: &mut Ui, state: &mut State) {
    ui.strong("Sheen");
    let materials = &state.scene.materials;
    if materials.len() > 1 {
        // Names may repeat, or be empty.
        let name = |index: usize| short(&format!("{index} {}", materials[index].name), NAME_SHOWN);
        let width = ui.available_width() - 60.0;
        let list = egui::ComboBox::from_label("material").width(width).truncate();
        let shown = list.show_index(ui, &mut state.material, materials.len(), name);
        shown.on_hover_text(&materials[state.material].name);
    }
    let material = &Drawn::new(&state.scene, &state.edits).materials[state.material];
    let mut changed = MaterialEdits::default();
    let before = state.edits.of_material(state.material);
    match material.sheen {
        Some(sheen) => show_sheen(ui, &sheen, (material, &before), &mut changed),
        None if material.unlit => drop(ui.weak("unlit: it shines as it is")),
        None => {
            if ui.button("Add a sheen").clicked() {
                (changed.alpha, changed.sheen_color) = (Some(0.5), Some(Vec3::ONE));
            }
        }
    }
    show_base(ui, material, &mut changed);
    if changed != MaterialEdits::default() {
        let own = state.edits.materials.entry(state.material).or_default();
        *own = changed.or(*own);
    }
}

/// What the user has made of a value, where that is another.
fn changed<T: PartialEq>(before: T, after: T) -> Option<T> {
    (after != before).then_some(after)
}

fn show_sheen(ui: &mut Ui, sheen: &Sheen, (material, before): (&Material, &MaterialEdits), edits: &mut MaterialEdits) {
    let mut alpha = sheen.alpha();
    ui.label("alpha");
    ui.horizontal(|ui| {
        ui.label("fuzz");
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.label("dust");
            // Its box, and room at the panel's edge.
            let value_width = 56.0;
            ui.spacing_mut().slider_width = ui.available_width() - value_width;
            share_slider(ui, &mut alpha);
        });
    });
    edits.alpha = changed(sheen.alpha(), alpha);
    let mut color = sheen.color;
    ui.horizontal(|ui| {
        ui.label("C_sheen");
        color_button(ui, &mut color);
        let is_textured =
            [TextureSlot::SheenColor, TextureSlot::SheenWeight].map(|slot| material.texture(slot).is_some());
        if is_textured != [false; 2] {
            ui.weak("x texture, until it is changed");
        } else if sheen.weight < 1.0 {
            ui.weak(format!("x {:.2}, until it is changed", sheen.weight));
        }
    });
    edits.sheen_color = changed(sheen.color, color);
    let mut map = sheen.roughness_map;
    // It makes alpha of a file's roughness: of an alpha that is set it makes nothing.
    ui.add_enabled_ui(before.alpha.is_none(), |ui| {
        ui.horizontal(|ui| {
            ui.label("roughness map");
            pick(ui, "roughness map", &mut map, &ROUGHNESS_MAPS);
        });
    })
    .response
    .on_disabled_hover_text("alpha is set: the file's roughness does not count");
    edits.roughness_map = changed(sheen.roughness_map, map);
    edits.layering = changed(sheen.layering, layering(ui, sheen.layering));
    let mut model = sheen.model;
    ui.horizontal(|ui| {
        ui.label("sheen model");
        let models = SheenModel::NAMES.into_iter().filter(|(_, model)| model.is_real_time());
        pick(ui, "sheen model", &mut model, &models.collect::<Vec<_>>());
    });
    edits.sheen_model = changed(sheen.model, model);
}

fn layering(ui: &mut Ui, mut layering: Layering) -> Layering {
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
            share_slider(ui, share);
        });
    }
    layering
}

fn show_base(ui: &mut Ui, material: &Material, edits: &mut MaterialEdits) {
    ui.separator();
    ui.strong("Base");
    let (mut color, mut metallic, mut roughness) = (material.base_color, material.metallic, material.roughness);
    let textured = |slot: TextureSlot| if material.texture(slot).is_some() { "x texture" } else { "" };
    ui.horizontal(|ui| {
        ui.label("base colour");
        color_button(ui, &mut color);
        ui.weak(textured(TextureSlot::BaseColor));
    });
    ui.horizontal(|ui| {
        ui.label("metallic");
        share_slider(ui, &mut metallic);
    });
    ui.horizontal(|ui| {
        ui.label("roughness");
        share_slider(ui, &mut roughness);
    });
    let below = textured(TextureSlot::MetallicRoughness);
    if !below.is_empty() {
        ui.weak(below);
    }
    edits.base_color = changed(material.base_color, color);
    edits.metallic = changed(material.metallic, metallic);
    edits.roughness = changed(material.roughness, roughness);
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
