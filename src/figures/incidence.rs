//! A lobe in the plane of incidence: as a curve of values, and as paths that were counted near it.

use crate::math::quadrature::gauss_legendre;
use crate::physics::walk::{Counts, Histogram};
use glam::{DMat3, DVec3};
use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::Range;

/// Elevations at which curves are computed: 1/4 degree apart.
const STEPS: usize = 720;

/// Neighbouring bins of the walk are pooled until they hold this many paths, for an error of 4%, and are at least this
/// wide, or until they are as wide as allowed.
const POOL_COUNTS: u64 = 625;
const POOL_LEAST: f64 = 1.5 * PI / 180.0;
const POOL_MOST: f64 = 8.0 * PI / 180.0;

/// Pools of fewer paths than this say little, and even less about their own error.
pub const FEWEST: u64 = 25;

/// Points (elevation, lobe per steradian); elevations are from the normal, in \[-pi/2, pi/2\], positive towards `wi`.
pub type Curve = Vec<[f64; 2]>;

/// What a walk found over a range of elevations.
#[derive(Clone, Debug, PartialEq)]
pub struct Pool {
    /// Elevations from the normal, the lower first; both positive, towards `wi`, or both negative.
    pub elevations: [f64; 2],
    /// Paths that left there.
    pub count: u64,
    /// The lobe's mean over these elevations and the sector, per steradian, and its standard error.
    pub mean: f64,
    pub error: f64,
}

/// The azimuth up to which `bins` of a walk's histogram reach, on one side of the plane of incidence.
pub fn sector(bins: usize) -> f64 {
    Histogram::phi_range(bins - 1)[1]
}

/// The mean of `lobe` over a sector of so many bins on one side of `wo`, in the plane of incidence.
pub fn sector_mean(lobe: impl Fn(DVec3) -> f64, wo: DVec3, bins: usize) -> f64 {
    let nodes = gauss_legendre(4, 0.0, sector(bins));
    nodes.iter().map(|(phi, weight)| weight * lobe(DMat3::from_rotation_z(*phi) * wo)).sum::<f64>() / sector(bins)
}

/// `lobe` along the plane of incidence, at all elevations.
pub fn curve(lobe: impl Fn(DVec3) -> f64) -> Curve {
    let elevation = |k: usize| PI * k as f64 / STEPS as f64 - FRAC_PI_2;
    (0..=STEPS).map(|k| [elevation(k), lobe(in_plane(elevation(k)))]).collect()
}

/// The direction in the plane of incidence at an elevation from the normal in \[-pi/2, pi/2\], positive towards `wi`.
pub fn in_plane(elevation: f64) -> DVec3 {
    let (x, z) = elevation.sin_cos();
    DVec3::new(x, 0.0, z.max(0.0))
}

/// The walk's histogram over `sector` bins of azimuths on either side of the plane of incidence, from the horizon
/// opposite `wi` to the horizon on its side; each path stands for `share` of the light.
pub fn pools(counts: &Counts, share: f64, sector: usize) -> Vec<Pool> {
    let away = pools_of_side(counts, share, Histogram::PHI_BINS - sector..Histogram::PHI_BINS);
    let mirrored = away.into_iter().map(|pool| {
        let [low, high] = pool.elevations;
        Pool { elevations: [-high, -low], ..pool }
    });
    let towards = pools_of_side(counts, share, 0..sector);
    mirrored.chain(towards.into_iter().rev()).collect()
}

