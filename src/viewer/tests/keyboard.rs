//! Each key of the table has its effect, and none while a text is typed.

use super::super::commands::Command;
use super::super::grab::Tool;
use super::super::keys::{Input, ROWS};
use super::super::lamp::LightId;
use super::super::panel;
use super::super::saving::{Settings, Wish};
use super::*;

/// What can be told of a window from outside.
#[derive(Debug, PartialEq)]
struct Snapshot {
    edits: Edits,
    flags: [bool; 4],
    request: Option<Request>,
    /// What is done with the light in the hand.
    tool: Option<Tool>,
}

/// A window in which every key has something to do, by a press with these modifiers.
fn after(modifiers: Modifiers, key: Option<Key>) -> Snapshot {
    let mut window = Window::new(scene(1.0));
    window.state.edits.exposure = Some(2.0.into());
    window.pass(vec![]);
    window.state.edits.exposure = Some(3.0.into());
    window.pass(vec![]);
    window.state.undo();
    window.drag(PointerButton::Primary, pos2(300.0, 300.0), pos2(340.0, 330.0));
    window.state.chosen_light = Some(LightId::Area(0));
    window.modifiers = modifiers;
    let request = key.and_then(|key| window.request(key));
    let State { edits, panel_hidden, keys_shown, saving, opening, hands, .. } = window.state;
    let flags = [panel_hidden, keys_shown, saving.form.is_some(), opening.is_some()];
    Snapshot { edits, flags, request, tool: hands.grab.map(|grab| grab.tool) }
}

#[test]
fn each_key_has_its_effect() {
    let nothing = after(Modifiers::NONE, None);
    let mut seen = 0;
    for row in ROWS {
        let (modifiers, key) = match row.input {
            Input::Press(modifiers, key) => (modifiers, key),
            Input::Unfocused(key) => (Modifiers::NONE, key),
            _ => continue,
        };
        seen += 1;
        let held = if modifiers.command { modifiers | Modifiers::CTRL } else { modifiers };
        let found = after(held, Some(key));
        let exposure = |edits: &Edits| edits.exposure;
        let is_right = match row.command {
            Command::Undo => exposure(&found.edits).is_none() && found.edits.camera == nothing.edits.camera,
            Command::Redo => exposure(&found.edits) == Some(3.0.into()) && found.edits.camera == nothing.edits.camera,
            Command::SavePicture => {
                found.request == Some(Request::SavePicture(Wish { settings: Settings::default(), name: None }))
            }
            Command::SavePictureAs => found.flags == [false, false, true, false] && found.request.is_none(),
            Command::CopyPicture => found.request == Some(Request::CopyCommand),
            Command::Open => found.flags == [false, false, false, true],
            Command::Reload => found.request == Some(Request::Reload),
            Command::SaveState => found.request == Some(Request::SaveState),
            Command::Fullscreen => found.request == Some(Request::Fullscreen),
            Command::Panel => found.flags == [true, false, false, false],
            Command::Keys => found.flags == [false, true, false, false],
            Command::Grab(tool) => found.tool == Some(tool) && found.edits.lights.is_empty(),
            Command::DuplicateLight => found.tool == Some(Tool::Move) && found.edits.added_lights.len() == 1,
            Command::DeleteLight => found.edits.lights[&0].removed == Some(true),
            Command::Home => found.edits.camera.is_none() && nothing.edits.camera.is_some(),
            Command::TurnBy(_) | Command::LookFrom(_) | Command::Frame => {
                found.edits.camera.is_some() && found.edits.camera != nothing.edits.camera
            }
            // Has a test of its own.
            Command::Close => true,
            Command::Turn | Command::Pan | Command::Zoom | Command::Pick => false,
            Command::Centre | Command::Fly(_) | Command::Aim => false,
        };
        assert!(is_right, "{row:?}: {found:?}");
    }
    assert!(seen > 15);
}

#[test]
fn views_look_along_the_axes() {
    for (key, towards_eye) in [(Key::Num1, Vec3::Z), (Key::Num3, Vec3::X), (Key::Num7, Vec3::Y)] {
        let mut window = Window::new(scene(1.0));
        let (target, distance) = (window.state.orbit().target, window.state.orbit().distance);
        window.drag(PointerButton::Primary, pos2(300.0, 300.0), pos2(340.0, 330.0));
        window.press(key);
        let (orbit, camera) = (window.state.orbit(), window.state.camera().world_from_camera);
        assert!(camera.z_axis.truncate().abs_diff_eq(towards_eye, 0.011), "{key:?}: {camera}");
        assert!(camera.y_axis.y >= 0.0 && orbit.target.abs_diff_eq(target, 1e-5) && orbit.distance == distance);
    }
}

