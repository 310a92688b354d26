//! The parts of the panel: presets, alpha, the list of materials, messages.

use super::*;
use crate::viewer::sheet::{Sheet, Tile};

#[test]
fn a_chip_sets_all_of_a_material_and_shows_that_it_is_in_force() {
    let mut window = full();
    let is_selected = |window: &Window, name: &str| {
        let chip = window.nodes.iter().find(|node| node.role() == Role::Button && node.label() == Some(name));
        chip.unwrap().toggled() == Some(egui::accesskit::Toggled::True)
    };
    let other = window.state.drawn().materials[1].clone();
    for name in ["velvet", "dusty metal"] {
        assert!(!is_selected(&window, name), "{name}");
        let at = window.place(Role::Button, name).center();
        assert_eq!(window.click(at), Change::Materials);
        window.pass(vec![]);
        assert!(is_selected(&window, name), "{name}");
    }
    assert!(!is_selected(&window, "velvet"));
    let drawn = window.state.drawn().materials;
    assert_eq!((drawn[0].metallic, drawn[0].sheen.unwrap().layering), (1.0, Layering::Gltf));
    assert_eq!(drawn[1], other);
    // It is in force until something of it is changed.
    let place = window.in_row("roughness", Role::SpinButton)[0];
    window.type_into(place, "0.9");
    assert!(!is_selected(&window, "dusty metal"));
}

/// The scene's materials may be called as chips are: what is a name of the scene's says so, and stays.
#[test]
fn names_of_the_scene_are_told_from_chips() {
    let mut window = full();
    let chip = window.place(Role::Button, "moss").center();
    window.click(chip);
    window.pass(vec![]);
    let list = window.in_row("in the scene", Role::ComboBox)[0];
    let says = window.nodes.iter().find(|node| place(node) == Some(list)).and_then(|node| node.value());
    assert_eq!(says, Some("0 velvet"));
    let text = window.hover_text(list.center()).unwrap();
    assert!(text.starts_with("velvet\n") && text.contains("name stays"), "{text}");
    // Where there is but one, there is nothing to pick.
    let one = Window::new(scene(1.0));
    assert!(one.nodes.iter().all(|node| node.value() != Some("in the scene")));
}

#[test]
fn a_picture_of_an_alpha_sets_it() {
    let mut window = full();
    for (name, alpha) in [("alpha 0.2", 0.2), ("alpha 1", 1.0)] {
        let at = window.place(Role::Button, name).center();
        window.click(at);
        assert_eq!(window.state.edits.of_material(0).alpha, Some(alpha));
    }
}

#[test]
fn a_sweep_moves_alpha_until_it_is_told_to_stop() {
    let alpha = |window: &Window| window.state.edits.of_material(0).alpha.unwrap();
    let stops: [fn(&mut Window); 4] = [
        |window| {
            let at = window.place(Role::Button, "stop sweeping").center();
            window.click(at);
        },
        |window| _ = window.press(Key::Escape),
        |window| {
            let at = window.places(Role::Slider)[0].center();
            window.click(at);
        },
        |window| {
            let at = window.place(Role::Button, "felt").center();
            window.click(at);
        },
    ];
    for (index, stop) in stops.into_iter().enumerate() {
        let mut window = full();
        let at = window.place(Role::Button, "sweep alpha").center();
        window.click(at);
        let (mut least, mut most) = (1.0f32, 0.0f32);
        for _ in 0..25 {
            window.wait(0.25 - window.pace);
            assert!(window.state.sweep.is_some() && window.delay == 0.0);
            (least, most) = (least.min(alpha(&window)), most.max(alpha(&window)));
        }
        assert!(least < 0.1 && most > 0.9, "from {least} to {most}");
        stop(&mut window);
        window.pass(vec![]);
        assert!(window.state.sweep.is_none(), "{index}");
        let before = alpha(&window);
        window.wait(1.0);
        assert_eq!(alpha(&window), before, "{index}");
    }
}

#[test]
fn a_sheet_of_nine_lies_over_the_picture_and_one_is_taken() {
    let mut window = full();
    let open = |window: &mut Window| {
        let at = window.place(Role::Button, "nine alphas").center();
        window.click(at);
        window.pass(vec![]);
        assert!(window.state.sheet.is_some());
    };
    let before = window.state.edits.clone();
    open(&mut window);
    _ = window.press(Key::Escape);
    assert!(window.state.sheet.is_none());
    assert_eq!(window.state.edits, before);
    for alpha in Sheet::ALPHAS {
        open(&mut window);
        let picture = window.layout.picture;
        let name = format!("alpha {alpha}");
        // One of the pictures in the panel has the same name as one of these.
        let places = window.nodes.iter().filter(|node| node.role() == Role::Button && node.label() == Some(&name));
        let cell = places.filter_map(place).find(|place| picture.contains_rect(*place)).unwrap();
        let camera = window.state.edits.camera;
        window.click(cell.center());
        assert!(window.state.sheet.is_none());
        assert_eq!(window.state.edits.of_material(0).alpha, Some(alpha));
        assert_eq!(window.state.edits.camera, camera);
    }
    // A drag over it turns nothing that lies below.
    open(&mut window);
    let camera = window.state.edits.camera;
    window.drag(PointerButton::Primary, pos2(300.0, 300.0), pos2(400.0, 320.0));
    assert_eq!(window.state.edits.camera, camera);
}

