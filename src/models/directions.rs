//! Directions sampled from a tabulated lobe, and its albedo: for lobes that have a closed form where their integrals
//! have none.
//!
//! For each of a few cosines of `wi` a row holds the lobe's shares in cells of the upper hemisphere, [`ELEVATIONS`] equal steps of the cube
//! root of the cosine of `wo` times [`AZIMUTHS`] equal steps of the azimuth from `wi`, both its signs together. In a cell the density over
//! (cube root, azimuth) is constant. Between two rows it is linear, and so are its sums, which are inverted without
//! choosing one of the two rows at random.

use super::{Sample, check_uniforms, cosine};
use crate::math::frame::AzimuthFrame;
use crate::math::{check_cosine, cube_root, sine};
use crate::table::{cell, node};
use glam::DVec3;
use std::f64::consts::PI;

/// Least alpha of the sheens of prior work; smaller ones are replaced by it, because narrower lobes would slip between
/// the cells from which they are sampled. The least alpha above 0 in the fitted table is 1/31.
pub const LEAST_ALPHA: f64 = 0.03;

/// Rows, at equal steps of [`place_from_mu`]. The albedo is held there too.
const ROWS: usize = 65;

/// Cells along the cube root of the cosine of `wo`: grazing light makes lobes as narrow as the square of alpha.
const ELEVATIONS: usize = 24;

/// Cells along half a circle.
const AZIMUTHS: usize = 16;

const CELLS: usize = ELEVATIONS * AZIMUTHS;

/// Least share of a cell, relative to the mean share: the lobe is evaluated on a cell's edges and in its middle, and
/// may be larger elsewhere in it.
const LEAST: f64 = 0.02;

/// f_r(wi, wo) times the cosine of `wo`, as a product, for `wi` above the horizon or on it and `wo` above it. For each
/// `wi` it is above 0 somewhere.
pub trait Lobe {
    /// What depends on the cosines alone.
    fn of_cosines(&self, mu_i: f64, mu_o: f64) -> f64;

    /// The rest.
    fn of_directions(&self, wi: DVec3, wo: DVec3) -> f64;

    fn value(&self, wi: DVec3, wo: DVec3) -> f64 {
        // Cosines may be past 1 by the directions' rounding.
        self.of_cosines(wi.z.min(1.0), wo.z.min(1.0)) * self.of_directions(wi, wo)
    }

    /// The value, and 0 for other directions: as [`super::Bsdf::evaluate`].
    fn evaluate(&self, wi: DVec3, wo: DVec3) -> f64 {
        let (mu_i, mu_o) = (cosine(wi), cosine(wo));
        if mu_i < 0.0 || mu_o <= 0.0 { 0.0 } else { self.value(wi, wo) }
    }
}

/// A lobe's cells for each row, and its albedos.
#[derive(Clone, Debug)]
pub struct Directions {
    /// The sum of the shares before each cell, elevation-major, and 1 after the last; row by row.
    cumulated: Vec<f64>,
    /// Logarithms of the rows' albedos.
    log_albedos: [f64; ROWS],
}

impl Directions {
    pub fn new(lobe: &impl Lobe) -> Self {
        let turns: [_; AZIMUTHS + 1] = std::array::from_fn(|k| (PI * k as f64 / AZIMUTHS as f64).sin_cos());
        let mut cumulated = Vec::with_capacity(ROWS * (CELLS + 1));
        let log_albedos = std::array::from_fn(|row| {
            let mu_i = mu_from_place(node(row, ROWS));
            let wi = DVec3::new(sine(mu_i), 0.0, mu_i);
            let strips = strips(lobe, wi, &turns);
            cumulate(&strips, &mut cumulated);
            let albedo: f64 = strips.iter().map(simpson).sum();
            assert!(albedo > 0.0 && albedo.is_finite(), "a lobe of mu {mu_i} has the albedo {albedo}");
            albedo.ln()
        });
        Self { cumulated, log_albedos }
    }

    /// A direction, as [`super::Bsdf::sample`]; `lobe` is what [`Self::new`] was given.
    pub fn sample(&self, lobe: &impl Lobe, wi: DVec3, uniforms: [f64; 2]) -> Option<Sample> {
        check_uniforms(uniforms);
        let mu_i = cosine(wi);
        if mu_i < 0.0 {
            return None;
        }
        let row = Row::at(mu_i);
        let elevation = last_at_most(ELEVATIONS, uniforms[0], |k| row.between(&self.cumulated, k * AZIMUTHS));
        let first = elevation * AZIMUTHS;
        let [from, to] = [first, first + AZIMUTHS].map(|cell| row.between(&self.cumulated, cell));
        let root = (elevation as f64 + (uniforms[0] - from) / (to - from)) / ELEVATIONS as f64;
        let mu = (root * root * root).min(1.0);
        if mu <= 0.0 {
            return None;
        }
        let turn = 2.0 * uniforms[1] - 1.0;
        let target = from + turn.abs() * (to - from);
        let azimuth = last_at_most(AZIMUTHS, target, |k| row.between(&self.cumulated, first + k));
        let [from, to] = [0, 1].map(|next| row.between(&self.cumulated, first + azimuth + next));
        let phi = PI * (azimuth as f64 + (target - from) / (to - from)) / AZIMUTHS as f64;
        let (sin, cos) = phi.min(PI).copysign(turn).sin_cos();
        let s = sine(mu);
        let wo = AzimuthFrame::of(wi).outside(DVec3::new(s * cos, s * sin, mu));
        let pdf = self.pdf(wi, wo);
        Some(Sample { wo, weight: lobe.value(wi, wo) / pdf, pdf })
    }

