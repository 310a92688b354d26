//! The part of the panel that shows one material: its sheen, how that lies on the base, and the base.

use egui::Ui;
use glam::Vec3;

use super::super::state::State;
use super::super::widgets::{About, Touch, color_rows, list, row, share_row, switch};
use super::{alpha, materials, presets};
use crate::scene::{Drawn, Edits, Layering, Material, MaterialEdits, RoughnessMap, Sheen, SheenModel, TextureSlot};

/// Share of the base that is left when layering is first made manual.
const MANUAL: f32 = 0.5;

const NO_SHEEN: &str = "This material has no sheen: tick \"has a sheen\" to add one.";
const UNLIT: &str = "This material is unlit: it shines in its base colour whatever lights it, so this changes nothing.";

/// What is shown of a material.
struct Shown {
    /// As it is drawn.
    material: Material,
    /// Its sheen; where it has none, the one that it would get.
    sheen: Sheen,
    /// What edits say of it, its own or those of all.
    set: MaterialEdits,
    /// Why its sheen cannot be changed.
    no_sheen: Option<&'static str>,
    /// Why nothing can be changed but its base colour.
    unlit: Option<&'static str>,
}

impl Shown {
    fn new(state: &State) -> Self {
        let index = state.material;
        let material = |edits: &Edits| Drawn::material(&state.scene, edits, index);
        let shown = material(&state.edits);
        let unlit = shown.unlit.then_some(UNLIT);
        let with_sheen = || {
            let mut edits = state.edits.clone();
            edits.materials.entry(index).or_default().sheen = Some(true);
            material(&edits).sheen
        };
        let sheen = shown.sheen.or_else(with_sheen).unwrap_or(Sheen::new(Vec3::ONE, 0.5));
        let no_sheen = unlit.or(shown.sheen.is_none().then_some(NO_SHEEN));
        Self { sheen, set: state.edits.of_material(index), no_sheen, unlit, material: shown }
    }

    fn has(&self, slot: TextureSlot) -> bool {
        self.material.texture(slot).is_some()
    }
}

/// The material that the user has picked. What is not touched is left unset.
pub fn show(ui: &mut Ui, state: &mut State) {
    materials::show(ui, state);
    let shown = Shown::new(state);
    let before = state.edits.materials.get(&state.material).copied().unwrap_or_default();
    let mut own = before;
    presets::show(ui, &shown.set, shown.unlit, &mut own);
    ui.add_space(4.0);
    alpha::show(ui, shown.sheen.alpha(), shown.no_sheen).apply(&mut own.alpha);
    if own != before {
        state.edits.materials.insert(state.material, own);
    }
    alpha::show_buttons(ui, state, shown.sheen.alpha(), shown.no_sheen);
    let before = state.edits.materials.get(&state.material).copied().unwrap_or_default();
    let mut own = before;
    ui.add_space(4.0);
    sheen(ui, &shown, &mut own);
    rules(ui, &shown, &mut own);
    ui.add_space(4.0);
    base(ui, &shown, &mut own);
    if own != before {
        state.edits.materials.insert(state.material, own);
        state.edits.materials.retain(|_, edits| *edits != MaterialEdits::default());
    }
}

fn sheen(ui: &mut Ui, shown: &Shown, own: &mut MaterialEdits) {
    let about = "The layer of fibres or dust on the material. Off takes it away, and on brings it back as it was.";
    switch(ui, "has a sheen", About::unless(about, shown.unlit), shown.no_sheen.is_none()).apply(&mut own.sheen);
    let sheen = &shown.sheen;
    let textured = shown.has(TextureSlot::SheenColor) || shown.has(TextureSlot::SheenWeight);
    let about = match textured {
        false => "The colour of the fibres or the dust, C_sheen: what light keeps each time it meets one.",
        true => {
            "The colour of the fibres or the dust, C_sheen; the file multiplies it by a texture, until it is changed."
        }
    };
    let color = color_rows(ui, "sheen colour", About::unless(about, shown.no_sheen), sheen.color);
    if let Touch::Set(_) = color
        && sheen.weight != 1.0
        && !shown.has(TextureSlot::SheenWeight)
    {
        // A colour alone covers all of the surface; here it is the colour that is changed, and no more.
        own.sheen_weight = Some(sheen.weight);
    }
    color.apply(&mut own.sheen_color);
    let about = match shown.has(TextureSlot::SheenWeight) {
        false => "How much of the surface the layer covers: 0 none of it, 1 all.",
        true => "How much of the surface the layer covers; the file has a texture for that, until it is changed.",
    };
    share_row(ui, "coverage", About::unless(about, shown.no_sheen), sheen.weight).apply(&mut own.sheen_weight);
}

