//! Flying: keys that are held together with the right button.

use super::*;

const AT: Pos2 = pos2(400.0, 700.0);

fn button(pressed: bool) -> Event {
    Event::PointerButton { pos: AT, button: PointerButton::Secondary, pressed, modifiers: Modifiers::NONE }
}

/// Flies with a key for half a second; from where and to where.
fn fly(window: &mut Window, key: Key) -> [Vec3; 2] {
    window.pass(vec![Event::PointerMoved(AT)]);
    window.pass(vec![button(true)]);
    let from = window.eye();
    window.pass(vec![window.key(key, true)]);
    let passes = (0.5 / window.pace).round() as usize;
    for _ in 0..passes {
        assert_eq!(window.pass(vec![]), Change::Drawn);
        assert_eq!(window.delay, 0.0);
    }
    let to = window.eye();
    window.pass(vec![window.key(key, false)]);
    window.pass(vec![button(false)]);
    [from, to]
}

#[test]
fn keys_fly_as_fast_whatever_the_frame_rate() {
    // The camera stands a metre above the triangle.
    for (key, direction) in [
        (Key::W, Vec3::NEG_Z),
        (Key::S, Vec3::Z),
        (Key::A, Vec3::NEG_X),
        (Key::D, Vec3::X),
        (Key::E, Vec3::Y),
        (Key::Q, Vec3::NEG_Y),
    ] {
        let flown = [1.0 / 60.0, 0.1].map(|pace| {
            let mut window = Window::new(scene(1.0));
            window.pace = pace;
            let [from, to] = fly(&mut window, key);
            to - from
        });
        for flown in flown {
            assert!(flown.abs_diff_eq(0.5 * 0.5 * direction, 1e-4), "{key:?}: {flown}");
        }
    }
    let mut window = Window::new(scene(1.0));
    let slow = fly(&mut window, Key::W);
    window.modifiers = Modifiers::SHIFT;
    let fast = fly(&mut window, Key::W);
    let ratio = fast[0].distance(fast[1]) / slow[0].distance(slow[1]);
    assert!((ratio - 4.0).abs() < 0.01, "{ratio}");
}

#[test]
fn a_pause_is_not_flown_afterwards() {
    let mut window = Window::new(scene(1.0));
    fly(&mut window, Key::W);
    let before = window.eye();
    // Nothing happens for a minute.
    window.pace = 60.0;
    window.pass(vec![]);
    window.pace = 1.0 / 60.0;
    window.pass(vec![button(true)]);
    window.pass(vec![window.key(Key::W, true)]);
    window.pass(vec![]);
    assert!(window.eye().distance(before) < 0.03, "{}", window.eye().distance(before));
}

#[test]
fn slow_pictures_make_no_leaps() {
    let mut window = Window::new(scene(1.0));
    window.pass(vec![Event::PointerMoved(AT)]);
    window.pass(vec![button(true)]);
    window.pass(vec![window.key(Key::W, true)]);
    let before = window.eye();
    window.pace = 3.0;
    window.pass(vec![]);
    let flown = window.eye().distance(before);
    assert!((flown - 0.5 * 0.25).abs() < 1e-4, "{flown}");
}

#[test]
fn the_pointer_looks_around_while_flying_and_pans_otherwise() {
    let mut window = Window::new(scene(1.0));
    window.pass(vec![Event::PointerMoved(AT)]);
    window.pass(vec![button(true)]);
    window.pass(vec![window.key(Key::W, true)]);
    window.pass(vec![window.key(Key::W, false)]);
    let (eye, back) = (window.eye(), window.state.camera().world_from_camera.z_axis);
    // The key is up again, the button is not.
    assert_eq!(window.pass(vec![Event::PointerMoved(AT + vec2(200.0, 0.0))]), Change::Drawn);
    assert!(window.eye().abs_diff_eq(eye, 1e-5));
    assert!(window.state.camera().world_from_camera.z_axis.x < back.x - 0.1);
    window.pass(vec![button(false)]);
    let turned = window.state.camera().world_from_camera.z_axis;
    window.drag(PointerButton::Secondary, AT, AT + vec2(100.0, 0.0));
    assert!(window.state.camera().world_from_camera.z_axis.abs_diff_eq(turned, 1e-6));
    assert!(!window.eye().abs_diff_eq(eye, 1e-2));
}

#[test]
fn keys_alone_do_not_fly() {
    for key in [Key::W, Key::A, Key::S, Key::D, Key::Q, Key::E] {
        let mut window = Window::new(scene(1.0));
        window.pass(vec![Event::PointerMoved(AT)]);
        assert_eq!(window.press(key), Change::None, "{key:?}");
        assert_eq!(window.state.edits.camera, None);
    }
}

/// A French hand lies on Z, Q, S, D, which are where W, A, S, D are on a US keyboard.
#[test]
fn keys_fly_by_their_place_and_command_by_their_letter() {
    let key = |key: Key, place: Key, pressed: bool| Event::Key {
        key,
        physical_key: Some(place),
        pressed,
        repeat: false,
        modifiers: Modifiers::NONE,
    };
    for (letter, place, direction) in [
        (Key::Z, Key::W, Vec3::NEG_Z),
        (Key::Q, Key::A, Vec3::NEG_X),
        (Key::S, Key::S, Vec3::Z),
        (Key::W, Key::Z, Vec3::ZERO),
    ] {
        let mut window = Window::new(scene(1.0));
        window.pass(vec![Event::PointerMoved(AT)]);
        window.pass(vec![button(true)]);
        let from = window.eye();
        window.pass(vec![key(letter, place, true)]);
        window.rest(30);
        let flown = (window.eye() - from).normalize_or_zero();
        assert!(flown.abs_diff_eq(direction, 1e-3), "{letter:?}: {flown}");
        // It ends when the key is released, and when the window hears no more of keys.
        let end = if letter == Key::Z { key(letter, place, false) } else { Event::WindowFocused(false) };
        window.pass(vec![end]);
        let there = window.eye();
        window.rest(5);
        assert_eq!(window.eye(), there, "{letter:?}");
    }
    let mut window = Window::new(scene(1.0));
    window.pass(vec![key(Key::H, Key::J, true)]);
    assert!(window.state.panel_hidden);
}
