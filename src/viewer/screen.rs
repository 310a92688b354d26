//! What the window has to show, and whether it shows that already.

use egui::epaint::ClippedShape;
use egui::epaint::textures::TexturesDelta;
use egui::{FullOutput, Rect};

use super::change::Change;
use super::layout::Layout;

/// The joint outcome of the passes over the user interface. They come more often than frames: egui asks for two or three
/// after each move of the pointer, few of which change anything.
pub struct Screen {
    /// What egui paints, as of the last pass.
    shapes: Vec<ClippedShape>,
    pub pixels_per_point: f32,
    /// Where the picture is, in points.
    pub picture: Rect,
    /// What has changed in the picture since it was shown.
    pub change: Change,
    /// Whether what is shown differs from all this.
    stale: bool,
    /// Whether the shapes have changed since they were handed on.
    is_painted_anew: bool,
}

impl Screen {
    /// Nothing has been shown yet.
    pub fn new() -> Self {
        Self {
            shapes: Vec::new(),
            pixels_per_point: 1.0,
            picture: Rect::ZERO,
            change: Change::Lights,
            stale: true,
            is_painted_anew: true,
        }
    }

    /// Takes what a pass has led to; returns the changes of egui's textures, which are due at once.
    pub fn take(&mut self, layout: &Layout, output: FullOutput) -> TexturesDelta {
        let FullOutput { shapes, pixels_per_point, textures_delta, .. } = output;
        let is_painted_anew = shapes != self.shapes || pixels_per_point != self.pixels_per_point;
        self.is_painted_anew |= is_painted_anew || !textures_delta.set.is_empty();
        self.stale |= layout.change > Change::None || layout.picture != self.picture || self.is_painted_anew;
        // In another size the picture is another one.
        let is_resized = layout.picture.size() != self.picture.size() || pixels_per_point != self.pixels_per_point;
        let resized = if is_resized { Change::Drawn } else { Change::None };
        self.change = self.change.max(layout.change).max(resized);
        (self.picture, self.shapes, self.pixels_per_point) = (layout.picture, shapes, pixels_per_point);
        textures_delta
    }

    /// All is to be shown anew, of another scene.
    pub fn begin(&mut self) {
        (self.change, self.stale) = (Change::Lights, true);
    }

    /// What is shown is lost, or of the wrong size.
    pub fn lose(&mut self) {
        self.stale = true;
    }

    /// Whether a frame is due.
    pub fn is_stale(&self) -> bool {
        self.stale
    }

    /// All of it is on its way to the screen: what egui paints, where that has changed since the last time.
    pub fn presented(&mut self) -> Option<Vec<ClippedShape>> {
        (self.change, self.stale) = (Change::None, false);
        std::mem::take(&mut self.is_painted_anew).then(|| self.shapes.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::super::layout;
    use super::super::state::State;
    use super::*;
    use crate::scene::{Edits, gltf};
    use egui::{Event, Modifiers, PointerButton, Pos2, RawInput, ViewportId, pos2, vec2};

    const DRAPE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/drape.glb");

    /// A window of 1280 by 720 points without the window.
    struct Desk {
        context: egui::Context,
        state: State,
        screen: Screen,
        time: f64,
    }

    impl Desk {
        /// After the first frames.
        fn settled() -> Self {
            let state = State::new(
                "drape.glb",
                gltf::load(DRAPE.as_ref(), &gltf::Options::default()).unwrap(),
                Edits::default(),
            );
            let mut desk = Self { context: egui::Context::default(), state, screen: Screen::new(), time: 0.0 };
            assert!(desk.screen.is_stale());
            desk.settle(vec![]);
            desk.screen.presented();
            desk
        }

        /// A pass after these events; whether egui wants another one at once.
        fn pass(&mut self, events: Vec<Event>) -> bool {
            self.time += 0.02;
            let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, vec2(1280.0, 720.0)));
            let input = RawInput { screen_rect, events, time: Some(self.time), ..RawInput::default() };
            let mut layout = Layout::default();
            let output = self.context.run_ui(input, |ui| layout = layout::show(ui, &mut self.state));
            let is_due = output.viewport_output[&ViewportId::ROOT].repaint_delay.is_zero();
            self.screen.take(&layout, output).clear();
            is_due
        }

        /// Passes until egui has enough; how many.
        fn settle(&mut self, events: Vec<Event>) -> usize {
            let mut is_due = self.pass(events);
            let mut passes = 1;
            while is_due {
                is_due = self.pass(vec![]);
                passes += 1;
                assert!(passes < 100, "egui never rests");
            }
            passes
        }

        fn hover(&mut self, x: f32, y: f32) -> usize {
            self.settle(vec![Event::PointerMoved(pos2(x, y))])
        }

        fn click(&mut self, x: f32, y: f32) {
            for pressed in [true, false] {
                let (pos, button, modifiers) = (pos2(x, y), PointerButton::Primary, Modifiers::NONE);
                self.settle(vec![Event::PointerMoved(pos), Event::PointerButton { pos, button, pressed, modifiers }]);
            }
        }
    }

