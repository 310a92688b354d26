//! A scene that is being loaded, and what the window shows until it is there.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use egui::{Align2, Ui};

use super::native::{self, Instant, Task};
use crate::scene::{Edits, Scene};

/// A scene and its first edits, or why there are none, on their way.
pub struct Loading {
    task: Task<Result<(Scene, Edits), String>>,
    stage: Arc<Mutex<&'static str>>,
    since: Instant,
}

impl Loading {
    /// Starts to load on a thread of its own. `load` may say what it is at.
    pub fn start(load: impl FnOnce(&dyn Fn(&'static str)) -> Result<(Scene, Edits), String> + Send + 'static) -> Self {
        let stage = Arc::new(Mutex::new(""));
        let said = stage.clone();
        let say = move |now| *said.lock().unwrap_or_else(PoisonError::into_inner) = now;
        Self { task: Task::start(move || load(&say)), stage, since: native::now() }
    }

    /// Waits for the scene.
    pub fn wait(self) -> Result<(Scene, Edits), String> {
        // A panic has said what there is to say.
        self.task.outcome().unwrap_or_else(|| Err("the scene could not be loaded".to_owned()))
    }

    /// Whether there is no more to wait for, after so long at most.
    pub(super) fn is_done_within(&self, patience: Duration) -> bool {
        self.task.wait(patience)
    }

    /// What it is at, and for how long it has been going on.
    fn said(&self) -> String {
        let stage = *self.stage.lock().unwrap_or_else(PoisonError::into_inner);
        format!("{stage}, {} s", self.since.elapsed().as_secs())
    }
}

/// Says in the window's middle that the scene of this name is being loaded.
pub(super) fn show(ui: &mut Ui, name: &str, loading: &Loading) {
    let area = ui.available_rect_before_wrap();
    let style = |style: egui::TextStyle| style.resolve(ui.style());
    let painter = ui.painter();
    let color = ui.visuals().text_color();
    painter.text(
        area.center(),
        Align2::CENTER_BOTTOM,
        format!("Loading {name}"),
        style(egui::TextStyle::Heading),
        color,
    );
    let below = area.center() + egui::vec2(0.0, 6.0);
    painter.text(below, Align2::CENTER_TOP, loading.said(), style(egui::TextStyle::Body), color);
}
