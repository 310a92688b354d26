//! The box that says how a picture is saved, and how far one is.

use super::super::request::Request;
use super::super::saving::{Progress, Settings, Wish};
use super::controls::controls;
use super::*;
use crate::picture::Format;

/// A window whose box is open, for pictures in a folder of its own.
fn open() -> (Window, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let mut window = Window::new(scene(1.0));
    window.state.saving.last.folder = Some(folder.path().to_str().unwrap().to_owned());
    window.state.saving.longest = Some(5000);
    click(&mut window, "Save picture...");
    (window, folder)
}

fn click(window: &mut Window, button: &str) -> Option<Request> {
    let at = window.place(Role::Button, button).center();
    let press =
        |pressed| Event::PointerButton { pos: at, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE };
    window.pass(vec![Event::PointerMoved(at)]);
    window.pass(vec![press(true)]);
    window.pass(vec![press(false)]);
    let request = window.layout.request.take();
    window.rest(4);
    request
}

/// What the form says by now.
fn form(window: &Window) -> Option<&Settings> {
    window.state.saving.form.as_ref().map(|form| &form.settings)
}

/// Whether a text of the window contains this one.
fn says(window: &Window, text: &str) -> bool {
    let labels = window.nodes.iter().filter(|node| node.role() == Role::Label);
    labels.filter_map(|node| node.value().or(node.label())).any(|label| label.contains(text))
}

/// Puts a text in place of what is in a box.
fn retype(window: &mut Window, row: &str, text: &str) {
    let place = window.in_row(row, Role::TextInput)[0];
    window.click(place.center());
    window.modifiers = Modifiers::COMMAND;
    window.press(Key::A);
    window.modifiers = Modifiers::NONE;
    window.pass(vec![Event::Text(text.to_owned())]);
    window.rest(2);
}

#[test]
fn what_is_set_in_the_box_is_saved() {
    let (mut window, folder) = open();
    assert_eq!(form(&window).map(|settings| settings.size), Some(None));
    let [width, height] = [0, 1].map(|index| window.below("picture size", Role::SpinButton)[index]);
    window.type_into(width, "1000+920");
    window.type_into(height, "1080");
    let samples = window.in_row("samples", Role::SpinButton)[0];
    window.type_into(samples, "16");
    let exr = window.place(Role::Button, ".exr").center();
    window.click(exr);
    window.rest(2);
    retype(&mut window, "name", "größe 1");
    assert!(says(&window, &format!("will be {}", folder.path().join("größe 1.exr").display())));
    let folder = folder.path().to_str().map(str::to_owned);
    let settings = Settings { size: Some([1920, 1080]), samples: 16, format: Format::Exr, folder };
    let wish = Wish { settings: settings.clone(), name: Some("größe 1".to_owned()) };
    assert_eq!(click(&mut window, "Save"), Some(Request::SavePicture(wish)));
    assert!(form(&window).is_none());
    // P saves the next one alike.
    assert_eq!(window.request(Key::P), Some(Request::SavePicture(Wish { settings, name: None })));
}

#[test]
fn enter_after_the_name_saves() {
    let (mut window, _folder) = open();
    retype(&mut window, "name", "a");
    let request = window.request(Key::Enter);
    assert!(matches!(request, Some(Request::SavePicture(Wish { name: Some(name), .. })) if name == "a"));
}

#[test]
fn the_box_proposes_what_is_free_and_says_what_is_not() {
    let (mut window, folder) = open();
    std::fs::write(folder.path().join("a.png"), "").unwrap();
    assert!(says(&window, "velour-001.png"));
    retype(&mut window, "name", "a");
    assert!(says(&window, "a-2.png"));
    for (row, text, expected) in
        [("name", "a/b", "no file's name"), ("name", " ", "no name"), ("folder", "/not/there", "no such folder")]
    {
        retype(&mut window, row, text);
        assert!(says(&window, "can't: ") && says(&window, expected), "{row} {text}");
        assert_eq!(click(&mut window, "Save"), None, "{row} {text}");
        assert!(form(&window).is_some());
        if row == "name" {
            retype(&mut window, row, "b");
        }
    }
}

#[test]
fn what_is_too_large_is_said() {
    let (mut window, _folder) = open();
    for (text, is_possible) in [("5000", true), ("5001", false), ("wide", false), ("16", true)] {
        let width = window.below("picture size", Role::SpinButton)[0];
        window.type_into(width, text);
        window.rest(2);
        assert_eq!(says(&window, "up to 5000 a side") || says(&window, "is no number"), !is_possible, "{text}");
    }
    let settings = form(&window).unwrap();
    assert_eq!(settings.size.unwrap()[0], 16);
}

#[test]
fn esc_and_cancel_close_the_box_and_save_nothing() {
    let (mut window, folder) = open();
    window.press(Key::Escape);
    assert!(form(&window).is_none());
    click(&mut window, "Save picture...");
    assert_eq!(click(&mut window, "Cancel"), None);
    assert!(form(&window).is_none());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    assert_eq!(
        window.state.saving.last,
        Settings { folder: window.state.saving.last.folder.clone(), ..Settings::default() }
    );
}

#[test]
fn every_control_of_the_box_says_what_it_is_for_and_goes_back() {
    let before = controls(&Window::new(scene(1.0))).len();
    let (mut window, _folder) = open();
    let touched =
        Settings { size: Some([640, 480]), samples: 7, format: Format::Exr, ..form(&window).unwrap().clone() };
    window.state.saving.form.as_mut().unwrap().settings = touched.clone();
    window.rest(3);
    let panel = window.size.x - crate::viewer::panel::WIDTH;
    let found: Vec<_> = controls(&window).into_iter().filter(|(_, place, _)| place.max.x < panel).collect();
    assert!(found.len() >= 10 && controls(&window).len() >= before + 10, "{found:?}");
    let mut put_back = 0;
    for (name, place, _) in &found {
        // The title's own button.
        if !name.contains("Close window") {
            let text = window.hover_text(place.center());
            assert!(text.as_ref().is_some_and(|text| text.len() > 15), "{name} at {place} says {text:?}");
        }
        if name.starts_with("Button") && !name.contains("\".") {
            continue;
        }
        window.modifiers = Modifiers::COMMAND;
        window.click(place.center());
        window.modifiers = Modifiers::NONE;
        window.wait(2.0);
        let form = window.state.saving.form.as_mut().unwrap();
        put_back += usize::from(form.settings != touched);
        form.settings = touched.clone();
        window.rest(3);
    }
    // The list of sizes, width, height, samples, two formats and the folder.
    assert_eq!(put_back, 7, "{found:?}");
}

#[test]
fn how_far_a_picture_is_shows_over_the_picture_and_can_be_cancelled() {
    let mut window = Window::new(scene(1.0));
    window.state.panel_hidden = true;
    let (name, doing) = ("a.png".to_owned(), "Drawing");
    window.state.saving.progress = Some(Progress { name, doing, share: 0.25, waiting: 1 });
    window.rest(3);
    assert!(says(&window, "Drawing a.png: 25 %, then 1 more"));
    let at = window.place(Role::Button, "Cancel").center();
    assert!(window.hover_text(at).is_some_and(|text| text.contains("nothing of it is saved")));
    assert_eq!(click(&mut window, "Cancel"), Some(Request::StopSaving));
    // The picture goes on to be turned.
    assert_eq!(window.drag(PointerButton::Primary, pos2(600.0, 300.0), pos2(640.0, 330.0)), Change::Drawn);
}
