//! What of a picture is drawn next: while things move, a first sample in as few pixels as it takes to follow them; once they rest, all of
//! its pixels, and more and more samples, up to a number or for a while.

use std::ops::Range;
use std::time::Duration;

use super::pace::Pace;
use crate::renderer::{SAMPLES, UNFILTERED};

/// Most samples of a picture at rest: as many as it takes to show them as they are.
const MOST: u32 = UNFILTERED;
/// As many as `velour render` takes where nobody says how many; a picture at rest has them however long they take.
const LEAST: u32 = SAMPLES;
/// How long it is refined beyond them.
const PATIENCE: Duration = Duration::from_secs(8);

/// What a frame draws of the picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    /// Its first sample in so many times fewer pixels a side.
    Coarse(u32),
    /// All pixels, with the shadows of the coarse picture.
    Sharp,
    /// These rows of the sample of this index.
    Rows(u32, Range<u32>),
    /// Nothing: it is finished.
    Enough,
}

/// How far the picture that is shown has come.
#[derive(Clone, Debug, Default)]
pub struct Resting {
    pace: Pace,
    at: At,
    /// Time that went into its samples.
    spent: Duration,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum At {
    /// Nothing of it is there.
    #[default]
    Start,
    /// It is coarse.
    Coarse,
    /// Rows of a sample are to be drawn from here on.
    Sample { index: u32, row: u32 },
    /// There is nothing more to draw.
    End,
}

impl Resting {
    /// `slow`: whether to begin with few pixels, before it is known how long they take.
    pub fn new(slow: bool) -> Self {
        Self { pace: Pace::new(slow), ..Self::default() }
    }

    /// Something has moved: the picture begins anew.
    pub fn moved(&mut self) {
        (self.at, self.spent) = (At::Start, Duration::ZERO);
    }

    /// What to draw next of a picture of this height, with shadows or without, that may be `scaled` or not.
    pub fn step(&self, height: u32, shadowed: bool, scaled: bool) -> Step {
        match self.at {
            At::Start if scaled && self.pace.divisor() > 1 => Step::Coarse(self.pace.divisor()),
            At::Coarse if shadowed => Step::Sharp,
            At::Start | At::Coarse if shadowed => Step::Rows(0, self.pace.rows(0, height)),
            At::Start | At::Coarse => Step::Rows(0, 0..height),
            At::Sample { index, row } if shadowed => Step::Rows(index, self.pace.rows(row, height)),
            At::Sample { .. } | At::End => Step::Enough,
        }
    }

    /// A step has been drawn, in this time; none where that says nothing of others, because something was made for it first.
    pub fn drawn(&mut self, step: &Step, (height, shadowed): (u32, bool), time: Option<Duration>) {
        match step {
            Step::Coarse(divisor) => {
                self.at = At::Coarse;
                time.into_iter().for_each(|time| self.pace.moved(*divisor, time));
            }
            Step::Sharp => self.at = At::Sample { index: 0, row: 0 },
            Step::Rows(index, rows) => {
                self.spent += time.unwrap_or_default();
                time.into_iter().for_each(|time| self.pace.rested(rows.len() as u32, time));
                let is_first = *index == 0 && *rows == (0..height);
                if let Some(time) = time.filter(|_| is_first) {
                    self.pace.moved(1, time);
                }
                self.at = match rows.end < height {
                    true => At::Sample { index: *index, row: rows.end },
                    false if !shadowed || index + 1 >= self.until(index + 1) => At::End,
                    false => At::Sample { index: index + 1, row: 0 },
                };
            }
            Step::Enough => {}
        }
    }

    /// How many samples there will be where `so_far` are there.
    pub fn until(&self, so_far: u32) -> u32 {
        let one = self.spent / so_far.max(1);
        let in_time = PATIENCE.as_nanos() / one.as_nanos().max(1);
        in_time.clamp(LEAST.into(), MOST.into()) as u32
    }