#[test]
fn no_key_fires_while_a_text_is_typed() {
    let mut window = Window::new(scene(1.0));
    let number = window.in_row("metallic", Role::SpinButton)[0];
    window.click(number.center());
    assert!(window.context.text_edit_focused());
    let before = window.state.edits.clone();
    for row in ROWS {
        let (modifiers, key) = match row.input {
            Input::Press(modifiers, key) if key != Key::Escape => (modifiers, key),
            Input::Unfocused(key) | Input::Held(key) => (Modifiers::NONE, key),
            _ => continue,
        };
        window.modifiers = modifiers;
        assert_eq!(window.request(key), None);
        assert!(window.context.text_edit_focused(), "{row:?}");
        assert_eq!(window.state.edits.camera, before.camera, "{row:?}");
        assert!(!window.state.panel_hidden && !window.state.keys_shown, "{row:?}");
        assert!(window.state.saving.form.is_none(), "{row:?}");
    }
    // In the picture keys are meant for the picture again.
    window.modifiers = Modifiers::NONE;
    window.click(pos2(300.0, 300.0));
    window.press(Key::H);
    assert!(window.state.panel_hidden);
}

#[test]
fn arrows_are_left_to_a_control_that_has_the_focus() {
    let mut window = Window::new(scene(1.0));
    assert_eq!(window.press(Key::ArrowLeft), Change::Drawn);
    let before = window.state.edits.camera;
    window.press(Key::Tab);
    assert!(window.context.memory(|memory| memory.focused().is_some()));
    window.press(Key::ArrowLeft);
    assert_eq!(window.state.edits.camera, before);
}

#[test]
fn the_list_of_keys_opens_and_closes() {
    let mut window = Window::new(scene(1.0));
    for close in [Key::Escape, Key::Questionmark] {
        window.modifiers = Modifiers::SHIFT;
        window.press(Key::Questionmark);
        window.pass(vec![]);
        for row in ROWS {
            let says =
                |text: &str| window.nodes.iter().any(|node| node.value().is_some_and(|value| value.contains(text)));
            assert!(says(&row.input.text(false)) && says(row.what), "{row:?}");
        }
        window.modifiers = if close == Key::Escape { Modifiers::NONE } else { Modifiers::SHIFT };
        window.press(close);
        assert!(!window.state.keys_shown);
    }
    // A key that is held opens it once.
    window.modifiers = Modifiers::NONE;
    for _ in 0..4 {
        window.pass(vec![window.key(Key::Questionmark, true)]);
    }
    assert!(window.state.keys_shown);
}

#[test]
fn the_list_fits_small_screens_and_scrolls() {
    let mut window = Window::new(scene(1.0));
    window.size = vec2(480.0, 320.0);
    window.press(Key::Questionmark);
    window.rest(20);
    let list = window.context.memory(|memory| memory.area_rect(egui::Id::unique("keys"))).unwrap();
    assert!(Rect::from_min_size(Pos2::ZERO, window.size).contains_rect(list), "{list}");
    let last = ROWS[ROWS.len() - 1].what;
    let before = window.place(Role::Label, last).min.y;
    let scroll = Event::MouseWheel {
        unit: egui::MouseWheelUnit::Line,
        delta: vec2(0.0, -5.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Wheel,
        modifiers: Modifiers::NONE,
    };
    window.pass(vec![Event::PointerMoved(list.center())]);
    window.pass(vec![scroll]);
    window.rest(20);
    assert!(window.place(Role::Label, last).min.y < before - 50.0);
    // The picture below does not hear of it.
    assert_eq!(window.state.edits.camera, None);
}

#[test]
fn the_panel_makes_way_in_narrow_windows_and_comes_back() {
    let mut window = Window::new(scene(1.0));
    let wide = window.layout.picture.width();
    window.press(Key::H);
    assert_eq!(window.layout.picture.width(), 1280.0);
    window.press(Key::H);
    assert_eq!(window.layout.picture.width(), wide);
    window.size = vec2(480.0, 320.0);
    window.rest(3);
    assert_eq!(window.layout.picture, Rect::from_min_size(Pos2::ZERO, window.size));
    let button = window.place(Role::Button, "<").center();
    window.click(button);
    window.pass(vec![]);
    let narrow = 480.0 - panel::WIDTH;
    assert_eq!(window.layout.picture.width(), narrow);
    let button = window.place(Role::Button, ">").center();
    assert!(window.layout.picture.contains(button));
    window.click(button);
    window.press(Key::H);
    assert_eq!(window.layout.picture.width(), narrow);
    window.press(Key::H);
    window.size = vec2(1280.0, 720.0);
    window.rest(3);
    assert_eq!(window.layout.picture.width(), wide);
}
