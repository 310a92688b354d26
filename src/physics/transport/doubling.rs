//! A layer from thin ones.
//!
//! Let a layer reflect and transmit by the matrices R and T, whose entry (i, j) is the share of the light coming in at
//! node i that goes out at node j; from below the layer is the same. Light that meets a second such layer behind the
//! first bounces between the two, and the sum over all its paths is a geometric series (van de Hulst 1980, section
//! 4.3):
//!
//! ```text
//! T' = T (1 - R R)^-1 T,        R' = R + T R (1 - R R)^-1 T.
//! ```
//!
//! Every term is positive where R and T are: nothing cancels, and small entries keep their digits.
//!
//! A thin layer grows by a slice dz, in which a share `loss` dz of the light at a node leaves it and `gain` dz is thrown back. From
//! the derivatives by thickness, R' = gain - loss R - R loss + R gain R and T' = (R gain - loss) T, follow the terms of
//! the power series of R and T.

use nalgebra::DMatrix;

/// Largest share that a node loses in the thin layer that the series is used for: its fifth power over 120 is what is
/// left out.
const THIN: f64 = 0.15;

/// Terms of (1 - R R)^-1 below this share of the first are left out.
const LEAST: f64 = 1e-15;

/// How a layer of thickness 1 reflects and transmits, from its rates: `loss` of light going onwards (on the diagonal
/// what leaves a node per unit length; elsewhere minus what it passes on to the others) and `gain` of light going back.
pub struct Layer {
    pub reflected: DMatrix<f64>,
    /// T - 1: what light loses on its way through, exact even for layers so thin that T itself would round it away.
    pub change: DMatrix<f64>,
}

impl Layer {
    pub fn new(loss: &DMatrix<f64>, gain: &DMatrix<f64>) -> Self {
        let largest = loss.diagonal().max();
        let doublings = (largest / THIN).log2().ceil().max(0.0) as i32;
        let mut layer = Self::thin(loss, gain, 0.5_f64.powi(doublings));
        let mut scratch = Scratch::new(loss.nrows());
        for _ in 0..doublings {
            layer.double(&mut scratch);
        }
        layer
    }

    /// The series up to the fourth power of the thickness.
    fn thin(loss: &DMatrix<f64>, gain: &DMatrix<f64>, thickness: f64) -> Self {
        let gain_2 = gain * gain;
        let r2 = (loss * gain + gain * loss) * -0.5;
        let r3 = (&gain_2 * gain - loss * &r2 - &r2 * loss) / 3.0;
        let r4 = (&gain_2 * &r2 + &r2 * &gain_2 - loss * &r3 - &r3 * loss) / 4.0;
        let t2 = (loss * loss + &gain_2) / 2.0;
        let t3 = (-(loss * &t2) - &gain_2 * loss + &r2 * gain) / 3.0;
        let t4 = (-(loss * &t3) + &gain_2 * &t2 - &r2 * gain * loss + &r3 * gain) / 4.0;
        let h = thickness;
        Self { reflected: (((r4 * h + r3) * h + r2) * h + gain) * h, change: (((t4 * h + t3) * h + t2) * h - loss) * h }
    }

    /// Puts the layer on another one like it. With T = 1 + t and (1 - R R)^-1 T = T + Z, the rules above read
    /// t' = 2 t + t t + T Z and R' = R + T R (T + Z).
    fn double(&mut self, scratch: &mut Scratch) {
        let Self { reflected, change } = self;
        let Scratch { through, inner, power, rest, spare } = scratch;
        through.copy_from(change);
        for i in 0..through.nrows() {
            through[(i, i)] += 1.0;
        }
        // Z by squaring: T + Z = ... (1 + D^4)(1 + D^2)(1 + D) T with D = R R.
        reflected.mul_to(reflected, power);
        rest.fill(0.0);
        inner.copy_from(through);
        loop {
            rest.gemm(1.0, power, inner, 1.0);
            through.add_to(rest, inner);
            let norm = row_norm(power);
            if norm * norm < LEAST {
                break;
            }
            power.mul_to(power, spare);
            std::mem::swap(power, spare);
        }
        reflected.mul_to(inner, spare);
        reflected.gemm(1.0, through, spare, 1.0);
        spare.copy_from(change);
        spare.gemm(1.0, change, change, 2.0);
        spare.gemm(1.0, through, rest, 1.0);
        std::mem::swap(change, spare);
    }
}

/// Matrices to work in.
struct Scratch {
    through: DMatrix<f64>,
    inner: DMatrix<f64>,
    power: DMatrix<f64>,
    rest: DMatrix<f64>,
    spare: DMatrix<f64>,
}

impl Scratch {
    fn new(n: usize) -> Self {
        let zero = || DMatrix::zeros(n, n);
        Self { through: zero(), inner: zero(), power: zero(), rest: zero(), spare: zero() }
    }
}

/// The largest sum of a row's magnitudes.
fn row_norm(matrix: &DMatrix<f64>) -> f64 {
    let mut sums = vec![0.0; matrix.nrows()];
    for column in matrix.column_iter() {
        sums.iter_mut().zip(column.iter()).for_each(|(sum, value)| *sum += value.abs());
    }
    sums.into_iter().fold(0.0, f64::max)
}
