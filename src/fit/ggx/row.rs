//! A row of the specular base's table: the nodes of one mu.

use crate::math::{simplex, sine};
use crate::physics::microfacet::{Ggx, Node};
use crate::table::{Ltc, node};

/// Numbers of nodes of the quadrature, enough that no sharp density hides between them.
pub const QUADRATURE: [usize; 2] = [40, 40];

/// Sides of the first and the last simplex, in logarithms of the lobe's width and height.
const STEP: f64 = 0.1;
const TOLERANCE: f64 = 1e-7;

/// The fit of one node.
#[derive(Clone, Copy, Debug)]
pub struct Fit {
    /// The inverse matrix that was found.
    pub ltc: Ltc,
    /// R.
    pub albedo: f64,
    /// L1 distance between the lobe over its albedo and the density, in \[0, 2\].
    pub distance: f64,
}

/// The fits for one `mu` > 0, at the nodes of roughness, ascending.
pub(super) fn row(resolution: usize, mu: f64) -> Vec<Fit> {
    let mut row: Vec<Fit> = Vec::with_capacity(resolution);
    let mut above: Option<(Ggx, Ltc)> = None;
    for i in (0..resolution).rev() {
        let ggx = Ggx::from_roughness(node(i, resolution));
        // The one before, made sharper by as much as the surface is smoother; at first a round one.
        let start = above.map_or(Ltc::COSINE, |(rougher, Ltc { a, b, c })| {
            let sharper = rougher.alpha() / ggx.alpha();
            Ltc { a: a * sharper, b: b * sharper, c: c * sharper }
        });
        let found = fit(ggx, mu, [start, mirror(ggx, mu)]);
        above = Some((ggx, found.ltc));
        row.push(found);
    }
    row.reverse();
    row
}

/// A sharp lobe's matrix: it points in the mirrored direction, and is twice as wide as the facets' slopes are.
fn mirror(ggx: Ggx, mu: f64) -> Ltc {
    let c = 0.5 / ggx.alpha();
    Ltc { a: c * mu * mu, b: c * mu * sine(mu), c }
}

/// The matrix of the density nearest to the lobe for `wi` of cosine `mu` in (0, 1\], the best of the minima reached from `starts`.
///
/// At mu = 1 the lobe is round: a = c, b = 0.
pub fn fit(ggx: Ggx, mu: f64, starts: [Ltc; 2]) -> Fit {
    let nodes = ggx.quadrature(mu, QUADRATURE);
    let albedo = albedo(&nodes);
    let search = |start: Ltc| {
        let value = |ltc| distance(&nodes, albedo, ltc);
        if mu == 1.0 {
            let at = |[x]: [f64; 1]| Ltc { a: start.c * x.exp(), b: 0.0, c: start.c * x.exp() };
            let (x, distance) = simplex::minimum(|x| value(at(x)), [0.0], STEP, TOLERANCE);
            return Fit { ltc: at(x), albedo, distance };
        }
        // b / a is the tangent of the lobe's direction; it moves in units of the lobe's length, 1 / a.
        let at = |[length, turn, width]: [f64; 3]| {
            let a = start.a * length.exp();
            Ltc { a, b: a * (start.b + turn) / start.a, c: start.c * width.exp() }
        };
        let (x, distance) = simplex::minimum(|x| value(at(x)), [0.0; 3], STEP, TOLERANCE);
        Fit { ltc: at(x), albedo, distance }
    };
    let [one, other] = starts.map(search);
    if other.distance < one.distance { other } else { one }
}

/// R, integrated on a quadrature.
pub fn albedo(nodes: &[Node]) -> f64 {
    nodes.iter().map(|node| node.weight * node.lobe).sum()
}

/// The integral over the hemisphere of |lobe / albedo - density|.
pub fn distance(nodes: &[Node], albedo: f64, ltc: Ltc) -> f64 {
    nodes.iter().map(|node| node.weight * (node.lobe / albedo - ltc.density(node.wo)).abs()).sum()
}
