//! Which sample of the picture comes next: while things move, the first one over and over; at rest more and more, up to a
//! number, and then none.

use crate::renderer::UNFILTERED;

/// Samples of a picture at rest: as many as it takes to show them as they are.
pub const UNTIL: u32 = UNFILTERED;

/// The samples of the picture that is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Resting {
    /// The next one's index.
    next: u32,
}

/// What a frame draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// A picture's first sample, in fewer pixels: the next picture is on its way perhaps.
    Coarse,
    /// The sample of this index.
    Sample(u32),
    /// Nothing: there are enough.
    Enough,
}

impl Resting {
    /// What to draw where something `moved` since the last frame, or did not. Where a sample takes long, as it does with
    /// `slow` drivers, what moves is drawn coarsely.
    pub fn step(&mut self, moved: bool, slow: bool) -> Step {
        if moved {
            self.next = u32::from(!slow);
            return if slow { Step::Coarse } else { Step::Sample(0) };
        }
        if self.next == UNTIL {
            return Step::Enough;
        }
        self.next += 1;
        Step::Sample(self.next - 1)
    }

    /// Whether there is more to draw.
    pub fn is_at_rest(&self) -> bool {
        self.next == UNTIL
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_added_until_there_are_enough() {
        for slow in [false, true] {
            let mut resting = Resting::default();
            let first = resting.step(true, slow);
            assert_eq!(first, if slow { Step::Coarse } else { Step::Sample(0) });
            let mut expected = u32::from(!slow);
            while !resting.is_at_rest() {
                assert_eq!(resting.step(false, slow), Step::Sample(expected));
                expected += 1;
            }
            assert_eq!(expected, UNTIL);
            assert_eq!(resting.step(false, slow), Step::Enough);
            // A move begins anew.
            assert_eq!(resting.step(true, slow), first);
            assert!(!resting.is_at_rest());
        }
    }
}
