//! The sheen of real-time rendering.

use super::{Bsdf, Sample, check_alpha, check_uniforms, cosine};
use crate::math::check_cosine;
use crate::math::frame::AzimuthFrame;
use crate::table::{Ltc, SheenTable, cell, node};
use glam::DVec3;

/// The sheen as a linearly transformed cosine, with the table's numbers at one alpha (Zeltner, Burley, Chiang 2022, eq. 1).
///
/// This is what the shaders integrate over polygons, so that a path tracer that uses it shows the same picture. Samples
/// have the lobe's density: their weight is the albedo r. It misses reciprocity by as much as the fit is off (9% of a
/// lobe on average).
#[derive(Clone, Debug, PartialEq)]
pub struct LtcSheen {
    /// `[a, b, r]` at the nodes of mu.
    nodes: Vec<[f64; 3]>,
}

impl LtcSheen {
    /// The sheen of roughness `alpha` in \[0, 1\]. At 0 the shipped table has r = 0: no lobe.
    pub fn new(table: &SheenTable, alpha: f64) -> Self {
        check_alpha(alpha);
        let [_, mus] = table.size();
        Self { nodes: (0..mus).map(|j| table.lookup(alpha, node(j, mus))).collect() }
    }

    /// The lobe at a cosine, and its albedo.
    fn lobe(&self, mu: f64) -> (Ltc, f64) {
        let (below, t) = cell(mu, self.nodes.len());
        let [low, high] = [self.nodes[below], self.nodes[below + 1]];
        let between = |k: usize| (1.0 - t) * low[k] + t * high[k];
        (Ltc::sheen(between(0), between(1)), between(2))
    }

    /// The lobe of `wi`, its albedo, and `wo` in its frame, unless one is below the horizon or nothing is scattered.
    fn meeting(&self, wi: DVec3, wo: DVec3) -> Option<(Ltc, f64, DVec3)> {
        let (mu_i, mu_o) = (cosine(wi), cosine(wo));
        if mu_i < 0.0 || mu_o <= 0.0 {
            return None;
        }
        let (ltc, r) = self.lobe(mu_i);
        (ltc.a > 0.0 && r > 0.0).then(|| (ltc, r, AzimuthFrame::of(wi).local(wo)))
    }
}

impl Bsdf for LtcSheen {
    fn evaluate(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.meeting(wi, wo).map_or(0.0, |(ltc, r, wo)| r * ltc.density(wo))
    }

    fn sample(&self, wi: DVec3, uniforms: [f64; 2]) -> Option<Sample> {
        check_uniforms(uniforms);
        let mu_i = cosine(wi);
        if mu_i < 0.0 {
            return None;
        }
        let (ltc, r) = self.lobe(mu_i);
        (ltc.a > 0.0 && r > 0.0).then(|| {
            let wo = ltc.sample(uniforms);
            Sample { wo: AzimuthFrame::of(wi).outside(wo), weight: r, pdf: ltc.density(wo) }
        })
    }

    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.meeting(wi, wo).map_or(0.0, |(ltc, _, wo)| ltc.density(wo))
    }

    /// r, linear between the table's nodes. 0 where a = 0: such a cell has no lobe.
    fn albedo(&self, mu: f64) -> f64 {
        check_cosine(mu);
        let (ltc, r) = self.lobe(mu);
        if ltc.a > 0.0 { r } else { 0.0 }
    }
}