/// Pools of some bins of azimuths, from the horizon up, with elevations as if they were towards `wi`.
fn pools_of_side(counts: &Counts, share: f64, columns: Range<usize>) -> Vec<Pool> {
    let azimuths = Histogram::phi_range(columns.len() - 1)[1];
    let in_row = |row: &[u64]| row[columns.clone()].iter().sum::<u64>();
    let rows = counts.reflected_once.bins().zip(counts.reflected_more.bins());
    let rows: Vec<u64> = rows.map(|(once, more)| in_row(once) + in_row(more)).collect();
    let elevations = |from: usize, to: usize| [Histogram::mu_range(to)[1].acos(), Histogram::mu_range(from)[0].acos()];
    let (mut pools, mut from, mut count) = (Vec::new(), 0, 0);
    for (to, in_row) in rows.iter().enumerate() {
        count += in_row;
        let range = elevations(from, to);
        let width = range[1] - range[0];
        if (count >= POOL_COUNTS && width >= POOL_LEAST) || width >= POOL_MOST || to + 1 == rows.len() {
            let cosines = Histogram::mu_range(to)[1] - Histogram::mu_range(from)[0];
            // Both sides of the plane of incidence.
            let per_path = share / (2.0 * azimuths * cosines);
            let [mean, error] = [count as f64, (count as f64).sqrt()].map(|count| count * per_path);
            pools.push(Pool { elevations: range, count, mean, error });
            (from, count) = (to + 1, 0);
        }
    }
    pools
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::slab::Slab;
    use crate::physics::transport::{Resolution, Transport};
    use crate::physics::walk::{FirstFlight, Walk};

    const SECTOR: usize = 1;

    #[test]
    fn curves_are_the_solvers_values_along_the_plane() {
        let transport = Transport::new(Slab::new(0.6), Resolution::default());
        let wi = in_plane(0.4_f64.acos());
        assert!((wi.z - 0.4).abs() < 1e-15 && wi.x > 0.0);
        let curve = curve(|wo| transport.reflected(wi, wo));
        assert_eq!(curve.len(), STEPS + 1);
        for (k, x) in [(STEPS * 3 / 4, 1.0), (STEPS / 4, -1.0)] {
            let half = std::f64::consts::FRAC_1_SQRT_2;
            let truth = transport.reflected(wi, DVec3::new(x * half, 0.0, half));
            let other = transport.reflected(wi, DVec3::new(-x * half, 0.0, half));
            // Round-off of an angle.
            assert!((curve[k][0] - x * PI / 4.0).abs() < 1e-12, "{:?}", curve[k]);
            assert!((curve[k][1] / truth - 1.0).abs() < 1e-12, "{:?} and {truth}", curve[k]);
            assert!((curve[k][1] / other - 1.0).abs() > 2e-2, "{:?} and {other}", curve[k]);
        }
        assert!([curve[0][1], curve[STEPS][1]].iter().all(|value| *value < 1e-9), "nothing leaves along the surface");
    }

    /// How many standard errors the pools are from a solution's means over the same directions, as a root mean square.
    fn distance(pools: &[Pool], transport: &Transport, mu: f64) -> f64 {
        let wi = in_plane(mu.acos());
        let off = |pool: &Pool| {
            let [one, other] = pool.elevations.map(|elevation| elevation.abs().cos());
            let side = if pool.elevations[1] > 0.0 { 1.0 } else { -1.0 };
            let terms = gauss_legendre(8, one, other);
            let lobe = |wo| transport.reflected(wi, wo);
            let mean =
                terms.iter().map(|(mu_o, weight)| weight * sector_mean(lobe, in_plane(side * mu_o.acos()), SECTOR));
            ((mean.sum::<f64>() / (other - one) - pool.mean) / pool.error).powi(2)
        };
        let seen: Vec<f64> = pools.iter().filter(|pool| pool.error > 0.0).map(off).collect();
        assert!(seen.len() > 20, "{} pools", seen.len());
        (seen.iter().sum::<f64>() / seen.len() as f64).sqrt()
    }

    #[test]
    fn pools_of_the_walk_lie_on_the_curves() {
        for (alpha, mu) in [(0.6, 0.4), (0.5, 0.1)] {
            let slab = Slab::new(alpha);
            let walk = Walk { slab, mu, first_flight: FirstFlight::Scattered, paths: 1 << 20, seed: 2 };
            let pools = pools(&walk.run(), walk.share(), SECTOR);
            assert_eq!(pools[0].elevations[0], -FRAC_PI_2);
            for pair in pools.windows(2) {
                assert!((pair[0].elevations[1] - pair[1].elevations[0]).abs() < 1e-12, "a gap: {pair:?}");
            }
            // 1 +- 0.1 is expected of 50 pools or so. A wrong slab, or the sides exchanged, is further off.
            let own = distance(&pools, &Transport::new(slab, Resolution::default()), mu);
            assert!((0.7..1.4).contains(&own), "alpha {alpha}, mu {mu}: {own}");
            let other = distance(&pools, &Transport::new(Slab::new(alpha * 0.95), Resolution::default()), mu);
            assert!(other > 1.6, "alpha {alpha}, mu {mu}: {other} from another slab");
            let turned: Vec<Pool> = pools
                .iter()
                .map(|pool| Pool { elevations: [-pool.elevations[1], -pool.elevations[0]], ..pool.clone() })
                .collect();
            let other = distance(&turned, &Transport::new(slab, Resolution::default()), mu);
            assert!(other > 1.6, "alpha {alpha}, mu {mu}: {other} with the sides exchanged");
        }
    }
}
