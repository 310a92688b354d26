//! How good a fitted table is.

use super::{Fit, Options};
use std::fmt;

/// Albedo below which a lobe is left out of the errors: nobody sees it.
const DIM: f64 = 1e-3;

/// Errors of a fitted table over its nodes with R > 1e-3.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    pub options: Options,
    /// Nodes with R > 1e-3.
    pub nodes: usize,
    /// Mean of the relative L2 distance between lobe and transformed cosine.
    pub mean: f64,
    pub median: f64,
    pub max: f64,
    /// Mean weighted by R.
    pub weighted: f64,
    /// Largest relative standard error of r.
    pub albedo_error: f64,
    /// Nodes of all whose a, b are copied from the next larger alpha.
    pub copied_shapes: usize,
    /// Nodes of all whose r is single scattering's times the next larger alpha's ratio.
    pub copied_albedos: usize,
}

impl Report {
    pub(super) fn new(options: Options, fits: &[&Fit]) -> Self {
        let mut bright: Vec<&Fit> = fits.iter().copied().filter(|fit| fit.albedo > DIM).collect();
        assert!(!bright.is_empty(), "lobes at alpha = 1 are bright");
        bright.sort_by(|one, other| one.distance.total_cmp(&other.distance));
        let nodes = bright.len();
        let albedo: f64 = bright.iter().map(|fit| fit.albedo).sum();
        let weighted = bright.iter().map(|fit| fit.albedo * fit.distance).sum::<f64>() / albedo;
        Self {
            options,
            nodes,
            mean: bright.iter().map(|fit| fit.distance).sum::<f64>() / nodes as f64,
            median: bright[nodes / 2].distance,
            max: bright[nodes - 1].distance,
            weighted,
            albedo_error: bright.iter().map(|fit| fit.albedo_error / fit.albedo).fold(0.0, f64::max),
            copied_shapes: fits.iter().filter(|fit| fit.shape_copied).count(),
            copied_albedos: fits.iter().filter(|fit| fit.albedo_copied).count(),
        }
    }

    /// What stands at the head of the table's .csv, a string a line: what it is, its axes, its errors, how it was made.
    pub fn header(&self) -> Vec<String> {
        let Options { resolution, .. } = self.options;
        let option = if resolution == Options::default().resolution {
            String::new()
        } else {
            format!(" --resolution {resolution}")
        };
        let about = format!(
            "Sheen of a slab of fibres as linearly transformed cosines (Zeltner, Burley, Chiang 2022), all orders of scattering.
alpha: roughness, small is fuzz, large is dust. mu: cosine of wi (the view in rendering) to the normal. Node k sits at k/{last}.
a, b: inverse matrix by rows (a,0,b), (0,a,0), (0,0,1) in the frame z = normal, x = wi projected on the surface; b <= 0.
r: albedo of the lobe, all colours 1. Reflected radiance = C_sheen r x (integral of the transformed cosine x radiance).
Lookup: bilinear. mu = 0 is computed at {grazing}. alpha = 0 has no lobe: r = 0, a and b of the next alpha.
",
            last = resolution - 1,
            grazing = super::GRAZING_MU,
        );
        let made = format!("Made by: velour fit{option}");
        about.lines().map(str::to_owned).chain(self.to_string().lines().map(str::to_owned)).chain([made]).collect()
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Options { resolution, paths, seed } = self.options;
        writeln!(
            f,
            "Relative L2 error of the lobe, {} nodes with r > {DIM}: mean {:.4}, median {:.4}, max {:.4}, weighted by r {:.4}.",
            self.nodes, self.mean, self.median, self.max, self.weighted
        )?;
        writeln!(
            f,
            "Standard error of r: at most {:.2}% there. Random walk of {paths} paths a node and more where it is dim, seed {seed}.",
            100.0 * self.albedo_error
        )?;
        write!(
            f,
            "Of {} nodes with alpha > 0, {} with r far below {DIM} have a, b of the next larger alpha,\n\
             and {} have r from single scattering and that alpha's share of the rest.",
            resolution * (resolution - 1),
            self.copied_shapes,
            self.copied_albedos,
        )
    }
}