/// The rules of the sheen that a file leaves open.
fn rules(ui: &mut Ui, shown: &Shown, own: &mut MaterialEdits) {
    let sheen = &shown.sheen;
    let layering = if let Layering::Manual(share) = sheen.layering { share } else { MANUAL };
    let layerings = [
        ("glTF", Layering::Gltf, "As much is left below as the layer does not send back, by its brightest channel."),
        ("OpenPBR", Layering::OpenPbr, "As much is left below as the layer does not send back, as if it were white."),
        ("reciprocal", Layering::Reciprocal, "As glTF, but seen from the view and from the light: the lesser of both."),
        ("manual", Layering::Manual(layering), "As much is left below as you say."),
        ("none", Layering::None, "All is left below: the layer's light is added."),
    ];
    let about = "How much of the light reaches the surface below the layer.";
    let named = About::unless(about, shown.no_sheen);
    let layering = row(ui, "layering", about, |ui| list(ui, "layering", named, sheen.layering, &layerings));
    layering.apply(&mut own.layering);
    if let Layering::Manual(share) = sheen.layering {
        let about = About::unless("The share of the surface below that is seen through the layer.", shown.no_sheen);
        share_row(ui, "base's share", about, share).map(Layering::Manual).apply(&mut own.layering);
    }
    let maps = [
        ("identity", RoughnessMap::Identity, "Alpha is the file's roughness, as in OpenPBR."),
        ("square", RoughnessMap::Square, "Alpha is the square of the file's roughness, as in glTF's own model."),
        ("square root", RoughnessMap::Sqrt, "Alpha is the square root of the file's roughness."),
    ];
    let about = "How the file's roughness of the layer becomes alpha.";
    // It makes alpha of a file's roughness: of an alpha that is set it makes nothing.
    let set = shown
        .set
        .alpha
        .and(Some("Alpha is set: the file's roughness does not count. Double-click alpha to use it again."));
    let named = About::unless(about, shown.no_sheen.or(set));
    row(ui, "roughness map", about, |ui| list(ui, "roughness map", named, sheen.roughness_map, &maps))
        .apply(&mut own.roughness_map);
    let about = "Which model of the layer is drawn: ltc is Velour's; the others are earlier work, to compare with.";
    let models: Vec<_> = SheenModel::NAMES
        .into_iter()
        .filter(|(_, model)| model.is_real_time())
        .map(|(name, model)| (name, model, model_about(model)))
        .collect();
    let named = About::unless(about, shown.no_sheen);
    row(ui, "model", about, |ui| list(ui, "sheen model", named, sheen.model, &models)).apply(&mut own.sheen_model);
}

fn model_about(model: SheenModel) -> &'static str {
    match model {
        SheenModel::Ltc => "Zeltner, Burley and Chiang 2022: light scattered over and over in a layer of fibres.",
        SheenModel::Burley => "Burley 2012: a glow at grazing angles.",
        SheenModel::ContyKulla => "Conty Estevez and Kulla 2017: microfacets that stand upright, as glTF has it.",
        SheenModel::NeubeltPettineo => "Neubelt and Pettineo 2013: velvet in games.",
        SheenModel::Patry => "Patry 2020: velvet in games.",
        SheenModel::Slab | SheenModel::Walk => "For path tracers.",
    }
}

fn base(ui: &mut Ui, shown: &Shown, own: &mut MaterialEdits) {
    let material = &shown.material;
    let about = match shown.has(TextureSlot::BaseColor) {
        false => "The colour of the surface below the layer; of a metal, what it reflects.",
        true => "The colour of the surface below the layer. It is multiplied by the file's texture.",
    };
    color_rows(ui, "base colour", about, material.base_color).apply(&mut own.base_color);
    let textured =
        if shown.has(TextureSlot::MetallicRoughness) { " It is multiplied by the file's texture." } else { "" };
    let about =
        format!("Whether the surface below the layer is a metal: 0 no, as plastic, cloth or skin; 1 yes.{textured}");
    share_row(ui, "metallic", About::unless(&about, shown.unlit), material.metallic).apply(&mut own.metallic);
    let about = format!("How wide the highlights of the surface below the layer are: 0 is polished, 1 dull.{textured}");
    share_row(ui, "roughness", About::unless(&about, shown.unlit), material.roughness).apply(&mut own.roughness);
}
