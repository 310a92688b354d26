//! Scattering between the elevations of a mesh, as matrices.

use super::mesh::{Mesh, PER_PANEL};
use crate::math::quadrature::gauss_legendre;
use crate::physics::modes::Elevation;
use crate::physics::sggx::Sggx;
use nalgebra::DMatrix;
use std::f64::consts::PI;

/// Most azimuthal modes that are solved for.
pub const MOST_MODES: usize = 16;

/// Gauss nodes in each interval of a graded integral.
const SUB_NODES: usize = 6;

/// The narrowest intervals of a graded integral, in widths of the kernel.
const NARROWEST: f64 = 0.15;

/// How much wider the next interval is.
const SUB_GROWTH: f64 = 2.5;

/// A panel is near where the kernel is not smooth: closer than this many of its widths.
const NEAR: f64 = 1.0;

/// What one azimuthal mode scatters from node i into the Lagrange polynomial of node j: the integral of
/// 2 pi K_m(mu_i, mu') l_j(mu') d mu', per unit length.
pub struct Rates {
    /// Between elevations on the same side of the horizon.
    pub onwards: DMatrix<f64>,
    /// From one side to the other.
    pub back: DMatrix<f64>,
}

/// The rates of the first `modes` modes.
///
/// Where K is smooth over a panel the integral is K's value at the node times its weight. Near the node itself it is not: K has a cusp
/// where mu' = mu and may be a hundred times narrower than the panel. There the integral is taken exactly, over intervals that narrow
/// down geometrically to the node (product integration; Atkinson 1997, section 4.2).
pub fn rates(medium: &Sggx, mesh: &Mesh, modes: usize) -> Vec<Rates> {
    assert!((1..=MOST_MODES).contains(&modes), "modes are in [1, {MOST_MODES}]: {modes}");
    let n = mesh.len();
    let zero = || DMatrix::zeros(n, n);
    let mut rates: Vec<Rates> = (0..modes).map(|_| Rates { onwards: zero(), back: zero() }).collect();
    let sub_rule = gauss_legendre(SUB_NODES, -1.0, 1.0);
    let mut values = [0.0; MOST_MODES];
    let values = &mut values[..modes];
    for i in 0..n {
        for side in [1.0, -1.0] {
            // Mirroring the node instead of the panel is the same.
            let angle = side * mesh.angles[i];
            let node = Elevation::from_angle(angle);
            for panel in 0..mesh.panels() {
                let [low, high] = mesh.panel(panel);
                let distance = f64::max(low - angle, angle - high);
                let columns = panel * PER_PANEL..(panel + 1) * PER_PANEL;
                if distance < NEAR * (high - low) {
                    let mut products = [[0.0; PER_PANEL]; MOST_MODES];
                    let scale = NARROWEST * medium.sigma() * node.s.max(medium.sigma());
                    for ends in graded(low, high, angle, scale) {
                        let [from, to] = ends.map(|end| mesh.coordinate(panel, end));
                        for (x, weight) in &sub_rule {
                            let x = (from + to) / 2.0 + (to - from) / 2.0 * x;
                            let (at, slope) = mesh.angle(panel, x);
                            let elevation = Elevation::from_angle(at);
                            medium.kernel_modes(node, elevation, values);
                            let weight = PI * (to - from) * weight * slope * elevation.s;
                            let lagrange = mesh.lagrange(x);
                            for (product, value) in products.iter_mut().zip(&*values) {
                                for (sum, polynomial) in product.iter_mut().zip(lagrange) {
                                    *sum += weight * value * polynomial;
                                }
                            }
                        }
                    }
                    for (rates, product) in rates.iter_mut().zip(products) {
                        let matrix = rates.side(side);
                        columns.clone().zip(product).for_each(|(j, value)| matrix[(i, j)] = value);
                    }
                } else {
                    for j in columns {
                        medium.kernel_modes(node, mesh.nodes[j], values);
                        for (rates, value) in rates.iter_mut().zip(&*values) {
                            rates.side(side)[(i, j)] = 2.0 * PI * mesh.weights[j] * value;
                        }
                    }
                }
            }
        }
    }
    rates
}

impl Rates {
    fn side(&mut self, side: f64) -> &mut DMatrix<f64> {
        if side > 0.0 { &mut self.onwards } else { &mut self.back }
    }
}

/// Splits \[`low`, `high`\] at `center`, if that is inside, and at distances from it that grow geometrically from `scale`.
fn graded(low: f64, high: f64, center: f64, scale: f64) -> Vec<[f64; 2]> {
    let mut edges = vec![];
    let mut one_side = |sign: f64, end: f64| {
        let start = if sign > 0.0 { low.max(center) } else { high.min(center) };
        if sign * (end - start) <= 0.0 {
            return;
        }
        let (mut at, mut step) = (start, scale);
        while sign * (end - center) > step {
            let next = center + sign * step;
            if sign * (next - at) > 0.0 {
                edges.push([at.min(next), at.max(next)]);
                at = next;
            }
            step *= SUB_GROWTH;
        }
        edges.push([at.min(end), at.max(end)]);
    };
    one_side(1.0, high);
    one_side(-1.0, low);
    edges
}
