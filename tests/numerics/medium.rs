use crate::statistics::{REJECTED, SIGNIFICANCE, chi_square};
use glam::DVec3;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use std::f64::consts::{FRAC_PI_2, PI};
use velour::math::quadrature::gauss_legendre;
use velour::physics::sggx::Sggx;

const SIGMAS: [f64; 4] = [1.0, 0.25, 0.04, 1.0 / (31.0 * 31.0)];
const COSINES: [f64; 5] = [1.0, 0.6, 0.05, 1e-3, -0.3];

fn direction(mu: f64, phi: f64) -> DVec3 {
    let s = ((1.0 - mu) * (1.0 + mu)).sqrt();
    DVec3::new(s * phi.cos(), s * phi.sin(), mu)
}

/// Edges over [from, to] that close in on `center` by halves, down to 2^-`halvings` of the way.
fn graded(from: f64, to: f64, center: f64, halvings: i32) -> Vec<f64> {
    let steps = |end: f64| (0..=halvings).map(move |k| center + (end - center) * 0.5_f64.powi(k));
    let mut edges: Vec<f64> = steps(from).chain([center]).chain(steps(to)).collect();
    edges.sort_by(f64::total_cmp);
    edges.dedup();
    edges
}

/// Bins of directions by elevation angle and |azimuth|, fine around the way straight on, where the phase function is.
struct Bins {
    elevations: Vec<f64>,
    azimuths: Vec<f64>,
}

impl Bins {
    fn around(back: DVec3, halvings: i32) -> Self {
        let straight_on = (-back.z).asin();
        Self {
            elevations: graded(-FRAC_PI_2, FRAC_PI_2, straight_on, halvings),
            azimuths: graded(0.0, PI, PI, halvings),
        }
    }

    /// The phase function's integral over each bin, `nodes` Gauss nodes a side.
    fn integrals(&self, medium: &Sggx, back: DVec3, nodes: usize) -> Vec<f64> {
        let mut integrals = Vec::new();
        for elevation in self.elevations.windows(2) {
            for azimuth in self.azimuths.windows(2) {
                let mut sum = 0.0;
                for (e, e_weight) in gauss_legendre(nodes, elevation[0], elevation[1]) {
                    for (phi, phi_weight) in gauss_legendre(nodes, azimuth[0], azimuth[1]) {
                        // Twice for the mirrored half.
                        let measure = 2.0 * e.cos() * e_weight * phi_weight;
                        sum += measure * medium.phase(back, direction(e.sin(), phi));
                    }
                }
                integrals.push(sum);
            }
        }
        integrals
    }

    fn count(&self, medium: &Sggx, back: DVec3, samples: u64, seed: u64) -> Vec<u64> {
        let mut rng = Pcg64::seed_from_u64(seed);
        let columns = self.azimuths.len() - 1;
        let mut counts = vec![0; (self.elevations.len() - 1) * columns];
        for _ in 0..samples {
            let out = medium.sample(back, &mut rng);
            assert!((out.length() - 1.0).abs() < 1e-12, "a sample of unit length: {out}");
            let bin = |edges: &[f64], x: f64| (edges.partition_point(|&edge| edge <= x)).clamp(1, edges.len() - 1) - 1;
            let row = bin(&self.elevations, out.z.clamp(-1.0, 1.0).asin());
            counts[row * columns + bin(&self.azimuths, out.y.abs().atan2(out.x))] += 1;
        }
        counts
    }
}

#[test]
fn phase_function_is_normalised() {
    for sigma in SIGMAS {
        for mu in COSINES {
            let (medium, back) = (Sggx::new(sigma), direction(mu, 0.0));
            let integral: f64 = Bins::around(back, 16).integrals(&medium, back, 12).iter().sum();
            // The innermost bins, where the flakes' density jumps from direction to direction, leave this much.
            assert!((integral - 1.0).abs() < 2e-5, "sigma {sigma}, mu {mu}: {integral}");
        }
    }
}

#[test]
fn extinction_is_the_flakes_projected_area() {
    for sigma in SIGMAS {
        for mu in COSINES {
            let (medium, w) = (Sggx::new(sigma), direction(mu, 0.0));
            let edges = graded(-FRAC_PI_2, FRAC_PI_2, 0.0, 16);
            let mut area = 0.0;
            for panel in edges.windows(2) {
                for (e, e_weight) in gauss_legendre(12, panel[0], panel[1]) {
                    let azimuths = 2_000;
                    let step = PI / f64::from(azimuths);
                    for k in 0..azimuths {
                        let seen = w.dot(direction(e.sin(), (f64::from(k) + 0.5) * step)).max(0.0);
                        area += 2.0 * step * e_weight * e.cos() * medium.flake_density(e.sin()) * seen;
                    }
                }
            }
            let extinction = medium.extinction(mu);
            // The kink of max(0, .) under both rules.
            assert!((area / extinction - 1.0).abs() < 1e-4, "sigma {sigma}, mu {mu}: {area} against {extinction}");
        }
    }
}

#[test]
fn kernel_is_symmetric() {
    let medium = Sggx::new(0.04);
    let (one, other) = (direction(0.3, 0.0), direction(-0.2, 2.0));
    assert_eq!(medium.kernel(one, other), medium.kernel(other, one));
    let unlike = medium.phase(one, other) / medium.phase(other, one);
    assert!((unlike - medium.extinction(-0.2) / medium.extinction(0.3)).abs() < 1e-12);
}

#[test]
fn sampling_agrees_with_evaluation() {
    for (seed, sigma) in (1..).zip(SIGMAS) {
        for mu in COSINES {
            let (medium, back) = (Sggx::new(sigma), direction(mu, 0.0));
            let bins = Bins::around(back, 8);
            let counts = bins.count(&medium, back, 200_000, seed);
            // The innermost bins' quadrature errs by less than a tenth of the noise.
            let p = chi_square(&counts, &bins.integrals(&medium, back, 24), 3e-4);
            assert!(p > SIGNIFICANCE, "sigma {sigma}, mu {mu}: p = {p:.1e}");
        }
    }
}

#[test]
fn a_wrong_phase_function_is_told() {
    for sigma in [0.25, 0.04] {
        let back = direction(0.6, 0.0);
        let bins = Bins::around(back, 8);
        let counts = bins.count(&Sggx::new(sigma), back, 200_000, 7);
        for wrong in [Sggx::new(sigma * 1.05), Sggx::new(sigma * 0.95)] {
            let p = chi_square(&counts, &bins.integrals(&wrong, back, 24), 3e-4);
            assert!(p < REJECTED, "sigma {sigma} taken for {}: p = {p:.1e}", wrong.sigma());
        }
    }
}
