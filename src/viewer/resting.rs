//! What of a picture is drawn next: while things move, as few pixels as it takes to follow them, with the shadows of the picture before
//! where these will do; once they rest, all of its pixels, and then more and more samples, up to a number or for a while.

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
    /// So many times fewer pixels a side, with the shadows of an earlier picture.
    Remember(u32),
    /// These rows of the sample of this index.
    Rows(u32, Range<u32>),
    /// Nothing: it is finished.
    Enough,
}

/// What can be done for a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Can {
    /// It has shadows.
    pub shadow: bool,
    /// The shadows of an earlier picture will do.
    pub remember: bool,
}

/// How far the picture that is shown has come.
#[derive(Clone, Debug, Default)]
pub struct Resting {
    /// Of samples,
    pace: Pace,
    /// and of pictures with the shadows of earlier ones.
    remembering: Pace,
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
        Self { pace: Pace::new(slow), remembering: Pace::new(slow), ..Self::default() }
    }

    /// Something has moved: the picture begins anew.
    pub fn moved(&mut self) {
        (self.at, self.spent) = (At::Start, Duration::ZERO);
    }

    /// What to draw next of a picture of this height.
    pub fn step(&self, height: u32, can: &Can) -> Step {
        let is_coarse = self.pace.divisor() > 1;
        match self.at {
            At::Start if is_coarse && can.remember => Step::Remember(self.remembering.divisor()),
            At::Start if is_coarse => Step::Coarse(self.pace.divisor()),
            At::Coarse if can.remember => Step::Remember(1),
            At::Start | At::Coarse if can.shadow => Step::Rows(0, self.pace.rows(0, height)),
            At::Start | At::Coarse => Step::Rows(0, 0..height),
            At::Sample { index, row } if can.shadow => Step::Rows(index, self.pace.rows(row, height)),
            At::Sample { .. } | At::End => Step::Enough,
        }
    }

    /// A step has been drawn, in this time; none where that says nothing of others, because something was made for it first.
    pub fn drawn(&mut self, step: &Step, (height, can): (u32, &Can), time: Option<Duration>) {
        match step {
            Step::Coarse(divisor) => {
                self.at = At::Coarse;
                time.into_iter().for_each(|time| self.pace.moved(*divisor, time));
            }
            Step::Remember(divisor) => {
                self.at = if *divisor == 1 { At::Sample { index: 0, row: 0 } } else { At::Coarse };
                time.into_iter().for_each(|time| self.remembering.moved(*divisor, time));
            }
            Step::Rows(index, rows) => {
                self.spent += time.unwrap_or_default();
                time.into_iter().for_each(|time| self.pace.rested(rows.len() as u32, time));
                let is_first = *index == 0 && *rows == (0..height);
                if let Some(time) = time.filter(|_| is_first) {
                    self.pace.moved(1, time);
                }
                self.at = match rows.end < height {
                    true => At::Sample { index: *index, row: rows.end },
                    false if !can.shadow || index + 1 >= self.until(index + 1) => At::End,
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

    const SHADOWED: Can = Can { shadow: true, remember: false };
    const REMEMBERED: Can = Can { remember: true, ..SHADOWED };
    const PLAIN: Can = Can { shadow: false, ..SHADOWED };

    /// The steps of a picture at rest, where each row of a sample takes this long, and a tenth of it without rays.
    fn steps(resting: &mut Resting, can: &Can, row: Duration) -> Vec<Step> {
        let mut steps = Vec::new();
        while !resting.is_finished() {
            let step = resting.step(HEIGHT, can);
            let time = match &step {
                Step::Coarse(divisor) => row * HEIGHT / (divisor * divisor),
                Step::Remember(divisor) => row * HEIGHT / (divisor * divisor) / 10,
                Step::Rows(_, rows) => row * rows.len() as u32,
                Step::Enough => panic!("enough, and not finished"),
            };
            resting.drawn(&step, (HEIGHT, can), Some(time));
            steps.push(step);
            assert!(steps.len() < 10_000, "it never ends");
        }
        assert_eq!(resting.step(HEIGHT, can), Step::Enough);
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
        for can in [SHADOWED, REMEMBERED] {
            let mut resting = Resting::new(false);
            for _ in 0..3 {
                let steps = steps(&mut resting, &can, Duration::from_micros(2));
                assert_eq!(steps[0], Step::Rows(0, 0..HEIGHT));
                assert_eq!(samples(&steps), MOST);
                resting.moved();
            }
        }
    }

    #[test]
    fn a_slow_one_follows_what_moves_and_is_sharp_before_its_shadows_are() {
        for can in [SHADOWED, REMEMBERED] {
            let mut resting = Resting::new(true);
            for _ in 0..3 {
                // Two seconds a sample: as many as it takes, whatever that takes, and in parts that leave room for what the user does.
                let steps = steps(&mut resting, &can, Duration::from_millis(3));
                let first = if can.remember { Step::Remember(4) } else { Step::Coarse(4) };
                assert_eq!(steps[0], first);
                assert_eq!(steps[1] == Step::Remember(1), can.remember);
                assert_eq!(samples(&steps), LEAST);
                assert!(steps.len() > 40, "{}", steps.len());
                resting.moved();
            }
        }
    }

    #[test]
    fn where_no_rays_are_traced_there_are_more_pixels() {
        let mut resting = Resting::new(true);
        let divisors: Vec<u32> = std::iter::repeat_with(|| {
            resting.moved();
            let first = resting.step(HEIGHT, &REMEMBERED);
            let Step::Remember(divisor) = first else { panic!("{first:?}") };
            // 160 ms for all pixels.
            resting.drawn(&first, (HEIGHT, &REMEMBERED), Some(Duration::from_millis(160) / (divisor * divisor)));
            divisor
        })
        .take(5)
        .collect();
        assert_eq!(divisors, [4, 3, 3, 3, 3]);
    }

    #[test]
    fn without_shadows_there_is_one_sample() {
        for slow in [false, true] {
            let mut resting = Resting::new(slow);
            let steps = steps(&mut resting, &PLAIN, Duration::from_micros(100));
            assert_eq!(steps.last(), Some(&Step::Rows(0, 0..HEIGHT)));
            assert_eq!((samples(&steps), steps.len()), (1, if slow { 2 } else { 1 }));
        }
    }

    #[test]
    fn however_long_they_take_there_are_a_few_samples() {
        let mut resting = Resting::new(true);
        assert_eq!(samples(&steps(&mut resting, &SHADOWED, Duration::from_millis(100))), LEAST);
    }

    #[test]
    fn what_moves_begins_anew() {
        let mut resting = Resting::new(true);
        let first = resting.step(HEIGHT, &SHADOWED);
        resting.drawn(&first, (HEIGHT, &SHADOWED), None);
        assert!(resting.is_coarse() && !resting.is_finished());
        resting.moved();
        assert_eq!(resting.step(HEIGHT, &SHADOWED), first);
    }
}
