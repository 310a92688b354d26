//! r at the nodes, such that R is what is interpolated between them.
//!
//! R is sampled at [`PER_CELL`] x [`PER_CELL`] points per cell, and the nodes' r minimise
//!
//! ```text
//! sum over samples with R > 1e-3 of |e|^1.5,  e = (interpolated r) / R - 1,      + a weak pull of every node's r / R towards 1.
//! ```
//!
//! Squares would bend whole cells for the sake of the few points at the corner of low alpha and grazing mu that no
//! bilinear function can meet, and a sum of plain magnitudes would give those points up. The pull holds the nodes that
//! no bright sample touches. Bounds: r is in \[R / 14, 1\]. Without the lower bound, r at the node nearest to the
//! corner falls to a hundredth, and all grazing light at alpha < 2/31 goes dark with it. At alpha = 0, r is 0, which is
//! the optimum too. No choice of r keeps the largest error below 0.95 over the whole square: just beside the corner R
//! rises from nothing to 0.9 within a hundredth of a cell.
//!
//! Solved by iteratively reweighted least squares, each step a few sweeps of projected Gauss-Seidel over the nodes.

use crate::fit::errors::DIM;
use crate::physics::slab::Slab;
use crate::physics::transport::{Resolution, Transport};
use crate::table::centres;
use rayon::prelude::*;

/// Samples a side of a cell, at the middles of its parts.
pub const PER_CELL: usize = 4;

/// Power of the relative error that is summed.
const POWER: f64 = 1.5;

/// Relative errors below which the sum becomes quadratic.
const SMOOTH: f64 = 1e-3;

/// Weight of a node's pull, where a sample's is 1.
const PULL: f64 = 0.16;

/// Least r / R of a node.
const LEAST: f64 = 1.0 / 14.0;

const REWEIGHTINGS: usize = 20;
const SWEEPS: usize = 6;

/// R over a grid of alphas and mus.
#[derive(Clone, Debug)]
pub struct Albedos {
    /// Roughnesses alpha, in (0, 1\].
    pub alphas: Vec<f64>,
    /// Cosines mu, in \[0, 1\].
    pub mus: Vec<f64>,
    /// R at each pair of them, alpha-major.
    pub values: Vec<f64>,
}

impl Albedos {
    /// Solves the slab for each of `alphas` in (0, 1\]; R is known to a relative 2e-4. `step` is called after each
    /// alpha, from any of the working threads.
    pub fn new(alphas: Vec<f64>, mus: Vec<f64>, step: impl Fn() + Sync) -> Self {
        let row = |&alpha: &f64| -> Vec<f64> {
            let solution = Transport::new(Slab::new(alpha), Resolution { modes: 1, refinement: 0.5, ridge: None });
            step();
            mus.iter().map(|&mu| solution.albedo(mu)).collect()
        };
        let values = alphas.par_iter().map(row).collect::<Vec<_>>().concat();
        Self { alphas, mus, values }
    }

    /// The places at which a table of `resolution` nodes a side is sampled, along either axis.
    pub fn samples(resolution: usize) -> Vec<f64> {
        centres((resolution - 1) * PER_CELL)
    }
}

/// r of each node, alpha-major, from R at the [`Albedos::samples`] and R at the nodes (any number where alpha = 0).
/// Panics where their counts are not those of a table of `resolution` nodes a side.
pub fn fit(resolution: usize, samples: &Albedos, at_nodes: &[f64]) -> Vec<f64> {
    let n = resolution;
    assert_eq!(samples.values.len(), ((n - 1) * PER_CELL).pow(2), "samples of a table of {n} nodes a side");
    assert_eq!(at_nodes.len(), n * n, "nodes of a table of {n} a side");
    let mut r = at_nodes.to_vec();
    r[..n].fill(0.0);
    for _ in 0..REWEIGHTINGS {
        let normal = Normal::new(n, samples, at_nodes, &r);
        for _ in 0..SWEEPS {
            for (node, albedo) in at_nodes.iter().enumerate().skip(n) {
                r[node] = normal.optimum(node, &r).clamp(LEAST * albedo, 1.0);
            }
        }
    }
    r
}

/// The normal equations of the weighted least squares. They couple a node to its eight neighbours.
struct Normal {
    n: usize,
    /// For each node, 3 x 3 coefficients around it.
    matrix: Vec<[f64; 9]>,
    right: Vec<f64>,
}

impl Normal {
    fn new(n: usize, samples: &Albedos, at_nodes: &[f64], r: &[f64]) -> Self {
        let mut normal = Self { n, matrix: vec![[0.0; 9]; n * n], right: vec![0.0; n * n] };
        for (node, albedo) in at_nodes.iter().enumerate().skip(n) {
            let weight = PULL / albedo.powi(2);
            normal.matrix[node][4] += weight;
            normal.right[node] += weight * albedo;
        }
        let side = (n - 1) * PER_CELL;
        for (index, &value) in samples.values.iter().enumerate().filter(|(_, value)| **value > DIM) {
            let place = |k: usize| (k / PER_CELL, ((k % PER_CELL) as f64 + 0.5) / PER_CELL as f64);
            let ((i, s), (j, t)) = (place(index / side), place(index % side));
            let corners = [(0, 0), (0, 1), (1, 0), (1, 1)];
            let share = [(1.0 - s) * (1.0 - t), (1.0 - s) * t, s * (1.0 - t), s * t];
            let node = corners.map(|(di, dj)| (i + di) * n + j + dj);
            let found: f64 = node.iter().zip(share).map(|(node, share)| r[*node] * share).sum();
            let error = found / value - 1.0;
            let weight = (error * error + SMOOTH * SMOOTH).powf(POWER / 2.0 - 1.0) / (value * value);
            for (one, (di, dj)) in corners.into_iter().enumerate() {
                normal.right[node[one]] += weight * share[one] * value;
                for (other, (ei, ej)) in corners.into_iter().enumerate() {
                    let offset = (1 + ei - di) * 3 + 1 + ej - dj;
                    normal.matrix[node[one]][offset] += weight * share[one] * share[other];
                }
            }
        }
        normal
    }

    /// The node's value for which the sum is least while all others hold still.
    fn optimum(&self, node: usize, r: &[f64]) -> f64 {
        let (i, j) = (node / self.n, node % self.n);
        let inside = |k: usize, step: usize| (k + step).checked_sub(1).filter(|at| *at < self.n);
        let mut rest = self.right[node];
        for (offset, coefficient) in self.matrix[node].iter().enumerate().filter(|(offset, _)| *offset != 4) {
            if let (Some(i), Some(j)) = (inside(i, offset / 3), inside(j, offset % 3)) {
                rest -= coefficient * r[i * self.n + j];
            }
        }
        rest / self.matrix[node][4]
    }
}
