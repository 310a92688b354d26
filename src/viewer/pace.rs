//! How many pixels can be drawn in the time that there is.

use std::ops::Range;
use std::time::Duration;

/// Most times fewer pixels a side.
pub const COARSEST: u32 = 4;
/// How long a frame of what moves may take.
const MOVING: Duration = Duration::from_millis(30);
/// How long a part of a sample at rest may take: nobody waits longer to be heard.
const RESTING: Duration = Duration::from_millis(70);
/// Most parts that a sample is drawn in: each takes what it takes to go through the scene once more.
const PARTS: u32 = 24;
/// How much of the running time is the last one's.
const SHARE: f64 = 0.4;
/// More pixels are tried where they are expected to take this share of the time that there is.
const ROOM: f64 = 0.7;

/// Running times of frames, and what follows from them.
#[derive(Clone, Debug)]
pub struct Pace {
    divisor: u32,
    /// Seconds that a frame takes in pixels of this divisor; none before the first.
    moving: Option<f64>,
    /// Seconds that a row of a sample takes.
    row: Option<f64>,
    slow: bool,
}

impl Default for Pace {
    fn default() -> Self {
        Self::new(false)
    }
}

impl Pace {
    /// Before anything has been drawn: `slow` ones begin with the fewest pixels.
    pub fn new(slow: bool) -> Self {
        Self { divisor: if slow { COARSEST } else { 1 }, moving: None, row: None, slow }
    }

    /// By how much the sides of what moves are divided, in [1, [`COARSEST`]].
    pub fn divisor(&self) -> u32 {
        self.divisor
    }

    /// What moves was drawn with this divisor, in this time.
    pub fn moved(&mut self, divisor: u32, time: Duration) {
        if divisor != self.divisor {
            return;
        }
        let time = time.as_secs_f64();
        let running = self.moving.map_or(time, |before| before + SHARE * (time - before));
        self.moving = Some(running);
        let with = |divisor: u32| running * f64::from(self.divisor * self.divisor) / f64::from(divisor * divisor);
        let fits = |divisor: &u32| with(*divisor) <= ROOM * MOVING.as_secs_f64();
        let next = if running > MOVING.as_secs_f64() {
            (self.divisor..=COARSEST).find(fits).unwrap_or(COARSEST)
        } else {
            (1..self.divisor).find(fits).unwrap_or(self.divisor)
        };
        if next != self.divisor {
            (self.moving, self.divisor) = (None, next);
        }
    }

    /// So many rows of a sample were drawn in this time.
    pub fn rested(&mut self, rows: u32, time: Duration) {
        let row = time.as_secs_f64() / f64::from(rows.max(1));
        self.row = Some(self.row.map_or(row, |before| before + SHARE * (row - before)));
    }

    /// The rows that are drawn next, of so many.
    pub fn rows(&self, first: u32, height: u32) -> Range<u32> {
        let least = height.div_ceil(PARTS).max(1);
        let count = match self.row {
            Some(row) => (RESTING.as_secs_f64() / row.max(1e-9)).min(f64::from(height)) as u32,
            None if self.slow => least,
            None => height,
        };
        // What would be left for a part of its own is taken along.
        let last = first + count.max(least);
        first..if last + least > height { height } else { last }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The divisors of frames whose times go with their pixels, where all of them take `whole`.
    fn divisors(pace: &mut Pace, whole: Duration, frames: usize) -> Vec<u32> {
        let frame = |_| {
            let divisor = pace.divisor();
            pace.moved(divisor, whole / (divisor * divisor));
            divisor
        };
        (0..frames).map(frame).collect()
    }

    #[test]
    fn pixels_are_as_many_as_fit() {
        for (whole, settled) in [(5, 1), (15, 1), (60, 2), (170, 3), (400, 4), (5000, 4)] {
            for slow in [false, true] {
                let mut pace = Pace::new(slow);
                let found = divisors(&mut pace, Duration::from_millis(whole), 20);
                assert_eq!(found.last(), Some(&settled), "{whole} ms, {slow}: {found:?}");
                // It does not go to and fro.
                assert!(found.windows(2).filter(|pair| pair[0] != pair[1]).count() <= 2, "{found:?}");
            }
        }
    }

    #[test]
    fn one_slow_frame_is_made_up_for() {
        let mut pace = Pace::new(false);
        divisors(&mut pace, Duration::from_millis(10), 5);
        pace.moved(1, Duration::from_millis(300));
        assert!(pace.divisor() > 1);
        assert_eq!(divisors(&mut pace, Duration::from_millis(10), 10).last(), Some(&1));
    }

    #[test]
    fn parts_take_the_time_that_there_is() {
        let mut pace = Pace::new(true);
        assert_eq!(pace.rows(0, 720), 0..30);
        pace.rested(30, Duration::from_millis(30));
        assert_eq!(pace.rows(30, 720), 30..100);
        assert_eq!(pace.rows(640, 720), 640..720);
        // However slow, there are not more parts than that.
        pace.rested(1, Duration::from_secs(100));
        assert_eq!(pace.rows(0, 720), 0..30);
        assert_eq!(Pace::new(false).rows(0, 720), 0..720);
        assert_eq!(pace.rows(0, 1), 0..1);
    }
}
