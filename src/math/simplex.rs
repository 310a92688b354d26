//! Minima of functions that have no slopes to follow.

/// Steps after which a search that still moves is stopped; 100 to 300 are usual.
const MOST_STEPS: usize = 2000;

/// A minimum of `value` near `start`, and the value there: the simplex method of Nelder and Mead (1965).
///
/// The first simplex has the sides `step`; the last one is smaller than `tolerance` in every coordinate.
pub fn minimum<const N: usize>(
    value: impl Fn([f64; N]) -> f64,
    start: [f64; N],
    step: f64,
    tolerance: f64,
) -> ([f64; N], f64) {
    let corner = |point: [f64; N]| (point, value(point));
    let mut simplex = vec![corner(start)];
    simplex.extend((0..N).map(|k| corner(std::array::from_fn(|l| start[l] + if k == l { step } else { 0.0 }))));
    for _ in 0..MOST_STEPS {
        simplex.sort_by(|one, other| one.1.total_cmp(&other.1));
        let (best, worst) = (simplex[0], simplex[N]);
        let spread = |k: usize| simplex.iter().map(|(point, _)| (point[k] - best.0[k]).abs()).fold(0.0, f64::max);
        if (0..N).all(|k| spread(k) < tolerance) {
            break;
        }
        let center: [f64; N] =
            std::array::from_fn(|k| simplex[..N].iter().map(|(point, _)| point[k]).sum::<f64>() / N as f64);
        // On the line from the worst corner through the middle of the others; that middle is at t = 0.
        let along = |t: f64| corner(std::array::from_fn(|k| center[k] + t * (center[k] - worst.0[k])));
        let reflected = along(1.0);
        let next = if reflected.1 < best.1 {
            let further = along(2.0);
            if further.1 < reflected.1 { further } else { reflected }
        } else if reflected.1 < simplex[N - 1].1 {
            reflected
        } else {
            along(if reflected.1 < worst.1 { 0.5 } else { -0.5 })
        };
        if next.1 < worst.1 {
            simplex[N] = next;
        } else {
            for (point, _) in &mut simplex[1..] {
                *point = std::array::from_fn(|k| 0.5 * (point[k] + best.0[k]));
            }
            simplex[1..].iter_mut().for_each(|at| *at = corner(at.0));
        }
    }
    simplex.sort_by(|one, other| one.1.total_cmp(&other.1));
    simplex[0]
}

#[cfg(test)]
mod tests {
    use super::minimum;

    #[test]
    fn the_bottom_of_a_bent_valley_is_found() {
        let rosenbrock = |[x, y]: [f64; 2]| (1.0 - x).powi(2) + 100.0 * (y - x * x).powi(2);
        let ([x, y], value) = minimum(rosenbrock, [-1.2, 1.0], 0.3, 1e-8);
        assert!((x - 1.0).abs() < 1e-7 && (y - 1.0).abs() < 1e-7 && value < 1e-14, "({x}, {y}): {value}");
    }

    #[test]
    fn kinks_are_no_hindrance() {
        let ([x], _) = minimum(|[x]: [f64; 1]| (x - 0.3).abs() + 0.5 * (x - 2.0).abs(), [5.0], 1.0, 1e-9);
        assert!((x - 0.3).abs() < 1e-8, "{x}");
    }
}
