//! How long a frame takes.

use std::collections::VecDeque;
use std::time::Duration;

/// How many frames the figure is taken over: few enough that it follows what the user changes within a drag.
const KEPT: usize = 9;

/// The times of the frames that were drawn last.
#[derive(Default)]
pub struct FrameTimes(VecDeque<Duration>);

impl FrameTimes {
    pub fn add(&mut self, time: Duration) {
        if self.0.len() == KEPT {
            self.0.pop_front();
        }
        self.0.push_back(time);
    }

    /// The median, which one slow frame among many does not move; none before the first.
    pub fn median(&self) -> Option<Duration> {
        let mut sorted: Vec<Duration> = self.0.iter().copied().collect();
        sorted.sort();
        sorted.get(sorted.len() / 2).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn median(milliseconds: &[u64]) -> Option<u128> {
        let mut times = FrameTimes::default();
        milliseconds.iter().for_each(|&time| times.add(Duration::from_millis(time)));
        times.median().map(|time| time.as_millis())
    }

    #[test]
    fn there_is_no_figure_before_the_first_frame() {
        assert_eq!(median(&[]), None);
        assert_eq!(median(&[7]), Some(7));
    }

    #[test]
    fn one_slow_frame_does_not_show() {
        assert_eq!(median(&[10, 11, 900, 12, 10]), Some(11));
    }

    #[test]
    fn it_follows_the_last_frames() {
        assert_eq!(median(&[[100; 50], [20; 50]].concat()), Some(20));
        assert_eq!(median(&[[100; 50].as_slice(), &[20; 5]].concat()), Some(20));
        assert_eq!(median(&[[100; 50].as_slice(), &[20; 4]].concat()), Some(100));
    }
}
