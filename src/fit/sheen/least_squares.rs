//! The matrix whose transformed cosine is nearest to a lobe.

use crate::fit::hemisphere::Hemisphere;
use crate::table::Ltc;
use glam::DVec3;

/// Least `a` that a fit gives.
pub const LEAST_A: f64 = 1e-3;

/// Steps after which a fit that still moves is stopped; a handful is usual.
const MOST_STEPS: usize = 100;

/// Which of the two parameters may move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Free {
    /// a and b.
    Both,
    /// a alone, with b = 0: the lobe of `wi` along the normal is round.
    OnlyA,
}

/// The matrix that minimises the integral over the hemisphere of (shape - density)^2, by Levenberg and Marquardt's
/// method over ln(a) and b <= 0, from `start`.
///
/// `shape` is a lobe divided by its albedo, at the nodes.
pub fn fit(shape: &[f64], hemisphere: &Hemisphere, start: Ltc, free: Free) -> Ltc {
    let mut best = start;
    let mut error = squared_error(shape, hemisphere, best);
    let mut damping = 1e-3;
    for _ in 0..MOST_STEPS {
        let step = Normal::new(shape, hemisphere, best, free).step(damping);
        let a = (best.a.ln() + step[0]).exp().max(LEAST_A);
        let next = Ltc::sheen(a, (best.b + step[1]).min(0.0));
        let next_error = squared_error(shape, hemisphere, next);
        let moved = (next.a / best.a).ln().abs() + (next.b - best.b).abs();
        if next_error < error {
            (best, error) = (next, next_error);
            damping = f64::max(damping / 10.0, 1e-9);
            if moved < 1e-9 {
                break;
            }
        } else if damping > 1e9 {
            break;
        } else {
            damping *= 10.0;
        }
    }
    best
}

/// The integral over the hemisphere of (shape - density)^2.
pub fn squared_error(shape: &[f64], hemisphere: &Hemisphere, ltc: Ltc) -> f64 {
    let terms = shape.iter().zip(&hemisphere.nodes).zip(&hemisphere.weights);
    terms.map(|((value, &wo), weight)| weight * (value - ltc.density(wo)).powi(2)).sum()
}

/// The density of the sheen's transformed cosine (c = a) at the unit vector `wo`, and its derivatives by ln(a) and by b.
pub fn density_and_slopes(ltc: Ltc, wo: DVec3) -> (f64, [f64; 2]) {
    let density = ltc.density(wo);
    let Ltc { a, b, .. } = ltc;
    let (x, y, z) = (a * wo.x + b * wo.z, a * wo.y, wo.z);
    let square = x * x + y * y + z * z;
    // The derivatives of ln(square) by ln(a) and by b.
    let by_ln_a = 2.0 * a * (x * wo.x + y * wo.y) / square;
    let by_b = 2.0 * x * wo.z / square;
    (density, [density * (2.0 - 2.0 * by_ln_a), density * -2.0 * by_b])
}

/// The normal equations of the linearised problem in (ln a, b).
struct Normal {
    /// Upper triangle: aa, ab, bb.
    matrix: [f64; 3],
    right: [f64; 2],
}

impl Normal {
    fn new(shape: &[f64], hemisphere: &Hemisphere, ltc: Ltc, free: Free) -> Self {
        let (mut matrix, mut right) = ([0.0; 3], [0.0; 2]);
        for ((value, &wo), weight) in shape.iter().zip(&hemisphere.nodes).zip(&hemisphere.weights) {
            let (density, [by_a, by_b]) = density_and_slopes(ltc, wo);
            let residual = value - density;
            matrix[0] += weight * by_a * by_a;
            matrix[1] += weight * by_a * by_b;
            matrix[2] += weight * by_b * by_b;
            right[0] += weight * by_a * residual;
            right[1] += weight * by_b * residual;
        }
        // At the bound b = 0, with the slope towards b > 0, b stays.
        if free == Free::OnlyA || (ltc.b == 0.0 && right[1] > 0.0) {
            (matrix[1], right[1]) = (0.0, 0.0);
        }
        Self { matrix, right }
    }

    /// The step towards the minimum, shorter and more downhill the larger `damping`.
    fn step(&self, damping: f64) -> [f64; 2] {
        let [aa, ab, bb] = self.matrix;
        let (aa, bb) = (aa * (1.0 + damping), bb * (1.0 + damping));
        let determinant = aa * bb - ab * ab;
        let [ra, rb] = self.right;
        [(bb * ra - ab * rb) / determinant, (aa * rb - ab * ra) / determinant]
    }
}
