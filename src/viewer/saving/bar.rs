//! How far a picture is that is being saved, over the picture's lower edge.

use egui::{Align2, Area, Button, Frame, Id, Label, Order, ProgressBar, Rect, Ui, vec2};

use super::super::request::Request;
use super::super::widgets::button;
use super::Progress;

/// The greatest width of the bar, in points.
const WIDTH: f32 = 280.0;

/// Shows it over the picture; what the user asks for.
pub fn show(ui: &Ui, picture: Rect, progress: &Progress) -> Option<Request> {
    let Progress { name, doing, share, waiting } = progress;
    let width = WIDTH.min(picture.width() - 40.0).max(80.0);
    let at = picture.left_bottom() + vec2(8.0, -8.0);
    let area = Area::new(Id::unique("saving")).order(Order::Foreground).fixed_pos(at).pivot(Align2::LEFT_BOTTOM);
    let shown = area.show(ui, |ui| {
        Frame::window(ui.style())
            .show(ui, |ui| {
                ui.set_width(width);
                let more = if *waiting > 0 { format!(", then {waiting} more") } else { String::new() };
                let percent = (100.0 * share).floor();
                ui.add(Label::new(format!("{doing} {name}: {percent} %{more}")).truncate().selectable(false));
                ui.horizontal(|ui| {
                    let about = "Ends the drawing of this picture: nothing of it is saved.";
                    let room = ui.available_width() - 60.0;
                    ui.add(ProgressBar::new(*share).desired_width(room));
                    button(ui, about, Button::new("Cancel"))
                })
                .inner
            })
            .inner
    });
    shown.inner.then_some(Request::StopSaving)
}
