//! The part of the panel that shows the lights.

mod adding;
mod placing;
mod shine;

use egui::{Button, CollapsingHeader, Pos2, Rangef, Rect, TextEdit, Ui, pos2, vec2};

use super::super::lamps::{Changes, LightId};
use super::super::state::State;
use super::super::widgets::{Touch, button, choice, control, row, short, switch};
use shine::{Shine, shine_rows};

/// Most lights whose sections are open from the start.
const OPEN: usize = 1;

/// A list of more lights than this has a box to search it.
const MANY: usize = 8;

/// Most characters of a light's name.
const NAME_SHOWN: usize = 24;

/// The width of a switch in a light's title, in points.
const SWITCH: f32 = 20.0;

/// What adds lights, and all that there are, a section for each.
pub fn show(ui: &mut Ui, state: &mut State) {
    adding::show(ui, state);
    let lights: Vec<LightId> = state.lights().collect();
    if lights.is_empty() {
        ui.weak("no lights");
    }
    let wanted = search(ui, lights.len());
    let holds = |state: &State, number: usize, id: LightId| {
        wanted.is_empty() || title(state, number, id).to_lowercase().contains(&wanted)
    };
    let held = held(ui);
    let is_few = lights.len() <= OPEN;
    let mut found = false;
    for (number, id) in (1..).zip(lights) {
        if !state.is_removed(id) && holds(state, number, id) {
            found = true;
            in_sight(ui, id, held, state.reveals(id), |ui| section(ui, state, (number, id), is_few));
        }
    }
    state.hands.revealed = None;
    if !found && !wanted.is_empty() {
        ui.weak("none has this in its name");
    }
}

/// A box to search many; what is typed there in small letters.
fn search(ui: &mut Ui, count: usize) -> String {
    let id = ui.scope_id().with("search");
    let mut wanted: String = ui.data(|data| data.get_temp(id)).unwrap_or_default();
    if count > MANY {
        let hint = format!("search {count} lights");
        let entry = ui.add(TextEdit::singleline(&mut wanted).hint_text(hint).desired_width(f32::INFINITY));
        entry.on_hover_text("Shows the lights whose names or numbers hold this text.");
        ui.data_mut(|data| data.insert_temp(id, wanted.clone()));
    } else {
        wanted.clear();
    }
    wanted.trim().to_lowercase()
}

