//! The program with its window: what happens between two events, and when something is drawn. It never waits for the device: what draws is a [`Painter`] on a thread of its own,
//! which has one order at a time.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use egui::ViewportId;
use winit::event_loop::{ActiveEventLoop, EventLoopProxy};
use winit::monitor::MonitorHandle;
use winit::window::{Fullscreen, Window};

use super::ViewerError;
use super::change::Change;
use super::files::{Files, is_state};
use super::health::Losses;
use super::layout::{self, Layout};
use super::loading::{self, Loading};
use super::native::{self, Instant, Keeper};
use super::open::{Open, REST};
use super::request::Request;
use super::shelf::Shelf;
use super::state::State;
use super::{file_name, window_size, wishes};
use crate::renderer::RenderError;
use crate::table::SheenTable;

/// How long a scene may take to load before a window is opened that says so: one that is there by then, or that cannot be
/// loaded, is not announced.
const UNSAID: Duration = Duration::from_millis(300);

/// How often it is shown how far a picture is that is being saved.
const STEP: Duration = Duration::from_millis(250);

/// An order that takes longer is told of in the window's title.
const SLOW: Duration = Duration::from_millis(333);

/// The program between its events.
pub(super) struct App {
    files: Box<dyn Files>,
    /// While a scene is on its way, the first one or another.
    loading: Option<Loading>,
    /// Whether that is the one that is shown, anew,
    is_reloading: bool,
    /// and what was said where that has failed.
    complaint: Option<String>,
    shelf: Shelf,
    /// From the first scene on.
    state: Option<State>,
    /// That of the scene before, until the painter has taken the one that is shown.
    before: Option<State>,
    table: Arc<SheenTable>,
    /// Saves pictures.
    keeper: Keeper,
    wake: EventLoopProxy<()>,
    /// There from the first `resumed` on.
    open: Option<Open>,
    /// When devices were lost, why the last one was, and when another one is tried.
    losses: Losses,
    lost: Option<String>,
    reopen_at: Option<Instant>,
    /// Why the loop was left, if that was not the user's doing.
    pub failure: Option<ViewerError>,
}

impl App {
    pub fn new((loading, files): (Loading, Box<dyn Files>), table: SheenTable, wake: EventLoopProxy<()>) -> Self {
        let (loading, table, keeper) = (Some(loading), Arc::new(table), Keeper::default());
        let (losses, lost, reopen_at) = (Losses::default(), None, None);
        let shelf = Shelf::new(wake.clone());
        Self {
            files,
            loading,
            is_reloading: false,
            complaint: None,
            shelf,
            state: None,
            before: None,
            table,
            keeper,
            wake,
            open: None,
            losses,
            lost,
            reopen_at,
            failure: None,
        }
    }

    /// The window, where there is one.
    pub fn window(&mut self) -> Option<&mut Open> {
        self.open.as_mut()
    }

    /// Opens the window.
    pub fn open(&mut self, event_loop: &ActiveEventLoop) -> Result<(), ViewerError> {
        self.receive_scene(UNSAID)?;
        // Where the system names no first monitor, the window may appear on any.
        let mut monitors: Vec<MonitorHandle> = event_loop.primary_monitor().into_iter().collect();
        if monitors.is_empty() {
            monitors.extend(event_loop.available_monitors());
        }
        let [size, least] = window_size::sizes(monitors.iter().map(|monitor| (monitor.size(), monitor.scale_factor())));
        let attributes =
            Window::default_attributes().with_title(self.title(None)).with_inner_size(size).with_min_inner_size(least);
        let window = event_loop.create_window(attributes).map_err(|error| ViewerError::Window(error.to_string()))?;
        self.open = Some(Open::new(Arc::new(window), self.table.clone(), self.wake.clone())?);
        Ok(())
    }

