//! What keys and mouse can ask for, and what comes of it.

use egui::{Popup, Rect, Ui};
use glam::Vec2;

use super::gizmo;
use super::grab::Tool;
use super::history::is_settled;
use super::opening::Opening;
use super::request::Request;
use super::saving::Wish;
use super::state::State;
use crate::scene::CameraEdit;

/// What an input of the user asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Command {
    // By the pointer in the picture.
    Turn,
    Pan,
    Zoom,
    Pick,
    Centre,
    /// To the right, up and ahead, while it is held.
    Fly([f32; 3]),
    // By keys.
    /// As by a drag of so many view heights, to the right and down.
    TurnBy([f32; 2]),
    /// Azimuth and elevation, radians.
    LookFrom([f32; 2]),
    Frame,
    Home,
    /// The chosen light.
    Grab(Tool),
    DuplicateLight,
    DeleteLight,
    /// Puts the chosen light's reflection where the pointer is, while it is held.
    Aim,
    Undo,
    Redo,
    SavePicture,
    SavePictureAs,
    Open,
    Reload,
    SaveState,
    CopyPicture,
    Panel,
    Fullscreen,
    Keys,
    Close,
}

impl Command {
    /// Whether it is done again and again while its key is held.
    pub fn repeats(self) -> bool {
        matches!(self, Self::TurnBy(_) | Self::Undo | Self::Redo)
    }

    /// Does what keys ask for; what the pointer does is seen to where the pointer is.
    pub fn run(self, ui: &Ui, picture: Rect, state: &mut State) -> Option<Request> {
        match self {
            Self::Turn | Self::Pan | Self::Zoom | Self::Pick | Self::Centre | Self::Fly(_) | Self::Aim => {}
            Self::Grab(tool) => gizmo::begin(ui, picture, state, tool),
            Self::DuplicateLight => {
                if let Some(light) = state.chosen() {
                    state.duplicate_light(light);
                    gizmo::begin(ui, picture, state, Tool::Move);
                }
            }
            Self::DeleteLight => state.chosen().into_iter().for_each(|light| state.remove_light(light)),
            Self::TurnBy([right, down]) => edit_view(state, |orbit| orbit.turn(Vec2::new(right, down))),
            Self::LookFrom([azimuth, elevation]) => edit_view(state, |orbit| orbit.look_from(azimuth, elevation)),
            Self::Frame => {
                let bounds = state.clicked_bounds().unwrap_or_else(|| state.foreground());
                edit_view(state, |orbit| orbit.frame(&bounds, picture.aspect_ratio()));
            }
            Self::Home => state.edits.camera = None,
            // Not in the midst of a change.
            Self::Undo if is_settled(ui) => state.undo(),
            Self::Redo if is_settled(ui) => state.redo(),
            Self::Undo | Self::Redo => {}
            Self::SavePicture => {
                return Some(Request::SavePicture(Wish { settings: state.saving.last.clone(), name: None }));
            }
            Self::SavePictureAs => state.saving.open(),
            Self::CopyPicture => return Some(Request::CopyCommand),
            Self::Open => Opening::toggle(&mut state.opening),
            Self::Reload => return Some(Request::Reload),
            Self::SaveState => return Some(Request::SaveState),
            Self::Fullscreen => return Some(Request::Fullscreen),
            Self::Panel => state.panel_hidden = !state.panel_hidden,
            Self::Keys => state.keys_shown = !state.keys_shown,
            Self::Close => {
                (state.keys_shown, state.opening, state.saving.form) = (false, None, None);
                (state.sheet, state.sweep, state.chosen_light) = (None, None, None);
                Popup::close_all(ui);
            }
        }
        None
    }
}

/// Changes the view from where it is.
pub fn edit_view(state: &mut State, edit: impl FnOnce(&mut crate::scene::Orbit)) {
    let mut orbit = state.orbit();
    edit(&mut orbit);
    state.edits.camera = Some(CameraEdit::Orbit(orbit));
}
