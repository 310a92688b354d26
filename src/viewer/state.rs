//! What the window shows and the user changes.

use std::sync::Arc;
use std::time::Duration;

use glam::Vec3;

use super::change::Change;
use super::facts::{self, Fact};
use super::file_name;
use super::hands::Hands;
use super::history::{self, History, Step};
use super::lamp::LightId;
use super::native;
use super::offer::Offer;
use super::opening::Opening;
use super::order::Shot;
use super::pick;
use super::saving::Saving;
use super::sheet::Sheet;
use super::sweep::Sweep;
use crate::picture::Exposure;
use crate::scene::{Bounds, Camera, CameraEdit, Carrier, Drawn, Edits, Orbit, Scene, Settings};

/// The scene as it was loaded, and what the user changes in it.
pub struct State {
    /// The file's name.
    pub name: String,
    pub scene: Arc<Scene>,
    pub edits: Edits,
    /// The edits as the last pass that changed something has left them.
    pub shown: Edits,
    /// The material that the panel shows.
    pub material: usize,
    /// The light whose handles are in the picture.
    pub chosen_light: Option<LightId>,
    /// What the renderer has to say of the view that it drew last.
    pub notice: Option<String>,
    /// Samples that the picture's shadows have so far, and how many there will be; none where it has no shadows.
    pub samples: Option<[u32; 2]>,
    /// How far another scene is that is being loaded.
    pub loading: Option<String>,
    /// What the program is at, where that takes long.
    pub doing: Option<&'static str>,
    /// How long the last drawn frame took.
    pub frame_time: Option<Duration>,
    /// What metering took for an exposure that is automatic; none before it has, and where it is to do so anew.
    pub metered: Option<f32>,
    /// What there is to say of the scene: by the loader, and of its first picture.
    pub notices: Vec<String>,
    /// What became of commands (a screenshot's name, or why there is none), the newest last; they stand until the user
    /// has read them.
    pub messages: Vec<String>,
    /// Alpha on its way to and fro: while there is one, all that it sets is one change.
    pub sweep: Option<Sweep>,
    /// Pictures that are saved.
    pub saving: Saving,
    /// The sheet of nine alphas, while it lies over the picture.
    pub sheet: Option<Sheet>,
    /// Whether the picture has the window to itself.
    pub panel_hidden: bool,
    /// Whether the list of keys lies over the picture.
    pub keys_shown: bool,
    /// The box to open a scene by, while it lies over the picture.
    pub opening: Option<Opening>,
    /// What there is to know of the scene.
    pub facts: Vec<Fact>,
    /// What an earlier run has left of changes to this scene, until the user has decided about it.
    pub offer: Option<Offer>,
    /// The material whose outline is shown for a moment.
    pub outlined: Option<usize>,
    /// What the pointer and the keys are about in the picture.
    pub hands: Hands,
    pub history: History,
    /// The middle of what is seen at first, else of what is lit, metres: a camera of the scene turns about it.
    center: Vec3,
    /// What is framed where nothing was clicked.
    foreground: Bounds,
    /// The scene's diagonal, metres, > 0.
    size: f32,
    /// From where the eye is at first to the middle, metres.
    distance: f32,
    /// The step of coordinates, metres: a power of ten, so small that some hundred of them cross the scene.
    step: f32,
}

/// How many steps cross the scene.
const STEPS: f64 = 500.0;

impl State {
    /// The state right after loading. Panics where the scene has no camera or no material; something in it is drawn.
    pub fn new(name: &str, scene: Scene, edits: Edits) -> Self {
        assert!(!scene.cameras.is_empty() && !scene.materials.is_empty(), "{name}: a scene without camera or material");
        let drawn = Drawn::new(&scene, &edits);
        let shown = drawn.materials.iter().position(|material| material.sheen.is_some());
        let camera = edits.camera(&scene);
        let center = pick::subject(&drawn, &camera).unwrap_or_else(|| scene.subject().center());
        let bounds = scene.bounds();
        Self {
            name: name.to_owned(),
            material: shown.unwrap_or(0),
            chosen_light: None,
            notice: None,
            samples: None,
            loading: None,
            doing: None,
            frame_time: None,
            metered: None,
            notices: scene.notices.clone(),
            messages: Vec::new(),
            sweep: None,
            saving: Saving::default(),
            sheet: None,
            panel_hidden: false,
            keys_shown: false,
            opening: None,
            offer: None,
            facts: facts::of(&scene),
            outlined: None,
            hands: Hands::default(),
            history: History::new(&edits),
            center,
            distance: Orbit::new(&camera, center).distance,
            foreground: scene.foreground(scene.cameras[0].world_from_camera.w_axis.truncate()),
            size: 2.0 * bounds.radius(),
            step: step(bounds.diagonal()),
            scene: Arc::new(scene),
            shown: edits.clone(),
            edits,
        }
    }

