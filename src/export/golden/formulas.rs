//! The sheen's lobe without a table: the polynomials of `sheen_fit.wgsl` by their coefficients, as sums of powers.

use super::flat::flat;
use super::function::{Definition, Function, Row};
use super::lobes::{PLACES, SheenLobe, SheenPoint, sheen_lobe};
use super::mistake::Mistake;
use glam::DMat3;

/// The coefficient of alpha^i mu^j at \[i\]\[j\].
type Polynomial = [[f64; 4]; 4];

/// p and q: a = p^2 / q.
const A: [Polynomial; 2] = [
    [
        [0.0712243, 2.08384, 0.447737, 1.33883],
        [-1.44859, 5.11827, -1.43431, 0.0],
        [11.8824, -4.78599, 0.0, 0.0],
        [-2.86849, 0.0, 0.0, 0.0],
    ],
    [[1.0, 8.39524, 57.9343, 0.0], [-18.981, -20.0247, 0.0, 0.0], [97.6674, 0.0, 0.0, 0.0], [0.0; 4]],
];
/// b = -sqrt(1 - mu) (1 - alpha) p^2 / q.
const B: [Polynomial; 2] = [
    [[0.0141647, -0.262813, 4.68426, 0.0], [1.11618, -4.6743, 0.0, 0.0], [3.33543, 0.0, 0.0, 0.0], [0.0; 4]],
    [[1.0, 30.9435, 50.5242, 0.0], [-8.88411, -88.4877, 0.0, 0.0], [35.9859, 0.0, 0.0, 0.0], [0.0; 4]],
];
/// r = 1 / (1 + exp(p / q)).
const R: [Polynomial; 2] = [
    [
        [0.923733, 25.714, 952.057, -486.046],
        [-17.0376, -10.1195, -6.4266, 0.0],
        [1.24115, -287.551, 0.0, 0.0],
        [-25.5475, 0.0, 0.0, 0.0],
    ],
    [
        [1.0, -9.89936, 26.4968, -6.45657],
        [-8.05803, 367.165, -227.569, 0.0],
        [78.7201, 43.9768, 0.0, 0.0],
        [-37.6456, 0.0, 0.0, 0.0],
    ],
];

/// Error of a polynomial, over the sum of its terms' sizes: constants are rounded, and so are some eight sums and products.
const TERMS: f64 = 6e-7;
/// Error of a quotient, a root and a few products, over what comes out.
const QUOTIENT: f64 = 6e-7;
/// A unit in the last place, at most.
const UNIT: f64 = 1.2e-7;

flat!(Fitted { a: f64, b: f64, r: f64 });

const SHEEN_FIT: Definition<SheenPoint, SheenLobe> = Definition {
    name: "sheen_fit_lobe",
    output: "",
    answer: |point| lobe_of(fitted(point)),
    tolerance: |point, _| tolerance(point),
    reason: "6e-7 of the sizes of each polynomial's terms, which cancel next to alpha = 0.1 and mu = 0, and what that makes of a, b and r; 6e-7 of \
             these; and an exponential that is off by 3 + 2 |x| units in the last place, as WGSL allows.",
    mistaken: |point, mistake| match mistake {
        Mistake::TableTransposed => Some(lobe_of(fitted(&SheenPoint { alpha: point.mu, mu: point.alpha }))),
        Mistake::AlphaSquared => Some(lobe_of(fitted(&SheenPoint { alpha: point.alpha * point.alpha, ..*point }))),
        Mistake::BSign => {
            let Fitted { a, b, r } = fitted(point);
            Some(lobe_of(Fitted { a, b: -b, r }))
        }
        Mistake::MInvTransposed => {
            let lobe = lobe_of(fitted(point));
            Some(SheenLobe { m_inv: lobe.m_inv.transpose(), ..lobe })
        }
        _ => None,
    },
};

fn lobe_of(Fitted { a, b, r }: Fitted) -> SheenLobe {
    sheen_lobe([a, b, r])
}

/// The polynomial, and the sum of its terms' sizes.
fn value(polynomial: &Polynomial, alpha: f64, mu: f64) -> [f64; 2] {
    let terms = (0..16).map(|k| polynomial[k / 4][k % 4] * alpha.powi(k as i32 / 4) * mu.powi(k as i32 % 4));
    terms.fold([0.0; 2], |[sum, sizes], term| [sum + term, sizes + term.abs()])
}

fn fitted(point: &SheenPoint) -> Fitted {
    let [alpha, mu] = [point.alpha, point.mu].map(|number| number.clamp(0.0, 1.0));
    let of = |[p, q]: &[Polynomial; 2]| [p, q].map(|polynomial| value(polynomial, alpha, mu)[0]);
    let ([a_p, a_q], [b_p, b_q], [r_p, r_q]) = (of(&A), of(&B), of(&R));
    Fitted {
        a: a_p.powi(2) / a_q,
        b: -(1.0 - mu).sqrt() * (1.0 - alpha) * b_p.powi(2) / b_q,
        r: 1.0 / (1.0 + (r_p / r_q).exp()),
    }
}

fn tolerance(point: &SheenPoint) -> SheenLobe {
    let [alpha, mu] = [point.alpha, point.mu].map(|number| number.clamp(0.0, 1.0));
    // Shares by which p and q may be off.
    let off = |pair: &[Polynomial; 2]| {
        pair.each_ref().map(|polynomial| {
            let [sum, sizes] = value(polynomial, alpha, mu);
            TERMS * sizes / sum.abs()
        })
    };
    let Fitted { a, b, r } = fitted(point);
    let squared = |pair| {
        let [p, q] = off(pair);
        2.0 * p + q + QUOTIENT
    };
    let exponent = (1.0 / r - 1.0).ln().abs();
    let [p, q] = off(&R);
    let power = exponent * (p + q + QUOTIENT) + (3.0 + 2.0 * exponent) * UNIT;
    let mut m_inv = DMat3::from_cols_array(&[UNIT; 9]);
    let a = a * squared(&A) + UNIT;
    [m_inv.x_axis.x, m_inv.y_axis.y, m_inv.z_axis.x] = [a, a, b.abs() * squared(&B) + UNIT];
    SheenLobe { m_inv, albedo: r * (1.0 - r) * power + 2.0 * UNIT }
}

pub(super) fn sheen_fits(index: usize) -> (Function, Vec<Row>) {
    let named = |case: &'static str| match case {
        "a node" | "a node in the last cells" | "in the middle of a cell" => "a place of the table",
        other => other,
    };
    SHEEN_FIT.rows(index, PLACES.map(|(case, [alpha, mu])| (named(case), SheenPoint { alpha, mu })))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::SheenTable;

    /// The errors that the shader states for alpha >= 3/31, at the table's nodes.
    #[test]
    fn formulas_are_as_near_to_the_table_as_the_shader_says() {
        let table = SheenTable::embedded();
        for k in 3 * 32..32 * 32 {
            let [alpha, mu] = [k / 32, k % 32].map(|k| k as f64 / 31.0);
            let (Fitted { a, b, r }, [table_a, table_b, table_r]) =
                (fitted(&SheenPoint { alpha, mu }), table.lookup(alpha, mu));
            assert!((a - table_a).abs() < 0.054 && (b - table_b).abs() < 0.016 && (r - table_r).abs() < 0.036, "{k}");
        }
    }
}
