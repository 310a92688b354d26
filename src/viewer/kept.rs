//! What the user changes is kept while one works: however the program ends, the next run offers it, and forces it on nobody.
//!
//! There is a text for each scene, a state as `--state` takes it. What is offered is taken before anything is kept, so that neither this
//! run nor another window takes it away; it is read when the user wants it, so that whatever is in it stops no start.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use super::file_name;
use super::native::{self, Instant};
use super::offer::Offer;
use super::state::State;
use crate::scene::{Edits, Scene};

/// So many scenes' changes are kept, those that were changed last.
pub const MOST: usize = 24;
/// How the names begin that they are kept under.
pub const BEGINNING: &str = "kept-";
/// The least time between two writes.
const PACE: Duration = Duration::from_secs(2);

/// What is kept of this state's scene, where it differs from what is shown.
pub fn offer(state: &State) -> Option<Offer> {
    let name = name(&state.scene);
    let text = native::remembered(&name)?;
    let now = state.edits.to_text(&state.scene);
    let is_shown = without_comments(&text) == without_comments(&now);
    (!is_shown).then(|| Offer { said: said(&state.name, native::age(&name)), text })
}

fn without_comments(text: &str) -> String {
    text.lines().filter(|line| !line.starts_with('#')).collect::<Vec<_>>().join("\n").trim().to_owned()
}

/// What is said of changes that were kept so long ago.
fn said(scene: &str, age: Option<Duration>) -> String {
    let ago = age.map(|age| format!(" ({})", ago(age))).unwrap_or_default();
    format!("Your last changes to {}{ago} are kept.", native::one_line(file_name(scene)))
}

/// In the largest unit that fits.
fn ago(age: Duration) -> String {
    const UNITS: [(u64, &str); 4] = [(86400, "day"), (3600, "hour"), (60, "minute"), (1, "second")];
    let seconds = age.as_secs().max(1);
    let (length, unit) = UNITS.into_iter().find(|(length, _)| seconds >= *length).unwrap_or((1, "second"));
    let count = seconds / length;
    format!("{count} {unit}{} ago", if count == 1 { "" } else { "s" })
}

/// The name that a scene's changes are kept under: by the path of its file, or one for all that have none.
pub fn name(scene: &Scene) -> String {
    let path = scene.files.first().map(|path| native::absolute(path));
    let bytes = path.as_deref().map_or(&[][..], |path| path.as_os_str().as_encoded_bytes());
    format!("{BEGINNING}{:016x}.toml", hash(bytes))
}