    fn title(&self, doing: Option<&str>) -> String {
        let doing = doing.map(|doing| format!(" - {doing}")).unwrap_or_default();
        format!("Velour - {}{doing}", file_name(self.name()))
    }

    /// What the scene is called that is shown, or that will be.
    fn name(&self) -> &str {
        let shown = self.state.as_ref().map(|state| &state.name);
        shown.or(self.loading.as_ref().map(|loading| &loading.name)).map_or("", String::as_str)
    }

    /// Takes the scene where it is there after so long at most. Another one that cannot be loaded leaves what is there.
    fn receive_scene(&mut self, patience: Duration) -> Result<(), ViewerError> {
        let Some(loading) = self.loading.take_if(|loading| loading.is_done_within(patience)) else { return Ok(()) };
        let is_reloading = std::mem::take(&mut self.is_reloading);
        match (loading.state(), &mut self.state) {
            (Ok(mut state), before) => {
                if let Some(before) = before.as_mut().filter(|_| is_reloading) {
                    let said = state.come_after(before);
                    let complaint = self.complaint.take();
                    before.messages.retain(|said| Some(said) != complaint.as_ref());
                    before.say(said);
                }
                self.show(state);
            }
            (Err(why), Some(state)) => {
                self.complaint = is_reloading.then(|| why.clone()).or(self.complaint.take());
                state.say(why);
            }
            (Err(why), None) => return Err(ViewerError::Scene(why)),
        }
        Ok(())
    }

    /// Loads the scene that is shown anew, where it has a file.
    fn reload(&mut self) {
        if let Some(path) = self.state.as_ref().and_then(|state| state.scene.files.first()) {
            (self.loading, self.is_reloading) = (Some(self.files.scene(path)), true);
            self.open.iter_mut().for_each(|open| open.wake_in(Duration::ZERO));
        }
    }

    /// Shows a scene in place of the one that is shown, if there is one.
    fn show(&mut self, mut state: State) {
        match &mut self.state {
            Some(before) => {
                self.shelf.end(before);
                state.take_over(before);
            }
            None => state.saving.last = wishes::remembered(),
        }
        self.shelf.begin(&state);
        // What the painter has not taken yet is nothing to go back to.
        let replaced = self.state.replace(state);
        self.before = self.before.take().or(replaced);
        let title = self.title(None);
        if let Some(open) = &mut self.open {
            open.begin();
            open.titled = None;
            open.window.set_title(&title);
        }
    }

    /// Goes back to the scene before where the painter cannot draw this one.
    fn go_back(&mut self, why: RenderError) -> Result<(), ViewerError> {
        let Some(before) = self.before.take() else { return Err(why.into()) };
        let refused = self.name().to_owned();
        self.show(before);
        self.before = None;
        if let Some(state) = &mut self.state {
            state.say(format!("{refused}: {why}"));
        }
        Ok(())
    }

    /// Opens what the user has brought: a scene once it is loaded, a state at once.
    fn bring(&mut self, path: &Path) {
        match &mut self.state {
            Some(state) if is_state(path) => match self.files.state(path, &state.scene) {
                Ok(edits) => (state.edits, state.metered) = (edits, None),
                Err(why) => state.say(why),
            },
            _ => (self.loading, self.is_reloading) = (Some(self.files.scene(path)), false),
        }
    }

