//! The sheet of nine alphas, where it lies over the picture.

use egui::accesskit::Role;
use egui::{Align2, Color32, Rect, Sense, StrokeKind, TextStyle, Ui, WidgetInfo, pos2, vec2};

use super::sheet::Sheet;
use super::state::State;
use super::widgets::written;

/// How many pictures stand beside each other.
const SIDE: usize = 3;

/// Between pictures, in points.
const GAP: f32 = 4.0;

/// The height of a caption, in points.
const CAPTION: f32 = 20.0;

/// Shows the sheet where it is open: a click takes an alpha and closes it, as Esc does without.
pub fn show(ui: &mut Ui, picture: Rect, state: &mut State) {
    if state.sheet.is_none() {
        return;
    }
    let (material, current) = (state.material, state.alpha());
    let now = Sheet::new(&state.edits, material);
    let Some(sheet) = &mut state.sheet else { return };
    if sheet.edits != now.edits {
        // Its pictures are of something else.
        *sheet = now;
    }
    sheet.size = size_in_pixels(ui, picture);
    ui.painter().rect_filled(picture, 0.0, ui.visuals().extreme_bg_color);
    // Nothing that is done between its pictures turns what lies below.
    ui.interact(picture, ui.scope_id().with("sheet"), Sense::click_and_drag());
    let mut taken = None;
    for index in 0..Sheet::ALPHAS.len() {
        if cell(ui, picture, sheet, index, current) {
            taken = Some(index);
        }
    }
    if let Some(index) = taken {
        state.edits = sheet.edits_of(index, material);
        state.sheet = None;
        ui.ctx().request_repaint();
    }
}

/// One picture of the sheet and its caption, where the material's alpha is `current`; whether it is taken.
fn cell(ui: &Ui, picture: Rect, sheet: &Sheet, index: usize, current: Option<f32>) -> bool {
    let [place, image] = image(picture, index);
    let (alpha, is_current) = (Sheet::ALPHAS[index], current.map(Sheet::nearest) == Some(index));
    let caption = format!("alpha {alpha}");
    // Drags, too, for the same reason.
    let response = ui.interact(place, ui.scope_id().with(("sheet", index)), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, is_current, &caption));
    let (visuals, painter) = (ui.style().interact(&response), ui.painter().with_clip_rect(place.expand(GAP)));
    match &sheet.pictures[index] {
        Some(tile) => {
            let uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            painter.image(tile.texture, image, uv, Color32::WHITE);
        }
        None => {
            painter.rect_filled(image, 2.0, ui.visuals().faint_bg_color);
            let font = TextStyle::Body.resolve(ui.style());
            painter.text(image.center(), Align2::CENTER_CENTER, "drawing …", font, ui.visuals().weak_text_color());
        }
    }
    if response.hovered() || response.has_focus() {
        painter.rect_stroke(image, 2.0, (2.0, visuals.fg_stroke.color), StrokeKind::Outside);
    }
    let below = pos2(place.center().x, place.max.y - 0.5 * CAPTION);
    let mut color = visuals.text_color();
    if is_current {
        // As a button looks that is in force.
        let selection = ui.visuals().selection;
        painter.rect_stroke(place, 4.0, (3.0, selection.bg_fill), StrokeKind::Outside);
        painter.rect_filled(place.with_min_y(image.max.y), 0.0, selection.bg_fill);
        color = selection.stroke.color;
    }
    painter.text(below, Align2::CENTER_CENTER, caption, TextStyle::Body.resolve(ui.style()), color);
    response.on_hover_text(about(alpha, current.filter(|_| is_current))).clicked()
}

/// What a click on the picture of this alpha does; `current` is the material's, where this is the nearest to it.
fn about(alpha: f32, current: Option<f32>) -> String {
    let taken = format!("Click to take alpha {alpha} and go back to the picture. Esc goes back without it.");
    match current {
        Some(current) if current == alpha => {
            "This is the alpha now. Click or Esc to go back to the picture.".to_owned()
        }
        Some(current) => format!("The nearest to the alpha now, {}.\n{taken}", written(current.into())),
        None => taken,
    }
}

/// Where the picture of a cell is, of the sheet over such a picture.
fn image(picture: Rect, index: usize) -> [Rect; 2] {
    let size = picture.size() / SIDE as f32;
    let corner = picture.min + size * vec2((index % SIDE) as f32, (index / SIDE) as f32);
    let place = Rect::from_min_size(corner, size).shrink(GAP);
    [place, place.with_max_y(place.max.y - CAPTION)]
}

/// The width and height of the sheet's pictures over such a picture, in pixels.
fn size_in_pixels(ui: &Ui, picture: Rect) -> [u32; 2] {
    let size = ui.pixels_per_point() * image(picture, 0)[1].size();
    [size.x, size.y].map(|side| side.max(1.0) as u32)
}
