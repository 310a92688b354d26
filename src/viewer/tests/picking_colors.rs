//! The picker of colours.

use super::*;

const FIELDS: [&str; 2] = ["saturation and brightness", "hue"];

/// A window with the picker of the sheen's colour open, which is grey.
fn open() -> Window {
    let mut scene = scene(1.0);
    scene.materials[0].sheen.as_mut().unwrap().color = Vec3::splat(0.25);
    let mut window = Window::new(scene);
    let swatch = window.in_row("sheen colour", Role::ColorWell)[0].center();
    assert_eq!(window.click(swatch), Change::None);
    // Popups grow to their size.
    window.rest(20);
    window
}

fn color(window: &Window) -> Vec3 {
    window.state.drawn().materials[0].sheen.unwrap().color
}

/// What the boxes of the sheen's colour show: its digits, and its linear numbers.
fn shown(window: &Window) -> (String, Vec3) {
    let text = |at: Rect| {
        let node = window.nodes.iter().find(|node| node.role() == Role::SpinButton && place(node) == Some(at)).unwrap();
        node.value().unwrap().to_owned()
    };
    let hex = text(window.in_row("sheen colour", Role::SpinButton)[0]);
    let channels = window.below("sheen colour", Role::SpinButton);
    (hex, Vec3::from_array(std::array::from_fn(|channel| text(channels[channel]).parse().unwrap())))
}

#[test]
fn all_of_it_says_what_it_is_and_egui_adds_nothing() {
    let mut window = open();
    let controls = |window: &Window| -> Vec<Rect> {
        let roles = [Role::Button, Role::CheckBox, Role::Slider, Role::SpinButton, Role::TextInput];
        roles.into_iter().flat_map(|role| window.places(role)).collect()
    };
    let mut places = controls(&window);
    egui::Popup::close_all(&window.context);
    window.rest(2);
    let beside = controls(&window);
    places.retain(|place| !beside.contains(place));
    let swatch = window.in_row("sheen colour", Role::ColorWell)[0].center();
    window.click(swatch);
    window.rest(20);
    assert_eq!(places, FIELDS.map(|name| window.place(Role::Slider, name)));
    for (place, wanted) in places.into_iter().zip(["Saturation", "hue"]) {
        let text = window.hover_text(place.center()).unwrap_or_default();
        assert!(text.contains(wanted), "{text}");
    }
    assert_eq!(window.state.edits, Edits::default());
}

#[test]
fn numbers_follow_while_it_is_dragged() {
    for name in FIELDS {
        let mut window = open();
        // Greys look the same whatever their hue.
        let square = window.place(Role::Slider, FIELDS[0]);
        window.click(square.right_top() + vec2(-50.0, 40.0));
        let field = window.place(Role::Slider, name);
        let press = |pos, pressed| Event::PointerButton {
            pos,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        };
        let at = |step: usize| field.left_bottom() + vec2(0.1 + 0.08 * step as f32, -0.43) * field.size();
        window.pass(vec![Event::PointerMoved(at(0))]);
        window.pass(vec![press(at(0), true)]);
        for step in 1..10 {
            let before = shown(&window);
            assert_eq!(window.pass(vec![Event::PointerMoved(at(step))]), Change::Materials);
            // A popup is laid out after what it belongs to.
            window.pass(vec![]);
            // It covers none of them.
            let boxes =
                [window.in_row("sheen colour", Role::SpinButton), window.below("sheen colour", Role::SpinButton)];
            assert!(boxes.iter().flatten().count() == 4 && boxes.iter().flatten().all(|at| !at.intersects(field)));
            let (hex, linear) = shown(&window);
            assert_ne!((&hex, linear), (&before.0, before.1), "{name}");
            let color = color(&window);
            assert!(linear.abs_diff_eq(color, 1e-4), "{name}: {linear} is not {color}");
            let bytes = color.to_array().map(|channel| {
                let channel = f64::from(channel);
                let encoded =
                    if channel <= 0.0031308 { 12.92 * channel } else { 1.055 * channel.powf(1.0 / 2.4) - 0.055 };
                (255.0 * encoded).round() as u8
            });
            assert_eq!(hex, format!("#{:02x}{:02x}{:02x}", bytes[0], bytes[1], bytes[2]), "{name}: {color}");
        }
        window.pass(vec![press(at(9), false)]);
        assert!(egui::Popup::is_any_open(&window.context));
    }
}

#[test]
fn places_are_colours() {
    let mut window = open();
    let square = window.place(Role::Slider, FIELDS[0]);
    // Beyond an edge it is the edge that is picked, to the last bit.
    let beyond = square.expand(10.0);
    let pick = |window: &mut Window, at: Pos2| _ = window.drag(PointerButton::Primary, square.center(), at);
    // Its corners, whatever the hue; a grey's is red.
    for (at, expected) in [
        (beyond.left_top(), Vec3::ONE),
        (beyond.right_top(), Vec3::X),
        (beyond.left_bottom(), Vec3::ZERO),
        (beyond.right_bottom(), Vec3::ZERO),
    ] {
        pick(&mut window, at);
        assert!(color(&window).abs_diff_eq(expected, 1e-3), "{expected} is {}", color(&window));
    }
    // Black and grey keep the hue that is picked.
    let bar = window.place(Role::Slider, "hue");
    window.click(bar.left_center() + vec2(bar.width() / 3.0, 0.0));
    assert_eq!(color(&window), Vec3::ZERO);
    pick(&mut window, beyond.left_top());
    assert_eq!(color(&window), Vec3::ONE);
    pick(&mut window, beyond.right_top());
    assert!(color(&window).abs_diff_eq(Vec3::Y, 1e-3), "{}", color(&window));
}

#[test]
fn arrow_keys_pick_and_the_view_stays() {
    let mut window = open();
    // A grey is the same whatever its hue.
    let square = window.place(Role::Slider, FIELDS[0]);
    window.click(square.center());
    for (name, keys) in [
        (FIELDS[0], vec![Key::ArrowRight, Key::ArrowUp, Key::ArrowLeft, Key::ArrowDown]),
        (FIELDS[1], vec![Key::ArrowRight, Key::ArrowLeft]),
    ] {
        let is_in = |window: &Window| {
            let field = window.place(Role::Slider, name);
            let focused = window.context.memory(|memory| memory.focused());
            focused.and_then(|id| window.context.read_response(id)).is_some_and(|response| response.rect == field)
        };
        for _ in 0..300 {
            if !is_in(&window) {
                window.press(Key::Tab);
            }
        }
        let start = color(&window);
        for key in keys {
            let before = color(&window);
            window.press(key);
            assert!(is_in(&window) && color(&window) != before, "{name}, {key:?}: {before}");
        }
        assert!(color(&window).abs_diff_eq(start, 1e-3), "{name}: {start} is {}", color(&window));
    }
    assert_eq!(window.state.edits.camera, None);
}