    /// Lets egui see the events so far and keeps what they lead to; whether they have changed something.
    pub fn pass(&mut self) -> bool {
        let Some(open) = &mut self.open else { return false };
        let input = open.egui.take_egui_input(&open.window);
        let context = open.egui.egui_ctx().clone();
        let (progress, longest) = (self.keeper.progress(), open.gpu.device.limits().max_texture_dimension_2d);
        let mut layout = Layout::default();
        let mut output = context.run_ui(input, |ui| {
            let last = match (&mut self.state, &self.loading) {
                (Some(state), loading) => {
                    (state.saving.progress, state.saving.longest) = (progress.clone(), Some(longest));
                    state.loading = loading.as_ref().map(|loading| format!("{}: {}", loading.what(), loading.said()));
                    layout::show(ui, state)
                }
                (None, Some(loading)) => {
                    loading::show(ui, loading);
                    Layout::default()
                }
                (None, None) => Layout::default(),
            };
            // egui may want to do it all over with the sizes that it has found, and without the events.
            let (change, request) = (layout.change.max(last.change), layout.request.take().or(last.request));
            layout = Layout { change, request, ..last };
        });
        open.egui.handle_platform_output(&open.window, std::mem::take(&mut output.platform_output));
        let delay = output.viewport_output.get(&ViewportId::ROOT).map_or(Duration::MAX, |root| root.repaint_delay);
        let textures = open.screen.take(&layout, output);
        open.take_textures(textures);
        // What moves by itself goes on as fast as it is drawn.
        open.is_eager = delay.is_zero() && open.busy_for().is_some();
        let delay = if open.screen.is_stale() && !open.is_eager { delay } else { delay.max(REST) };
        (open.passed, open.due) = (native::now(), native::after(delay));
        if self.loading.is_some() {
            open.wake_in(REST);
        }
        if progress.is_some() {
            open.wake_in(STEP);
        }
        layout.request.into_iter().for_each(|request| self.fulfil(request));
        layout.change > Change::None
    }

    fn fulfil(&mut self, request: Request) {
        match (request, &mut self.state, &mut self.open) {
            (Request::Open(path), _, _) => self.bring(&path),
            (Request::SavePicture(wish), Some(state), Some(open)) => {
                let means = open.means(&self.table);
                wishes::save(&mut self.keeper, means, open, state, wish);
            }
            (Request::StopSaving, _, _) => self.keeper.stop(),
            (Request::CopyCommand, Some(state), Some(open)) => {
                let said = wishes::copy(&*self.files, open, state);
                state.say(said);
            }
            (Request::List(typed), _, _) => self.shelf.list(typed),
            (Request::Reload, _, _) => self.reload(),
            (Request::BringBack, Some(state), _) => state.bring_back(),
            (Request::Decline, Some(state), _) => {
                let declined = state.offer.take();
                declined.into_iter().for_each(|offer| self.shelf.decline(state, offer));
            }
            (Request::SaveState, Some(state), _) => {
                let said = native::save_state(&state.name, &state.edits.to_text(&state.scene));
                state.say(said);
            }
            (Request::Fullscreen, _, Some(open)) => toggle_fullscreen(&open.window),
            (_, _, _) => {}
        }
        self.open.iter_mut().for_each(|open| open.wake_in(Duration::ZERO));
    }

    /// What is due by now: the scene, what the painter has to tell, a pass, its next order.
    pub fn follow(&mut self) -> Result<(), ViewerError> {
        let Some(open) = &self.open else { return Ok(()) };
        if let Some(why) = open.loss() {
            return Err(ViewerError::Lost(why));
        }
        if self.reopen_at.is_some_and(|at| at <= native::now()) {
            self.reopen()?;
        }
        let was_loading = self.loading.is_some();
        self.receive_scene(Duration::ZERO)?;
        let is_loaded = was_loading && self.loading.is_none();
        let told = match (&mut self.open, &mut self.state) {
            (Some(open), Some(state)) => open.hear(state)?,
            (Some(open), None) => open.hear_nothing()?,
            (None, _) => false,
        };
        match self.open.as_mut().and_then(Open::verdict) {
            Some(Err(why)) => self.go_back(why)?,
            Some(Ok(())) => {
                self.before = None;
                self.shelf.drawn();
            }
            None => {}
        }
        if self.loading.is_none() && self.shelf.has_changed() {
            self.reload();
        }
        let is_found = self.state.as_mut().is_some_and(|state| self.shelf.follow(state));
        let is_eager = self.open.as_ref().is_some_and(|open| open.is_eager && open.busy_for().is_none());
        let told = self.hear_keeper() || told;
        let is_due = is_loaded || told || is_found || is_eager || self.open.as_ref().is_some_and(Open::is_due);
        if is_due && self.pass() {
            // What stands above the control that was touched has been laid out with the value before.
            self.pass();
        }
        if let Some(open) = &mut self.open {
            open.give(self.state.as_ref());
        }
        self.tell();
        Ok(())
    }

