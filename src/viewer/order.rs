//! What the window asks its painter for, and what that tells it.

use std::sync::Arc;
use std::time::Duration;

use egui::TextureId;
use egui::epaint::ClippedShape;
use egui::epaint::textures::TexturesDelta;

use super::change::Change;
use super::sheet::Tile;
use crate::renderer::RenderError;
use crate::scene::{Camera, Drawn, Edits, Scene, Settings};

/// One frame of the window, or something else to be drawn.
pub struct Order {
    /// Of the window, in pixels.
    pub size: [u32; 2],
    /// Where the picture is, in points.
    pub place: egui::Rect,
    pub pixels_per_point: f32,
    /// What egui paints, where that has changed since the last order.
    pub shapes: Option<Vec<ClippedShape>>,
    /// What is to be done to egui's textures before.
    pub textures: Textures,
    /// Textures of the sheet that are seen no more.
    pub dropped: Vec<TextureId>,
    /// What the picture shows; none before there is a scene.
    pub shot: Option<Shot>,
    pub work: Work,
    /// Whether the window shows something else than it should; otherwise it is presented only where the picture has come further.
    pub stale: bool,
    /// What is said of this order while it lasts, for it will: it is presented before the work begins.
    pub announced: bool,
}

/// Changes of egui's textures, which take offence where they are dropped undone: where the window is closed they are.
#[derive(Default)]
pub struct Textures(pub TexturesDelta);

impl Drop for Textures {
    fn drop(&mut self) {
        self.0.clear();
    }
}

/// What is to be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// The window, and more of its picture where that is unfinished.
    Frame,
    /// The window with its picture as it is.
    Present,
    /// One of the sheet's pictures: its index, and its size in pixels.
    Tile(usize, [u32; 2]),
}

/// The scene as a picture shows it.
#[derive(Clone)]
pub struct Shot {
    pub scene: Arc<Scene>,
    pub edits: Edits,
    pub camera: Camera,
    /// Those of the edits, with what metering took.
    pub settings: Settings,
    /// Whether the exposure is to be metered first.
    pub meter: bool,
    /// What of all this has changed since the last order.
    pub change: Change,
    /// The material whose outline is shown.
    pub outlined: Option<usize>,
}

impl Shot {
    /// The scene as it is drawn.
    pub fn drawn(&self) -> Drawn<'_> {
        Drawn::new(&self.scene, &self.edits)
    }
}

/// What became of an order.
#[derive(Default)]
pub struct Report {
    /// Nobody can see the window, or the surface has changed: what the order was about is still to be shown.
    pub unseen: Option<Unseen>,
    /// Nothing has been done, because it will take long for this reason: the order is to be given again, announced.
    pub about_to: Option<&'static str>,
    /// Why the scene cannot be drawn.
    pub refused: Option<RenderError>,
    /// What is left to do although nothing changes.
    pub left: Left,
    /// Samples of the picture's shadows so far, and how many there will be; none where it has none.
    pub samples: Option<[u32; 2]>,
    /// What the renderer has to say of the view that it drew last.
    pub notice: Option<String>,
    /// What metering took.
    pub metered: Option<f32>,
    /// What is to be said of the first picture: that it shows nothing, and what to try.
    pub advice: Option<String>,
    /// How long it took to draw what moves.
    pub frame_time: Option<Duration>,
    /// The sheet's picture that was asked for.
    pub tile: Option<(usize, Tile)>,
}

/// Why nothing was presented.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unseen {
    /// The surface had changed: it may be tried again at once.
    Again,
    /// The window cannot be seen.
    Hidden,
}

/// What is left to do of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Left {
    #[default]
    Nothing,
    /// More, at once.
    More,
    /// More, once nothing has moved for a while: what is shown is coarse.
    Rest,
    /// Something is being built elsewhere.
    Built,
}
