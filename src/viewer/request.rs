//! What the user asks for that takes more than a change of the edits.

use std::path::PathBuf;

use super::saving::Wish;

/// A wish that the window fulfils.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Request {
    /// A picture of what is shown, in a file.
    SavePicture(Wish),
    /// No picture of those that are being saved.
    StopSaving,
    /// The command that makes the picture, on the clipboard.
    CopyCommand,
    /// The edits, in a file.
    SaveState,
    /// The window over all of the screen, or back as it was.
    Fullscreen,
    /// A file in place of what is there: another scene, or a state of this one.
    Open(PathBuf),
    /// Files that may be meant by what has been typed.
    List(String),
    /// The scene anew, from its file.
    Reload,
    /// The changes of an earlier run to this scene.
    BringBack,
    /// None of them, and never again.
    Decline,
}
