//! What the window has to do with files beside opening them: changes are kept, the scenes that were opened are listed, and the files of
//! the scene that is shown are looked after.

use std::path::PathBuf;

use winit::event_loop::EventLoopProxy;

use super::clerk::{self, Done, Errand};
use super::kept::{self, Keeper, Step};
use super::native::{self, Instant, Watch, Worker};
use super::offer::Offer;
use super::state::State;
use crate::scene::Edits;

pub(super) struct Shelf {
    wake: EventLoopProxy<()>,
    clerk: Worker<Errand, Done>,
    keeper: Keeper,
    /// Of the files of the scene that is shown; none where it has none.
    watch: Option<Watch>,
    /// The scene's file, until it is known that it can be drawn.
    unlisted: Option<PathBuf>,
}

impl Shelf {
    pub fn new(wake: EventLoopProxy<()>) -> Self {
        let of_clerk = wake.clone();
        // Where the loop has ended nobody is left to be woken.
        let clerk = Worker::start(clerk::run, move || _ = of_clerk.send_event(()));
        Self { wake, clerk, keeper: Keeper::new(&Edits::default()), watch: None, unlisted: None }
    }

    /// A scene is shown from now on.
    pub fn begin(&mut self, state: &State) {
        let files = state.scene.files.clone();
        self.keeper = Keeper::new(&state.edits);
        self.unlisted = files.first().cloned();
        let wake = self.wake.clone();
        self.watch = (!files.is_empty()).then(|| Watch::start(files, move || _ = wake.send_event(())));
    }

    /// The scene is shown no more: what has been changed in it is kept.
    pub fn end(&mut self, state: &State) {
        self.keep(state, true);
    }

    /// The scene that is shown can be drawn.
    pub fn drawn(&mut self) {
        self.unlisted.take().into_iter().for_each(|path| self.clerk.give(Errand::Opened(path)));
    }

    /// What may be meant by this is to be listed.
    pub fn list(&self, typed: String) {
        self.clerk.give(Errand::List(typed));
    }

    /// Nobody wants what was kept of this state's scene.
    pub fn decline(&self, state: &State, offer: Offer) {
        self.clerk.give(Errand::Decline(kept::name(&state.scene), offer.text));
    }

    /// Whether the scene's files have changed since this was asked last.
    pub fn has_changed(&self) -> bool {
        self.watch.as_ref().is_some_and(Watch::has_changed)
    }

    /// Sees to what is due; whether there is something new to show.
    pub fn follow(&mut self, state: &mut State) -> bool {
        self.keep(state, false);
        let mut is_new = false;
        // One that has panicked has said so: the window goes on without.
        while let Ok(Some(done)) = self.clerk.report() {
            match done {
                Done::Well => {}
                Done::Badly(why) => {
                    is_new |= !state.messages.contains(&why);
                    state.say(why);
                }
                Done::Listed(listing) => is_new |= state.opening.as_mut().is_some_and(|opening| opening.take(listing)),
            }
        }
        is_new
    }

    /// When there is something to do for a state.
    pub fn next(&self, state: &State) -> Option<Instant> {
        self.keeper.next(&state.edits)
    }

    fn keep(&mut self, state: &State, is_end: bool) {
        match self.keeper.step(state, native::now(), is_end) {
            None => {}
            Some(Step::Keep(kept)) => self.clerk.give(Errand::Keep(kept)),
            Some(Step::Forget(name)) => self.clerk.give(Errand::Forget(name)),
        }
    }
}
