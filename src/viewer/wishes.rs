//! Pictures of what is shown, as the user wants them: in a file, or as the command that makes one.

use super::change::Change;
use super::files::{Files, Pictured};
use super::native::{self, Job, Keeper, Means};
use super::open::Open;
use super::saving::{Settings, Wish};
use super::state::State;

/// Under which name it is kept how pictures are saved.
const KEPT: &str = "picture.toml";

/// How pictures were saved in an earlier run.
pub fn remembered() -> Settings {
    native::remembered(KEPT).and_then(|text| Settings::from_text(&text)).unwrap_or_default()
}

/// Has a picture saved of what the state shows.
pub fn save(keeper: &mut Keeper, means: Means, open: &Open, state: &mut State, mut wish: Wish) {
    if wish.name.is_some()
        && let Err(why) = native::remember(KEPT, &wish.settings.to_text())
    {
        state.say(format!("can't keep for the next time how pictures are saved: {why}"));
    }
    wish.settings.size = wish.settings.size.or(Some(open.shown_size()));
    keeper.keep(means, Job { name: state.name.clone(), shot: state.shot(Change::None), wish });
}

/// Puts the command on the clipboard that makes the picture which would be saved at once; says that, or why not.
pub fn copy(files: &dyn Files, open: &mut Open, state: &State) -> String {
    let Settings { size, samples, format, .. } = state.saving.last;
    let size = size.unwrap_or(open.shown_size());
    let pictured = Pictured { scene: &state.scene, edits: &state.edits, size, samples, format };
    match files.command(&pictured) {
        Ok(command) => {
            open.egui.set_clipboard_text(command);
            "the command is on the clipboard".to_owned()
        }
        Err(why) => format!("can't copy the command: {why}"),
    }
}
