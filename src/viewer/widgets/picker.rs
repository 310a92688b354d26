//! A swatch that opens a picker: a square of saturation and brightness, and a bar of hues. The numbers of the colour stand beside the
//! swatch, which egui's own picker would repeat without saying what they are.

use egui::accesskit::Role;
use egui::ecolor::HsvaGamma;
use egui::{
    Color32, EventFilter, Key, Mesh, Popup, PopupCloseBehavior, RectAlign, Response, Rgba, Sense, StrokeKind, Ui, Vec2,
    WidgetInfo, remap_clamp, vec2,
};
use glam::Vec3;

/// Width of the picker, and heights of its square and its bar, in points.
const WIDTH: f32 = 220.0;
const SQUARE: f32 = 160.0;
const BAR: f32 = 20.0;

/// Columns and rows of colours that are shown of the square and of the bar; what lies between them is mixed on the screen. Of hues there are
/// so many sixths of a turn, at which they are purest.
const SQUARE_CELLS: [u16; 2] = [24, 24];
const BAR_CELLS: [u16; 2] = [36, 1];

/// What an arrow key moves, as a share of the width and the height.
const ARROW: f32 = 0.01;

/// A button that shows a colour, linear Rec. 709 in [0, 1], and opens a picker, which changes it.
pub fn color_button(ui: &mut Ui, color: &mut Vec3) -> Response {
    let (rect, mut response) = ui.allocate_exact_size(ui.spacing().interact_size, Sense::click());
    let shown = Color32::from(rgba(*color));
    response.widget_info(|| {
        let mut info = WidgetInfo::labeled(Role::ColorWell, ui.is_enabled(), "colour");
        info.current_text_value = Some(shown.to_hex());
        info
    });
    let visuals = ui.style().interact(&response);
    // Framed, for the colour may be the panel's own.
    ui.painter().rect(rect, visuals.corner_radius, shown, (1.0, visuals.bg_fill), StrokeKind::Inside);
    let popup = Popup::menu(&response).close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    // The numbers beside the swatch and below it stay in sight.
    popup.align(RectAlign::LEFT_START).show(|ui| {
        if let Some(picked) = picker(ui, *color) {
            *color = picked;
            response.mark_changed();
        }
    });
    response
}

fn rgba(color: Vec3) -> Rgba {
    Rgba::from_rgb(color.x, color.y, color.z)
}

/// What is picked instead of a colour, where anything is.
fn picker(ui: &mut Ui, color: Vec3) -> Option<Vec3> {
    // A grey has no hue, and black no saturation, either: as long as it is shown they stay what they were when it was picked.
    let id = ui.scope_id().with("picked");
    let picked: Option<(Vec3, HsvaGamma)> = ui.data(|data| data.get_temp(id));
    let before = picked.filter(|(picked, _)| *picked == color).map_or_else(|| rgba(color).into(), |(_, hsv)| hsv);
    let hsv = square(ui, before);
    let hsv = bar(ui, hsv);
    if hsv == before {
        return None;
    }
    let rgba = Rgba::from(hsv);
    let picked = Vec3::new(rgba.r(), rgba.g(), rgba.b()).clamp(Vec3::ZERO, Vec3::ONE);
    ui.data_mut(|data| data.insert_temp(id, (picked, hsv)));
    Some(picked)
}

/// Saturation to the right, brightness upwards.
fn square(ui: &mut Ui, hsv: HsvaGamma) -> HsvaGamma {
    let at = |[s, v]: [f32; 2]| HsvaGamma { s, v, ..hsv };
    let (response, [s, v]) = field(ui, "saturation and brightness", [hsv.s, hsv.v], (SQUARE, SQUARE_CELLS), at);
    response.on_hover_text("Saturation to the right, brightness upwards: drag, or use the arrow keys.");
    HsvaGamma { s, v, ..hsv }
}

fn bar(ui: &mut Ui, hsv: HsvaGamma) -> HsvaGamma {
    let at = |[h, _]: [f32; 2]| HsvaGamma { h, s: 1.0, v: 1.0, a: 1.0 };
    let (response, [h, _]) = field(ui, "hue", [hsv.h, 0.5], (BAR, BAR_CELLS), at);
    response.on_hover_text("The hue, all around the colour wheel: drag, or use the arrow keys.");
    HsvaGamma { h, ..hsv }
}

/// A field of colours. Of the place in it that is picked, from the lower left corner and in [0, 1], it returns what the user makes.
fn field(
    ui: &mut Ui,
    name: &str,
    at: [f32; 2],
    (height, cells): (f32, [u16; 2]),
    color_at: impl Fn([f32; 2]) -> HsvaGamma,
) -> (Response, [f32; 2]) {
    let (rect, response) = ui.allocate_exact_size(vec2(WIDTH, height), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Slider, ui.is_enabled(), name));
    let pointed = response.interact_pointer_pos().map(|pointer| {
        let x = remap_clamp(pointer.x, rect.left()..=rect.right(), 0.0..=1.0);
        vec2(x, remap_clamp(pointer.y, rect.bottom()..=rect.top(), 0.0..=1.0))
    });
    let place = pointed.unwrap_or(Vec2::from(at) + arrows(ui, &response)).clamp(Vec2::ZERO, Vec2::splat(1.0));
    let painter = ui.painter();
    painter.add(painted(cells, |x, y| {
        let color = Color32::from(color_at([x, y]));
        (rect.left_bottom() + vec2(x, -y) * rect.size(), color)
    }));
    let visuals = ui.style().interact(&response);
    painter.rect_stroke(rect, 0.0, visuals.bg_stroke, StrokeKind::Outside);
    let color = Color32::from(color_at(place.into()));
    let contrast = if color.intensity() < 0.5 { Color32::WHITE } else { Color32::BLACK };
    let center = rect.left_bottom() + vec2(place.x, -place.y) * rect.size();
    painter.circle(center, 6.0, color, (visuals.fg_stroke.width, contrast));
    (response, place.into())
}

/// How far the arrow keys move what has the focus.
fn arrows(ui: &Ui, response: &Response) -> Vec2 {
    if !response.has_focus() {
        return Vec2::ZERO;
    }
    let arrows = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
    ui.input(|input| {
        let presses = |key| input.num_presses(key) as f32;
        let right = presses(Key::ArrowRight) - presses(Key::ArrowLeft);
        ARROW * vec2(right, presses(Key::ArrowUp) - presses(Key::ArrowDown))
    })
}

/// A grid of so many columns and rows, of places and colours by shares of its width and height.
fn painted([columns, rows]: [u16; 2], vertex: impl Fn(f32, f32) -> (egui::Pos2, Color32)) -> Mesh {
    let mut mesh = Mesh::default();
    for row in 0..=rows {
        for column in 0..=columns {
            let (place, color) = vertex(f32::from(column) / f32::from(columns), f32::from(row) / f32::from(rows));
            mesh.colored_vertex(place, color);
        }
    }
    let width = u32::from(columns) + 1;
    for row in 0..u32::from(rows) {
        for column in 0..u32::from(columns) {
            let corner = row * width + column;
            mesh.add_triangle(corner, corner + 1, corner + width);
            mesh.add_triangle(corner + 1, corner + width, corner + width + 1);
        }
    }
    mesh
}