    /// The coarse picture is not to be sharpened.
    pub fn skip_sharp(&mut self) {
        self.at = At::Sample { index: 0, row: 0 };
    }

    /// Whether there is nothing more to draw.
    pub fn is_finished(&self) -> bool {
        self.at == At::End
    }

    /// Whether what is there is coarse.
    pub fn is_coarse(&self) -> bool {
        self.at == At::Coarse
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEIGHT: u32 = 720;

    /// The steps of a picture at rest, where each row of a sample takes this long; panics past a thousand.
    fn steps(resting: &mut Resting, shadowed: bool, row: Duration) -> Vec<Step> {
        let mut steps = Vec::new();
        while !resting.is_finished() {
            let step = resting.step(HEIGHT, shadowed, true);
            let time = match &step {
                Step::Coarse(divisor) => row * HEIGHT / (divisor * divisor),
                Step::Sharp => row * HEIGHT / 4,
                Step::Rows(_, rows) => row * rows.len() as u32,
                Step::Enough => panic!("enough, and not finished"),
            };
            resting.drawn(&step, (HEIGHT, shadowed), Some(time));
            steps.push(step);
            assert!(steps.len() < 10_000, "it never ends");
        }
        assert_eq!(resting.step(HEIGHT, shadowed, true), Step::Enough);
        steps
    }

    /// How many samples the steps are, whose rows are all there, in their order and once.
    fn samples(steps: &[Step]) -> u32 {
        let (mut index, mut row) = (0, 0);
        for step in steps {
            if let Step::Rows(of, rows) = step {
                assert_eq!((*of, rows.start), (index, row));
                assert!(rows.end > rows.start && rows.end <= HEIGHT);
                (index, row) = if rows.end == HEIGHT { (index + 1, 0) } else { (index, rows.end) };
            }
        }
        assert_eq!(row, 0);
        index
    }

    #[test]
    fn a_fast_device_draws_all_pixels_at_once() {
        let mut resting = Resting::new(false);
        for _ in 0..3 {
            let steps = steps(&mut resting, true, Duration::from_micros(2));
            assert_eq!(steps[0], Step::Rows(0, 0..HEIGHT));
            assert_eq!(samples(&steps), MOST);
            resting.moved();
        }
    }

    #[test]
    fn a_slow_one_follows_what_moves_and_is_sharp_before_its_shadows_are() {
        let mut resting = Resting::new(true);
        for _ in 0..3 {
            let steps = steps(&mut resting, true, Duration::from_millis(3));
            assert!(matches!(steps[0], Step::Coarse(4)), "{:?}", steps[0]);
            assert_eq!(steps[1], Step::Sharp);
            // Two seconds a sample: as many as it takes, whatever that takes, and in parts that leave room for what the user does.
            assert_eq!(samples(&steps), LEAST);
            assert!(steps.len() > 40, "{}", steps.len());
            resting.moved();
        }
    }

    #[test]
    fn without_shadows_there_is_one_sample() {
        for slow in [false, true] {
            let mut resting = Resting::new(slow);
            let steps = steps(&mut resting, false, Duration::from_micros(100));
            assert_eq!(steps.last(), Some(&Step::Rows(0, 0..HEIGHT)));
            assert_eq!(samples(&steps), 1);
        }
    }

    #[test]
    fn however_long_they_take_there_are_a_few_samples() {
        let mut resting = Resting::new(true);
        assert_eq!(samples(&steps(&mut resting, true, Duration::from_millis(100))), LEAST);
    }

    #[test]
    fn what_moves_begins_anew() {
        let mut resting = Resting::new(true);
        let first = resting.step(HEIGHT, true, true);
        resting.drawn(&first, (HEIGHT, true), None);
        assert!(resting.is_coarse() && !resting.is_finished());
        resting.moved();
        assert_eq!(resting.step(HEIGHT, true, true), first);
    }
}