    /// As [`super::Bsdf::pdf`].
    pub fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        let (mu_i, mu_o) = (cosine(wi), cosine(wo));
        if mu_i < 0.0 || mu_o <= 0.0 {
            return 0.0;
        }
        let local = AzimuthFrame::of(wi).local(wo);
        // The least root keeps the density finite.
        let root = cube_root(mu_o).max(1e-100);
        let step = |x: f64, steps: usize| ((x * steps as f64) as usize).min(steps - 1);
        let at = step(root, ELEVATIONS) * AZIMUTHS + step(local.y.abs().atan2(local.x) / PI, AZIMUTHS);
        let row = Row::at(mu_i);
        let share = row.between(&self.cumulated, at + 1) - row.between(&self.cumulated, at);
        share * CELLS as f64 / (2.0 * PI * 3.0 * root * root)
    }

    /// The integral of the lobe for `wi` of cosine `mu` in \[0, 1\]. Between the rows the logarithm is a cubic through four of them.
    pub fn albedo(&self, mu: f64) -> f64 {
        check_cosine(mu);
        let place = place_from_mu(mu) * (ROWS - 1) as f64;
        let first = (place as usize).clamp(1, ROWS - 3) - 1;
        let t = place - first as f64;
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| self.log_albedos[first + k]);
        // Lagrange's polynomial at the nodes 0, 1, 2, 3.
        let [u, v, w] = [t - 1.0, t - 2.0, t - 3.0];
        ((t * u * v * d - a * u * v * w) / 6.0 + (t * v * w * b - t * u * w * c) / 2.0).exp()
    }
}

/// For each step in elevation, the lobe's integral over that step by Simpson's rule, taken at the edges between
/// azimuths, times a cell's width in azimuth (both its signs together).
fn strips(lobe: &impl Lobe, wi: DVec3, turns: &[(f64, f64); AZIMUTHS + 1]) -> [[f64; AZIMUTHS + 1]; ELEVATIONS] {
    let at = |k: usize| {
        if k == 0 {
            // On the horizon there is nothing.
            return [0.0; AZIMUTHS + 1];
        }
        let root = node(k, 2 * ELEVATIONS + 1);
        let mu = root * root * root;
        let s = sine(mu);
        let scale = lobe.of_cosines(wi.z, mu) * 3.0 * root * root * 2.0 * PI / CELLS as f64;
        turns.map(|(sin, cos)| scale * lobe.of_directions(wi, DVec3::new(s * cos, s * sin, mu)))
    };
    let mut low = at(0);
    std::array::from_fn(|elevation| {
        let [middle, high] = [1, 2].map(|k| at(2 * elevation + k));
        let strip = std::array::from_fn(|k| (low[k] + 4.0 * middle[k] + high[k]) / 6.0);
        low = high;
        strip
    })
}

/// The integral of a strip over the azimuths. The trapezoids from which the cells' shares are made give steep cells
/// enough, but would be wrong here where the lobe has a kink at the azimuth pi.
fn simpson(strip: &[f64; AZIMUTHS + 1]) -> f64 {
    (0..AZIMUTHS).step_by(2).map(|k| (strip[k] + 4.0 * strip[k + 1] + strip[k + 2]) / 3.0).sum()
}

/// Appends a row to `cumulated`: the sum of the shares before each of its cells, scaled so that the row ends at 1.
fn cumulate(strips: &[[f64; AZIMUTHS + 1]; ELEVATIONS], cumulated: &mut Vec<f64>) {
    let shares = strips.iter().flat_map(|strip| strip.windows(2).map(|edges| 0.5 * (edges[0] + edges[1])));
    let least = LEAST * shares.clone().sum::<f64>() / CELLS as f64;
    let whole: f64 = shares.clone().map(|share| share.max(least)).sum();
    let mut sum = 0.0;
    for share in shares {
        cumulated.push(sum);
        sum += share.max(least) / whole;
    }
    // Uniform numbers are below 1.
    cumulated.push(1.0);
}

/// The last of `count` ascending values that is at most `target`; the first where all are more.
fn last_at_most(count: usize, target: f64, value: impl Fn(usize) -> f64) -> usize {
    let (mut low, mut high) = (0, count);
    while high - low > 1 {
        let middle = low.midpoint(high);
        if value(middle) <= target {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Where a cosine in \[0, 1\] lies along the rows: p with mu = (p (2 - p))^4, dense at both ends.
fn place_from_mu(mu: f64) -> f64 {
    let root = mu.sqrt().sqrt();
    root / (1.0 + (1.0 - root).sqrt())
}

fn mu_from_place(place: f64) -> f64 {
    (place * (2.0 - place)).powi(4)
}

/// A place between two rows.
#[derive(Clone, Copy)]
struct Row {
    /// The row below.
    first: usize,
    /// The next row's share.
    share: f64,
}

impl Row {
    fn at(mu_i: f64) -> Self {
        let (first, share) = cell(place_from_mu(mu_i), ROWS);
        Self { first, share }
    }

    /// The sum before a cell.
    #[inline]
    fn between(self, cumulated: &[f64], cell: usize) -> f64 {
        let at = self.first * (CELLS + 1) + cell;
        (1.0 - self.share) * cumulated[at] + self.share * cumulated[at + CELLS + 1]
    }
}
