//! Elevations: panels of Gauss nodes that follow the slab's roughness, and interpolation on them.

use crate::math::quadrature::gauss_legendre;
use crate::physics::modes::Elevation;
use std::f64::consts::FRAC_PI_2;

/// Gauss nodes in a panel; functions are polynomials of degree one less in it.
pub const PER_PANEL: usize = 8;

/// Widest panel, in radians.
const WIDEST: f64 = 0.25;

/// How much wider the next panel is where panels grow.
const GROWTH: f64 = 2.0;

/// Panels grow from this many sigma^(2/3) above the horizon. Light at mu scatters 1 / mu times and is turned by sigma
/// each time, by sigma / sqrt(mu) in all, which is as much as its own elevation where sigma / sqrt(mu) = mu.
const GRAZING_REACH: f64 = 3.0;

/// How often the panel at the horizon is split towards it, in ratios of 4: functions behave as mu ln(mu) there.
const HORIZON_SPLITS: i32 = 2;

/// In the panel next to the horizon, functions are polynomials in this root of the angle, in which mu ln(mu) is
/// smoother.
const HORIZON_POWER: i32 = 3;

/// Gauss nodes and weights over \[-1, 1\], and the weights of the barycentric interpolation formula on them.
#[derive(Clone, Debug)]
struct Rule {
    points: [f64; PER_PANEL],
    weights: [f64; PER_PANEL],
    barycentric: [f64; PER_PANEL],
}

impl Rule {
    fn new() -> Self {
        let rule = gauss_legendre(PER_PANEL, -1.0, 1.0);
        let points: [f64; PER_PANEL] = std::array::from_fn(|j| rule[j].0);
        let others = |j: usize| points.iter().enumerate().filter(move |(i, _)| *i != j);
        let barycentric = std::array::from_fn(|j| others(j).map(|(_, x)| 1.0 / (points[j] - x)).product());
        Self { points, weights: std::array::from_fn(|j| rule[j].1), barycentric }
    }

    /// The values of the Lagrange polynomials of the points at `x` in \[-1, 1\] (Berrut and Trefethen 2004, eq. 4.2).
    fn lagrange(&self, x: f64) -> [f64; PER_PANEL] {
        if let Some(at) = self.points.iter().position(|point| *point == x) {
            return std::array::from_fn(|j| f64::from(j == at));
        }
        let terms: [f64; PER_PANEL] = std::array::from_fn(|j| self.barycentric[j] / (x - self.points[j]));
        let sum: f64 = terms.iter().sum();
        terms.map(|term| term / sum)
    }
}

/// Panels over the elevations \[0, pi/2\] above the horizon.
#[derive(Clone, Debug)]
pub struct Mesh {
    rule: Rule,
    /// Where panels meet, ascending from 0 to pi/2; one more than there are panels.
    edges: Vec<f64>,
    /// Angles of the nodes above the horizon, ascending, [`PER_PANEL`] a panel.
    pub angles: Vec<f64>,
    /// The same as elevations.
    pub nodes: Vec<Elevation>,
    /// Weights of the nodes for integrals over mu in \[0, 1\].
    pub weights: Vec<f64>,
    /// The first node above the region in which panels are narrow.
    pub first_wide: usize,
}

/// How to interpolate at one elevation: the nodes of a panel, from `first` on, and their weights.
pub struct Stencil {
    pub first: usize,
    pub weights: [f64; PER_PANEL],
}

impl Mesh {
    /// A mesh for fibres of cross-section `sigma`, `refinement` times as fine as usual; around the elevation `ridge`,
    /// if any, as fine as the kernel is wide there.
    pub fn new(sigma: f64, refinement: f64, ridge: Option<f64>) -> Self {
        let (mut edges, wide_from) = edges(sigma, refinement);
        if let Some(ridge) = ridge {
            edges = refined(&edges, ridge, 2.0 * sigma * ridge.cos().max(sigma) / refinement);
        }
        let rule = Rule::new();
        let mut mesh = Self { rule, edges, angles: vec![], nodes: vec![], weights: vec![], first_wide: 0 };
        for panel in 0..mesh.panels() {
            for (x, weight) in mesh.rule.points.into_iter().zip(mesh.rule.weights) {
                let (angle, slope) = mesh.angle(panel, x);
                let node = Elevation::from_angle(angle);
                mesh.angles.push(angle);
                mesh.nodes.push(node);
                mesh.weights.push(weight * slope * node.s);
            }
        }
        mesh.first_wide = mesh.angles.partition_point(|angle| *angle < wide_from);
        mesh
    }

    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    pub fn panels(&self) -> usize {
        self.edges.len() - 1
    }

