//! A layer from thin ones.
//!
//! Let a layer reflect and transmit by the matrices R and T, whose entry (i, j) is the share of the light that comes in at node i and
//! goes out at node j; it looks the same from below. Light that meets a second such layer behind the first goes to and fro between
//! them, and the sum over all its ways is that of a geometric series (van de Hulst 1980, section 4.3):
//!
//! ```text
//! T' = T (1 - R R)^-1 T,        R' = R + T R (1 - R R)^-1 T.
//! ```
//!
//! Every term is positive where R and T are: nothing cancels, and small entries keep their digits.
//!
//! A thin layer grows by a slice dz, in which a share `loss` dz of the light at a node leaves it and `gain` dz is thrown back. From
//! R' = gain - loss R - R loss + R gain R and T' = (R gain - loss) T follow the terms of their series in the thickness.

use nalgebra::DMatrix;

/// Largest share that a node loses in the layer that the series starts: its fifth power over 120 is what they leave out.
const THIN: f64 = 0.15;

/// Terms of (1 - R R)^-1 below this share of the first are left out.
const LEAST: f64 = 1e-15;

/// How a layer of thickness 1 reflects and transmits, from its rates: `loss` of light onwards (the diagonal: what leaves a node per unit
/// length; elsewhere minus what it passes on to the others), `gain` of light going back.
pub struct Layer {
    pub reflected: DMatrix<f64>,
    /// With what passes unscattered, on the diagonal.
    pub transmitted: DMatrix<f64>,
}

impl Layer {
    pub fn new(loss: &DMatrix<f64>, gain: &DMatrix<f64>) -> Self {
        let largest = loss.diagonal().max();
        let doublings = (largest / THIN).log2().ceil().max(0.0) as i32;
        let mut layer = Self::thin(loss, gain, 0.5_f64.powi(doublings));
        let n = loss.nrows();
        let (mut one, mut two) = (DMatrix::zeros(n, n), DMatrix::zeros(n, n));
        for _ in 0..doublings {
            layer.double(&mut one, &mut two);
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
        let mut transmitted = (t4 * h + t3) * h + t2;
        transmitted = (transmitted * h - loss) * h;
        for i in 0..loss.nrows() {
            transmitted[(i, i)] += 1.0;
        }
        Self { reflected: (((r4 * h + r3) * h + r2) * h + gain) * h, transmitted }
    }

    /// Puts the layer on another one like it. `one` and `two` are room to work in.
    fn double(&mut self, one: &mut DMatrix<f64>, two: &mut DMatrix<f64>) {
        let Self { reflected, transmitted } = self;
        // The series of R R by squaring: X = (1 + D)(1 + D^2)(1 + D^4)... T.
        let mut power = DMatrix::zeros(reflected.nrows(), reflected.ncols());
        reflected.mul_to(reflected, &mut power);
        let mut inner = transmitted.clone();
        loop {
            one.copy_from(&inner);
            inner.gemm(1.0, &power, one, 1.0);
            let norm = row_norm(&power);
            if norm * norm < LEAST {
                break;
            }
            power.mul_to(&power, two);
            std::mem::swap(&mut power, two);
        }
        reflected.mul_to(&inner, one);
        reflected.gemm(1.0, transmitted, one, 1.0);
        transmitted.mul_to(&inner, one);
        std::mem::swap(transmitted, one);
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