    /// Comes in place of another state: what the window is like stays, and what has not been read yet.
    pub fn take_over(&mut self, before: &mut Self) {
        self.panel_hidden = before.panel_hidden;
        self.hands.is_narrow = before.hands.is_narrow;
        self.messages = std::mem::take(&mut before.messages);
        self.saving = std::mem::take(&mut before.saving);
        self.opening = before.opening.take();
        // Nothing goes on below another scene.
        (before.sheet, before.sweep, before.outlined, before.loading) = (None, None, None, None);
    }

    /// The same scene as it is in its file by now: the changes that still apply are carried over, those before them, too. Returns what to
    /// say of it.
    pub fn come_after(&mut self, before: &Self) -> String {
        let carrier = Carrier::new(&before.scene, &self.scene);
        let (edits, lost) = carrier.carry(&before.edits);
        self.history = before.history.carried(&carrier);
        self.material = carrier.material(before.material).unwrap_or(self.material);
        (self.edits, self.metered, self.offer) = (edits, before.metered, before.offer.clone());
        self.shown.clone_from(&self.edits);
        let name = native::one_line(file_name(&self.name));
        match lost.len() {
            0 => format!("reloaded {name}"),
            1 => format!("reloaded {name}; a change had nothing to apply to: {}", lost[0]),
            count => format!("reloaded {name}; {count} changes had nothing to apply to: {}", lost.join(", ")),
        }
    }

    /// Takes over the changes that an earlier run has left.
    pub fn bring_back(&mut self) {
        let Some(offer) = self.offer.take() else { return };
        match Edits::from_text(&offer.text, &self.scene) {
            Ok(edits) => (self.edits, self.metered) = (edits, None),
            Err(why) => self.say(format!("your last changes do not fit this scene any more: {why}")),
        }
    }

