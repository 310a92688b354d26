//! How good a fitted table is.

use super::albedo::Albedos;
use super::row::{Fit, grazing_mu};
use crate::fit::errors::{DIM, Errors};
use crate::fit::{LICENCE, RESOLUTION};
use crate::table::{SheenTable, centres};
use std::fmt;

/// Errors of a fitted table, where R > 1e-3.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Nodes a side.
    pub resolution: usize,
    /// Nodes with R > 1e-3.
    pub nodes: usize,
    /// Relative L2 distance between lobe and transformed cosine at those nodes.
    pub lobe: Errors,
    /// Its mean weighted by R.
    pub weighted: f64,
    /// Relative error of the interpolated r at the centres of the table's cells.
    pub centres: Errors,
    /// The same at the centres of a grid of 48 x 48 cells, which do not line up with the table's. They are not random:
    /// if they were, the greatest error would depend on the few that happen to be next to alpha = mu = 0. See
    /// [`albedo`](super::albedo).
    pub spread: Errors,
}

/// Cells a side of the grid that does not follow the table's.
pub const SPREAD: usize = 48;

impl Report {
    /// `step` is called after each slab that is solved, [`Report::steps`] in all, from any of the working threads.
    pub(super) fn new<'a>(table: &SheenTable, fits: impl Iterator<Item = &'a Fit>, step: impl Fn() + Sync) -> Self {
        let bright: Vec<&Fit> = fits.filter(|fit| fit.albedo > DIM).collect();
        let albedo: f64 = bright.iter().map(|fit| fit.albedo).sum();
        let weighted = bright.iter().map(|fit| fit.albedo * fit.distance).sum::<f64>() / albedo;
        let lobe = Errors::new(bright.iter().map(|fit| fit.distance).collect());
        let resolution = table.size()[0];
        let [centres, spread] = [resolution - 1, SPREAD].map(|cells| albedo_errors(table, cells, &step));
        Self { resolution, nodes: bright.len(), lobe, weighted, centres, spread }
    }

    /// How many slabs a report solves.
    pub(super) fn steps(resolution: usize) -> usize {
        resolution - 1 + SPREAD
    }

    /// The head of the table's .csv, a string for each line: what the table is, its axes, its errors, how it was made.
    pub fn header(&self) -> Vec<String> {
        let option =
            if self.resolution == RESOLUTION { String::new() } else { format!(" --resolution {}", self.resolution) };
        let about = format!(
            "Sheen of a slab of fibres as linearly transformed cosines (Zeltner, Burley, Chiang 2022), all orders of scattering.
alpha: roughness, small is fuzz, large is dust. mu: cosine of wi (the view in rendering) to the normal. Node k sits at k/{last}.
a, b: inverse matrix by rows (a,0,b), (0,a,0), (0,0,1) in the frame z = normal, x = wi projected on the surface; b <= 0.
r: albedo of the lobe, all colours 1. Reflected radiance = C_sheen r x (integral of the transformed cosine x radiance).
Lookup: bilinear. r is fitted for the interpolated value: below alpha = 0.25, where R rises steeply, it is 10 to 80% under R at the node,
and next to alpha = mu = 0 far from it either way.
a, b of mu = 0 are those of mu = {grazing}. alpha = 0 has no lobe: a and b of the next alpha.",
            last = self.resolution - 1,
            grazing = (grazing_mu(self.resolution) * 1e6).round() / 1e6,
        );
        let errors = self.to_string();
        let made = format!("Made by: velour fit{option}");
        let lines = LICENCE.into_iter().chain(about.lines()).chain(errors.lines());
        lines.chain([made.as_str()]).map(str::to_owned).collect()
    }

    /// The errors of the lobe, of r at the cells' centres, and of r at the spread points, in words.
    pub fn figures(&self) -> [String; 3] {
        let Self { lobe, weighted, centres, spread, .. } = self;
        let shape = format!(
            "mean {:.4}, median {:.4}, max {:.4}, weighted by R {weighted:.4}",
            lobe.mean, lobe.median, lobe.max
        );
        let albedo = |errors: &Errors| format!("mean {:.4}, max {:.4}", errors.mean, errors.max);
        [shape, albedo(centres), albedo(spread)]
    }
}

/// Relative errors of the table's r at the centres of `cells` x `cells` cells, where R > 1e-3.
fn albedo_errors(table: &SheenTable, cells: usize, step: impl Fn() + Sync) -> Errors {
    let truth = Albedos::new(centres(cells), centres(cells), step);
    let mut errors = Vec::new();
    for (row, &alpha) in truth.values.chunks_exact(cells).zip(&truth.alphas) {
        let bright = row.iter().zip(&truth.mus).filter(|(value, _)| **value > DIM);
        errors.extend(bright.map(|(value, &mu)| (table.lookup(alpha, mu)[2] / value - 1.0).abs()));
    }
    Errors::new(errors)
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let [shape, centres, spread] = self.figures();
        let cells = self.resolution - 1;
        write!(
            f,
            "Relative L2 error of the lobe, {} nodes with R > {DIM}: {shape}.\n\
             Relative error of the interpolated r where R > {DIM}: at the {cells} x {cells} centres of its cells {centres};\n\
             at those of {SPREAD} x {SPREAD} cells {spread}.",
            self.nodes
        )
    }
}
