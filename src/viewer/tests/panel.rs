//! The panel.

use super::*;

#[test]
fn rests_while_nothing_happens() {
    for mut window in [Window::new(scene(1.0)), full()] {
        let before = window.state.edits.clone();
        for _ in 0..10 {
            window.pass(vec![]);
        }
        assert_eq!(window.pass(vec![]), Change::None);
        assert!(window.delay > 3600.0, "the next pass is wanted in {} s", window.delay);
        assert_eq!(window.state.edits, before);
    }
}

#[test]
fn the_panel_leaves_the_picture_free() {
    let picture = Window::new(scene(1.0)).layout.picture;
    assert!(picture.min == Pos2::ZERO && picture.width() > 950.0 && picture.height() == 1400.0);
}

#[test]
fn long_names_and_many_things_leave_the_panel_as_wide_as_it_is() {
    let mut many = scene(1.0);
    let name = "a very long name of a material ".repeat(20);
    many.materials = vec![Material { name: name.clone(), ..many.materials[0].clone() }; 60];
    many.lights = vec![Light { name: name.replace(' ', "_"), ..many.lights[0].clone() }; 40];
    let mut window = Window::new(many);
    assert_eq!(window.layout.picture, Window::new(scene(1.0)).layout.picture);
    let list = window.places(Role::ComboBox)[0];
    window.click(list.center());
    for node in &window.nodes {
        let place = place(node).unwrap_or(Rect::NOTHING);
        assert!(place.max.x <= 1280.0, "{node:?}");
    }
}

#[test]
fn the_alpha_slider_is_alpha_itself_and_reset_takes_it_back() {
    let mut scene = scene(1.0);
    let texture = TextureUse { texture: 0, tex_coord: 0, uv_from_tex_coord: Default::default() };
    scene.materials[0].textures[TextureSlot::SheenRoughness as usize] = Some(texture);
    let mut window = Window::new(scene);
    let slider = window.places(Role::Slider)[0];
    let change = window.drag(PointerButton::Primary, slider.left_center(), slider.right_center() - vec2(40.0, 0.0));
    assert_eq!(change, Change::Materials);
    let alpha = window.state.edits.materials[&0].alpha.unwrap();
    assert!(alpha > 0.6, "{alpha}");
    // Whatever the texture: the same value as the flag's.
    let drawn = window.state.drawn();
    assert_eq!(drawn.materials[0].sheen.map(|sheen| sheen.alpha()), Some(alpha));
    assert_eq!(drawn.materials[0].texture(TextureSlot::SheenRoughness), None);
    // The scene stays as it was loaded.
    assert_eq!(window.state.scene.materials[0].sheen, Some(Sheen::new(Vec3::ONE, 0.3)));
    assert_eq!(window.state.scene.materials[0].texture(TextureSlot::SheenRoughness), Some(texture));
    let reset = window.place(Role::Button, "Reset").center();
    assert_eq!(window.click(reset), Change::Materials);
    assert_eq!(window.state.edits, Edits::default());
}

#[test]
fn what_is_set_for_a_material_is_for_it_alone() {
    let mut window = full();
    let before = window.state.edits.clone();
    let share = window.in_row("base's share", Role::Slider)[0];
    let change = window.drag(PointerButton::Primary, share.left_center(), share.center());
    assert_eq!(change, Change::Materials);
    assert!(matches!(window.state.edits.materials[&0].layering, Some(Layering::Manual(share)) if share != 0.3));
    assert_eq!((window.state.edits.materials.len(), window.state.edits.every_material), (1, before.every_material));
}

#[test]
fn a_sheen_is_added_where_there_is_none() {
    let mut scene = scene(1.0);
    scene.materials[0].sheen = None;
    scene.materials[0].alpha_mode = AlphaMode::Opaque;
    let mut window = Window::new(scene);
    let switch = window.place(Role::CheckBox, "has a sheen").center();
    assert_eq!(window.click(switch), Change::Materials);
    assert_eq!(window.state.drawn().materials[0].sheen, Some(Sheen::new(Vec3::ONE, 0.5)));
}

#[test]
fn lights_keep_their_hue_when_they_are_turned_down_and_up() {
    let mut window = full();
    for (row, loaded) in [("radiance", Vec3::new(4.0, 2.0, 1.0)), ("ambient light", Vec3::new(0.1, 0.2, 0.3))] {
        let radiance = |window: &Window| match row {
            "ambient light" => window.state.edits.settings().ambient,
            _ => window.state.drawn().lights[0].radiance,
        };
        assert_eq!(radiance(&window), loaded);
        for (text, strength) in [("0", 0.0), ("3.7", 3.7)] {
            let number = window.in_row(row, Role::SpinButton)[0];
            window.type_into(number, text);
            let expected = loaded / loaded.max_element() * strength;
            assert!(radiance(&window).abs_diff_eq(expected, 1e-6), "{row} {text}: {}", radiance(&window));
        }
    }
}

