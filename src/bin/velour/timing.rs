//! How long the parts of a run take.

use std::time::Instant;

use serde_json::{Map, Value, json};

/// Seconds spent in the parts of a run, in order.
#[derive(Default)]
pub struct Timing(Vec<(&'static str, f64)>);

impl Timing {
    pub fn measure<T>(&mut self, part: &'static str, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let done = work();
        self.0.push((part, start.elapsed().as_secs_f64()));
        done
    }

    pub fn total(&self) -> f64 {
        self.0.iter().map(|(_, seconds)| seconds).sum()
    }

    /// Seconds spent in one part, 0 where there was none of that name.
    pub fn of(&self, part: &str) -> f64 {
        self.0.iter().find(|(name, _)| *name == part).map_or(0.0, |(_, seconds)| *seconds)
    }

    /// For machines.
    pub fn seconds(&self) -> Map<String, Value> {
        self.0.iter().map(|(part, seconds)| (part.to_string(), json!(seconds))).collect()
    }
}
