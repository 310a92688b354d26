//! `--state FILE`: what the viewer has saved; `-` is standard input.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use velour::scene::{Edits, Scene};

use crate::failure::Failure;

/// Most bytes of a state: far more than a viewer saves, and far less than a memory.
const BYTES_MAX: u64 = 1 << 24;

/// Whether a path stands for standard input.
pub fn is_stdin(path: &Path) -> bool {
    path == Path::new("-")
}

/// The edits of `scene` that a file holds.
pub fn load(path: &Path, scene: &Scene) -> Result<Edits, Failure> {
    let failure = |what: String| Failure::input(format!("--state {}: {what}", path.display()));
    let mut bytes = Vec::new();
    let read = match is_stdin(path) {
        true => io::stdin().take(BYTES_MAX + 1).read_to_end(&mut bytes),
        false => File::open(path).and_then(|file| file.take(BYTES_MAX + 1).read_to_end(&mut bytes)),
    };
    read.map_err(|error| failure(format!("cannot be read ({error})")))?;
    if bytes.len() as u64 > BYTES_MAX {
        return Err(failure(format!("has more than {BYTES_MAX} bytes: give a state that the viewer has saved")));
    }
    let text = String::from_utf8(bytes)
        .map_err(|_| failure("is no text: give a state that the viewer has saved".to_owned()))?;
    // Some editors put a mark before the text.
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    Edits::from_text(text, scene).map_err(|error| failure(error.to_string()))
}
