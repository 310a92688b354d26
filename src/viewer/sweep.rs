//! Alpha on its way from 0 to 1 and back, over and over.

/// How long a way to and fro takes, in seconds.
const PERIOD: f64 = 6.0;

/// A sweep of one material's alpha.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sweep {
    pub material: usize,
    /// When alpha was 0, or would have been, in seconds.
    start: f64,
    /// What the sweep has set last. Where alpha is another, somebody else has taken hold of it.
    pub last: Option<f32>,
}

impl Sweep {
    /// Goes up from this alpha; `set` is what the material's own edits have for it.
    pub fn new(material: usize, alpha: f32, set: Option<f32>, now: f64) -> Self {
        Self { material, start: now - 0.5 * PERIOD * f64::from(alpha), last: set }
    }

    /// Alpha at a time in seconds: a triangle wave.
    pub fn alpha(&self, now: f64) -> f32 {
        let phase = ((now - self.start) / PERIOD).rem_euclid(1.0);
        (1.0 - (2.0 * phase - 1.0).abs()) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_goes_up_from_where_alpha_is_and_to_and_fro() {
        for alpha in [0.0, 0.3, 1.0] {
            let sweep = Sweep::new(0, alpha, None, 17.0);
            assert!((sweep.alpha(17.0) - alpha).abs() < 1e-6);
            for periods in [1.0, 7.0] {
                assert!((sweep.alpha(17.0 + periods * PERIOD) - alpha).abs() < 1e-5);
            }
        }
        let sweep = Sweep::new(0, 0.0, None, 0.0);
        for (share, alpha) in [(0.0, 0.0), (0.125, 0.25), (0.25, 0.5), (0.5, 1.0), (0.75, 0.5), (0.875, 0.25)] {
            assert!((sweep.alpha(share * PERIOD) - alpha).abs() < 1e-6, "{share}");
        }
    }
}
