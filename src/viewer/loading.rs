//! A scene that is being loaded, and what the window shows until it is there.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use egui::{Align2, Ui};

use super::file_name;
use super::kept;
use super::native::{self, Instant, Task};
use super::state::State;
use crate::scene::{Edits, Scene};

/// A scene and its first edits, or why there are none, on their way. What takes longer the larger a scene is, is done there,
/// too: the window has but to show it.
pub struct Loading {
    /// What the scene is called.
    pub(super) name: String,
    task: Task<Result<State, String>>,
    stage: Arc<Mutex<&'static str>>,
    since: Instant,
}

impl Loading {
    /// Starts to load the scene of this name on a thread of its own. `load` may say what it is at; the scene has a camera, a
    /// material and something that is drawn.
    pub fn start(
        name: &str,
        load: impl FnOnce(&dyn Fn(&'static str)) -> Result<(Scene, Edits), String> + Send + 'static,
    ) -> Self {
        let stage = Arc::new(Mutex::new(""));
        let (said, name) = (stage.clone(), name.to_owned());
        let say = move |now| *said.lock().unwrap_or_else(PoisonError::into_inner) = now;
        let of = name.clone();
        let work = move || {
            let (scene, edits) = load(&say)?;
            let mut state = State::new(&of, scene, edits);
            state.offer = kept::offer(&state);
            Ok(state)
        };
        Self { name, task: Task::start(work), stage, since: native::now() }
    }

    /// Waits for the scene.
    pub fn wait(self) -> Result<Arc<Scene>, String> {
        self.state().map(|state| state.scene)
    }

    /// Waits for the state right after loading.
    pub(super) fn state(self) -> Result<State, String> {
        // A panic has said what there is to say.
        self.task.outcome().unwrap_or_else(|| Err("the scene could not be loaded".to_owned()))
    }

    /// Whether there is no more to wait for, after so long at most.
    pub(super) fn is_done_within(&self, patience: Duration) -> bool {
        self.task.wait(patience)
    }

    /// What is going on.
    pub(super) fn what(&self) -> String {
        format!("loading {}", file_name(&self.name))
    }

    /// What it is at, and for how long it has been going on.
    pub(super) fn said(&self) -> String {
        let stage = *self.stage.lock().unwrap_or_else(PoisonError::into_inner);
        format!("{stage}, {} s", self.since.elapsed().as_secs())
    }
}

/// Says in the window's middle that the scene is being loaded.
pub(super) fn show(ui: &mut Ui, loading: &Loading) {
    let area = ui.available_rect_before_wrap();
    let style = |style: egui::TextStyle| style.resolve(ui.style());
    let painter = ui.painter();
    let color = ui.visuals().text_color();
    painter.text(
        area.center(),
        Align2::CENTER_BOTTOM,
        format!("Loading {}", file_name(&loading.name)),
        style(egui::TextStyle::Heading),
        color,
    );
    let below = area.center() + egui::vec2(0.0, 6.0);
    painter.text(below, Align2::CENTER_TOP, loading.said(), style(egui::TextStyle::Body), color);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_state_is_made_where_the_scene_is_loaded() {
        // Nothing can be made of a scene that has nothing: this thread does not even hear of it.
        let loading = Loading::start("empty.glb", |_| Ok((Scene::default(), Edits::default())));
        assert!(loading.state().is_err_and(|why| why.contains("could not be loaded")));
        let refused = Loading::start("none.glb", |_| Err("there is no such file".to_owned()));
        assert_eq!(refused.wait().err().as_deref(), Some("there is no such file"));
    }

    /// On the scene that comes with the command line.
    #[cfg(feature = "cli")]
    #[test]
    fn what_was_loaded_is_shown_as_it_is_called() {
        let exposed = Edits { exposure: Some(1.5.into()), ..Edits::default() };
        let edits = exposed.clone();
        let load = move |_: &dyn Fn(&'static str)| Ok((crate::scene::assets::DRAPE.load().unwrap(), edits));
        let state = Loading::start("a/drape.glb", load).state().unwrap();
        assert_eq!((state.name.as_str(), &state.edits), ("a/drape.glb", &exposed));
        assert!(!state.can_undo());
    }
}