    /// The angles between which a panel lies.
    pub fn panel(&self, panel: usize) -> [f64; 2] {
        [self.edges[panel], self.edges[panel + 1]]
    }

    /// The angle at the coordinate `x` in \[-1, 1\] of a panel, and its derivative by `x`.
    pub fn angle(&self, panel: usize, x: f64) -> (f64, f64) {
        let [low, high] = self.panel(panel);
        if panel > 0 {
            return ((low + high) / 2.0 + (high - low) / 2.0 * x, (high - low) / 2.0);
        }
        let share = (1.0 + x) / 2.0;
        (high * share.powi(HORIZON_POWER), high * f64::from(HORIZON_POWER) * share.powi(HORIZON_POWER - 1) / 2.0)
    }

    /// The coordinate in \[-1, 1\] of an angle in a panel.
    pub fn coordinate(&self, panel: usize, angle: f64) -> f64 {
        let [low, high] = self.panel(panel);
        let share = (angle - low) / (high - low);
        let share = if panel > 0 { share } else { share.max(0.0).powf(1.0 / f64::from(HORIZON_POWER)) };
        (2.0 * share - 1.0).clamp(-1.0, 1.0)
    }

    /// The panel's Lagrange polynomials at a coordinate.
    pub fn lagrange(&self, x: f64) -> [f64; PER_PANEL] {
        self.rule.lagrange(x)
    }

    /// How to interpolate a function of the elevation at the cosine `mu` in \[0, 1\].
    pub fn stencil(&self, mu: f64) -> Stencil {
        let angle = mu.asin();
        let panel = self.edges.partition_point(|edge| *edge <= angle).clamp(1, self.panels()) - 1;
        Stencil { first: panel * PER_PANEL, weights: self.lagrange(self.coordinate(panel, angle)) }
    }
}

impl Stencil {
    /// The interpolated value of a function of the node's index.
    pub fn interpolate(&self, value: impl Fn(usize) -> f64) -> f64 {
        self.weights.iter().enumerate().map(|(j, weight)| weight * value(self.first + j)).sum()
    }
}

/// Where panels meet, and the angle from which on they grow.
fn edges(sigma: f64, refinement: f64) -> (Vec<f64>, f64) {
    // With this spacing of the nodes the kernel, which is about sigma wide, is resolved near the horizon.
    let narrow = PER_PANEL as f64 * sigma / 2.0;
    let widest = WIDEST / refinement;
    let mut width = f64::min(narrow / refinement, widest);
    let mut edges = vec![0.0];
    edges.extend((0..=HORIZON_SPLITS).rev().map(|split| width * 0.25_f64.powi(split)));
    // Near the normal the extinction changes where s is about sigma: panels narrow down to that.
    let mut top = vec![FRAC_PI_2];
    let mut from_top = sigma;
    while from_top < WIDEST {
        top.push(FRAC_PI_2 - from_top);
        from_top *= GROWTH * GROWTH;
    }
    let grow_from = GRAZING_REACH * sigma.powf(2.0 / 3.0);
    let mut wide_from = FRAC_PI_2;
    let end = top[top.len() - 1];
    let mut at = edges[edges.len() - 1];
    assert!(at < end, "the first panel is inside: sigma {sigma}, refinement {refinement}");
    loop {
        if at > grow_from {
            wide_from = wide_from.min(at);
            width = f64::min(width * GROWTH, widest);
        }
        if end - at <= 1.3 * width {
            break;
        }
        at += width;
        edges.push(at);
    }
    edges.extend(top.into_iter().rev());
    (edges, wide_from)
}

/// `edges`, with those panels split that are wider than `scale` and wider than their distance from the elevation `ridge`.
fn refined(edges: &[f64], ridge: f64, scale: f64) -> Vec<f64> {
    let mut waiting: Vec<[f64; 2]> = edges.windows(2).rev().map(|pair| [pair[0], pair[1]]).collect();
    let mut refined = vec![0.0];
    while let Some([low, high]) = waiting.pop() {
        let distance = f64::max(low - ridge, ridge - high).max(0.0);
        if high - low > f64::max(scale, distance) {
            // Split at the ridge itself where that is well inside: the kernel has a cusp there.
            let inside = (ridge - low).min(high - ridge) > 0.25 * (high - low);
            let middle = if inside { ridge } else { (low + high) / 2.0 };
            waiting.extend([[middle, high], [low, middle]]);
        } else {
            refined.push(high);
        }
    }
    refined
}
