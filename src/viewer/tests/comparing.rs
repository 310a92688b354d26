//! The sweep and the sheet among other things that are done: what undo, redo, Esc and each other make of them.

use super::*;
use crate::viewer::sheet::Sheet;

const CTRL: Modifiers = Modifiers { ctrl: true, ..Modifiers::COMMAND };
const CTRL_SHIFT: Modifiers = Modifiers { shift: true, ..CTRL };

fn alpha(window: &Window) -> Option<f32> {
    window.state.edits.of_material(0).alpha
}

fn press(window: &mut Window, modifiers: Modifiers, key: Key) {
    window.modifiers = modifiers;
    window.press(key);
    window.modifiers = Modifiers::NONE;
    window.pass(vec![]);
}

fn press_button(window: &mut Window, name: &str) {
    let at = window.place(Role::Button, name).center();
    window.click(at);
    window.pass(vec![]);
}

/// Types an alpha, and sweeps it for a while.
fn swept() -> Window {
    let mut window = Window::new(scene(1.0));
    let number = window.in_row("alpha", Role::SpinButton)[0];
    window.type_into(number, "0.7");
    press_button(&mut window, "sweep alpha");
    for _ in 0..5 {
        window.wait(0.3);
    }
    assert!(window.state.sweep.is_some() && alpha(&window) != Some(0.7));
    window
}

#[test]
fn a_sweep_is_one_step() {
    for stop in [
        |window: &mut Window| press_button(window, "stop sweeping"),
        |window: &mut Window| press(window, Modifiers::NONE, Key::Escape),
    ] {
        let mut window = swept();
        stop(&mut window);
        assert!(window.state.sweep.is_none());
        let left = alpha(&window);
        press(&mut window, CTRL, Key::Z);
        assert_eq!(alpha(&window), Some(0.7));
        press(&mut window, CTRL, Key::Z);
        assert_eq!(alpha(&window), None);
        assert!(!window.state.can_undo());
        press(&mut window, CTRL_SHIFT, Key::Z);
        press(&mut window, CTRL_SHIFT, Key::Z);
        assert_eq!(alpha(&window), left);
        // It does not go on by itself.
        window.wait(1.0);
        assert_eq!((alpha(&window), window.state.can_redo()), (left, false));
    }
}

#[test]
fn undo_ends_a_sweep_and_takes_it_back() {
    for undo in [|window: &mut Window| press(window, CTRL, Key::Z), |window: &mut Window| press_button(window, "Undo")]
    {
        let mut window = swept();
        undo(&mut window);
        assert!(window.state.sweep.is_none());
        assert_eq!(alpha(&window), Some(0.7));
        window.wait(1.0);
        assert_eq!(alpha(&window), Some(0.7));
        // Where it was ended is done again.
        assert!(window.state.can_redo());
        window.state.redo();
        assert!(alpha(&window).is_some_and(|alpha| alpha != 0.7));
    }
}

/// A sweep is a new change, after which nothing is done again.
#[test]
fn redo_leaves_a_sweep_alone() {
    let mut window = Window::new(scene(1.0));
    let number = window.in_row("metallic", Role::SpinButton)[0];
    window.type_into(number, "0.7");
    press(&mut window, CTRL, Key::Z);
    press_button(&mut window, "sweep alpha");
    window.wait(0.3);
    let redo = window.place(Role::Button, "Redo").center();
    assert!(window.hover_text(redo).is_some_and(|text| text.contains("nothing to redo")));
    press(&mut window, CTRL_SHIFT, Key::Z);
    assert!(window.state.sweep.is_some());
    press(&mut window, Modifiers::NONE, Key::Escape);
    press(&mut window, CTRL_SHIFT, Key::Z);
    assert_eq!(window.state.edits.of_material(0).metallic, None);
    press(&mut window, CTRL, Key::Z);
    assert_eq!((window.state.edits.clone(), window.state.can_undo()), (Edits::default(), false));
}

#[test]
fn esc_closes_the_sheet_and_keeps_what_was_done() {
    let mut window = swept();
    press_button(&mut window, "nine alphas");
    // It shows what is there: nothing moves below it.
    assert!(window.state.sheet.is_some() && window.state.sweep.is_none());
    let number = window.in_row("metallic", Role::SpinButton)[0];
    window.type_into(number, "0.3");
    let before = window.state.edits.clone();
    assert_eq!(before.of_material(0).metallic, Some(0.3));
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(window.state.sheet.is_none());
    assert_eq!(window.state.edits, before);
    // Each of them can still be undone: the number, the sweep, the alpha before it.
    for expected in [Some(0.3), None, None] {
        assert_eq!(window.state.edits.of_material(0).metallic, expected);
        press(&mut window, CTRL, Key::Z);
    }
    assert_eq!((window.state.edits.clone(), window.state.can_undo()), (Edits::default(), false));
}

#[test]
fn what_is_undone_below_the_sheet_is_seen_in_it() {
    let mut window = Window::new(scene(1.0));
    for row in ["alpha", "metallic"] {
        let number = window.in_row(row, Role::SpinButton)[0];
        window.type_into(number, "0.7");
    }
    press_button(&mut window, "nine alphas");
    let drawn =
        window.context.load_texture("test", egui::ColorImage::filled([2, 2], egui::Color32::WHITE), Default::default());
    let draw = |window: &mut Window| {
        let sheet = window.state.sheet.as_mut().unwrap();
        sheet.pictures.fill(Some(drawn.id()));
    };
    let missing = |window: &Window| window.state.sheet.as_ref().unwrap().missing();
    draw(&mut window);
    press(&mut window, CTRL, Key::Z);
    // Its pictures were of another metal.
    assert_eq!((window.state.edits.of_material(0).metallic, missing(&window)), (None, Some(0)));
    draw(&mut window);
    press(&mut window, CTRL, Key::Z);
    // Alpha is what they differ in: they stay.
    assert_eq!((alpha(&window), missing(&window)), (None, None));
    // The one that is taken is a step of its own, from what is there now.
    let picture = window.layout.picture;
    window.click(picture.left_top() + picture.size() / 2.0);
    window.pass(vec![]);
    assert_eq!((alpha(&window), window.state.sheet.is_none()), (Some(Sheet::ALPHAS[4]), true));
    assert_eq!(window.state.edits.of_material(0).metallic, None);
    press(&mut window, CTRL, Key::Z);
    assert_eq!((window.state.edits.clone(), window.state.can_undo()), (Edits::default(), false));
}

#[test]
fn the_sheet_makes_way_for_a_sweep() {
    let mut window = Window::new(scene(1.0));
    press_button(&mut window, "nine alphas");
    press_button(&mut window, "sweep alpha");
    assert!(window.state.sheet.is_none() && window.state.sweep.is_some());
}

/// Pictures stand apart by a gap: what is done there is not done to what lies below, either.
#[test]
fn nothing_below_the_sheet_hears_of_the_pointer() {
    let mut window = Window::new(scene(1.0));
    press_button(&mut window, "nine alphas");
    let picture = window.layout.picture;
    let gap = picture.left_top() + picture.size() / 3.0;
    for button in [PointerButton::Primary, PointerButton::Middle, PointerButton::Secondary] {
        assert_eq!(window.drag(button, gap, gap + vec2(50.0, 90.0)), Change::None, "{button:?}");
    }
    window.click(gap);
    window.pass(vec![Event::Zoom(1.5)]);
    assert!(window.state.sheet.is_some());
    assert_eq!((window.state.edits.clone(), window.state.outlined), (Edits::default(), None));
}
