//! The open window: what it shows, and what its painter is at.

use std::sync::Arc;
use std::time::Duration;

use egui::epaint::textures::TexturesDelta;
use egui::{TextureId, ViewportId};
use winit::event_loop::EventLoopProxy;
use winit::window::Window;

use super::ViewerError;
use super::change::Change;
use super::easel::Easel;
use super::frame::pixel_size;
use super::health::Health;
use super::mirror::Mirror;
use super::native::{self, Gone, Instant, Means, Worker};
use super::order::{Left, Order, Report, Textures, Unseen, Work};
use super::screen::Screen;
use super::state::State;
use super::{theme, window_size};
use crate::renderer::{Gpu, RenderError};
use crate::scene::Edits;
use crate::table::SheenTable;

/// The least time between two passes for a pointer that only hovers: a mouse may tell of its moves a thousand times a
/// second, a display shows sixty pictures.
const PACE: Duration = Duration::from_millis(16);
/// How long egui waits for its next pass after one that has led to nothing. It asks for two more after all input, so that
/// what lags behind can settle, and no frame makes it wait.
pub(super) const REST: Duration = Duration::from_millis(100);
/// How long nothing moves before what is shown coarsely is drawn in all its pixels,
const SETTLED: Duration = Duration::from_millis(120);
/// and how long while a button is held: a drag that pauses goes on most often.
const HELD: Duration = Duration::from_millis(800);
/// How often the frame time that is shown may change: each time the panel is painted anew.
const TIMED: Duration = Duration::from_secs(1);
/// How often is looked whether something that is built is there.
const BUILDING: Duration = Duration::from_millis(50);

/// A window with what belongs to it.
pub(super) struct Open {
    pub window: Arc<Window>,
    pub gpu: Gpu,
    health: Health,
    pub egui: egui_winit::State,
    pub screen: Screen,
    /// Changes of egui's textures that the painter has not been told.
    textures: Textures,
    mirror: Mirror,
    /// When egui had its last pass.
    pub passed: Instant,
    /// When it gets its next; never while nothing happens.
    pub due: Option<Instant>,
    /// What the title says that is being done.
    pub titled: Option<String>,
    painter: Worker<Order, Result<Report, ViewerError>>,
    /// Whether the painter has ended, because its device is lost.
    is_without_device: bool,
    /// Since when the painter has had an order.
    busy: Option<Instant>,
    /// Whether its next one has been announced.
    announced: bool,
    left: Left,
    /// When the picture changed last.
    moved: Instant,
    /// When the painter reported last.
    heard: Instant,
    /// When the frame time was told last.
    timed: Instant,
    is_hidden: bool,
    /// Whether the system has said that nothing of the window can be seen.
    is_out_of_sight: bool,
    /// What has changed in the picture that the painter has not been told.
    untold: Change,
    /// Textures of the sheet's pictures that the painter has made.
    tiles: Vec<TextureId>,
    /// What the sheet was of when the last of them was asked for.
    asked: Option<Edits>,
    /// Whether egui wants its next pass as soon as the painter is free.
    pub is_eager: bool,
    /// Whether the order that the painter has is about a scene that is shown no more.
    is_outdated: bool,
    /// What the painter makes of a scene that it has been given.
    verdict: Option<Result<(), RenderError>>,
}

impl Open {
    pub fn new(window: Arc<Window>, table: Arc<SheenTable>, wake: EventLoopProxy<()>) -> Result<Self, ViewerError> {
        let context = egui::Context::default();
        theme::apply(&context);
        let Easel { gpu, health, painter } = Easel::new(&window, &context, table, wake)?;
        let egui = egui_winit::State::new(
            context,
            ViewportId::ROOT,
            &window,
            Some(window.scale_factor() as f32),
            window.theme(),
            Some(gpu.device.limits().max_texture_dimension_2d as usize),
        );
        let now = native::now();
        let open = Self {
            window,
            gpu,
            health,
            egui,
            screen: Screen::new(),
            textures: Textures::default(),
            mirror: Mirror::default(),
            passed: now,
            due: Some(now),
            titled: None,
            painter,
            is_without_device: false,
            busy: None,
            announced: false,
            left: Left::Nothing,
            moved: now,
            heard: now,
            timed: now,
            is_hidden: false,
            is_out_of_sight: false,
            untold: Change::None,
            tiles: Vec::new(),
            asked: None,
            is_eager: false,
            is_outdated: false,
            verdict: None,
        };
        open.fit();
        Ok(open)
    }

    /// Lets go of a device that is lost: nothing is drawn until there is another one.
    pub fn close_device(&mut self) {
        self.painter.end();
        self.is_without_device = true;
        (self.busy, self.announced) = (None, false);
        (self.is_eager, self.left) = (false, Left::Nothing);
    }

