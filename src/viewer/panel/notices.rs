//! What the loader has to say about a scene, and the renderer about a view, in the panel.

use egui::{CollapsingHeader, ScrollArea, Ui};

/// The list's greatest height, in points: more of it scrolls.
const HEIGHT: f32 = 160.0;

/// A section that is closed at first, with one paragraph a notice; nothing where there are none.
pub fn show<'a>(ui: &mut Ui, notices: impl Iterator<Item = &'a String> + Clone) {
    let count = notices.clone().count();
    if count == 0 {
        return;
    }
    CollapsingHeader::new(format!("notices ({count})")).id_salt("notices").show(ui, |ui| {
        ScrollArea::vertical().id_salt("notices").max_height(HEIGHT).auto_shrink([false, true]).show(ui, |ui| {
            for notice in notices {
                ui.add(egui::Label::new(one_line(notice)).wrap());
            }
        });
    });
}

/// A name in a notice may hold anything.
fn one_line(notice: &str) -> String {
    notice.chars().map(|character| if character.is_control() { ' ' } else { character }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{Context, Event, Modifiers, PointerButton, Pos2, RawInput, Rect, pos2, vec2};

    /// Width and height that the section takes of a column 250 points wide, after a click on its title.
    fn opened(notices: &[String]) -> [f32; 2] {
        let context = Context::default();
        let (pos, button, modifiers) = (pos2(30.0, 9.0), PointerButton::Primary, Modifiers::NONE);
        let press = |pressed| Event::PointerButton { pos, button, pressed, modifiers };
        let passes = [vec![Event::PointerMoved(pos)], vec![press(true)], vec![press(false)]];
        let mut taken = [0.0; 2];
        for (index, events) in passes.into_iter().chain(vec![vec![]; 30]).enumerate() {
            let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, vec2(250.0, 700.0)));
            let time = Some(0.05 * index as f64);
            let output = context.run_ui(RawInput { screen_rect, events, time, ..RawInput::default() }, |ui| {
                let section = ui.scope(|ui| show(ui, notices.iter())).response.rect;
                taken = [section.width(), section.height()];
            });
            output.drop_without_applying_deltas();
        }
        taken
    }

    #[test]
    fn nothing_takes_no_room() {
        assert_eq!(opened(&[])[1], 0.0);
    }

    #[test]
    fn long_lines_are_wrapped() {
        let short = opened(&["no camera".to_owned()]);
        for long in ["a word ".repeat(20), "x".repeat(140), "a\nb\u{7}".repeat(30)] {
            let [width, height] = opened(std::slice::from_ref(&long));
            assert!(width <= 250.0, "{width} points wide: {long}");
            assert!(height > short[1] + 20.0, "{height} points high: {long}");
        }
    }

    #[test]
    fn many_notices_scroll() {
        let notices: Vec<String> = (0..50).map(|number| format!("notice {number}: of some length")).collect();
        let [width, height] = opened(&notices);
        assert!(width <= 250.0 && height > 100.0 && height < HEIGHT + 40.0, "{width} by {height}");
    }
}
