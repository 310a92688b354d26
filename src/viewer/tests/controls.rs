//! What all controls of the panel have in common.

use super::*;
use egui::Id;

/// Roles of what can be touched.
const TOUCHED: [Role; 8] = [
    Role::Button,
    Role::CheckBox,
    Role::ColorWell,
    Role::ComboBox,
    Role::DisclosureTriangle,
    Role::Slider,
    Role::SpinButton,
    Role::TextInput,
];

/// Whether a control has a value: buttons and folds have none, but for those that stand for one of several values.
fn has_value(name: &str) -> bool {
    let is_choice =
        ["neutral", "AgX", "none", "one side", "both"].iter().any(|choice| name.contains(&format!("\"{choice}\"")));
    // Which material is shown is no part of any.
    let is_list = name.contains("0 velvet");
    is_choice || !(name.starts_with("Button") || name.starts_with("Disclosure") || is_list)
}

/// Controls of the panel that are in sight, where they are, and whether they can be used.
fn controls(window: &Window) -> Vec<(String, Rect, bool)> {
    let touched = window.nodes.iter().filter(|node| TOUCHED.contains(&node.role()));
    let all = touched.filter_map(|node| {
        let name = format!("{:?} {:?} {:?}", node.role(), node.label(), node.value());
        Some((name, place(node)?, !node.is_disabled()))
    });
    all.collect()
}

#[test]
fn every_control_says_what_it_is_for() {
    let mut window = full();
    window.state.say("a message".to_owned());
    for _ in 0..3 {
        window.pass(vec![]);
    }
    let found = controls(&window);
    assert!(found.len() > 55, "{} controls", found.len());
    for (name, place, _) in found {
        let text = window.hover_text(place.center());
        assert!(text.as_ref().is_some_and(|text| text.len() > 15), "{name} at {place} says {text:?}");
    }
    // The ruler: what is no control says nothing.
    assert_eq!(window.hover_text(pos2(200.0, 900.0)), None);
}

#[test]
fn what_cannot_be_changed_says_why() {
    for (is_unlit, expected) in [(false, "has no sheen"), (true, "unlit")] {
        let mut scene = scene(1.0);
        scene.materials[0].sheen = None;
        scene.materials[0].unlit = is_unlit;
        let mut window = Window::new(scene);
        window.pass(vec![]);
        let disabled: Vec<_> = controls(&window).into_iter().filter(|(.., is_enabled)| !is_enabled).collect();
        assert!(disabled.len() > 15, "{} controls", disabled.len());
        let mut reasons = 0;
        for (name, place, _) in disabled {
            let text = window.hover_text(place.center()).unwrap_or_else(|| panic!("{name} says nothing"));
            reasons += usize::from(text.contains(expected));
            let before = window.state.edits.clone();
            window.click(place.center());
            assert_eq!(window.state.edits, before, "{name}");
        }
        assert!(reasons > 14, "{reasons} name the reason: {expected}");
    }
}

/// So many clicks with these modifiers.
fn click_with(window: &mut Window, at: Pos2, modifiers: Modifiers, times: usize) {
    window.modifiers = modifiers;
    for _ in 0..times {
        window.click(at);
    }
    window.modifiers = Modifiers::NONE;
    // No click after these counts as one more of them.
    window.wait(2.0);
}

