//! The chosen light in the picture: its outline, where it shines, and handles to move, turn and scale it.

use egui::{Align2, Color32, Event, FontId, Key, Painter, Pos2, Rect, Response, Shape, Stroke, Ui, vec2};
use glam::Vec3;

use super::grab::{ARROW, Grab, Tool};
use super::lamps::LightId;
use super::lens::Lens;
use super::state::State;

/// How near to a handle the pointer takes it, in points.
const REACH: f32 = 9.0;
/// The least side of a box, in points, of which the corners are handles.
const LEAST: f32 = 30.0;
/// The length of the arrows along the axes, in points.
const AXIS: f32 = 52.0;
/// The colours of the axes, as everywhere: x red, y green, z blue.
const COLORS: [Color32; 3] =
    [Color32::from_rgb(235, 90, 90), Color32::from_rgb(110, 200, 90), Color32::from_rgb(95, 150, 255)];
const LIGHT: Color32 = Color32::from_rgb(255, 205, 90);
const DARK: Color32 = Color32::from_black_alpha(150);

/// A part that can be taken.
struct Handle {
    at: Pos2,
    tool: Tool,
    axis: Option<usize>,
}

/// Draws the chosen light and lets it be taken; whether the pointer is about it, so that nothing else may be done with it.
pub fn show(ui: &Ui, response: &Response, picture: Rect, state: &mut State) -> bool {
    let lens = Lens::new(state.camera(), picture);
    let was_held = state.hands.grab.is_some();
    if let Some(mut grab) = state.hands.grab.take() {
        let goes_on = !state.is_removed(grab.light) && carry_on(ui, &mut grab, &lens, state);
        state.hands.grab = goes_on.then_some(grab);
    }
    let Some(light) = state.chosen() else { return was_held };
    let handles = handles(&lens, state, light);
    let hovered = response.hover_pos().and_then(|at| nearest(&handles, at));
    let is_pressed = response.is_pointer_button_down_on() && ui.input(|input| input.pointer.primary_pressed());
    let pressed_at =
        ui.input(|input| input.pointer.press_origin()).filter(|_| is_pressed && state.hands.grab.is_none());
    if let Some((at, handle)) = pressed_at.and_then(|at| Some((at, nearest(&handles, at)?))) {
        state.hands.grab = Grab::new(state, light, handle.tool, at, true).map(|grab| grab.along(handle.axis));
    }
    paint(&ui.painter_at(picture), &lens, (state, light), &handles, hovered);
    was_held || state.hands.grab.is_some()
}

/// Takes the chosen light in the hand, where the pointer is in the picture or not.
pub fn begin(ui: &Ui, picture: Rect, state: &mut State, tool: Tool) {
    let is_free = state.hands.grab.is_none() && !ui.input(|input| input.pointer.any_down());
    let Some(light) = state.chosen().filter(|_| is_free) else { return };
    let at = ui.input(|input| input.pointer.latest_pos()).unwrap_or(picture.center());
    state.hands.grab = Grab::new(state, light, tool, at, false);
}

/// What pointer and keys make of what is in the hand; whether it stays there.
fn carry_on(ui: &Ui, grab: &mut Grab, lens: &Lens, state: &mut State) -> bool {
    let events = ui.input(|input| input.events.clone());
    for event in events {
        match event {
            Event::Key { key: Key::Escape, pressed: true, .. } => {
                grab.cancel(state);
                return false;
            }
            Event::Key { key: Key::Enter, pressed: true, .. } => return false,
            Event::Key { key: Key::Backspace, pressed: true, .. } => _ = grab.typed.pop(),
            Event::Text(text) if !grab.is_drag => text.chars().for_each(|character| type_in(grab, character)),
            _ => {}
        }
    }
    let (at, pressed, released, is_down) = ui.input(|input| {
        let pointer = &input.pointer;
        (
            pointer.latest_pos().unwrap_or(grab.from),
            [pointer.primary_pressed(), pointer.secondary_pressed()],
            pointer.any_released(),
            pointer.any_down(),
        )
    });
    if pressed[1] && !grab.is_drag {
        grab.cancel(state);
        grab.is_over = true;
    }
    if !grab.is_over {
        grab.follow(state, lens, at);
    }
    // A drag ends with its button, all else with the click that puts it down: once that is over, which is no click in the picture.
    grab.is_over |= if grab.is_drag { released } else { pressed[0] };
    !grab.is_over || is_down
}

/// An axis, or a part of a number.
fn type_in(grab: &mut Grab, character: char) {
    match character.to_ascii_lowercase() {
        'x' => grab.toggle_axis(0),
        'y' => grab.toggle_axis(1),
        'z' => grab.toggle_axis(2),
        '-' if grab.typed.starts_with('-') => _ = grab.typed.remove(0),
        '-' => grab.typed.insert(0, '-'),
        '.' | ',' if !grab.typed.contains('.') => grab.typed.push('.'),
        digit @ '0'..='9' if grab.typed.len() < 12 => grab.typed.push(digit),
        _ => {}
    }
}

