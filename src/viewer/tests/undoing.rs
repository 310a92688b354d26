//! Undo and redo of what is done in the panel.

use super::*;

/// Undoes everything; how many steps that were.
fn undo_all(window: &mut Window) -> usize {
    let mut steps = 0;
    while window.state.history.can_undo() {
        window.state.undo();
        window.pass(vec![]);
        steps += 1;
    }
    steps
}

/// Redoes everything; how many steps that were.
fn redo_all(window: &mut Window) -> usize {
    let mut steps = 0;
    while window.state.history.can_redo() {
        window.state.redo();
        window.pass(vec![]);
        steps += 1;
    }
    steps
}

/// Drags to a place by way of many others.
fn drag_slowly(window: &mut Window, from: Pos2, to: Pos2) {
    let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
    let press = |pos, pressed| Event::PointerButton { pos, button, pressed, modifiers };
    window.pass(vec![Event::PointerMoved(from)]);
    window.pass(vec![press(from, true)]);
    for step in 1..=10 {
        window.pass(vec![Event::PointerMoved(from + (to - from) * (step as f32 / 10.0))]);
    }
    window.pass(vec![press(to, false)]);
    window.pass(vec![]);
}

/// Checks that what has been done is so many steps, that they lead back to the start and on again, and that the view stays.
fn check(window: &mut Window, steps: usize) {
    window.drag(PointerButton::Primary, pos2(300.0, 300.0), pos2(400.0, 320.0));
    let done = window.state.edits.clone();
    assert!(done.camera.is_some());
    assert_eq!(undo_all(window), steps);
    assert_eq!(window.state.edits, Edits { camera: done.camera, ..Edits::default() });
    assert_eq!(redo_all(window), steps);
    assert_eq!(window.state.edits, done);
}

#[test]
fn a_drag_is_one_step() {
    let mut window = Window::new(scene(1.0));
    let slider = window.places(Role::Slider)[0];
    drag_slowly(&mut window, slider.left_center(), slider.right_center() - vec2(20.0, 0.0));
    assert!(window.state.edits.materials[&0].alpha.is_some());
    check(&mut window, 1);
    drag_slowly(&mut window, slider.right_center() - vec2(20.0, 0.0), slider.center());
    check(&mut window, 2);
}

#[test]
fn a_number_that_is_typed_is_one_step() {
    let mut window = Window::new(scene(1.0));
    let number = window.in_row("alpha", Role::SpinButton)[0];
    window.type_into(number, "0.7125");
    assert_eq!(window.state.edits.materials[&0].alpha, Some(0.7125));
    check(&mut window, 1);
}

#[test]
fn a_colour_is_one_step_while_its_picker_stays_open() {
    let mut window = Window::new(scene(1.0));
    let well = window.places(Role::ColorWell)[0];
    window.click(well.center());
    window.pass(vec![]);
    assert!(egui::Popup::is_any_open(&window.context));
    let before = window.state.edits.clone();
    let square = window.place(Role::Slider, "saturation and brightness");
    drag_slowly(&mut window, square.center(), square.center() + vec2(40.0, 0.0));
    assert!(egui::Popup::is_any_open(&window.context));
    assert_ne!(window.state.edits, before);
    assert!(window.state.history.can_undo());
    egui::Popup::close_all(&window.context);
    window.pass(vec![]);
    check(&mut window, 1);
}

#[test]
fn nothing_is_undone_in_the_midst_of_a_drag() {
    let mut window = Window::new(scene(1.0));
    let number = window.in_row("alpha", Role::SpinButton)[0];
    window.type_into(number, "0.7");
    let slider = window.places(Role::Slider)[0];
    let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
    window.pass(vec![Event::PointerMoved(slider.center())]);
    window.pass(vec![Event::PointerButton { pos: slider.center(), button, pressed: true, modifiers }]);
    let held = window.state.edits.clone();
    assert_ne!(held.materials[&0].alpha, Some(0.7));
    window.modifiers = Modifiers::CTRL | Modifiers::COMMAND;
    window.press(Key::Z);
    assert_eq!(window.state.edits, held);
    window.pass(vec![Event::PointerButton { pos: slider.center(), button, pressed: false, modifiers }]);
    window.press(Key::Z);
    assert_eq!(window.state.edits.materials[&0].alpha, Some(0.7));
}

#[test]
fn reset_is_undone_but_for_the_view() {
    let mut window = Window::new(scene(1.0));
    let number = window.in_row("alpha", Role::SpinButton)[0];
    window.type_into(number, "0.7");
    let reset = window.place(Role::Button, "Reset").center();
    window.click(reset);
    assert_eq!(window.state.edits, Edits::default());
    window.state.undo();
    assert_eq!(window.state.edits.materials[&0].alpha, Some(0.7));
}

#[test]
fn buttons_undo_and_redo_and_say_why_not() {
    let mut window = Window::new(scene(1.0));
    let button = |window: &Window, name: &str| window.place(Role::Button, name).center();
    let says = |window: &mut Window, name: &str, wanted: &str| {
        let at = button(window, name);
        let text = window.hover_text(at).unwrap_or_default();
        assert!(text.contains(wanted), "{name}: {text}");
    };
    says(&mut window, "Undo", "nothing to undo");
    says(&mut window, "Redo", "nothing to redo");
    let number = window.in_row("alpha", Role::SpinButton)[0];
    window.type_into(number, "0.7");
    let done = window.state.edits.clone();
    says(&mut window, "Undo", "Ctrl-Z");
    let undo = button(&window, "Undo");
    assert_eq!(window.click(undo), Change::Materials);
    assert_eq!(window.state.edits, Edits::default());
    window.pass(vec![]);
    says(&mut window, "Undo", "nothing to undo");
    says(&mut window, "Redo", "Ctrl-Shift-Z");
    // A button that is disabled does nothing.
    assert_eq!(window.click(undo), Change::None);
    let redo = button(&window, "Redo");
    assert_eq!(window.click(redo), Change::Materials);
    assert_eq!(window.state.edits, done);
}

#[test]
fn an_exposure_that_was_metered_is_metered_no_more_when_it_comes_back() {
    let mut window = Window::new(scene(1.0));
    let auto = window.place(Role::CheckBox, "auto exposure").center();
    window.click(auto);
    assert!(window.state.needs_metering());
    window.state.metered = Some(-4.0);
    window.pass(vec![]);
    window.click(auto);
    assert_eq!(window.state.settings().exposure, -4.0);
    window.state.undo();
    assert!(!window.state.needs_metering() && window.state.settings().exposure == -4.0);
    window.state.undo();
    assert_eq!(window.state.edits, Edits::default());
    assert_eq!(window.state.settings().exposure, 0.0);
}
