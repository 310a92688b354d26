//! Statistics of what is off.

/// Albedo R below which a lobe is left out of errors: nobody sees it.
pub const DIM: f64 = 1e-3;

/// Statistics of relative errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// The arithmetic mean.
    pub mean: f64,
    /// The middle one, the upper of two.
    pub median: f64,
    /// The largest.
    pub max: f64,
}

impl Errors {
    /// Statistics of one or more errors; panics where there is none.
    pub fn new(mut errors: Vec<f64>) -> Self {
        assert!(!errors.is_empty(), "errors of nothing have no mean");
        errors.sort_by(f64::total_cmp);
        let mean = errors.iter().sum::<f64>() / errors.len() as f64;
        Self { mean, median: errors[errors.len() / 2], max: errors[errors.len() - 1] }
    }
}
