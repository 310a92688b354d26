//! The box by which files are opened, changes of the last time, and a scene whose file has changed.

use super::super::listing::{Entry, Listing};
use super::super::offer::Offer;
use super::super::opening::Opening;
use super::*;
use crate::scene::CameraEdit;

fn entry(path: &str, is_folder: bool, is_there: bool) -> Entry {
    Entry { path: path.into(), is_folder, is_there }
}

/// A window in which Ctrl-O has been pressed; what that asks for.
fn opened() -> (Window, Option<Request>) {
    let mut window = Window::new(scene(1.0));
    window.modifiers = Modifiers::COMMAND | Modifiers::CTRL;
    let mut request = window.request(Key::O);
    window.modifiers = Modifiers::NONE;
    window.pass(vec![]);
    request = window.layout.request.clone().or(request);
    (window, request)
}

fn give(window: &mut Window, typed: &str, entries: Vec<Entry>) {
    let taken = window.state.opening.as_mut().unwrap().take(Listing { typed: typed.to_owned(), entries });
    assert!(taken, "{typed}");
    window.rest(2);
}

fn type_text(window: &mut Window, text: &str) {
    for character in text.chars() {
        window.pass(vec![Event::Text(character.to_string())]);
        window.pass(vec![]);
    }
}

#[test]
fn what_is_typed_is_opened_and_no_key_of_the_picture() {
    let (mut window, request) = opened();
    assert_eq!(request, Some(Request::List(String::new())));
    assert!(window.context.text_edit_focused());
    window.pass(vec![Event::Text("/h1.glb".to_owned()), window.key(Key::H, true)]);
    assert_eq!(window.layout.request, Some(Request::List("/h1.glb".to_owned())));
    window.pass(vec![window.key(Key::H, false)]);
    assert!(!window.state.panel_hidden);
    assert_eq!(window.request(Key::Enter), Some(Request::Open("/h1.glb".into())));
    assert!(window.state.opening.is_none());
    window.press(Key::H);
    assert!(window.state.panel_hidden);
}

#[test]
fn the_list_is_chosen_from_by_keys_and_folders_are_looked_into() {
    let (mut window, _) = opened();
    give(&mut window, "", vec![entry("/a/gone.glb", false, false), entry("/a/felt.glb", false, true)]);
    // What is gone cannot be opened.
    window.press(Key::ArrowDown);
    assert_eq!(window.request(Key::Enter), None);
    assert!(window.state.opening.is_some());
    window.press(Key::ArrowDown);
    assert_eq!(window.request(Key::Enter), Some(Request::Open("/a/felt.glb".into())));

    let (mut window, _) = opened();
    type_text(&mut window, "/a");
    give(&mut window, "/a", vec![entry("/ab", true, true), entry("/a.glb", false, true)]);
    window.press(Key::ArrowDown);
    window.pass(vec![window.key(Key::Enter, true)]);
    window.rest(2);
    assert!(window.context.text_edit_focused());
    // It is typed on at the end.
    type_text(&mut window, "x.glb");
    assert_eq!(window.request(Key::Enter), Some(Request::Open("/ab/x.glb".into())));
}

#[test]
fn a_list_that_comes_too_late_is_not_shown() {
    let (mut window, _) = opened();
    type_text(&mut window, "/b");
    let late = Listing { typed: "/".to_owned(), entries: vec![entry("/a", true, true)] };
    assert!(!window.state.opening.as_mut().unwrap().take(late));
}

#[test]
fn esc_closes_the_box_and_every_control_says_what_it_is_for() {
    let (mut window, _) = opened();
    give(&mut window, "", vec![entry("/a\u{7}b/felt\n.glb", false, true), entry("/gone.glb", false, false)]);
    for (role, name) in [(Role::Button, "Open"), (Role::Button, "Cancel"), (Role::Button, "felt.glb ab")] {
        let nodes = window.nodes.iter().filter(|node| node.role() == role && node.label() == Some(name));
        // The box's stands left of the panel's.
        let place = nodes.filter_map(place).min_by(|left, right| left.min.x.total_cmp(&right.min.x));
        let place = place.unwrap_or_else(|| panic!("no {name}"));
        let text = window.hover_text(place.center());
        assert!(text.as_ref().is_some_and(|text| text.len() > 10), "{name}: {text:?}");
    }
    window.press(Key::Escape);
    assert!(window.state.opening.is_none());
    let mut opening = Some(Opening::default());
    Opening::toggle(&mut opening);
    assert!(opening.is_none());
}

