//! Warnings, which wait until loading has succeeded.

use super::error::one_line;

/// Collects what the user is to be told: one line per kind, however often it occurs.
#[derive(Debug, Default)]
pub(super) struct Notices {
    kinds: Vec<Notice>,
}

#[derive(Debug)]
struct Notice {
    kind: &'static str,
    first: String,
    more: usize,
}

impl Notices {
    /// Notes that something of `kind`, a clause that says what is done about it, occurs at `place`.
    pub fn add(&mut self, kind: &'static str, place: impl FnOnce() -> String) {
        match self.kinds.iter_mut().find(|notice| notice.kind == kind) {
            Some(notice) => notice.more += 1,
            None => self.kinds.push(Notice { kind, first: place(), more: 0 }),
        }
    }

    /// The lines, in the order in which their kinds first occurred.
    pub fn into_lines(self) -> impl Iterator<Item = String> {
        self.kinds.into_iter().map(|Notice { kind, first, more }| {
            let first = one_line(&first);
            match more {
                0 => format!("{kind}: {first}"),
                _ => format!("{kind}: {first} and {more} more"),
            }
        })
    }
}
