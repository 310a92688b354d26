//! What nodes hold, so that what is interpolated linearly between them is nearest to values at points.

use nalgebra::DMatrix;

/// From values at points `at` in \[0, 1\] to those at `nodes` nodes whose linear interpolation is nearest to them, by least squares.
///
/// Each node has points nearby: `at` holds the middles of parts of the cells, say.
pub fn nearest(at: &[f64], nodes: usize) -> DMatrix<f64> {
    let interpolation = DMatrix::from_fn(at.len(), nodes, |point, node| {
        (1.0 - (at[point] * (nodes - 1) as f64 - node as f64).abs()).max(0.0)
    });
    let normal = interpolation.tr_mul(&interpolation);
    let factor = normal.cholesky().expect("each node has points on either side: the hats are independent");
    factor.solve(&interpolation.transpose())
}