#[test]
fn changes_of_the_last_time_are_brought_back_where_they_fit() {
    for (text, alpha, says) in [
        ("[[material]]\nname = \"velvet\"\nalpha = 0.75\n", Some(0.75), None),
        ("[[material]]\nname = \"felt\"\nalpha = 0.75\n", None, Some("do not fit")),
        ("\0[[[", None, Some("do not fit")),
    ] {
        let mut window = Window::new(scene(1.0));
        window.state.offer = Some(Offer { text: text.to_owned(), said: "Your last changes are kept.".to_owned() });
        window.rest(3);
        assert_eq!(window.state.edits, Edits::default());
        let at = window.place(Role::Button, "Bring back").center();
        assert!(window.hover_text(at).is_some_and(|text| text.len() > 15));
        window.click(at);
        assert_eq!(window.layout.request, Some(Request::BringBack));
        window.state.bring_back();
        window.rest(2);
        assert_eq!(window.state.edits.of_material(0).alpha, alpha);
        assert_eq!(window.state.can_undo(), alpha.is_some());
        assert!(says.is_none_or(|says| window.state.messages[0].contains(says)), "{:?}", window.state.messages);
        assert!(window.state.offer.is_none());
    }
}

#[test]
fn a_scene_that_is_loaded_again_keeps_changes_and_undo() {
    let mut before = full().state;
    let mut edits = before.edits.clone();
    edits.camera = Some(CameraEdit::Orbit(before.orbit()));
    edits.materials.entry(1).or_default().alpha = Some(0.9);
    before.edits = edits.clone();
    before.history.keep(&edits, None);
    let mut same = State::new("a/test.glb", (*before.scene).clone(), Edits::default());
    assert_eq!(same.come_after(&before), "reloaded test.glb");
    assert_eq!(same.edits, edits);
    same.undo();
    assert_eq!((same.edits.of_material(1).alpha, same.edits.camera), (None, edits.camera));

    let mut scene = scene(1.0);
    scene.materials[0].name = "felt".to_owned();
    let mut other = State::new("a/test.glb", scene, Edits::default());
    let said = other.come_after(&before);
    assert_eq!(said, "reloaded test.glb; 2 changes had nothing to apply to: material velvet, material velvet");
    assert_eq!((other.edits.camera, other.edits.ambient), (edits.camera, edits.ambient));
    assert!(other.edits.materials.is_empty());
}

#[test]
fn the_files_cameras_are_chosen_in_the_panel() {
    let mut scene = scene(1.0);
    scene.cameras.push(Camera { name: "side".into(), ..scene.cameras[0].clone() });
    let mut window = Window::of_size(scene, vec2(1280.0, 2400.0));
    let fold = window.nodes.iter().find(|node| node.label() == Some("Scene")).and_then(place).unwrap();
    window.click(fold.center());
    window.rest(30);
    let list = window.in_row("camera", Role::ComboBox)[0];
    window.click(list.center());
    window.rest(2);
    let side = window.place(Role::Button, "1 side").center();
    window.click(side);
    assert_eq!(window.state.edits.camera, Some(CameraEdit::Loaded(1)));
    // Of the default scene there is no file.
    let reload = window.place(Role::Button, "Reload").center();
    assert!(window.hover_text(reload).is_some_and(|text| text.contains("no file")));
    for name in ["triangles", "images", "size"] {
        let at = window.place(Role::Label, name).center();
        assert!(window.hover_text(at).is_some_and(|text| text.len() > 15), "{name}");
    }
}
