//! The values at nodes whose linear interpolation is nearest to given values at points.

use nalgebra::DMatrix;

/// The matrix that takes values at the points `at` in \[0, 1\] to the values at `nodes` equally spaced nodes whose
/// linear interpolation is nearest to them, by least squares.
///
/// Panics unless each node has points nearby, as it has where `at` are the centres of equal parts of the cells.
pub fn nearest(at: &[f64], nodes: usize) -> DMatrix<f64> {
    let interpolation = DMatrix::from_fn(at.len(), nodes, |point, node| {
        (1.0 - (at[point] * (nodes - 1) as f64 - node as f64).abs()).max(0.0)
    });
    let normal = interpolation.tr_mul(&interpolation);
    let factor = normal.cholesky().expect("each node has points on either side: the hats are independent");
    factor.solve(&interpolation.transpose())
}