    /// Goes on with another device: all is drawn anew.
    pub fn reopen_device(&mut self, table: Arc<SheenTable>, wake: EventLoopProxy<()>) -> Result<(), ViewerError> {
        let Easel { gpu, health, painter } = Easel::new(&self.window, self.egui.egui_ctx(), table, wake)?;
        (self.gpu, self.health, self.painter) = (gpu, health, painter);
        self.is_without_device = false;
        // What the painter before has made is gone with it.
        self.tiles.clear();
        self.asked = None;
        self.textures = Textures(self.mirror.all());
        self.screen.begin();
        self.expose();
        (self.untold, self.is_outdated, self.verdict) = (Change::Lights, false, None);
        self.wake_in(Duration::ZERO);
        Ok(())
    }

    /// What draws pictures that are saved.
    pub fn means(&self, table: &Arc<SheenTable>) -> Means {
        Means { gpu: self.gpu.clone(), table: table.clone(), health: self.health.clone() }
    }

    /// Whether a device is lost that was used until now, and why.
    pub fn loss(&self) -> Option<String> {
        self.health.ailment().filter(|_| !self.is_without_device)
    }

    /// Keeps what a pass has made of egui's textures.
    pub fn take_textures(&mut self, textures: TexturesDelta) {
        self.mirror.follow(&textures);
        self.textures.0.append(textures);
    }

    /// Another scene is shown from now on.
    pub fn begin(&mut self) {
        self.screen.begin();
        (self.is_outdated, self.verdict) = (self.busy.is_some(), None);
        self.left = Left::Nothing;
        self.wake_in(Duration::ZERO);
    }

    /// What the painter has made of a scene that it was given, told once: whether it draws it, or why not.
    pub fn verdict(&mut self) -> Option<Result<(), RenderError>> {
        self.verdict.take()
    }

    /// Makes the user interface of the size that finds room in the window.
    pub fn fit(&self) {
        let size = self.window.inner_size().to_logical(self.window.scale_factor());
        self.egui.egui_ctx().set_zoom_factor(window_size::zoom(size));
    }

    /// The next pass comes at this time, or when it was due before, if that is earlier.
    pub fn wake(&mut self, at: Instant) {
        self.due = Some(self.due.map_or(at, |due| due.min(at)));
    }

    /// The same after a delay.
    pub fn wake_in(&mut self, delay: Duration) {
        native::after(delay).into_iter().for_each(|at| self.wake(at));
    }

    /// The pointer has moved: egui hears of it when a frame may come of that. While one is drawn, that is when this is done; else at
    /// once, or a little later where nothing is dragged.
    pub fn follow_pointer(&mut self) {
        let is_held = self.egui.egui_ctx().input(|input| input.pointer.any_down());
        let pace = match (self.busy, is_held) {
            (Some(_), _) => REST,
            (None, true) => Duration::ZERO,
            (None, false) => PACE,
        };
        self.is_eager |= self.busy.is_some();
        self.wake(self.passed + pace);
    }

    /// Width and height in pixels of the picture as it is shown.
    pub fn shown_size(&self) -> [u32; 2] {
        pixel_size(self.screen.picture, self.screen.pixels_per_point)
    }

    pub fn is_due(&self) -> bool {
        self.due.is_some_and(|due| due <= native::now())
    }

    /// How long the painter has been at its order.
    pub fn busy_for(&self) -> Option<Duration> {
        self.busy.map(|since| since.elapsed())
    }

    /// When something is to be looked at again: `slow` after an order was given, it is told of.
    pub fn next(&self, slow: Duration, state: Option<&State>) -> Option<Instant> {
        let told = self.busy.filter(|_| self.titled.is_none()).map(|since| since + slow);
        let is_covered = state.is_some_and(|state| state.sheet.is_some());
        let waits = self.busy.is_some()
            || self.is_without_device
            || self.is_hidden
            || self.is_out_of_sight
            || self.is_minimised()
            || is_covered;
        let rested = if waits { None } else { self.rests_at() };
        [self.due, told, rested].into_iter().flatten().min()
    }

    /// When more of the picture is to be drawn.
    fn rests_at(&self) -> Option<Instant> {
        match self.left {
            Left::Nothing => None,
            Left::More => Some(self.moved),
            Left::Built => Some(self.heard + BUILDING),
            Left::Rest => {
                let is_held = self.egui.egui_ctx().input(|input| input.pointer.any_down());
                Some(self.moved + if is_held { HELD } else { SETTLED })
            }
        }
    }

