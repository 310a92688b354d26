//! From the solution's matrices to functions of two cosines.

use super::mesh::Mesh;
use nalgebra::DMatrix;

/// Degree of the polynomials that stand for reflected light in the wide panels.
const SMOOTH_DEGREE: usize = 10;

/// The matrix that replaces values at the mesh's wide nodes by their best approximation by polynomials in the logarithm of the angle, in
/// the norm of d ln(angle); none where the wide panels are too few to need it.
pub fn projection(mesh: &Mesh) -> Option<DMatrix<f64>> {
    let wide = mesh.first_wide..mesh.len();
    if wide.len() < 2 * (SMOOTH_DEGREE + 1) {
        return None;
    }
    let logarithm = |k: usize| mesh.angles[k].ln();
    let (low, high) = (logarithm(wide.start), logarithm(wide.end - 1));
    let root: Vec<f64> = wide.clone().map(|k| (mesh.weights[k] / mesh.nodes[k].s / mesh.angles[k]).sqrt()).collect();
    let basis = DMatrix::from_fn(wide.len(), SMOOTH_DEGREE + 1, |row, degree| {
        let x = (2.0 * logarithm(wide.start + row) - low - high) / (high - low);
        // Chebyshev's polynomials: well conditioned.
        root[row] * (degree as f64 * x.clamp(-1.0, 1.0).acos()).cos()
    });
    let orthonormal = basis.qr().q();
    let mut projection = &orthonormal * orthonormal.transpose();
    for i in 0..wide.len() {
        for j in 0..wide.len() {
            projection[(i, j)] *= root[j] / root[i];
        }
    }
    Some(projection)
}

/// A symmetric function of two cosines at the nodes, from `values` (i, j) that are exact in i and averages in j, and the mesh's
/// [`projection`].
pub fn symmetric(projection: Option<&DMatrix<f64>>, mut values: DMatrix<f64>) -> DMatrix<f64> {
    if let Some(projection) = projection {
        let (wide, first) = (projection.nrows(), values.nrows() - projection.nrows());
        let mut block = values.view_mut((first, first), (wide, wide));
        let smooth = &block * projection.transpose();
        block.copy_from(&smooth);
    }
    values.fill_upper_triangle_with_lower_triangle();
    values
}