    /// The scene as it is drawn.
    pub fn drawn(&self) -> Drawn<'_> {
        Drawn::new(&self.scene, &self.edits)
    }

    /// The alpha of the material that the panel shows; none where it has no sheen.
    pub fn alpha(&self) -> Option<f32> {
        Drawn::material(&self.scene, &self.edits, self.material).sheen.map(|sheen| sheen.alpha())
    }

    /// Whether the exposure is to be metered before the picture is drawn.
    pub fn needs_metering(&self) -> bool {
        self.edits.exposure == Some(Exposure::Auto) && self.metered.is_none()
    }

    /// What the picture is drawn with: its exposure is the metered one where it is automatic.
    pub fn settings(&self) -> Settings {
        let settings = self.edits.settings();
        let metered = self.metered.filter(|_| self.edits.exposure == Some(Exposure::Auto));
        Settings { exposure: metered.unwrap_or(settings.exposure), ..settings }
    }

    /// What a picture of it shows, where this has changed since the last.
    pub fn shot(&self, change: Change) -> Shot {
        Shot {
            scene: self.scene.clone(),
            edits: self.edits.clone(),
            camera: self.camera(),
            settings: self.settings(),
            meter: self.needs_metering(),
            change,
            outlined: self.outlined,
        }
    }

    /// What a picture of the same view with other edits shows.
    pub fn shot_of(&self, edits: &Edits) -> Shot {
        Shot { edits: edits.clone(), ..self.shot(Change::None) }
    }

    /// The view: a camera of the scene as it is, until the user turns it.
    pub fn camera(&self) -> Camera {
        self.edits.camera(&self.scene)
    }

    /// The view as the user turns it.
    pub fn orbit(&self) -> Orbit {
        match self.edits.camera {
            Some(CameraEdit::Orbit(orbit)) => orbit,
            _ => Orbit::new(&self.camera(), self.center),
        }
    }

    /// The box of what is framed where nothing was clicked: the first camera tells what is seen from the midst of it.
    pub fn foreground(&self) -> Bounds {
        self.foreground
    }

    /// The scene's diagonal, metres, > 0.
    pub fn size(&self) -> f32 {
        self.size
    }

    /// How far away the scene is seen from at first, metres.
    pub fn distance(&self) -> f32 {
        self.distance
    }

    /// Whether a change has come to its end: nothing is held, typed or swept.
    pub fn is_settled(&self, context: &egui::Context) -> bool {
        self.sweep.is_none() && self.hands.grab.is_none() && history::is_settled(context)
    }

    /// Whether there is a change that can be taken back: a sweep is one, while it lasts.
    pub fn can_undo(&self) -> bool {
        self.sweep.is_some() || self.history.can_undo()
    }

    /// Whether something that was taken back can be done again: a sweep is a new change, after which nothing can.
    pub fn can_redo(&self) -> bool {
        self.sweep.is_none() && self.history.can_redo()
    }

    /// Takes back the last change, a sweep as a whole; the view stays.
    pub fn undo(&mut self) {
        if self.sweep.take().is_some() {
            self.history.keep(&self.edits, self.metered);
        }
        if let Some(step) = self.history.undo().cloned() {
            self.go_to(step);
        }
    }

    /// Does again what was taken back last; the view stays.
    pub fn redo(&mut self) {
        if self.can_redo()
            && let Some(step) = self.history.redo().cloned()
        {
            self.go_to(step);
        }
    }

    fn go_to(&mut self, Step { edits, metered }: Step) {
        self.edits = Edits { camera: self.edits.camera, ..edits };
        self.metered = metered;
    }

    /// Tells the user; what is said already is moved to the end.
    pub fn say(&mut self, what: String) {
        self.messages.retain(|said| *said != what);
        self.messages.push(what);
    }

    /// Pictures that were drawn beside the one that is shown are gone.
    pub fn lose_pictures(&mut self) {
        self.sheet.iter_mut().for_each(|sheet| sheet.pictures = Default::default());
    }

    /// Moves alpha on where it is being swept, to where it is at a time in seconds; whether it still is. It stops where the
    /// material is changed for another, and where alpha has been set by other means.
    pub fn sweep_on(&mut self, now: f64) -> bool {
        let Some(sweep) = &mut self.sweep else { return false };
        let own = self.edits.materials.get(&sweep.material).and_then(|own| own.alpha);
        if own != sweep.last || sweep.material != self.material {
            self.sweep = None;
            return false;
        }
        sweep.last = Some(sweep.alpha(now));
        self.edits.materials.entry(sweep.material).or_default().alpha = sweep.last;
        true
    }

    /// The step of coordinates in the scene, metres.
    pub fn step(&self) -> f32 {
        self.step
    }

    /// Puts everything back as it was loaded.
    pub fn reset(&mut self) {
        self.edits = Edits::default();
    }
}

/// The step of coordinates in a scene of this size, both in metres.
fn step(size: f64) -> f32 {
    10f64.powf((size / STEPS).log10().round().clamp(-9.0, 9.0)) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On the scene that comes with the command line.
    #[cfg(feature = "cli")]
    #[test]
    fn an_automatic_exposure_is_the_metered_one_until_another_is_asked_for() {
        let edits = |exposure| Edits { exposure, ..Edits::default() };
        let mut state = State::new("drape", crate::scene::assets::DRAPE.load().unwrap(), edits(Some(Exposure::Auto)));
        assert!(state.needs_metering() && state.settings().exposure == 0.0);
        state.metered = Some(-9.37);
        assert!(!state.needs_metering() && state.settings().exposure == -9.37);
        // Neither a turn nor a lamp meters anew.
        state.edits.ambient = Some(Vec3::ONE);
        state.edits.camera = Some(CameraEdit::Orbit(state.orbit()));
        assert!(!state.needs_metering());
        for (exposure, expected) in [(None, 0.0), (Some(1.5.into()), 1.5)] {
            state.edits = edits(exposure);
            assert!(!state.needs_metering() && state.settings().exposure == expected);
        }
    }

    #[test]
    fn steps_follow_the_scenes_size() {
        for (size, expected) in [(1e-3, 1e-6), (3.0, 0.01), (1e3, 1.0), (0.0, 1e-9), (f64::INFINITY, 1e9)] {
            assert_eq!(step(size), expected, "{size}");
        }
    }
}
