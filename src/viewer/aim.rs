//! A light whose reflection is put where the pointer is: as a photographer moves a lamp until it shows where it should.

use egui::{Key, Pos2, Rect, Response, Ui};
use glam::Quat;

use super::lamps::LightId;
use super::lens::Lens;
use super::pick::pick;
use super::state::State;

/// Where the chosen light is to be so that its mirror image is seen at a point of a surface: as far from that as it was, facing it.
pub fn aim(state: &mut State, light: LightId, lens: &Lens, at: Pos2) {
    let Some(picked) = pick(&state.drawn(), &lens.ray(at)) else { return };
    let to_eye = lens.to_eye(picked.point);
    // A surface that is seen from behind is turned.
    let normal = if picked.normal.dot(to_eye) < 0.0 { -picked.normal } else { picked.normal };
    let mirrored = (2.0 * normal.dot(to_eye) * normal - to_eye).normalize_or(normal);
    let place = state.placing(light);
    if place.can_move {
        let distance = place.position.distance(picked.point).max(1e-3 * state.size());
        state.move_light(light, picked.point + distance * mirrored);
    }
    if place.can_turn {
        state.turn_light(light, Quat::from_rotation_arc(place.normal(), -mirrored));
    }
}

/// Puts the chosen light's reflection below the pointer while L is held and the picture is dragged; whether it does.
pub fn show(ui: &Ui, response: &Response, picture: Rect, state: &mut State) -> bool {
    let is_held = state.hands.keys.contains(&Key::L) && !ui.text_edit_focused();
    let is_down = response.is_pointer_button_down_on() && ui.input(|input| input.pointer.primary_down());
    if !is_held || !is_down {
        // What has been begun with L ends with the button, not as a turn.
        state.hands.aims &= is_down;
        return state.hands.aims;
    }
    state.hands.aims = true;
    let Some(light) = state.chosen() else {
        state.say("L and drag: choose a light first, in the panel or in the picture.".to_owned());
        return true;
    };
    let Some(at) = ui.input(|input| input.pointer.latest_pos()) else { return true };
    let lens = Lens::new(state.camera(), picture);
    aim(state, light, &lens, at);
    true
}
