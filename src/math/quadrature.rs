//! Gauss-Legendre quadrature.

use std::f64::consts::PI;

/// Nodes and weights of Gauss-Legendre quadrature with `n` >= 1 nodes over \[`from`, `to`\], nodes ascending.
///
/// Exact for polynomials of degree 2n - 1, to 1e-14 of the interval for n up to 100. Newton's iteration on the Legendre
/// polynomial `P_n`, from the classical guess cos(pi (k - 1/4) / (n + 1/2)) for its k-th root.
pub fn gauss_legendre(n: usize, from: f64, to: f64) -> Vec<(f64, f64)> {
    assert!(n >= 1, "a quadrature has nodes: {n}");
    let (center, half_width) = ((from + to) / 2.0, (to - from) / 2.0);
    let node = |k: usize| {
        let mut x = -(PI * (k as f64 + 0.75) / (n as f64 + 0.5)).cos();
        for _ in 0..NEWTON_STEPS {
            let (value, slope) = legendre(n, x);
            x -= value / slope;
        }
        let (_, slope) = legendre(n, x);
        let weight = 2.0 / ((1.0 - x * x) * slope * slope);
        (center + half_width * x, half_width * weight)
    };
    (0..n).map(node).collect()
}

/// The guess is good to a few percent of the nodes' spacing, so that four quadratic steps reach round-off; one more is
/// to spare.
const NEWTON_STEPS: usize = 5;

/// `P_n(x)` and its derivative, |x| < 1, by the three-term recurrence.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
    }
    let slope = n as f64 * (before - x * value) / (1.0 - x * x);
    (value, slope)
}

#[cfg(test)]
mod tests {
    use super::gauss_legendre;

    #[test]
    fn integrates_polynomials_up_to_its_degree_and_no_further() {
        for n in [1, 2, 3, 8, 24] {
            let degree = 2 * n as i32 - 1;
            let moment = |power: i32| gauss_legendre(n, 0.0, 1.0).iter().map(|(x, w)| w * x.powi(power)).sum::<f64>();
            let exact = |power: i32| 1.0 / f64::from(power + 1);
            // Round-off of a sum of n terms below 1.
            assert!((moment(degree) - exact(degree)).abs() < 1e-14, "{n} nodes, degree {degree}");
            if n <= 8 {
                // The next degree misses by (n!)^4 / ((2n+1) ((2n)!)^2), above 1e-11 up to 8 nodes.
                assert!((moment(degree + 1) - exact(degree + 1)).abs() > 1e-11, "{n} nodes, degree {}", degree + 1);
            }
        }
    }
}
