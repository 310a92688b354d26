//! Cosine series.

/// The sum over m of (1 if m = 0, else 2) `modes[m]` cos(m phi), by Clenshaw's recurrence. `modes` holds one or more.
pub fn cosine_sum(modes: &[f64], cos_phi: f64) -> f64 {
    let (mut next, mut after) = (0.0, 0.0);
    for mode in modes[1..].iter().rev() {
        (next, after) = (2.0 * mode + 2.0 * cos_phi * next - after, next);
    }
    modes[0] + cos_phi * next - after
}