#[test]
fn a_colour_that_is_looked_at_is_no_change() {
    let mut window = full();
    let buttons = window.places(Role::ColorWell);
    // The sheen's, the base's, the ambient light's, and the light's.
    assert_eq!(buttons.len(), 4);
    for button in buttons {
        let before = window.state.edits.clone();
        assert_eq!(window.click(button.center()), Change::None);
        assert!(egui::Popup::is_any_open(&window.context), "{button}");
        for step in 0..10 {
            let over = button.center() + vec2(-4.0 * step as f32, 10.0 * step as f32);
            assert_eq!(window.pass(vec![Event::PointerMoved(over)]), Change::None);
        }
        assert_eq!(window.state.edits, before);
        egui::Popup::close_all(&window.context);
        window.pass(vec![]);
    }
}

/// A value of one material's is no reason for the others to change.
#[test]
fn a_material_that_is_edited_takes_nothing_from_the_others() {
    let mut scene = scene(1.0);
    scene.materials[0].sheen = None;
    scene.materials.push(scene.materials[0].clone());
    let mut window = Window::new(scene);
    window.state.edits.every_material.alpha = Some(0.5);
    window.pass(vec![]);
    let number = window.in_row("alpha", Role::SpinButton)[0];
    window.type_into(number, "0.7");
    let drawn = window.state.drawn();
    let alphas: Vec<_> = drawn.materials.iter().map(|material| material.sheen.map(|sheen| sheen.alpha())).collect();
    assert_eq!(alphas, [Some(0.7), Some(0.5)]);
}

#[test]
fn boxes_hold_what_is_typed_key_by_key() {
    for size in [1e-3, 1.0, 1e3] {
        let mut window = Window::new(scene(size));
        // Longer and finer than what the boxes show.
        for (text, expected) in [("2.3", 2.3), ("-0.0456", -0.0456), ("1234.567", 1234.567), ("0.12345", 0.12345)] {
            for axis in 0..3 {
                let place = window.in_row("position", Role::SpinButton)[axis];
                window.type_into(place, text);
                assert_eq!(window.state.edits.lights[&0].position.unwrap()[axis], expected, "{text} {size}");
            }
            let place = window.in_row("radiance", Role::SpinButton)[0];
            window.type_into(place, text.trim_start_matches('-'));
            assert_eq!(window.state.drawn().lights[0].radiance.x, expected.abs(), "{text} {size}");
        }
        let fractions = [("alpha", "0.12345"), ("metallic", "0.4567"), ("exposure", "1.2345")];
        for (row, text) in fractions {
            let place = window.in_row(row, Role::SpinButton)[0];
            window.type_into(place, text);
            let own = window.state.edits.of_material(0);
            let exposure = window.state.edits.exposure.map(|_| window.state.settings().exposure);
            let found = [own.alpha, own.metallic, exposure].into_iter().flatten().last();
            assert_eq!(found, text.parse().ok(), "{row}");
        }
    }
}

#[test]
fn a_drag_of_a_position_is_in_the_scenes_proportion() {
    for size in [1e-3, 1.0, 1e3] {
        let mut window = Window::new(scene(size));
        let place = window.in_row("position", Role::SpinButton)[0].center();
        window.drag(PointerButton::Primary, place, place + vec2(100.0, 0.0));
        let moved = window.state.edits.lights[&0].position.unwrap().x - window.state.scene.lights[0].position().x;
        assert!((0.02..2.0).contains(&(moved / size)), "{moved} m in a scene of {size} m");
    }
}

#[test]
fn requests_reach_the_window() {
    let mut window = Window::new(scene(1.0));
    for (button, request) in [("Save picture", Request::Screenshot), ("Save state", Request::SaveState)] {
        let at = window.place(Role::Button, button).center();
        let press = |pressed| Event::PointerButton {
            pos: at,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        };
        window.pass(vec![Event::PointerMoved(at)]);
        window.pass(vec![press(true)]);
        assert_eq!(window.layout.request, None);
        window.pass(vec![press(false)]);
        assert_eq!(window.layout.request, Some(request));
    }
}
