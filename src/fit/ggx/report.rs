//! How good the specular base's table is.

use super::row::{Fit, QUADRATURE, albedo, distance};
use crate::fit::LICENCE;
use crate::fit::errors::Errors;
use crate::physics::microfacet::{Ggx, LEAST_ALPHA};
use crate::table::ggx::{GRAZING_MU, cosine};
use crate::table::{GgxTable, centres};
use rayon::prelude::*;
use std::fmt;

/// Cells a side of the grid that does not follow the table's.
const SPREAD: usize = 48;

/// Points a side of the grid on which tables are compared: roughness k/7 but for 0, t = k/7, mu no less than [`GRAZING_MU`].
const COMPARED: usize = 8;

/// Errors of a fitted table. Those of shapes are L1 distances between the lobe over its albedo and the density, at most
/// 2.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Nodes a side.
    pub resolution: usize,
    /// Errors of the fit, at the nodes.
    pub nodes: Shapes,
    /// Errors of lookups at the centres of 48 x 48 cells, which do not line up with the table's.
    pub spread: Lookups,
    /// Mean error, weighted by R, of the shapes that are looked up on the grid on which tables are compared.
    pub compared: f64,
}

/// L1 distances of shapes.
#[derive(Clone, Debug, PartialEq)]
pub struct Shapes {
    /// Statistics in which all places count alike.
    pub errors: Errors,
    /// The mean weighted by R.
    pub weighted: f64,
}

/// Errors of what is looked up between the nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Lookups {
    /// L1 distances of the shapes.
    pub shapes: Shapes,
    /// Relative error of R.
    pub albedo: Errors,
    /// Error of the Fresnel share over R.
    pub fresnel: Errors,
}

/// The errors of what is looked up at one place.
struct Lookup {
    /// R.
    truth: f64,
    distance: f64,
    albedo: f64,
    fresnel: f64,
}

impl Report {
    /// `step` is told of each roughness that is seen, [`Report::STEPS`] in all, from any of the working threads.
    pub(super) fn new<'a>(table: &GgxTable, fits: impl Iterator<Item = &'a Fit>, step: impl Fn() + Sync) -> Self {
        let nodes = Shapes::new(fits.map(|fit| (fit.albedo, fit.distance)).collect());
        let resolution = table.size()[0];
        let mus = |t: Vec<f64>| -> Vec<f64> { t.into_iter().map(|t| cosine(t).max(GRAZING_MU)).collect() };
        let spread = Lookups::new(&lookups(table, &centres(SPREAD), &mus(centres(SPREAD)), &step));
        let compared: Vec<f64> = (0..COMPARED).map(|k| k as f64 / (COMPARED - 1) as f64).collect();
        let compared = lookups(table, &compared[1..], &mus(compared.clone()), &step);
        let compared = Shapes::new(compared.iter().map(|lookup| (lookup.truth, lookup.distance)).collect()).weighted;
        Self { resolution, nodes, spread, compared }
    }

    /// How many roughnesses a report looks at.
    pub(super) const STEPS: usize = SPREAD + COMPARED - 1;

    /// The head of the table's .csv, a string for each line: what the table is, its axes, its errors, how it was made.
    pub fn header(&self) -> Vec<String> {
        let about = format!(
            "GGX microfacets (Walter et al. 2007), shadowing correlated by height (Heitz 2014), as linearly transformed cosines.
roughness: the user's; alpha = roughness^2, no less than {LEAST_ALPHA}. t: sqrt(1 - mu), mu the cosine of wi (the view) to the normal. \
             Node k sits at k/{last}.
u, v, s: inverse matrix by rows (a,0,b), (0,c,0), (0,0,1) in the frame z = normal, x = wi projected on the surface:
c = 1 / s^2, a = c (m^2 + u), b = c (m sqrt(1 - m^2) + v), m = max(mu, {GRAZING_MU}).
albedo: R, what comes back from a perfect mirror. fresnel: the same weighted by (1 - dot(wi, h))^5.
Reflected radiance = E x (integral of the transformed cosine x radiance), E = f0 (albedo - fresnel) + f90 fresnel, times
1 + f0 (1 / albedo - 1) to make up for light that facets reflect more than once.
Lookup: bilinear. albedo and fresnel are fitted for the interpolated value. u, v, s of t = 1 (mu = 0) are those of mu = {GRAZING_MU}.",
            last = self.resolution - 1,
        );
        let errors = self.to_string();
        let lines = LICENCE.into_iter().chain(about.lines()).chain(errors.lines());
        lines.chain(["Made by: velour fit"]).map(str::to_owned).collect()
    }

    /// The errors of shapes at the nodes and between them, of R, and of the Fresnel share, in words.
    pub fn figures(&self) -> [String; 5] {
        let shapes = |Shapes { errors, weighted }: &Shapes| {
            let Errors { mean, median, max } = errors;
            format!("mean {mean:.4}, median {median:.4}, max {max:.4}, weighted by R {weighted:.4}")
        };
        let lookup = |errors: &Errors| format!("mean {:.4}, max {:.4}", errors.mean, errors.max);
        let Lookups { albedo, fresnel, .. } = &self.spread;
        let compared = format!("{:.3}", self.compared);
        [shapes(&self.nodes), shapes(&self.spread.shapes), lookup(albedo), lookup(fresnel), compared]
    }
}