/// FNV-1a of 64 bits, the same in each build: two of some dozen paths share one once in 10^17.
fn hash(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

/// What is to be kept.
pub struct Kept {
    pub name: String,
    pub of: String,
    pub scene: Arc<Scene>,
    pub edits: Edits,
}

impl Kept {
    /// The text of it.
    pub fn text(&self) -> String {
        let whole = self.scene.files.first().map(|path| native::absolute(path));
        let of = whole.as_deref().map(Path::to_string_lossy).unwrap_or(self.of.as_str().into());
        format!("# Changes to {}, for --state.\n{}", native::one_line(&of), self.edits.to_text(&self.scene))
    }
}

/// What is to be done with the changes of a scene.
pub enum Step {
    Keep(Box<Kept>),
    /// There are none any more.
    Forget(String),
}

/// Sees to it that the changes of the scene that is shown are kept.
pub struct Keeper {
    /// The edits as they were begun with, and as they were looked at last.
    begun: Edits,
    last: Edits,
    /// When that was, where there was something to do.
    at: Option<Instant>,
    /// Whether something is kept of this run.
    has_kept: bool,
}

impl Keeper {
    /// Begins with these edits, which are kept by whoever has them.
    pub fn new(edits: &Edits) -> Self {
        Self { begun: edits.clone(), last: edits.clone(), at: None, has_kept: false }
    }

    /// What is to be done by this time, if anything is; at the end, without further delay.
    pub fn step(&mut self, state: &State, now: Instant, is_end: bool) -> Option<Step> {
        let waits = !is_end && self.at.is_some_and(|at| at + PACE > now);
        if waits || state.edits == self.last {
            return None;
        }
        self.last.clone_from(&state.edits);
        let name = name(&state.scene);
        if is_worth_keeping(&self.begun, &self.last) {
            (self.at, self.has_kept) = (Some(now), true);
            let (scene, edits) = (state.scene.clone(), self.last.clone());
            return Some(Step::Keep(Box::new(Kept { name, of: state.name.clone(), scene, edits })));
        }
        std::mem::take(&mut self.has_kept).then(|| {
            self.at = Some(now);
            Step::Forget(name)
        })
    }

    /// When these edits are to be looked at; never where that has been done. At once where nothing has been kept yet.
    pub fn next(&self, edits: &Edits) -> Option<Instant> {
        (*edits != self.last).then(|| self.at.map_or_else(native::now, |at| at + PACE))
    }
}

/// Whether more has changed than the view.
fn is_worth_keeping(begun: &Edits, edits: &Edits) -> bool {
    let [begun, edits] = [begun, edits].map(|edits| Edits { camera: None, ..edits.clone() });
    edits != Edits::default() && edits != begun
}

#[cfg(test)]
mod tests {
    use super::super::tests::scene;
    use super::*;
    use crate::scene::{CameraEdit, MaterialEdits};

    fn state() -> State {
        State::new("a/felt.glb", scene(1.0), Edits::default())
    }

    /// What is done at a time in seconds after the first.
    fn done(keeper: &mut Keeper, state: &State, start: Instant, seconds: f32) -> Option<String> {
        match keeper.step(state, start + Duration::from_secs_f32(seconds), false)? {
            Step::Keep(kept) => Some(kept.text()),
            Step::Forget(_) => Some("forgotten".to_owned()),
        }
    }

    #[test]
    fn changes_are_kept_at_once_and_then_at_most_once_in_two_seconds() {
        let mut state = state();
        let mut keeper = Keeper::new(&state.edits);
        let start = native::now() + Duration::from_secs(1);
        assert_eq!(done(&mut keeper, &state, start, 0.0), None);
        let mut kept = Vec::new();
        for eighth in 1_u8..=48 {
            // A drag that takes six seconds.
            state.edits.exposure = Some(f32::from(eighth).into());
            kept.extend(done(&mut keeper, &state, start, f32::from(eighth) / 8.0));
        }
        assert_eq!(kept.len(), 3);
        for (text, eighth) in kept.iter().zip([1, 17, 33]) {
            assert_eq!(text, &format!("# Changes to a/felt.glb, for --state.\nexposure = {eighth}\n"));
        }
        // The last of it is kept once it is due, and then there is nothing to do.
        assert!(keeper.next(&state.edits).is_some_and(|next| next > start + Duration::from_secs(6)));
        assert!(done(&mut keeper, &state, start, 6.2).is_some_and(|text| text.contains("exposure = 48")));
        assert_eq!((done(&mut keeper, &state, start, 60.0), keeper.next(&state.edits)), (None, None));
    }

    #[test]
    fn at_the_end_nothing_waits() {
        let mut state = state();
        let mut keeper = Keeper::new(&state.edits);
        let now = native::now();
        for stops in [1.0, 2.0] {
            state.edits.exposure = Some(stops.into());
            assert!(matches!(keeper.step(&state, now, true), Some(Step::Keep(kept)) if kept.edits == state.edits));
        }
        assert!(keeper.step(&state, now, true).is_none());
    }

    #[test]
    fn what_is_no_change_is_not_kept() {
        let mut state = state();
        let mut keeper = Keeper::new(&state.edits);
        let start = native::now() + Duration::from_secs(1);
        // A turn.
        state.edits.camera = Some(CameraEdit::Orbit(state.orbit()));
        assert_eq!(done(&mut keeper, &state, start, 1.0), None);
        // With something else it is kept, too.
        state.edits.shadows = Some(false);
        assert!(done(&mut keeper, &state, start, 2.0).is_some_and(|text| text.contains("[view]")));
        // What is taken back is forgotten, once.
        state.edits.shadows = None;
        assert_eq!(done(&mut keeper, &state, start, 5.0).as_deref(), Some("forgotten"));
        state.edits.camera = None;
        assert_eq!(done(&mut keeper, &state, start, 9.0), None);
        // What a run begins with has whoever gave it; but not the file of another run.
        let begun = Edits { shadows: Some(false), ..Edits::default() };
        let mut keeper = Keeper::new(&begun);
        assert_eq!(done(&mut keeper, &state, start, 10.0), None);
    }

    #[test]
    fn names_go_by_the_path_from_the_root() {
        let of =
            |path: Option<&str>| name(&Scene { files: path.map(Into::into).into_iter().collect(), ..Scene::default() });
        let here = std::env::current_dir().unwrap();
        assert_eq!(of(Some("x.glb")), of(here.join("x.glb").to_str()));
        assert_ne!(of(Some("x.glb")), of(Some("y.glb")));
        assert_eq!(of(None), "kept-cbf29ce484222325.toml");
        // The reference's own value.
        assert_eq!(hash(b"foobar"), 0x8594_4171_f739_67e8);
    }

    #[test]
    fn ages_are_told_in_the_largest_unit() {
        let told = |seconds| ago(Duration::from_secs(seconds));
        assert_eq!(
            [0, 59, 60, 7300, 200_000].map(told),
            ["1 second ago", "59 seconds ago", "1 minute ago", "2 hours ago", "2 days ago"]
        );
        assert_eq!(said("a/x\n.glb", None), "Your last changes to x.glb are kept.");
    }

    #[test]
    fn what_is_kept_is_a_state_of_its_scene() {
        let state = state();
        let material = MaterialEdits { alpha: Some(0.25), ..MaterialEdits::default() };
        let edits = Edits { materials: [(0, material)].into(), ..Edits::default() };
        let (scene, of) = (state.scene.clone(), "a\nb".to_owned());
        let text = Kept { name: String::new(), of, scene, edits: edits.clone() }.text();
        assert_eq!(Edits::from_text(&text, &state.scene), Ok(edits));
    }
}