    /// Says what became of a picture that was to be saved; whether there is something to say.
    fn hear_keeper(&mut self) -> bool {
        let Some(open) = &self.open else { return false };
        let heard = self.keeper.heard(|| open.means(&self.table));
        let is_heard = heard.is_some();
        self.state.iter_mut().zip(heard).for_each(|(state, said)| state.say(said));
        is_heard
    }

    /// When something is to be looked at again.
    pub fn next(&self) -> Option<Instant> {
        let drawn = self.open.as_ref().and_then(|open| open.next(SLOW, self.state.as_ref()));
        let kept = self.state.as_ref().and_then(|state| self.shelf.next(state));
        drawn.into_iter().chain(self.reopen_at).chain(kept).min()
    }

    /// Says in the title what takes long.
    fn tell(&mut self) {
        let is_slow = self.open.as_ref().and_then(Open::busy_for).is_some_and(|time| time >= SLOW);
        let drawing = || self.state.as_ref().and_then(|state| state.doing).unwrap_or("drawing").to_owned();
        let loading = || self.loading.as_ref().filter(|_| self.state.is_some()).map(Loading::what);
        let doing = if is_slow { Some(drawing()) } else { loading() };
        let title = self.title(doing.as_deref());
        if let Some(open) = self.open.as_mut().filter(|open| open.titled != doing) {
            open.titled = doing;
            open.window.set_title(&title);
        }
    }

    /// Ends the program where something has failed.
    pub fn heed(&mut self, event_loop: &ActiveEventLoop, done: Result<(), ViewerError>) {
        let done = match done {
            Err(ViewerError::Lost(why)) => self.lose_device(why),
            done => done,
        };
        if let Err(failure) = done {
            self.failure = Some(failure);
            self.close(event_loop);
        }
    }

    /// The device is lost: another one is to be tried, unless that was to no avail.
    fn lose_device(&mut self, why: String) -> Result<(), ViewerError> {
        let delay = self.losses.again(native::now());
        let (Some(open), Some(delay)) = (&mut self.open, delay) else { return Err(ViewerError::Lost(why)) };
        open.close_device();
        self.reopen_at = native::after(delay);
        self.lost = Some(why);
        Ok(())
    }

    /// Goes on with another device; the state stays as it is.
    fn reopen(&mut self) -> Result<(), ViewerError> {
        self.reopen_at = None;
        let Some(open) = &mut self.open else { return Ok(()) };
        // Whatever kept it from opening may pass, as what took the last one has.
        open.reopen_device(self.table.clone(), self.wake.clone())
            .map_err(|error| ViewerError::Lost(error.to_string()))?;
        let Some(state) = &mut self.state else { return Ok(()) };
        state.lose_pictures();
        let why = self.lost.take().unwrap_or_default();
        state.say(format!("the graphics device was lost ({why}): all is drawn on another one now"));
        Ok(())
    }

    /// The window is gone at once, whatever the painter is at.
    pub fn close(&mut self, event_loop: &ActiveEventLoop) {
        if let Some(open) = &self.open {
            open.window.set_visible(false);
        }
        self.state.iter().for_each(|state| self.shelf.end(state));
        event_loop.exit();
    }
}

/// Over all of the screen, or back as it was.
fn toggle_fullscreen(window: &Window) {
    let is_full = window.fullscreen().is_some();
    window.set_fullscreen((!is_full).then_some(Fullscreen::Borderless(None)));
}