#[test]
fn a_sheet_whose_scene_has_changed_begins_anew() {
    let mut window = full();
    let mut sheet = Sheet::new(&window.state.edits, 0);
    sheet.pictures[3] = Some(Tile { texture: egui::TextureId::User(7), size: [2; 2] });
    window.state.sheet = Some(sheet);
    let is_kept = |window: &Window| window.state.sheet.as_ref().unwrap().pictures[3].is_some();
    // Alpha is none of what they have in common.
    window.state.edits.materials.entry(0).or_default().alpha = Some(0.77);
    window.pass(vec![]);
    assert!(is_kept(&window));
    window.state.edits.exposure = Some(1.0.into());
    window.pass(vec![]);
    assert!(!is_kept(&window));
}

#[test]
fn a_sheen_goes_off_and_comes_back() {
    let mut window = full();
    let before = window.state.drawn().materials[0].sheen;
    for expected in [None, before] {
        let at = window.place(Role::CheckBox, "has a sheen").center();
        assert_eq!(window.click(at), Change::Materials);
        assert_eq!(window.state.drawn().materials[0].sheen, expected);
    }
}

#[test]
fn a_colour_that_is_changed_covers_as_much_as_before() {
    let mut scene = scene(1.0);
    scene.materials[0].sheen.as_mut().unwrap().weight = 0.25;
    let mut window = Window::new(scene);
    let place = window.in_row("sheen colour", Role::SpinButton)[0];
    window.type_into(place, "#f00");
    let sheen = window.state.drawn().materials[0].sheen.unwrap();
    assert_eq!((sheen.color, sheen.weight), (Vec3::X, 0.25));
    let place = window.in_row("coverage", Role::SpinButton)[0];
    window.type_into(place, "0");
    assert_eq!(window.state.drawn().materials[0].sheen.map(|sheen| sheen.weight), Some(0.0));
}

#[test]
fn many_materials_are_searched() {
    for (count, is_searched) in [(12, false), (200, true)] {
        let mut scene = scene(1.0);
        let material = |index: usize| Material { name: format!("cloth.{index:03}"), ..scene.materials[0].clone() };
        scene.materials = (0..count).map(material).collect();
        let mut window = Window::new(scene);
        let list = window.places(Role::ComboBox)[0];
        window.click(list.center());
        window.pass(vec![]);
        let boxes = window.places(Role::TextInput);
        assert_eq!(boxes.len(), usize::from(is_searched));
        if let [search] = boxes[..] {
            window.click(search.center());
            for character in "147".chars() {
                window.pass(vec![Event::Text(character.to_string())]);
                window.pass(vec![]);
            }
            let found = window.place(Role::Button, "cloth.147");
            window.click(found.center());
            assert_eq!(window.state.material, 147);
            assert!(!egui::Popup::is_any_open(&window.context));
        }
    }
}

#[test]
fn messages_stand_until_they_are_dismissed() {
    let mut window = Window::new(scene(1.0));
    for what in ["one", "two", "one", "three"] {
        window.state.say(what.to_owned());
    }
    assert_eq!(window.state.messages, ["two", "one", "three"]);
    for _ in 0..3 {
        window.pass(vec![]);
    }
    // Nor does anything else that is done.
    let reset = window.place(Role::Button, "Reset").center();
    window.click(reset);
    assert_eq!(window.state.messages.len(), 3);
    let row = window.place(Role::Label, "one").y_range();
    let mut buttons = window.places(Role::Button).into_iter();
    let dismiss = buttons.find(|place| row.contains(place.center().y)).unwrap();
    window.click(dismiss.center());
    assert_eq!(window.state.messages, ["two", "three"]);
}

#[test]
fn what_was_said_of_the_exposure_goes_with_it() {
    let mut window = Window::new(scene(1.0));
    window.state.notices.push("all is black".to_owned());
    window.state.say("all is black".to_owned());
    window.state.say("saved".to_owned());
    window.pass(vec![]);
    let place = window.in_row("exposure", Role::SpinButton)[0];
    window.type_into(place, "3");
    assert_eq!(window.state.messages, ["saved"]);
}

#[test]
fn one_line_says_how_things_stand() {
    let mut window = Window::new(scene(1.0));
    window.state.frame_time = Some(std::time::Duration::from_micros(8_340));
    window.state.samples = Some([12, 64]);
    window.state.doing = Some("sorting triangles");
    window.pass(vec![]);
    window.place(Role::Label, "sorting triangles, frame 8.3 ms, 12 of 64 samples");
}