/// Edits of everything that the panel shows.
fn touched() -> Edits {
    let own = MaterialEdits {
        sheen: Some(true),
        alpha: Some(0.6),
        sheen_color: Some(Vec3::new(0.5, 0.25, 0.1)),
        sheen_weight: Some(0.5),
        layering: Some(Layering::Manual(0.3)),
        sheen_model: Some(crate::scene::SheenModel::Burley),
        base_color: Some(Vec3::new(0.1, 0.2, 0.3)),
        metallic: Some(0.5),
        roughness: Some(0.25),
        ..MaterialEdits::default()
    };
    let light = crate::scene::LightEdits {
        radiance: Some(Vec3::new(1.0, 0.25, 0.5)),
        strength: Some(3.0),
        temperature: Some(2700.0),
        power: Some(10.0),
        position: Some(Vec3::new(0.1, 0.2, 0.3)),
        rotation: Some(glam::Quat::from_euler(glam::EulerRot::YXZ, 0.1, 0.2, 0.3)),
        size: Some(glam::Vec2::new(0.3, 0.4)),
        two_sided: Some(true),
        ..crate::scene::LightEdits::default()
    };
    let studio = crate::scene::Added {
        name: "studio key light".to_owned(),
        shape: crate::scene::LightShape::Rectangle,
        changes: light,
    };
    Edits {
        added_lights: vec![studio],
        materials: [(0, own)].into(),
        lights: [(0, light)].into(),
        exposure: Some(1.5.into()),
        ambient: Some(Vec3::new(0.5, 1.0, 0.5)),
        ambient_strength: Some(0.5),
        tone: Some(crate::picture::ToneCurve::Agx),
        shadows: Some(false),
        lights_visible: Some(false),
        lobes: Some(crate::scene::Lobes::NONE),
        ..Edits::default()
    }
}

#[test]
fn ctrl_click_puts_every_control_back() {
    let mut window = full();
    window.state.edits = touched();
    window.pass(vec![]);
    let controls = controls(&window);
    for (name, place, is_enabled) in controls {
        if !is_enabled || !has_value(&name) {
            continue;
        }
        window.state.edits = touched();
        window.pass(vec![]);
        click_with(&mut window, place.center(), Modifiers::COMMAND, 1);
        let after = window.state.edits.clone();
        assert_ne!(after, touched(), "{name} at {place}");
        assert!(!egui::Popup::is_any_open(&window.context), "{name}");
        assert_eq!(window.context.memory(|memory| memory.focused()), None, "{name}");
    }
}

#[test]
fn everything_put_back_is_what_was_loaded() {
    let mut window = full();
    window.state.edits = touched();
    window.pass(vec![]);
    // What is put back may move those below it.
    let mut index = 0;
    while let Some((name, place, is_enabled)) = controls(&window).get(index) {
        if *is_enabled && has_value(name) {
            let at = place.center();
            click_with(&mut window, at, Modifiers::COMMAND, 1);
        }
        index += 1;
    }
    assert!(index > 50, "{index} controls");
    assert_eq!(window.state.edits, Edits::default());
}

#[test]
fn a_double_click_puts_sliders_and_swatches_back() {
    let mut window = full();
    for (row, role) in [
        ("exposure", Role::Slider),
        ("metallic", Role::Slider),
        ("roughness", Role::Slider),
        ("coverage", Role::Slider),
        ("sheen colour", Role::ColorWell),
        ("base colour", Role::ColorWell),
        ("hue", Role::ColorWell),
    ] {
        window.state.edits = touched();
        window.pass(vec![]);
        let at = window.in_row(row, role)[0].center();
        click_with(&mut window, at, Modifiers::NONE, 2);
        let own = window.state.edits.of_material(0);
        let light = window.state.edits.lights[&0].radiance;
        let is_back = match row {
            "exposure" => window.state.edits.exposure.is_none(),
            "metallic" => own.metallic.is_none(),
            "roughness" => own.roughness.is_none(),
            "coverage" => own.sheen_weight.is_none(),
            "sheen colour" => own.sheen_color.is_none(),
            "base colour" => own.base_color.is_none(),
            _ => light == Some(Vec3::new(1.0, 0.5, 0.25)),
        };
        assert!(is_back, "{row}: {:?}", window.state.edits);
        assert!(!egui::Popup::is_any_open(&window.context), "{row}");
    }
    // Alpha's slider stands below its name.
    window.state.edits = touched();
    window.pass(vec![]);
    let at = window.places(Role::Slider)[0].center();
    click_with(&mut window, at, Modifiers::NONE, 2);
    assert_eq!(window.state.edits.of_material(0).alpha, None);
    // A box is typed into instead, and a switch switches twice.
    let at = window.in_row("metallic", Role::SpinButton)[0].center();
    let before = window.state.edits.clone();
    click_with(&mut window, at, Modifiers::NONE, 2);
    assert_eq!(window.state.edits, before);
}

