use crate::direction;
use crate::statistics::{REJECTED, SIGNIFICANCE, chi_square};
use glam::DVec3;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use std::f64::consts::{FRAC_PI_2, PI};
use velour::math::quadrature::gauss_legendre;
use velour::physics::modes::Elevation;
use velour::physics::sggx::Sggx;

const SIGMAS: [f64; 4] = [1.0, 0.25, 0.04, 1.0 / (31.0 * 31.0)];
const COSINES: [f64; 5] = [1.0, 0.6, 0.05, 1e-3, -0.3];

/// Edges over [from, to] that approach `center`, halving the distance each time, down to 2^-`halvings` of the way.
fn graded(from: f64, to: f64, center: f64, halvings: i32) -> Vec<f64> {
    let steps = |end: f64| (0..=halvings).map(move |k| center + (end - center) * 0.5_f64.powi(k));
    let mut edges: Vec<f64> = steps(from).chain([center]).chain(steps(to)).collect();
    edges.sort_by(f64::total_cmp);
    edges.dedup();
    edges
}

/// Bins of directions by elevation angle and |azimuth|, fine around straight on, where the phase function has its peak.
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

    /// The phase function's integral over each bin, with `nodes` Gauss nodes along each side.
    fn integrals(&self, medium: &Sggx, back: DVec3, nodes: usize) -> Vec<f64> {
        let mut integrals = Vec::new();
        for elevation in self.elevations.windows(2) {
            for azimuth in self.azimuths.windows(2) {
                let mut sum = 0.0;
                for (e, e_weight) in gauss_legendre(nodes, elevation[0], elevation[1]) {
                    for (phi, phi_weight) in gauss_legendre(nodes, azimuth[0], azimuth[1]) {
                        // Twice, for the mirrored half.
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
            // The error of the innermost bins, where the flakes' density jumps from direction to direction.
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
            // Both rules err at the kink of max(0, .).
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

#[test]
fn kernel_modes_are_the_kernels_fourier_integrals() {
    for sigma in [1.0, 0.25, 0.04] {
        let medium = Sggx::new(sigma);
        for (mu, mu_before) in [(0.5, 0.2), (-0.4, 0.7), (0.3, 0.31), (0.0, 0.6), (1.0, 0.3)] {
            let [one, other] = [mu, mu_before].map(Elevation::from_cosine);
            let mut modes = [0.0; 6];
            medium.kernel_modes(one, other, &mut modes);
            // Periodic and analytic: equidistant azimuths converge geometrically.
            let n = 20_000;
            let azimuths = (0..n).map(|k| 2.0 * PI * f64::from(k) / f64::from(n));
            let values: Vec<(f64, f64)> =
                azimuths.map(|phi| (phi, medium.kernel(-direction(mu_before, 0.0), direction(mu, phi)))).collect();
            for (m, mode) in modes.into_iter().enumerate() {
                let integral =
                    values.iter().map(|(phi, value)| value * (m as f64 * phi).cos()).sum::<f64>() / f64::from(n);
                assert!((mode - integral).abs() < 1e-12 * modes[0], "sigma {sigma}, {mu}, {mu_before}: K_{m}");
            }
        }
    }
}

#[test]
fn mode_0_of_the_kernel_sums_to_the_extinction() {
    for sigma in SIGMAS {
        let medium = Sggx::new(sigma);
        for mu in COSINES {
            let node = Elevation::from_cosine(mu);
            let edges = graded(-FRAC_PI_2, FRAC_PI_2, mu.asin(), 34);
            let mut sum = 0.0;
            for edge in edges.windows(2) {
                for (angle, weight) in gauss_legendre(12, edge[0], edge[1]) {
                    let mut mode = [0.0];
                    medium.kernel_modes(node, Elevation::from_angle(angle), &mut mode);
                    sum += 2.0 * PI * weight * angle.cos() * mode[0];
                }
            }
            assert!((sum / medium.extinction(mu) - 1.0).abs() < 1e-9, "sigma {sigma}, mu {mu}: {sum}");
        }
    }
}

#[test]
fn the_kernels_tail_keeps_its_digits() {
    // Far from the peak K_0 is (a^2 + b^2 / 2) / (4 pi sigma k^2) up to a / k: as a difference of three terms it would be noise.
    for sigma in [1e-3, 1e-4] {
        for (mu, mu_before) in [(0.8, 0.1), (-0.2, 0.3), (1.0, 0.05)] {
            let [one, other] = [mu, mu_before].map(Elevation::from_cosine);
            let (a, b) = (1.0 - mu * mu_before, one.s * other.s);
            let k = (1.0 - sigma * sigma) * (mu - mu_before).powi(2) / (2.0 * sigma * sigma);
            let mut modes = [0.0; 2];
            Sggx::new(sigma).kernel_modes(one, other, &mut modes);
            let tail = (a * a + b * b / 2.0) / (4.0 * PI * sigma * k * k);
            assert!((modes[0] / tail - 1.0).abs() < 4.0 * a / k, "sigma {sigma}: {:e}, {tail:e}", modes[0]);
            assert!((modes[1] + a * b / (4.0 * PI * sigma * k * k)).abs() < 8.0 * a / k * tail, "sigma {sigma}: K_1");
        }
    }
}

#[test]
fn along_one_elevation_the_kernel_is_the_same_for_every_azimuth() {
    let node = Elevation::from_cosine(0.3);
    let mut modes = [1.0; 3];
    Sggx::new(0.04).kernel_modes(node, node, &mut modes);
    assert_eq!(modes, [1.0 / (4.0 * PI * 0.04), 0.0, 0.0]);
}

#[test]
fn kernel_modes_are_finite_however_near_elevations_are() {
    for sigma in [1.0, 0.04, 1e-4] {
        for (mu, other) in
            [(0.0, 1e-105), (0.0, 1e-120), (0.0, 1e-160), (0.0, 0.0), (1.0, 1.0), (1.0, -1.0), (0.5, 0.5 + 1e-16)]
        {
            let mut modes = [f64::NAN; 4];
            Sggx::new(sigma).kernel_modes(Elevation::from_cosine(mu), Elevation::from_cosine(other), &mut modes);
            assert!(
                modes.iter().all(|mode| mode.is_finite()) && modes[0] > 0.0,
                "sigma {sigma}, {mu}, {other}: {modes:?}"
            );
        }
    }
}
