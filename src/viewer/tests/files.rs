//! Files that are dragged over the window and dropped on it.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::*;

/// A file as egui hears of it where it falls.
#[derive(Debug)]
struct Fallen(PathBuf);

impl egui::DroppedFile for Fallen {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        Err("nobody reads it here".to_owned())
    }
}

/// A pass in which these are dragged over the window, and those fall: what is asked for, and what is written over all of the window.
fn bring(window: &mut Window, dragged: &[&str], dropped: &[&str]) -> (Option<Request>, Option<String>) {
    let area = Rect::from_min_size(Pos2::ZERO, window.size);
    let input = RawInput {
        screen_rect: Some(area),
        hovered_files: dragged
            .iter()
            .map(|path| egui::HoveredFile { path: Some(path.into()), mime: String::new() })
            .collect(),
        dropped_files: dropped.iter().map(|path| Arc::new(Fallen(path.into())) as egui::DroppedFileHandle).collect(),
        ..RawInput::default()
    };
    let mut request = None;
    let output = window.context.run_ui(input, |ui| request = layout::show(ui, &mut window.state).request);
    let shapes: Vec<&egui::Shape> = output.shapes.iter().map(|clipped| &clipped.shape).collect();
    let said = match shapes[..] {
        [.., egui::Shape::Rect(cover), egui::Shape::Text(text)] if cover.rect == area => {
            Some(text.galley.text().to_owned())
        }
        _ => None,
    };
    output.drop_without_applying_deltas();
    (request, said)
}

#[test]
fn what_is_dragged_over_the_window_is_told_what_comes_of_it() {
    let mut window = Window::new(scene(1.0));
    for (dragged, says) in [
        (&[][..], None),
        (&["/a/chair.glb"], Some("Drop it to open it")),
        (&["/a/velour-001.toml"], Some("Drop it to take over its changes")),
        // The first counts.
        (&["/a/chair.glb", "/a/velour-001.TOML"], Some("Drop it to open it")),
        (&["/a/velour-001.TOML", "/a/chair.glb"], Some("Drop it to take over its changes")),
    ] {
        assert_eq!(bring(&mut window, dragged, &[]), (None, says.map(str::to_owned)), "{dragged:?}");
    }
}

#[test]
fn what_is_dropped_is_to_be_opened() {
    let mut window = Window::new(scene(1.0));
    let (request, said) = bring(&mut window, &[], &["/a/b c.glb", "/a/d.glb"]);
    assert_eq!((request, said), (Some(Request::Open("/a/b c.glb".into())), None));
    assert_eq!(bring(&mut window, &[], &[]).0, None);
}

#[test]
fn another_scene_finds_the_window_as_it_is() {
    let mut window = Window::new(scene(1.0));
    window.state.panel_hidden = true;
    window.state.say("saved velour-001.png".to_owned());
    let mut other = State::new("other.glb", scene(2.0), Edits::default());
    other.take_over(&mut window.state);
    assert!(other.panel_hidden && window.state.messages.is_empty());
    assert_eq!(other.messages, ["saved velour-001.png"]);
    assert_eq!(other.edits, Edits::default());
    assert!(!other.can_undo());
}