#[test]
fn tab_walks_through_all_and_changes_nothing() {
    let mut window = full();
    let before = window.state.edits.clone();
    // What cannot be used is passed over.
    let count = controls(&window).into_iter().filter(|(.., is_enabled)| *is_enabled).count();
    let mut seen: Vec<Id> = Vec::new();
    for _ in 0..count + 20 {
        _ = window.press(Key::Tab);
        window.pass(vec![]);
        seen.extend(window.context.memory(|memory| memory.focused()));
        assert_eq!(window.state.edits, before);
    }
    seen.sort_by_key(|id| id.value());
    seen.dedup();
    assert!(seen.len() >= count, "{} of {count} controls", seen.len());
}

#[test]
fn boxes_take_sums_and_say_what_is_no_number() {
    let mut window = full();
    let metallic = |window: &Window| window.state.edits.of_material(0).metallic;
    for (text, expected) in [("1/3 + 0.2", 1.0 / 3.0 + 0.2), ("2*0.4", 0.8), ("(1+2)/4", 0.75), ("0,125", 0.125)] {
        let place = window.in_row("metallic", Role::SpinButton)[0];
        window.type_into(place, text);
        assert_eq!(metallic(&window), Some(expected as f32), "{text}");
        assert!(window.state.messages.is_empty(), "{:?}", window.state.messages);
    }
    for text in ["two", "1/", "0.1.2", "1/0"] {
        let before = window.state.edits.clone();
        let place = window.in_row("metallic", Role::SpinButton)[0];
        window.type_into(place, text);
        assert_eq!(window.state.edits, before, "{text}");
        assert!(window.state.messages.last().is_some_and(|said| said.contains(text)), "{:?}", window.state.messages);
    }
    // Esc leaves a box as it was, and says nothing.
    let before = (window.state.edits.clone(), window.state.messages.clone());
    for text in ["0.9x", "0.9"] {
        let at = window.in_row("metallic", Role::SpinButton)[0].center();
        window.click(at);
        window.pass(vec![Event::Text(text.to_owned())]);
        _ = window.press(Key::Escape);
        window.wait(1.0);
        assert_eq!((window.state.edits.clone(), window.state.messages.clone()), before, "{text}");
    }
}

#[test]
fn colours_are_typed_as_the_web_writes_them() {
    let mut window = full();
    let color = |window: &Window| window.state.drawn().materials[0].sheen.unwrap().color;
    for (text, expected) in [
        ("#a0c030", [0xa0, 0xc0, 0x30]),
        ("102030", [0x10, 0x20, 0x30]),
        ("#f3A", [0xff, 0x33, 0xaa]),
        ("FFF", [0xff; 3]),
    ] {
        let place = window.in_row("sheen colour", Role::SpinButton)[0];
        window.type_into(place, text);
        let linear = |byte: i32| {
            let encoded = f64::from(byte) / 255.0;
            (if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }) as f32
        };
        let expected = Vec3::from_array(expected.map(linear));
        assert!(color(&window).abs_diff_eq(expected, 1e-5), "{text}: {} is not {expected}", color(&window));
    }
    let before = window.state.edits.clone();
    let place = window.in_row("sheen colour", Role::SpinButton)[0];
    window.type_into(place, "#a0c0");
    assert_eq!(window.state.edits, before);
    assert!(window.state.messages[0].contains("#a0c0"), "{:?}", window.state.messages);
    // Linear numbers below it.
    let place = window.below("sheen colour", Role::SpinButton)[1];
    window.type_into(place, "0.123");
    assert_eq!(color(&window).y, 0.123);
}