#[test]
fn reset_ends_a_sweep_and_leaves_nothing() {
    let mut window = full();
    let at = window.place(Role::Button, "sweep alpha").center();
    window.click(at);
    window.wait(0.5);
    let at = window.place(Role::Button, "Reset").center();
    window.click(at);
    window.wait(0.5);
    assert!(window.state.sweep.is_none());
    assert_eq!(window.state.edits, Edits::default());
}

#[test]
fn parts_fold_and_stay_folded() {
    let mut window = full();
    let is_open = |window: &Window| !window.places(Role::Slider).is_empty();
    for title in ["Material", "Picture"] {
        assert!(is_open(&window));
        let at = window.place(Role::DisclosureTriangle, title).center();
        window.click(at);
        for _ in 0..60 {
            window.pass(vec![]);
        }
    }
    assert!(!is_open(&window));
}

/// On the least window everything can be scrolled to once the panel is shown, and what is done with the whole stays in sight.
#[test]
fn a_small_window_reaches_everything() {
    let size = vec2(480.0, 320.0);
    let mut window = Window::of_size(scene(1.0), size);
    let names = ["Save picture", "Save state", "Undo", "Redo", "Reset", "?"];
    window.press(Key::H);
    assert!(window.layout.picture.width() > 150.0);
    let wheel = Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        delta: vec2(0.0, -60.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Wheel,
        modifiers: Modifiers::NONE,
    };
    let mut seen = std::collections::BTreeSet::new();
    window.pass(vec![Event::PointerMoved(pos2(330.0, 120.0))]);
    for _ in 0..60 {
        for name in names {
            let place = window.place(Role::Button, name);
            assert!(Rect::from_min_size(Pos2::ZERO, size).contains_rect(place), "{name} at {place}");
        }
        let strip = window.place(Role::Button, "Reset").min.y;
        let sight = Rect::from_min_max(Pos2::ZERO, pos2(480.0, strip));
        let labels = window.nodes.iter().filter(|node| node.role() == Role::Label);
        let shown = labels.filter(|node| place(node).is_some_and(|place| sight.contains_rect(place)));
        seen.extend(shown.filter_map(|node| node.value().map(str::to_owned)));
        window.pass(vec![wheel.clone()]);
        for _ in 0..10 {
            window.pass(vec![]);
        }
    }
    for row in ["alpha", "sheen colour", "layering", "roughness", "exposure", "ambient light", "radiance", "position"] {
        assert!(seen.contains(row), "{row} is not in {seen:?}");
    }
}

/// What is out of sight costs nothing but its room.
#[test]
fn a_thousand_lights_are_laid_out_where_they_are_seen() {
    let mut many = scene(1.0);
    many.lights = vec![many.lights[0].clone(); 1000];
    let mut window = Window::of_size(many, vec2(1280.0, 720.0));
    let listed = |window: &Window| -> Vec<usize> {
        let titles = window.nodes.iter().filter_map(|node| node.label()?.strip_prefix("key (")?.strip_suffix(')'));
        titles.map(|number| number.parse().unwrap()).collect()
    };
    assert!((1..100).contains(&listed(&window).len()), "{}", listed(&window).len());
    let scroll = |window: &mut Window, delta: f32| {
        let (unit, phase) = (egui::MouseWheelUnit::Point, egui::TouchPhase::Move);
        let source = egui::MouseWheelSource::Wheel;
        let (delta, modifiers) = (vec2(0.0, delta), Modifiers::NONE);
        window.pass(vec![Event::PointerMoved(pos2(1100.0, 300.0))]);
        window.pass(vec![Event::MouseWheel { unit, delta, phase, source, modifiers }]);
        window.rest(40);
    };
    // All of them have their room: the last is at the very end.
    scroll(&mut window, -1e6);
    let last = window.place(Role::DisclosureTriangle, "key (1000)");
    assert!(last.max.y < 660.0 && !listed(&window).contains(&1));
    // One that is opened there works, and stays open while it is out of sight.
    window.click(last.center());
    window.rest(40);
    scroll(&mut window, -1e6);
    let radiance = window.in_row("radiance", Role::SpinButton)[0];
    window.type_into(radiance, "3");
    assert_eq!(window.state.edits.lights[&999].strength, Some(3.0));
    // What is being typed is not lost there.
    window.wait(2.0);
    window.click(radiance.center());
    window.pass(vec![Event::Text("5".to_owned())]);
    scroll(&mut window, 1e6);
    assert!(listed(&window).contains(&1) && listed(&window).contains(&1000));
    window.press(Key::Enter);
    assert_eq!(window.state.edits.lights[&999].strength, Some(5.0));
    window.rest(2);
    assert!(!listed(&window).contains(&1000));
    scroll(&mut window, -1e6);
    assert_eq!(window.in_row("radiance", Role::SpinButton), [radiance]);
}
