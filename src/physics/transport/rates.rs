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

/// A panel is near, so that the kernel is not smooth on it, where its distance is less than this many of its widths.
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
    let (n, integrals) = (mesh.len(), Integrals { medium, mesh, modes, rule: gauss_legendre(SUB_NODES, -1.0, 1.0) });
    let zero = || DMatrix::zeros(n, n);
    let mut rates: Vec<Rates> = (0..modes).map(|_| Rates { onwards: zero(), back: zero() }).collect();
    for i in 0..n {
        for panel in 0..mesh.panels() {
            // Mirroring the node instead of the panel is the same.
            let [onwards, back] = [1.0, -1.0].map(|side| integrals.of(side * mesh.angles[i], panel));
            for (mode, rates) in rates.iter_mut().enumerate() {
                for k in 0..PER_PANEL {
                    let at = (i, panel * PER_PANEL + k);
                    rates.onwards[at] = onwards[mode][k];
                    rates.back[at] = back[mode][k];
                }
            }
        }
    }
    rates
}

/// For each mode, the integrals of the kernel from one node against the polynomials of a panel.
type Products = [[f64; PER_PANEL]; MOST_MODES];

struct Integrals<'a> {
    medium: &'a Sggx,
    mesh: &'a Mesh,
    modes: usize,
    rule: Vec<(f64, f64)>,
}

impl Integrals<'_> {
    fn of(&self, angle: f64, panel: usize) -> Products {
        let [low, high] = self.mesh.panel(panel);
        let distance = f64::max(low - angle, angle - high);
        if distance < NEAR * (high - low) { self.near(angle, panel) } else { self.far(angle, panel) }
    }

    /// The kernel's value at the panel's nodes.
    fn far(&self, angle: f64, panel: usize) -> Products {
        let mut products = [[0.0; PER_PANEL]; MOST_MODES];
        let (node, mut values) = (Elevation::from_angle(angle), [0.0; MOST_MODES]);
        for k in 0..PER_PANEL {
            let j = panel * PER_PANEL + k;
            self.medium.kernel_modes(node, self.mesh.nodes[j], &mut values[..self.modes]);
            let weight = 2.0 * PI * self.mesh.weights[j];
            products.iter_mut().zip(values).for_each(|(product, value)| product[k] = weight * value);
        }
        products
    }

    /// Integrals over intervals that narrow towards the node's angle, which lies in or beside the panel.
    fn near(&self, angle: f64, panel: usize) -> Products {
        let Self { medium, mesh, .. } = self;
        let mut products = [[0.0; PER_PANEL]; MOST_MODES];
        let (node, mut values) = (Elevation::from_angle(angle), [0.0; MOST_MODES]);
        let [low, high] = mesh.panel(panel);
        let scale = NARROWEST * medium.sigma() * node.s.max(medium.sigma());
        for ends in graded(low, high, angle, scale) {
            let [from, to] = ends.map(|end| mesh.coordinate(panel, end));
            for (x, weight) in &self.rule {
                let x = (from + to) / 2.0 + (to - from) / 2.0 * x;
                let (at, slope) = mesh.angle(panel, x);
                let elevation = Elevation::from_angle(at);
                medium.kernel_modes(node, elevation, &mut values[..self.modes]);
                let weight = PI * (to - from) * weight * slope * elevation.s;
                let lagrange = mesh.lagrange(x);
                for (product, value) in products.iter_mut().zip(&values[..self.modes]) {
                    product.iter_mut().zip(lagrange).for_each(|(sum, l)| *sum += weight * value * l);
                }
            }
        }
        products
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