impl Shapes {
    /// From pairs of R and distance.
    fn new(pairs: Vec<(f64, f64)>) -> Self {
        let whole: f64 = pairs.iter().map(|(albedo, _)| albedo).sum();
        let weighted = pairs.iter().map(|(albedo, distance)| albedo * distance).sum::<f64>() / whole;
        Self { errors: Errors::new(pairs.into_iter().map(|(_, distance)| distance).collect()), weighted }
    }
}

impl Lookups {
    fn new(lookups: &[Lookup]) -> Self {
        let errors = |error: fn(&Lookup) -> f64| Errors::new(lookups.iter().map(error).collect());
        Self {
            shapes: Shapes::new(lookups.iter().map(|lookup| (lookup.truth, lookup.distance)).collect()),
            albedo: errors(|lookup| lookup.albedo),
            fresnel: errors(|lookup| lookup.fresnel),
        }
    }
}

/// The errors of what is looked up at all pairs of roughness and cosine.
fn lookups(table: &GgxTable, roughnesses: &[f64], mus: &[f64], step: impl Fn() + Sync) -> Vec<Lookup> {
    let row = |&roughness: &f64| {
        let ggx = Ggx::from_roughness(roughness);
        let one = |&mu: &f64| {
            let (nodes, truth, found) =
                (ggx.quadrature(mu, QUADRATURE), ggx.reflected(mu), table.lookup(roughness, mu));
            Lookup {
                truth: truth.albedo,
                distance: distance(&nodes, albedo(&nodes), found.ltc),
                albedo: (found.albedo / truth.albedo - 1.0).abs(),
                fresnel: (found.fresnel - truth.fresnel).abs() / truth.albedo,
            }
        };
        let row: Vec<Lookup> = mus.iter().map(one).collect();
        step();
        row
    };
    roughnesses.par_iter().map(row).collect::<Vec<_>>().into_iter().flatten().collect()
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let [nodes, spread, albedo, fresnel, compared] = self.figures();
        write!(
            f,
            "L1 error of the lobe over R, {n} x {n} nodes: {nodes}.\n\
             Looked up at the centres of {SPREAD} x {SPREAD} cells: L1 {spread};\n\
             relative error of albedo {albedo}; error of fresnel over albedo {fresnel}.\n\
             Looked up at roughness k/7, t = k/7, mu >= {GRAZING_MU}: L1 weighted by R {compared}.",
            n = self.resolution,
        )
    }
}
