//! Rulers for models: bins of directions, and whether samples have the density that a model states.

use crate::direction;
use crate::statistics::chi_square;
use glam::DVec3;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use std::f64::consts::TAU;
use velour::math::quadrature::gauss_legendre;
use velour::math::warp::uniform;
use velour::models::Bsdf;
use velour::table::SlabWarp;

/// The azimuth of `wi` in tests, along neither of the axes.
pub const AZIMUTH: f64 = 2.2;

/// The variable in which bins of elevation are equal steps.
enum Axis {
    Slab(SlabWarp),
    CubeRoot,
}

/// Bins of directions: elevations along an axis, azimuths around the whole circle from that of `wi`.
pub struct Bins {
    axis: Axis,
    elevations: usize,
    azimuths: usize,
}

impl Bins {
    /// Along the slab table's axis.
    pub fn of_slab(alpha: f64) -> Self {
        Self { axis: Axis::Slab(SlabWarp::new(alpha)), elevations: 31, azimuths: 16 }
    }

    /// Along the cube root of the cosine. Densities that are constant in cells whose numbers divide these are
    /// integrated exactly.
    pub fn of_cube_root(elevations: usize, azimuths: usize) -> Self {
        Self { axis: Axis::CubeRoot, elevations, azimuths }
    }

    pub fn index(&self, wo: DVec3) -> usize {
        let mu = wo.z.min(1.0);
        let place = match &self.axis {
            Axis::Slab(warp) => warp.place(mu),
            Axis::CubeRoot => mu.cbrt(),
        };
        let phi = (wo.y.atan2(wo.x) - AZIMUTH).rem_euclid(TAU) / TAU;
        let bin = |x: f64, bins: usize| ((x * bins as f64) as usize).min(bins - 1);
        bin(place, self.elevations) * self.azimuths + bin(phi, self.azimuths)
    }

    /// The integration variable at a place, the cosine there, and the variable's slope over the cosine.
    fn variable(&self, place: f64) -> f64 {
        match self.axis {
            Axis::Slab(_) => SlabWarp::root_from_place(place),
            Axis::CubeRoot => place,
        }
    }

    fn mu_and_slope(&self, variable: f64) -> (f64, f64) {
        match &self.axis {
            Axis::Slab(warp) => {
                let mu = warp.mu(variable);
                (mu, warp.root_slope(mu))
            }
            Axis::CubeRoot => (variable.powi(3), 1.0 / (3.0 * variable * variable)),
        }
    }

    /// The integral of a function of directions over each bin, by Gauss nodes on its halves or, at the horizon, on ever
    /// thinner parts.
    pub fn integrals(&self, value: impl Fn(DVec3) -> f64) -> Vec<f64> {
        let mut integrals = vec![0.0; self.elevations * self.azimuths];
        let width = TAU / self.azimuths as f64;
        for elevation in 0..self.elevations {
            let parts: Vec<f64> = match elevation {
                0 => [0.0].into_iter().chain((0..12).rev().map(|k| 0.25_f64.powi(k))).collect(),
                _ => vec![0.0, 0.5, 1.0],
            };
            let variable = |part: f64| self.variable((elevation as f64 + part) / self.elevations as f64);
            for edges in parts.windows(2) {
                for (variable, weight) in gauss_legendre(4, variable(edges[0]), variable(edges[1])) {
                    let (mu, slope) = self.mu_and_slope(variable);
                    for azimuth in 0..self.azimuths {
                        let edges = [azimuth, azimuth + 1].map(|k| k as f64 * width);
                        for (phi, phi_weight) in gauss_legendre(6, edges[0], edges[1]) {
                            integrals[elevation * self.azimuths + azimuth] +=
                                weight * phi_weight / slope * value(direction(mu, AZIMUTH + phi));
                        }
                    }
                }
            }
        }
        integrals
    }

    /// The probability that samples of a density as `said` lie as far from it as those of `sampled` do.
    pub fn probability(&self, sampled: &dyn Bsdf, said: &dyn Bsdf, mu: f64) -> f64 {
        let wi = direction(mu, AZIMUTH);
        let mut rng = Pcg64::seed_from_u64(31);
        let mut counts = vec![0; self.elevations * self.azimuths];
        for _ in 0..200_000 {
            let sample = sampled.sample(wi, [(); 2].map(|()| uniform(&mut rng))).expect("a lobe");
            counts[self.index(sample.wo)] += 1;
        }
        // The quadrature's error is a tenth of the noise.
        chi_square(&counts, &self.integrals(|wo| said.pdf(wi, wo)), 2e-4)
    }
}

/// The message of a call that must panic.
pub fn message(wrong: &(dyn Fn() + std::panic::RefUnwindSafe)) -> String {
    let caught = std::panic::catch_unwind(wrong).expect_err("a mistake");
    caught.downcast_ref::<String>().expect("a message").clone()
}

/// Fails unless a model panics on mistakes in its calls.
pub fn assert_calls_are_checked(model: &(dyn Bsdf + std::panic::RefUnwindSafe)) {
    let up = direction(0.5, 0.0);
    // The square of the length may be off by 1e-5: half of that is let pass, a little more is not.
    for near in [up * (1.0 + 2.5e-6), up * (1.0 - 2.5e-6)] {
        model.evaluate(near, up);
        model.pdf(up, near);
        model.sample(near, [0.5; 2]);
    }
    let wrong_lengths = [1.0 + 6e-6, 1.0 - 6e-6, 1.01].map(|length| length * up);
    for wrong in [DVec3::NAN, DVec3::ZERO, DVec3::new(f64::INFINITY, 0.0, 0.5)].into_iter().chain(wrong_lengths) {
        assert!(message(&|| _ = model.evaluate(wrong, up)).contains("a direction is unit"));
        assert!(message(&|| _ = model.pdf(up, wrong)).contains("a direction is unit"));
        assert!(message(&|| _ = model.sample(wrong, [0.5; 2])).contains("a direction is unit"));
    }
    for right in [1.0 + 4e-6, 1.0 - 4e-6].map(|length| length * up) {
        assert!([model.evaluate(right, right), model.pdf(right, right)].iter().all(|value| value.is_finite()));
    }
    for wrong in [[1.0, 0.5], [0.5, -0.1], [f64::NAN, 0.5]] {
        assert!(message(&|| _ = model.sample(up, wrong)).contains("uniform numbers are in [0, 1)"));
    }
    assert!(message(&|| _ = model.albedo(1.5)).contains("mu is in [0, 1]"));
}
