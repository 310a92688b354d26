//! Errands to files that are done aside, one after another, so that the window waits for no disk.

use std::path::PathBuf;

use super::kept::{self, Kept};
use super::listing::{self, Listing};
use super::{native, recent};

/// What is to be done.
pub enum Errand {
    /// Keep the changes of a scene.
    Keep(Box<Kept>),
    /// Forget them.
    Forget(String),
    /// Forget what was offered under this name, unless it has been kept anew meanwhile.
    Decline(String, String),
    /// A scene has been opened: list it with those that were opened last.
    Opened(PathBuf),
    /// List what may be meant by what has been typed.
    List(String),
}

/// What has come of it.
#[derive(Debug, PartialEq)]
pub enum Done {
    Well,
    /// It could not be done.
    Badly(String),
    Listed(Listing),
}

/// Does an errand.
pub fn run(errand: Errand) -> Done {
    let kept = match errand {
        Errand::Keep(kept) => {
            let done = native::remember(&kept.name, &kept.text());
            native::tidy(kept::BEGINNING, kept::MOST);
            done.map_err(|why| format!("your changes cannot be kept for the next time: {why}"))
        }
        Errand::Forget(name) => {
            native::forget(&name);
            Ok(())
        }
        Errand::Decline(name, text) => {
            if native::remembered(&name) == Some(text) {
                native::forget(&name);
            }
            Ok(())
        }
        // That nothing is listed is no news to whoever opens scenes.
        Errand::Opened(path) => {
            let _ = recent::add(&path);
            Ok(())
        }
        Errand::List(typed) => return Done::Listed(listing::list(typed)),
    };
    kept.map_or_else(Done::Badly, |()| Done::Well)
}
