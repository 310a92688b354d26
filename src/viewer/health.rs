//! Whether a device can still be used, and how often another one is tried.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use super::native::Instant;
use crate::renderer::Gpu;

/// What has befallen a device: it is lost, it has no memory left, or it does not take what it is given.
#[derive(Clone, Default)]
pub struct Health(Arc<Mutex<Option<String>>>);

impl Health {
    /// Watches a device; after whatever befalls it `wake` is called.
    pub fn of(gpu: &Gpu, wake: impl Fn() + Clone + Send + Sync + 'static) -> Self {
        let health = Self::default();
        let (lost, called) = (health.clone(), wake.clone());
        gpu.device.set_device_lost_callback(move |_, why| {
            lost.note(why);
            called();
        });
        let wrong = health.clone();
        gpu.device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            wrong.note(error.to_string());
            wake();
        }));
        health
    }

    /// What came first counts: the rest follows from it.
    fn note(&self, why: String) {
        let why = why.split_whitespace().collect::<Vec<_>>().join(" ");
        let mut noted = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        noted.get_or_insert(if why.is_empty() { "for an unknown reason".to_owned() } else { why });
    }

    /// Why the device can be used no more; none where it can.
    pub fn ailment(&self) -> Option<String> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

/// Most devices that are tried within [`WHILE`],
const TRIES: usize = 3;
const WHILE: Duration = Duration::from_secs(10);
/// and how long is waited before each of them: drivers may take a while to come back.
const DELAYS: [Duration; TRIES] = [Duration::ZERO, Duration::from_secs(1), Duration::from_secs(4)];

/// When devices were lost, or did not come.
#[derive(Default)]
pub struct Losses(Vec<Instant>);

impl Losses {
    /// One is lost, or has not come: after how long another one is to be tried, if at all.
    pub fn again(&mut self, now: Instant) -> Option<Duration> {
        self.0.retain(|time| now.saturating_duration_since(*time) < WHILE);
        let delay = DELAYS.get(self.0.len()).copied();
        self.0.push(now);
        delay
    }
}

#[cfg(test)]
mod tests {
    use super::super::native;
    use super::*;

    #[test]
    fn three_are_tried_within_ten_seconds() {
        let start = native::now();
        let at = |seconds: f32| start + Duration::from_secs_f32(seconds);
        let mut losses = Losses::default();
        assert_eq!(
            [0.0, 0.1, 1.2, 5.3].map(|time| losses.again(at(time))),
            [Some(DELAYS[0]), Some(DELAYS[1]), Some(DELAYS[2]), None]
        );
        // What is lost now and then may be lost for ever.
        let mut losses = Losses::default();
        for hour in 0..100 {
            assert_eq!(losses.again(at(3600.0 * hour as f32)), Some(Duration::ZERO));
        }
    }

    #[test]
    fn what_came_first_is_told_in_one_line() {
        let health = Health::default();
        assert_eq!(health.ailment(), None);
        health.note("a\n  b\tc".to_owned());
        health.note("d".to_owned());
        assert_eq!(health.clone().ailment().as_deref(), Some("a b c"));
        let unknown = Health::default();
        unknown.note("\n".to_owned());
        assert_eq!(unknown.ailment().as_deref(), Some("for an unknown reason"));
    }
}
