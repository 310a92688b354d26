//! Files that the user brings: where they are read, and what the window shows while one is dragged over it.

use std::path::Path;

use egui::{Align2, FontId, Id, LayerId, Ui};

use super::loading::Loading;
use super::request::Request;
use crate::picture::Format;
use crate::scene::{Edits, Scene};

/// What a command has to draw.
pub struct Pictured<'a> {
    /// As it was loaded.
    pub scene: &'a Scene,
    /// What has been changed in it, the view too.
    pub edits: &'a Edits,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Samples a pixel, where there are shadows.
    pub samples: u32,
    /// Of the picture's file.
    pub format: Format,
}

/// Who reads files for the viewer, with whatever was asked for at its start.
pub trait Files {
    /// Starts to load the scene in a file.
    fn scene(&self, path: &Path) -> Loading;

    /// Reads the state of a scene that is shown; one line where it cannot be taken.
    fn state(&self, path: &Path, scene: &Scene) -> Result<Edits, String>;

    /// A command for a shell that makes this picture; one line where there is none.
    fn command(&self, pictured: &Pictured) -> Result<String, String>;
}

/// Whether a file holds a state rather than a scene.
pub fn is_state(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"))
}

/// Says over the whole window what comes of what is dragged over it; the first file that was dropped is to be opened.
pub fn show(ui: &Ui) -> Option<Request> {
    let (hovered, dropped) = ui.input(|input| (input.raw.hovered_files.clone(), input.raw.dropped_files.clone()));
    if !hovered.is_empty() {
        let path = hovered.iter().find_map(|file| file.path.as_deref());
        let text = match path {
            Some(path) if is_state(path) => "Drop it to take over its changes",
            _ => "Drop it to open it",
        };
        let (area, visuals) = (ui.ctx().content_rect(), ui.visuals());
        let painter = ui.ctx().layer_painter(LayerId::new(egui::Order::Foreground, Id::unique("dragged files")));
        painter.rect_filled(area, 0.0, visuals.extreme_bg_color.gamma_multiply(0.8));
        painter.text(
            area.center(),
            Align2::CENTER_CENTER,
            text,
            FontId::proportional(20.0),
            visuals.strong_text_color(),
        );
    }
    dropped.first().map(|file| Request::Open(file.path().to_owned()))
}