    #[test]
    fn a_pointer_that_moves_over_the_picture_asks_for_no_frame() {
        let mut desk = Desk::settled();
        desk.hover(100.0, 100.0);
        desk.screen.presented();
        let passes: usize = (0..20).map(|step| desk.hover(120.0 + 30.0 * step as f32, 200.0)).sum();
        // egui's own count of frames, which were all drawn once.
        assert!(passes >= 40, "{passes}");
        assert!(!desk.screen.is_stale());
    }

    #[test]
    fn a_button_under_the_pointer_asks_for_one_frame_and_not_for_the_scene() {
        let mut desk = Desk::settled();
        let mut frames = 0;
        for y in (0..700).step_by(4) {
            desk.hover(1160.0, y as f32);
            if desk.screen.is_stale() {
                frames += 1;
                assert_eq!(desk.screen.change, Change::None);
                desk.screen.presented();
                desk.hover(1160.0, y as f32);
                assert!(!desk.screen.is_stale(), "at {y}");
            }
        }
        assert!(frames > 5, "{frames} things that light up");
    }

    #[test]
    fn a_colour_that_is_looked_at_is_not_changed() {
        let mut desk = Desk::settled();
        let mut opened = 0;
        // Where the buttons are is egui's business: whatever opens something is tried.
        for (x, y) in (0..44).flat_map(|row| [1090, 1250].map(|x| (x as f32, 16.0 * row as f32))) {
            desk.click(x, y);
            let is_open = egui::Popup::is_any_open(&desk.context);
            opened += usize::from(is_open);
            if is_open {
                desk.hover(640.0, 300.0);
                assert_eq!(desk.screen.change, Change::None, "at {x}, {y}");
            }
            egui::Popup::close_all(&desk.context);
            desk.state.reset();
            desk.settle(vec![]);
            desk.screen.presented();
        }
        assert!(opened > 2, "{opened} popups");
    }

    #[test]
    fn shapes_are_handed_over_once() {
        let mut desk = Desk::settled();
        desk.screen.lose();
        assert!(desk.screen.presented().is_none());
        desk.hover(1160.0, 300.0);
        let again = (200..700).step_by(4).find_map(|y| {
            desk.hover(1160.0, y as f32);
            desk.screen.is_stale().then(|| desk.screen.presented())
        });
        assert!(again.flatten().is_some_and(|shapes| shapes.len() > 10));
        assert!(desk.screen.presented().is_none());
    }

    #[test]
    fn where_the_picture_has_more_room_it_is_drawn_anew() {
        let mut desk = Desk::settled();
        for _ in 0..2 {
            desk.state.panel_hidden = !desk.state.panel_hidden;
            desk.settle(vec![]);
            assert_eq!(desk.screen.change, Change::Drawn);
            desk.screen.presented();
        }
        // Not where it is but moved.
        let layout = Layout { picture: desk.screen.picture.translate(egui::vec2(3.0, 2.0)), ..Layout::default() };
        desk.screen.take(&layout, FullOutput { pixels_per_point: 1.0, ..FullOutput::default() }).clear();
        assert!(desk.screen.is_stale() && desk.screen.change == Change::None);
        // Scaled up it has more pixels.
        desk.screen.take(&layout, FullOutput { pixels_per_point: 2.0, ..FullOutput::default() }).clear();
        assert_eq!(desk.screen.change, Change::Drawn);
    }

    #[test]
    fn what_is_lost_is_shown_again() {
        let mut desk = Desk::settled();
        desk.screen.lose();
        assert!(desk.screen.is_stale());
        desk.settle(vec![]);
        assert!(desk.screen.is_stale());
        desk.screen.presented();
        assert!(!desk.screen.is_stale());
    }

    #[test]
    fn changes_add_up_until_they_are_shown() {
        let mut screen = Screen::new();
        screen.presented();
        for change in [Change::Shown, Change::Lights, Change::Drawn, Change::None] {
            let layout = Layout { change, ..Layout::default() };
            screen.take(&layout, FullOutput { pixels_per_point: 1.0, ..FullOutput::default() }).clear();
            assert!(screen.is_stale());
        }
        assert_eq!(screen.change, Change::Lights);
        screen.presented();
        assert_eq!((screen.change, screen.is_stale()), (Change::None, false));
    }
}
