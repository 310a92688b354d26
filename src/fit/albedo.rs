//! r at the nodes, so that what is interpolated between them is R.

use crate::physics::slab::Slab;
use crate::physics::transport::{Resolution, Transport};
use rayon::prelude::*;

/// R where it is compared with the table's bilinear lookup: rows of one alpha.
pub struct Truth {
    pub alphas: Vec<f64>,
    pub mus: Vec<f64>,
    /// R, alpha-major.
    pub values: Vec<f64>,
}

const PER_CELL: usize = 4;

impl Truth {
    /// The alphas at which it has rows.
    pub fn alphas(resolution: usize) -> Vec<f64> {
        let n = (resolution - 1) * PER_CELL;
        (0..n).map(|k| (k as f64 + 0.5) / n as f64).collect()
    }

    pub fn new(_resolution: usize, alphas: &[f64], step: impl Fn() + Sync) -> Self {
        let mus = alphas.to_vec();
        let rows: Vec<Vec<f64>> = alphas
            .par_iter()
            .map(|&alpha| {
                let solution = Transport::new(Slab::new(alpha), Resolution { modes: 1, ..Default::default() });
                step();
                mus.iter().map(|&mu| solution.albedo(mu)).collect()
            })
            .collect();
        Self { alphas: alphas.to_vec(), mus, values: rows.concat() }
    }
}

/// r of each node, alpha-major.
pub fn fit(resolution: usize, truth: &Truth) -> Vec<f64> {
    let _ = truth;
    vec![0.5; resolution * resolution]
}
