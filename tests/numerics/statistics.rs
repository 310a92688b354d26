//! Rulers for samples, and tests in which they must fail.

use statrs::distribution::{ChiSquared, ContinuousCDF};

/// A correct sampler fails a test for one seed in ten thousand; the seeds are fixed.
pub const SIGNIFICANCE: f64 = 1e-4;

/// The probability below which a wrong density must fall, for a test to count as able to tell it.
pub const REJECTED: f64 = 1e-9;

/// Cells are pooled until this many counts are expected in each, so that the chi-square's tails are right.
const LEAST_EXPECTED: f64 = 10.0;

/// The probability that counts drawn from `probabilities` lie as far from them as `counts` do, by Pearson's chi-square.
///
/// The cells must cover everything: the probabilities sum to 1 up to `probabilities_error`.
pub fn chi_square(counts: &[u64], probabilities: &[f64], probabilities_error: f64) -> f64 {
    assert_eq!(counts.len(), probabilities.len());
    let whole: f64 = probabilities.iter().sum();
    assert!((whole - 1.0).abs() < probabilities_error, "probabilities sum to {whole}");
    let samples: u64 = counts.iter().sum();
    let mut cells: Vec<(f64, f64)> =
        counts.iter().zip(probabilities).map(|(&count, p)| (p / whole * samples as f64, count as f64)).collect();
    cells.sort_by(|one, other| one.0.total_cmp(&other.0));
    let (mut statistic, mut pools, mut pool) = (0.0, 0, (0.0, 0.0));
    let mut remaining = samples as f64;
    for (expected, count) in cells {
        pool = (pool.0 + expected, pool.1 + count);
        remaining -= expected;
        if pool.0 >= LEAST_EXPECTED && (remaining >= LEAST_EXPECTED || remaining < 1e-6 * samples as f64) {
            statistic += (pool.1 - pool.0).powi(2) / pool.0;
            (pools, pool) = (pools + 1, (0.0, 0.0));
        }
    }
    assert!(pools >= 2, "{samples} samples fill {pools} pools");
    ChiSquared::new(f64::from(pools - 1)).expect("freedom is positive").sf(statistic)
}

/// Fails where `measured` is more than `allowed` standard errors from `truth`.
pub fn assert_within(measured: f64, truth: f64, error: f64, allowed: f64, what: &str) {
    let off = (measured - truth) / error;
    assert!(off.abs() <= allowed, "{what}: {measured} is {off:.2} standard errors ({error:.1e}) from {truth}");
}

#[test]
fn chi_square_accepts_fair_dice_and_rejects_loaded_ones() {
    let throws = [1000, 980, 1030, 1010, 970, 1010];
    assert!(chi_square(&throws, &[1.0 / 6.0; 6], 1e-12) > 0.5);
    // With one side 10% heavier and another 10% lighter, p is 3e-3 after 6000 throws; 100 times as many leave no doubt.
    let loaded = throws.map(|count| count * 100);
    let bias = [1.1, 0.9, 1.0, 1.0, 1.0, 1.0].map(|weight| weight / 6.0);
    assert!(chi_square(&loaded, &bias, 1e-12) < REJECTED);
}

#[test]
#[should_panic(expected = "4.00 standard errors")]
fn a_mean_too_far_off_is_told() {
    assert_within(0.5, 0.46, 0.01, 3.0, "a mean");
}