/// Lays out the item of this name; where it is far out of sight, and nothing in it is typed, dragged or revealed, the room that it took
/// last.
fn in_sight(ui: &mut Ui, id: LightId, held: Option<Pos2>, is_revealed: bool, add: impl FnOnce(&mut Ui)) {
    let id = ui.scope_id().with(("place", id));
    let known: Option<Rect> = ui.data(|data| data.get_temp(id));
    let seen = ui.clip_rect();
    let near = seen.y_range().expand(seen.height());
    let top = ui.cursor().min.y;
    let is_far = |place: &Rect| !near.intersects(Rangef::new(top, top + place.height()));
    let is_held = |place: &Rect| held.is_some_and(|at| place.contains(at));
    if let Some(place) = known.filter(|place| is_far(place) && !is_held(place) && !is_revealed) {
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

/// What a light is called: names may repeat, so that its number tells which it is.
fn title(state: &State, number: usize, id: LightId) -> String {
    let name = match state.light_name(id) {
        "" => "light",
        name => name,
    };
    format!("{} ({number})", short(name, NAME_SHOWN))
}

/// A light under its name, open at first where there are few, and where it has been chosen.
fn section(ui: &mut Ui, state: &mut State, (number, id): (usize, LightId), few: bool) {
    let (is_revealed, is_chosen) = (state.reveals(id), state.chosen() == Some(id));
    let about = format!(
        "{}\nClick to fold this light away, or to open it. What is open and chosen has its handles in the picture.",
        state.light_name(id)
    );
    let text = egui::RichText::new(title(state, number, id));
    let text = if is_chosen { text.strong().underline() } else { text };
    let section = CollapsingHeader::new(text).id_salt(id).default_open(few).open(is_revealed.then_some(true));
    let shown = section.show_unindented(ui, |ui| light(ui, state, id));
    let header = shown.header_response;
    let (was_clicked, place) = (header.clicked(), header.rect);
    if is_revealed {
        header.scroll_to_me(Some(egui::Align::TOP));
    }
    header.on_hover_text(about);
    if was_clicked {
        // What is folded away is done with.
        let is_open = shown.openness < 0.5;
        state.chosen_light = is_open.then_some(id);
    }
    if !state.is_removed(id) {
        switches(ui, state, id, place);
    }
}

/// Whether it is lit, at the right end of its title.
fn switches(ui: &mut Ui, state: &mut State, id: LightId, title: Rect) {
    let (on, solo) = match state.changes(id) {
        Changes::Area(own) => (own.on, own.solo),
        Changes::Punctual(own) => (own.on, own.solo),
    };
    let right = ui.max_rect().max.x;
    let mut one = |place: f32, text: &str, about: &str, is_set: bool| {
        let from = pos2(right - place * (SWITCH + 2.0), title.min.y);
        let place = Rect::from_min_size(from, vec2(SWITCH, title.height()));
        let mut aside = ui.new_child(egui::UiBuilder::new().max_rect(place));
        control(&mut aside, about, &is_set, |ui, is_set| {
            let response = ui.add_sized(place.size(), Button::selectable(*is_set, text).small());
            *is_set ^= response.clicked();
            response
        })
    };
    let mute = one(2.0, "M", "Mutes this light: it is as if it were not there.", on == Some(false));
    let alone = one(1.0, "S", "Solo: this light, and others with the same mark, are lit alone.", solo == Some(true));
    let on = match mute {
        Touch::Nothing => on,
        Touch::Set(is_muted) => is_muted.then_some(false),
        Touch::Reset => None,
    };
    let solo = match alone {
        Touch::Nothing => solo,
        Touch::Set(is_solo) => is_solo.then_some(true),
        Touch::Reset => None,
    };
    let changes = match state.changes(id) {
        Changes::Area(own) => Changes::Area(crate::scene::LightEdits { on, solo, ..own }),
        Changes::Punctual(own) => Changes::Punctual(crate::scene::PunctualEdits { on, solo, ..own }),
    };
    if changes != state.changes(id) {
        state.set_changes(id, changes);
    }
}

fn light(ui: &mut Ui, state: &mut State, id: LightId) {
    match id {
        LightId::Area(index) => area(ui, state, index),
        LightId::Punctual(index) => punctual(ui, state, index),
    }
    ui.horizontal(|ui| {
        if button(ui, "Adds a light like this one, a little to its side.", Button::new("Duplicate")) {
            state.duplicate_light(id);
            state.reveal_chosen();
        }
        if button(ui, "Takes this light away (Delete).", Button::new("Delete")) {
            state.remove_light(id);
        }
    });
    ui.add_space(4.0);
}

fn area(ui: &mut Ui, state: &mut State, index: usize) {
    let id = LightId::Area(index);
    let base = state.scene.base_light(&state.edits, index);
    let frame = state.scene.base_frame(&state.edits, index);
    let before = state.edits.of_light(&state.scene, index);
    let sized = frame.with(None, None, before.size).size / frame.size;
    let two_sided = before.two_sided.unwrap_or(base.two_sided);
    let unit = crate::scene::Light { two_sided, ..base.clone() }.power(1.0) * sized.x * sized.y;
    let shine = Shine {
        color: before.radiance,
        strength: before.strength,
        temperature: before.temperature,
        power: before.power,
    };
    let about = "How bright the light is to look at: its radiance, of the strongest of red, green and blue. 0 is off.";
    let shine = shine_rows(ui, shine, base.radiance, Some(unit), ("radiance", about));
    let mut edits = crate::scene::LightEdits {
        radiance: shine.color,
        strength: shine.strength,
        temperature: shine.temperature,
        power: shine.power,
        ..before
    };
    let about = "Where the middle of the light is, in metres: to the right, up, and to the front.";
    let position = before.position.unwrap_or(frame.position);
    placing::position_row(ui, about, position, frame.position, state.step()).apply(&mut edits.position);
    placing::rotation_rows(ui, &frame, before.rotation).apply(&mut edits.rotation);
    placing::size_row(ui, &frame, before.size, state.step()).apply(&mut edits.size);
    let sides = [
        ("one side", false, "The light shines to the side that its arrow in the picture points to."),
        ("both", true, "The light shines to both sides, with the same radiance."),
    ];
    let about = "To which sides the light shines.";
    row(ui, "shines to", about, |ui| choice(ui, two_sided, &sides)).apply(&mut edits.two_sided);
    if edits != before {
        state.set_changes(id, Changes::Area(edits));
    }
}

fn punctual(ui: &mut Ui, state: &mut State, index: usize) {
    use crate::scene::PunctualKind::{Directional, Spot};
    let id = LightId::Punctual(index);
    let base = state.scene.base_punctual(&state.edits, index);
    let before = state.edits.of_punctual(&state.scene, index);
    let now = before.applied(&base);
    let shine = Shine {
        color: before.intensity,
        strength: before.strength,
        temperature: before.temperature,
        power: before.power,
    };
    let (name, about) = match base.kind {
        Directional => (
            "irradiance",
            "How brightly a surface that faces the light is lit, of the strongest of red, green and blue.",
        ),
        _ => {
            ("intensity", "How much the light sends out a direction, in W/sr, of the strongest of red, green and blue.")
        }
    };
    let shine = shine_rows(ui, shine, base.intensity, now.power(1.0), (name, about));
    let mut edits = crate::scene::PunctualEdits {
        intensity: shine.color,
        strength: shine.strength,
        temperature: shine.temperature,
        power: shine.power,
        ..before
    };
    if base.kind != Directional {
        let about = "Where the light is, in metres: to the right, up, and to the front.";
        placing::position_row(ui, about, now.position, base.position, state.step()).apply(&mut edits.position);
    }
    if state.placing(id).can_turn {
        placing::direction_row(ui, now.direction, base.direction).apply(&mut edits.direction);
    }
    if let Spot { inner, outer, .. } = now.kind {
        placing::cone_row(ui, [inner, outer], [&mut edits.inner, &mut edits.outer]);
    }
    if edits != before {
        state.set_changes(id, Changes::Punctual(edits));
    }
}

/// Whether the lights of a studio are there.
fn rig_switch(ui: &mut Ui, state: &mut State) {
    let about = "Key, fill and rim light, as in a studio, around what is seen at first. They are lights as others are.";
    let before = state.has_rig();
    let after = switch(ui, "studio rig", about, before).value(before, !state.scene.rig.is_empty());
    if after != before {
        state.set_rig(after);
    }
}