    /// Takes in what the painter has told, if it has; whether there is something new to show of it.
    pub fn hear(&mut self, state: &mut State) -> Result<bool, ViewerError> {
        let Some(report) = self.report()? else { return Ok(false) };
        if std::mem::take(&mut self.is_outdated) {
            self.tiles.extend(report.tile.map(|(_, tile)| tile.texture));
            return Ok(true);
        }
        let said = |state: &State| (state.samples, state.notice.clone(), state.metered, state.doing, state.frame_time);
        let before = said(state);
        (self.announced, state.doing) = (report.about_to.is_some(), report.about_to);
        if report.about_to.is_some() {
            self.left = Left::More;
            return Ok(true);
        }
        self.verdict = Some(report.refused.map_or(Ok(()), Err));
        self.left = report.left;
        (state.samples, state.notice) = (report.samples, report.notice);
        state.metered = report.metered.or(state.metered);
        if report.frame_time.is_some() && self.timed.elapsed() > TIMED {
            (state.frame_time, self.timed) = (report.frame_time, native::now());
        }
        if let Some((index, tile)) = report.tile {
            self.tiles.push(tile.texture);
            // The sheet may have begun anew meanwhile.
            let asked = self.asked.take();
            if let Some(sheet) = state.sheet.as_mut().filter(|sheet| Some(&sheet.edits) == asked.as_ref()) {
                sheet.pictures[index] = Some(tile);
                return Ok(true);
            }
        }
        if let Some(advice) = report.advice {
            state.notices.push(advice.clone());
            state.say(advice);
            return Ok(true);
        }
        Ok(before != said(state))
    }

    /// The same before there is a scene.
    pub fn hear_nothing(&mut self) -> Result<bool, ViewerError> {
        self.report().map(|_| false)
    }

    fn report(&mut self) -> Result<Option<Report>, ViewerError> {
        if self.is_without_device {
            return Ok(None);
        }
        let gone = |Gone| ViewerError::Window("its painter has failed".to_owned());
        let Some(report) = self.painter.report().map_err(gone)?.transpose()? else { return Ok(None) };
        (self.busy, self.heard) = (None, native::now());
        self.is_hidden = report.unseen == Some(Unseen::Hidden);
        if report.unseen.is_some() {
            self.screen.lose();
        }
        Ok(Some(report))
    }

    fn is_minimised(&self) -> bool {
        let size = self.window.inner_size();
        size.width == 0 || size.height == 0
    }

    /// Gives the painter its next order, if it is free and there is something to do.
    pub fn give(&mut self, state: Option<&State>) {
        // Minimised: what has changed is drawn when the window comes back.
        if self.busy.is_some() || self.is_minimised() || self.is_without_device {
            return;
        }
        let Some(work) = self.work(state) else { return };
        let (now, stale) = (native::now(), self.screen.is_stale());
        if self.screen.change > Change::None {
            self.moved = now;
        }
        self.untold = self.untold.max(self.screen.change);
        let change = if work == Work::Frame { std::mem::take(&mut self.untold) } else { Change::None };
        let order = Order {
            size: self.window.inner_size().into(),
            place: self.screen.picture,
            pixels_per_point: self.screen.pixels_per_point,
            shapes: self.screen.presented(),
            textures: std::mem::take(&mut self.textures),
            dropped: self.unused_tiles(state),
            shot: state.map(|state| match (work, &state.sheet) {
                (Work::Tile(index, _), Some(sheet)) => state.shot_of(&sheet.edits_of(index, state.material)),
                _ => state.shot(change),
            }),
            work,
            stale,
            announced: self.announced,
        };
        if matches!(work, Work::Tile(..)) {
            self.asked = state.and_then(|state| state.sheet.as_ref()).map(|sheet| sheet.edits.clone());
        }
        self.busy = Some(now);
        self.painter.give(order);
    }

    /// Nobody can see the window.
    pub fn hide(&mut self) {
        self.is_out_of_sight = true;
    }

    /// The system has something of the window shown again.
    pub fn expose(&mut self) {
        (self.is_hidden, self.is_out_of_sight) = (false, false);
        self.screen.lose();
    }

    /// What the painter is to do next; nothing while nobody can see the window.
    fn work(&self, state: Option<&State>) -> Option<Work> {
        if self.is_hidden || self.is_out_of_sight {
            return None;
        }
        let rests = self.rests_at().is_some_and(|at| at <= native::now());
        let sheet = state.and_then(|state| state.sheet.as_ref());
        match sheet {
            // Over the picture, which waits.
            Some(_) if self.screen.is_stale() => Some(Work::Present),
            Some(sheet) => sheet.missing().map(|index| Work::Tile(index, sheet.size)),
            None if rests || self.announced || self.untold.max(self.screen.change) > Change::None => Some(Work::Frame),
            None => self.screen.is_stale().then_some(Work::Present),
        }
    }

    /// Textures that no sheet shows any more.
    fn unused_tiles(&mut self, state: Option<&State>) -> Vec<TextureId> {
        let sheet = state.and_then(|state| state.sheet.as_ref());
        let is_used =
            |id: &TextureId| sheet.is_some_and(|sheet| sheet.pictures.iter().flatten().any(|tile| tile.texture == *id));
        let (used, unused) = std::mem::take(&mut self.tiles).into_iter().partition(is_used);
        self.tiles = used;
        unused
    }
}