/// Where the handles are.
fn handles(lens: &Lens, state: &State, light: LightId) -> Vec<Handle> {
    let place = state.placing(light);
    let Some(middle) = lens.project(place.position) else { return Vec::new() };
    let metres = lens.metres_a_point(place.position);
    let mut handles = Vec::new();
    let mut add = |point: Vec3, tool: Tool, axis: Option<usize>| {
        handles.extend(lens.project(point).map(|at| Handle { at, tool, axis }));
    };
    if place.can_turn {
        add(place.position + ARROW * metres * place.normal(), Tool::Point, None);
    }
    // A box that is too small for its corners is scaled by S.
    if let Some(size) = place.size.filter(|size| size.min_element() > LEAST * metres) {
        for [x, y] in [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]] {
            let corner = place.rotation * Vec3::new(x * size.x, y * size.y, 0.0);
            add(place.position + corner, Tool::Corner, None);
        }
    }
    if place.can_move {
        for (axis, direction) in Vec3::AXES.into_iter().enumerate() {
            add(place.position + AXIS * metres * direction, Tool::Move, Some(axis));
        }
        handles.push(Handle { at: middle, tool: Tool::Move, axis: None });
    }
    handles
}

/// The one that a pointer takes: the last of those that are near, as it lies uppermost.
fn nearest(handles: &[Handle], at: Pos2) -> Option<&Handle> {
    let near = handles.iter().filter(|handle| handle.at.distance(at) <= REACH);
    near.min_by(|one, other| one.at.distance(at).total_cmp(&other.at.distance(at)))
}

fn paint(
    painter: &Painter,
    lens: &Lens,
    (state, light): (&State, LightId),
    handles: &[Handle],
    hovered: Option<&Handle>,
) {
    let place = state.placing(light);
    let metres = lens.metres_a_point(place.position);
    if let LightId::Area(index) = light {
        for polygon in &state.drawn().lights[index].polygons {
            polygon.contours.iter().for_each(|contour| outline(painter, lens, contour));
        }
    }
    if let Some(size) = place.size {
        let corner = |[x, y]: [f32; 2]| place.position + place.rotation * Vec3::new(x * size.x, y * size.y, 0.0);
        let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]].map(corner);
        for side in 0..4 {
            let ends = lens.segment([corners[side], corners[(side + 1) % 4]]);
            ends.into_iter()
                .for_each(|ends| painter.extend(Shape::dashed_line(&ends, Stroke::new(1.0, LIGHT), 3.0, 4.0)));
        }
    }
    if lens.project(place.position).is_some() {
        let arrow = |to: Vec3, color: Color32| line(painter, lens, [place.position, to], color);
        if place.can_move {
            (0..3).for_each(|axis| arrow(place.position + AXIS * metres * Vec3::AXES[axis], COLORS[axis]));
        }
        if place.can_turn {
            arrow(place.position + ARROW * metres * place.normal(), LIGHT);
        }
    }
    for handle in handles {
        let is_hovered = hovered.is_some_and(|hovered| std::ptr::eq(hovered, handle));
        let color = if is_hovered { Color32::WHITE } else { handle.axis.map_or(LIGHT, |axis| COLORS[axis]) };
        let radius = if is_hovered { 6.0 } else { 4.5 };
        match handle.tool {
            Tool::Corner => {
                let place = Rect::from_center_size(handle.at, egui::Vec2::splat(1.6 * radius));
                painter.rect_filled(place.expand(1.0), 1.0, DARK);
                painter.rect_filled(place, 1.0, color);
            }
            _ => {
                painter.circle_filled(handle.at, radius + 1.0, DARK);
                painter.circle_filled(handle.at, radius, color);
            }
        }
    }
    let is_seen = handles.iter().any(|handle| painter.clip_rect().contains(handle.at));
    said(painter, &text(state, light, is_seen));
}

/// What stands at the picture's foot.
fn text(state: &State, light: LightId, is_seen: bool) -> String {
    let name = match state.light_name(light) {
        "" => "light",
        name => name,
    };
    let what = match &state.hands.grab {
        Some(grab) if grab.is_drag => grab.said(state),
        Some(grab) => format!("{}   X Y Z axis, a number, Enter or click done, Esc back", grab.said(state)),
        None => "G move, R turn, S scale, L+drag puts its reflection below the pointer".to_owned(),
    };
    let place = if is_seen { "" } else { ", out of sight" };
    format!("{}{place}: {what}", super::widgets::short(name, 32))
}

fn said(painter: &Painter, text: &str) {
    let at = painter.clip_rect().left_bottom() + vec2(8.0, -8.0);
    let room = painter.clip_rect().width() - 24.0;
    let layout = painter.layout(text.to_owned(), FontId::proportional(12.5), Color32::WHITE, room.max(40.0));
    let place = Align2::LEFT_BOTTOM.anchor_size(at, layout.size());
    painter.rect_filled(place.expand2(vec2(5.0, 3.0)), 3.0, DARK);
    painter.galley(place.min, layout, Color32::WHITE);
}

fn outline(painter: &Painter, lens: &Lens, contour: &[Vec3]) {
    let next = contour.iter().cycle().skip(1);
    contour.iter().zip(next).for_each(|(from, to)| line(painter, lens, [*from, *to], LIGHT));
}

/// A line that is seen before bright and dark.
fn line(painter: &Painter, lens: &Lens, ends: [Vec3; 2], color: Color32) {
    if let Some(ends) = lens.segment(ends) {
        painter.line_segment(ends, Stroke::new(3.5, DARK));
        painter.line_segment(ends, Stroke::new(1.5, color));
    }
}
