//! Whether files change on disk. Their times and lengths are looked at, which costs next to nothing and works on every file system.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::{Duration, SystemTime};

/// How often is looked. What has changed is told once it has stood still for so long: it may be in the midst of being written.
const PACE: Duration = Duration::from_millis(500);

/// A thread that looks after files, until this is dropped.
pub struct Watch {
    changed: Arc<AtomicBool>,
    /// Closed, it ends the thread.
    _end: mpsc::Sender<()>,
}

/// When a file was written last, and how long it is; none where there is none.
type Stamp = Option<(Option<SystemTime>, u64)>;

impl Watch {
    /// Looks after these files, of which the first is the one that names the others; calls `wake` when one of them has changed.
    pub fn start(files: Vec<PathBuf>, wake: impl Fn() + Send + 'static) -> Self {
        let (end, ended) = mpsc::channel();
        let changed = Arc::new(AtomicBool::new(false));
        let told = changed.clone();
        let stamps = move || files.iter().map(|file| stamp(file)).collect();
        let mut changes = Changes::new(stamps());
        std::thread::spawn(move || {
            while ended.recv_timeout(PACE) == Err(RecvTimeoutError::Timeout) {
                if changes.settle(stamps()) {
                    told.store(true, Ordering::Relaxed);
                    wake();
                }
            }
        });
        Self { changed, _end: end }
    }

    /// Whether one has changed since this was asked last.
    pub fn has_changed(&self) -> bool {
        self.changed.swap(false, Ordering::Relaxed)
    }
}

fn stamp(file: &Path) -> Stamp {
    std::fs::metadata(file).ok().map(|file| (file.modified().ok(), file.len()))
}

/// What has been seen of files.
struct Changes {
    /// As they were told of last.
    told: Vec<Stamp>,
    /// As they were seen last.
    seen: Vec<Stamp>,
}

impl Changes {
    fn new(stamps: Vec<Stamp>) -> Self {
        Self { told: stamps.clone(), seen: stamps }
    }

    /// Whether there is a change to tell of: of files that are as they were the last time, and the first of which is there.
    fn settle(&mut self, now: Vec<Stamp>) -> bool {
        let stands_still = self.seen == now;
        self.seen = now;
        let is_due = stands_still && self.seen != self.told && self.seen.first().is_some_and(Option::is_some);
        if is_due {
            self.told.clone_from(&self.seen);
        }
        is_due
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_is_told_once_it_stands_still() {
        let at = |length| Some((None, length));
        let mut changes = Changes::new(vec![at(1), None]);
        for (now, is_told) in [
            (vec![at(1), None], false),
            // It is being written.
            (vec![at(2), None], false),
            (vec![at(3), None], false),
            (vec![at(3), None], true),
            (vec![at(3), None], false),
            // What comes and goes within a while was nothing.
            (vec![at(4), None], false),
            (vec![at(3), None], false),
            (vec![at(3), None], false),
            // A file that was missing.
            (vec![at(3), at(7)], false),
            (vec![at(3), at(7)], true),
            // Without the first there is nothing to load: it will come back.
            (vec![None, at(7)], false),
            (vec![None, at(7)], false),
            (vec![at(3), at(7)], false),
            (vec![at(3), at(7)], false),
            (vec![at(9), at(7)], false),
            (vec![at(9), at(7)], true),
        ] {
            assert_eq!(changes.settle(now.clone()), is_told, "{now:?}");
        }
    }

    #[test]
    fn the_thread_wakes_on_a_change_and_ends_with_its_watch() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("scene.gltf");
        std::fs::write(&file, "1").unwrap();
        let (woken, wakes) = mpsc::channel();
        let watch = Watch::start(vec![file.clone()], move || _ = woken.send(()));
        assert!(!watch.has_changed());
        std::fs::write(&file, "12").unwrap();
        wakes.recv_timeout(Duration::from_secs(60)).unwrap();
        assert!(watch.has_changed() && !watch.has_changed());
        drop(watch);
        // The sender goes with the thread.
        assert_eq!(wakes.recv_timeout(Duration::from_secs(60)), Err(RecvTimeoutError::Disconnected));
    }
}
