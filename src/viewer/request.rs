//! What the user asks for that takes more than a change of the edits.

/// A wish that the window fulfils.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Request {
    /// The picture as it is shown, in a file.
    Screenshot,
    /// The edits, in a file.
    SaveState,
    /// The window over all of the screen, or back as it was.
    Fullscreen,
}
