//! The part of the panel that shows the lights.

use egui::{CollapsingHeader, Pos2, Rangef, Rect, Ui, vec2};
use glam::Vec3;

use super::super::state::State;
use super::super::widgets::{Glow, Touch, color_rows, number_box, row, short};
use crate::scene::{FARTHEST, LightEdits};

/// Most lights whose sections are open from the start.
const OPEN: usize = 4;

/// Most characters of a light's name.
const NAME_SHOWN: usize = 32;

/// All polygon lights, a section for each.
pub fn show(ui: &mut Ui, state: &mut State) {
    let few = state.scene.lights.len() <= OPEN;
    if state.scene.lights.is_empty() {
        ui.weak("no lights with an area");
    }
    let held = held(ui);
    for index in 0..state.scene.lights.len() {
        in_sight(ui, index, held, |ui| section(ui, state, index, few));
    }
}

/// Lays out the item of this index; where it is far out of sight, and nothing in it is typed or dragged, the room that it took last.
fn in_sight(ui: &mut Ui, index: usize, held: Option<Pos2>, add: impl FnOnce(&mut Ui)) {
    let id = ui.scope_id().with(("place", index));
    let known: Option<Rect> = ui.data(|data| data.get_temp(id));
    let seen = ui.clip_rect();
    let near = seen.y_range().expand(seen.height());
    let top = ui.cursor().min.y;
    let is_far = |place: &Rect| !near.intersects(Rangef::new(top, top + place.height()));
    let is_held = |place: &Rect| held.is_some_and(|at| place.contains(at));
    if let Some(place) = known.filter(|place| is_far(place) && !is_held(place)) {
        ui.allocate_space(vec2(ui.available_width(), place.height()));
        return;
    }
    let place = ui.scope(add).response.rect;
    ui.data_mut(|data| data.insert_temp(id, place));
}

/// Where the control is that has the focus, or is dragged.
fn held(ui: &Ui) -> Option<Pos2> {
    let id = ui.memory(|memory| memory.focused()).or_else(|| ui.dragged_id())?;
    ui.read_response(id).map(|response| response.rect.center())
}

/// A light under its name, open at first where there are few.
fn section(ui: &mut Ui, state: &mut State, index: usize, few: bool) {
    let name = match state.scene.lights[index].name.as_str() {
        "" => "light",
        name => name,
    };
    let about = format!("{name}\nClick to fold this light away, or to open it.");
    let title = format!("{} ({})", short(name, NAME_SHOWN), index + 1);
    let section = CollapsingHeader::new(title).id_salt(index).default_open(few);
    let header = section.show_unindented(ui, |ui| light(ui, state, index)).header_response;
    header.on_hover_text(about);
}

fn light(ui: &mut Ui, state: &mut State, index: usize) {
    let loaded = &state.scene.lights[index];
    let before = state.edits.of_light(&state.scene, index);
    let mut edits = before;
    let glow_before = Glow::new(before.radiance.unwrap_or(loaded.radiance), before.strength);
    let glow_loaded = Glow::new(loaded.radiance, None);
    let mut glow = glow_before;
    let about = "How bright the light is to look at: its radiance, of the strongest of red, green and blue. 0 is off.";
    let strength = row(ui, "radiance", about, |ui| {
        let speed = 0.02 * glow.strength.max(1e-3);
        number_box(ui, about, glow.strength, 0.0..=f32::MAX, speed)
    });
    glow.strength = strength.value(glow.strength, glow_loaded.strength);
    let color = color_rows(ui, "hue", "The light's hue. It stays when the light is turned off and on again.", glow.hue);
    glow = glow.with_color(color.value(glow.hue, glow_loaded.hue));
    if glow == glow_loaded {
        (edits.radiance, edits.strength) = (None, None);
    }
    if glow != glow_before && glow != glow_loaded {
        (edits.radiance, edits.strength) = (Some(glow.hue), Some(glow.strength));
    }
    let position = before.position.unwrap_or_else(|| loaded.position());
    position_boxes(ui, position, loaded.position(), state.step()).apply(&mut edits.position);
    if edits != before {
        state.edits.lights.insert(index, edits);
        state.edits.lights.retain(|_, edits| *edits != LightEdits::default());
    }
}

/// Three boxes, in metres; a drag of a point moves by `step`.
fn position_boxes(ui: &mut Ui, position: Vec3, loaded: Vec3, step: f32) -> Touch<Vec3> {
    let about = "Where the middle of the light is, in metres: to the right, up, and to the front.";
    row(ui, "position", about, |ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        (0..3).fold(Touch::Nothing, |touched, axis| {
            let number = number_box(ui, about, position[axis], -FARTHEST..=FARTHEST, step);
            let mut moved = position;
            moved[axis] = number.value(position[axis], loaded[axis]);
            touched.or(match number {
                Touch::Nothing => Touch::Nothing,
                Touch::Reset if moved == loaded => Touch::Reset,
                Touch::Set(_) | Touch::Reset => Touch::Set(moved),
            })
        })
    })
}
