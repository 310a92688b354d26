//! The deterministic solution: against itself on other meshes, against the walk, and against what is known from
//! elsewhere.

use crate::direction;
use crate::statistics::{REJECTED, SIGNIFICANCE, assert_within, chi_square};
use glam::DVec3;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use std::f64::consts::PI;
use velour::fit::hemisphere::Hemisphere;
use velour::math::quadrature::gauss_legendre;
use velour::math::sine;
use velour::physics::modes::Elevation;
use velour::physics::slab::Slab;
use velour::physics::transport::{Resolution, Transport};
use velour::physics::walk::{FirstFlight, Histogram, Walk};

fn solve(alpha: f64, modes: usize, refinement: f64) -> Transport {
    Transport::new(Slab::new(alpha), Resolution { modes, refinement, ridge: None })
}

/// The cosines of the tables' nodes; the first one, 0, is replaced by 1e-3.
fn mus() -> impl Iterator<Item = f64> {
    (0..32).map(|j| (f64::from(j) / 31.0).max(1e-3))
}

fn incident(mu: f64) -> DVec3 {
    direction(mu, 0.0)
}

/// The largest relative differences over `mus` in R, and in the reflected lobe (L2).
fn difference(one: &Transport, other: &Transport, mus: impl Iterator<Item = f64>) -> [f64; 2] {
    let hemisphere = Hemisphere::new(other.cosines());
    let (mut albedo, mut lobe) = (0.0_f64, 0.0_f64);
    for mu in mus {
        albedo = albedo.max((one.albedo(mu) / other.albedo(mu) - 1.0).abs());
        let wi = incident(mu);
        let [mut square, mut norm] = [0.0; 2];
        for (&wo, weight) in hemisphere.nodes.iter().zip(&hemisphere.weights) {
            let truth = other.reflected(wi, wo);
            square += weight * (one.reflected(wi, wo) - truth).powi(2);
            norm += weight * truth * truth;
        }
        lobe = lobe.max((square / norm).sqrt());
    }
    [albedo, lobe]
}

/// The most by which two meshes may differ, relatively, for alpha >= 2/31 and mu >= 1e-3: in R, and in lobes (L2).
/// docs/accuracy.md quotes both.
const MESHES: [f64; 2] = [2e-4, 3e-4];

#[test]
fn two_meshes_agree_at_every_node() {
    let check = |i: f64, [albedo_limit, lobe_limit]: [f64; 2]| {
        let [albedo, lobe] = difference(&solve(i / 31.0, 4, 1.0), &solve(i / 31.0, 4, 1.5), mus());
        assert!(albedo < albedo_limit && lobe < lobe_limit, "alpha {i}/31: R {albedo:.1e}, lobe {lobe:.1e}");
    };
    (2..32).into_par_iter().for_each(|i| check(f64::from(i), MESHES));
    // At lower alpha, the wide panels' polynomials are what limits the lobes.
    check(1.0, [5e-5, 1e-3]);
    check(0.5, [5e-5, 1e-3]);
    let quoted = format!("R within {:e}, lobes (L2) within {:e}", MESHES[0], MESHES[1]);
    assert!(include_str!("../../docs/accuracy.md").contains(&quoted), "docs/accuracy.md does not say '{quoted}'");
}

#[test]
fn at_the_horizon_itself_lobes_agree_less_and_a_coarse_mesh_is_told() {
    for i in [2.0, 8.0, 16.0, 31.0] {
        let [albedo, lobe] = difference(&solve(i / 31.0, 4, 1.0), &solve(i / 31.0, 4, 1.5), [0.0].into_iter());
        assert!(albedo < 1e-4 && lobe < 6e-3, "alpha {i}/31: R {albedo:.1e}, lobe {lobe:.1e}");
    }
    let coarse = difference(&solve(0.3, 4, 0.3), &solve(0.3, 4, 1.5), mus());
    assert!(coarse[0] > MESHES[0] && coarse[1] > MESHES[1], "{coarse:?}");
}

#[test]
fn errors_fall_with_the_mesh_at_high_order() {
    // Eight nodes per panel: order 8 where functions are smooth, and less near the horizon, which affects other cosines
    // by scattering.
    for (alpha, least_order) in [(0.7, 5.0), (0.3, 4.0)] {
        let finest = solve(alpha, 1, 5.0);
        let [coarse, fine] = [0.5, 2.0].map(|refinement| {
            let solution = solve(alpha, 1, refinement);
            [0.3, 0.5, 0.8].map(|mu| (solution.albedo(mu) / finest.albedo(mu) - 1.0).abs())
        });
        let orders = coarse.iter().zip(fine).map(|(coarse, fine)| (coarse / fine).log2() / 2.0);
        let order = orders.sum::<f64>() / 3.0;
        assert!(order > least_order, "alpha {alpha}: order {order:.1} from {coarse:?} to {fine:?}");
        assert!(fine.iter().all(|error| *error < 1e-6), "alpha {alpha}: {fine:?}");
    }
}

#[test]
fn errors_fall_with_the_number_of_modes() {
    for alpha in [0.1, 0.3, 0.6] {
        let all = solve(alpha, 12, 1.0);
        let errors = [1, 2, 3, 4, 6].map(|modes| difference(&solve(alpha, modes, 1.0), &all, mus())[1]);
        // Single scattering is exact. The rest is smooth in azimuth, and each further mode leaves a fraction of what
        // the last one left.
        assert!(errors.windows(2).all(|pair| pair[1] < 0.5 * pair[0]), "alpha {alpha}: {errors:?}");
        assert!(errors[1] < 4e-3 && errors[3] < 3e-4, "alpha {alpha}: {errors:?}");
        println!("alpha {alpha}: relative L2 error with 1, 2, 3, 4, 6 modes {errors:?}");
    }
}

/// R of an isotropically scattering slab of depth 1, from the density of its collisions over depth: C = first + 1/2
/// integral of E_1(|t - t'|) C(t') dt', taken as constant in each of `n` cells. It has no elevations.
fn isotropic_albedo(mu: f64, n: usize) -> f64 {
    let h = 1.0 / n as f64;
    // E_2 and E_3 as integrals over the cosine; x >= 0.
    let rule: Vec<(f64, f64)> = gauss_legendre(80, 0.0, 1.0);
    let moment = |x: f64, power: i32| -> f64 {
        rule.iter().map(|(t, w)| (t * t, 2.0 * t * w)).map(|(m, w)| w * m.powi(power) * (-x / m).exp()).sum()
    };
    let e3: Vec<f64> = (0..=n + 1).map(|k| moment(k as f64 * h, 1)).collect();
    // The mean over one cell of half the integral of E_1 over another, k cells apart: second differences of E_3.
    let coupling = |k: usize| {
        if k == 0 { 1.0 - (e3[0] - e3[1]) / h } else { 0.5 * (e3[k - 1] - 2.0 * e3[k] + e3[k + 1]) / h }
    };
    let first = DVector::from_fn(n, |i, _| ((-(i as f64) * h / mu).exp() - (-((i + 1) as f64) * h / mu).exp()) / h);
    let matrix = DMatrix::from_fn(n, n, |i, j| f64::from(i == j) - coupling(i.abs_diff(j)));
    let density = matrix.lu().solve(&first).expect("light leaves: the matrix is regular");
    density.iter().enumerate().map(|(i, density)| density * 0.5 * (e3[i] - e3[i + 1])).sum()
}

#[test]
fn the_isotropic_slab_agrees_with_its_solution_over_depth() {
    let slab = solve(1.0, 1, 1.0);
    for mu in [1.0, 0.5, 0.1, 0.01] {
        // Piecewise constant functions converge at second order, so that two resolutions give the limit.
        let [coarse, fine] = [150, 300].map(|n| isotropic_albedo(mu, n));
        let truth = fine + (fine - coarse) / 3.0;
        assert!((slab.albedo(mu) / truth - 1.0).abs() < 3e-5, "mu {mu}: {}, {truth}", slab.albedo(mu));
    }
}

#[test]
fn albedos_are_the_known_ones() {
    // From walks of 1e8 paths or more by another program, each known to 5e-5.
    let known = [(1.0, 1.0, 0.3413), (1.0, 0.01, 0.7498), (0.7, 0.4, 0.3768), (0.5, 0.5, 0.1535), (0.3, 0.15, 0.3274)];
    for (alpha, mu, truth) in known {
        let albedo = solve(alpha, 1, 1.0).albedo(mu);
        assert!((albedo - truth).abs() < 1e-4, "alpha {alpha}, mu {mu}: {albedo}, {truth}");
    }
}

/// 34 cells from all of the table that a walk can resolve, low alpha included: R is from 3e-4 to 0.88.
const CELLS: [(u32, &[u32]); 8] = [
    (1, &[0, 1]),
    (2, &[0, 1, 2, 3]),
    (3, &[0, 1, 3, 5]),
    (4, &[0, 2, 5, 8]),
    (8, &[0, 3, 7, 14, 31]),
    (14, &[0, 4, 10, 20, 31]),
    (22, &[0, 5, 12, 21, 31]),
    (31, &[0, 3, 9, 18, 31]),
];

/// How many of the walk's standard errors the solver's R at (`solved`, mu) is off the walk's R at (`alpha`, mu).
fn off_the_walk(alpha: f64, mu: f64, solved: f64) -> f64 {
    let slab = Slab::new(alpha);
    let walk = Walk { slab, mu, first_flight: FirstFlight::Scattered, paths: 300_000, seed: 21 };
    let counts = walk.run().reflected_more.total() as f64;
    assert!(counts > 90.0, "alpha {alpha}, mu {mu}: {counts} paths are too few");
    let walked = slab.single_scattering_albedo(mu) + counts * walk.share();
    // The standard error of a binomial distribution.
    let error = walk.share() * (counts * (1.0 - counts / walk.paths as f64)).sqrt();
    (solve(solved, 1, 1.0).albedo(mu) - walked) / error
}

#[test]
fn albedos_agree_with_the_walk() {
    let mut all = 0;
    for (i, js) in CELLS {
        for &j in js {
            let (alpha, mu) = (f64::from(i) / 31.0, (f64::from(j) / 31.0).max(1e-3));
            let off = off_the_walk(alpha, mu, alpha);
            assert!(off.abs() < 3.0, "alpha {i}/31, mu {j}/31: {off:.2} standard errors");
            all += 1;
        }
    }
    assert!(
        include_str!("../../docs/accuracy.md").contains(&format!("R in {all} cells")),
        "docs/accuracy.md does not say {all} cells"
    );
    // The ruler notices 2% of alpha.
    assert!(off_the_walk(0.5, 0.5, 0.51).abs() > 5.0 && off_the_walk(0.2, 0.1, 0.204).abs() > 5.0);
}

/// The shares of multiply scattered light in the walk's bins, from a lobe over the cosine and azimuth of `wo`.
fn shares(nodes: usize, lobe: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let mut shares = Vec::new();
    for row in 0..Histogram::MU_BINS {
        let [low, high] = Histogram::mu_range(row);
        for column in 0..Histogram::PHI_BINS {
            let [first, last] = Histogram::phi_range(column);
            let mut share = 0.0;
            for (mu_o, mu_weight) in gauss_legendre(nodes, low, high) {
                for (phi, phi_weight) in gauss_legendre(3, first, last) {
                    share += 2.0 * mu_weight * phi_weight * lobe(mu_o, phi);
                }
            }
            shares.push(share.max(0.0));
        }
    }
    let whole: f64 = shares.iter().sum();
    shares.iter_mut().for_each(|share| *share /= whole);
    shares
}

fn lobe_probability(walked: (f64, f64), solved: (f64, f64)) -> f64 {
    let (alpha, mu) = walked;
    let walk = Walk { slab: Slab::new(alpha), mu, first_flight: FirstFlight::Scattered, paths: 300_000, seed: 22 };
    let counts: Vec<u64> = walk.run().reflected_more.bins().flatten().copied().collect();
    let (solution, wi) = (solve(solved.0, 6, 1.0), incident(solved.1));
    chi_square(&counts, &shares(3, |mu_o, phi| solution.multiple_reflected(wi, direction(mu_o, phi))), 1e-9)
}

#[test]
fn lobes_agree_with_the_walks_histogram() {
    let cells = [
        (1.0 / 31.0, 1e-3),
        (1.0 / 31.0, 1.0 / 31.0),
        (2.0 / 31.0, 2.0 / 31.0),
        (0.1, 0.1),
        (0.15, 0.3),
        (0.2, 0.01),
        (0.3, 0.5),
        (0.5, 0.2),
        (0.7, 1.0),
        (1.0, 0.1),
    ];
    for cell in cells {
        let p = lobe_probability(cell, cell);
        assert!(p > SIGNIFICANCE, "alpha, mu {cell:?}: p = {p:.1e}");
    }
}

#[test]
fn another_slabs_lobe_is_told() {
    for other in [(0.53, 0.2), (0.5, 0.3)] {
        let p = lobe_probability((0.5, 0.2), other);
        assert!(p < REJECTED, "(0.5, 0.2) is taken for {other:?}: p = {p:.1e}");
    }
}

#[test]
fn light_is_neither_lost_nor_gained() {
    // The transmittance is the remainder by definition; the transmitted lobe, another part of the solution, has to
    // agree with it.
    for (alpha, mu) in [(1.0, 0.7), (0.8, 0.2), (0.6, 1.0), (0.5, 0.05)] {
        let solution = Transport::new(Slab::new(alpha), Resolution { ridge: Some(mu), modes: 1, refinement: 4.0 });
        let below: f64 = solution
            .cosines()
            .map(|(mu_o, weight)| {
                let [one, other] = [mu, mu_o].map(Elevation::from_cosine);
                let mut single = [0.0];
                solution.slab().medium().kernel_modes(one, other, &mut single);
                let once = single[0] * solution.slab().transmitted_once(one, other) * mu_o;
                2.0 * PI * weight * (once + solution.multiple_transmitted(incident(mu), direction(-mu_o, 0.3)))
            })
            .sum();
        let sum = solution.albedo(mu) + below + solution.slab().unscattered(mu);
        assert!((sum - 1.0).abs() < 1e-4, "alpha {alpha}, mu {mu}: {sum}");
        let all = solution.albedo(mu) + solution.transmittance(mu) + solution.slab().unscattered(mu);
        assert!((all - 1.0).abs() < 1e-15);
    }
}

#[test]
fn a_reflected_lobe_holds_its_albedo_and_a_transmitted_one_its_transmittance() {
    for (alpha, mu) in [(1.0, 0.7), (0.5, 0.2), (0.3, 0.05), (0.2, 0.6)] {
        let resolution = Resolution { ridge: Some(mu), ..Default::default() };
        let solution = Transport::new(Slab::new(alpha), resolution);
        let hemisphere = Hemisphere::new(solution.cosines());
        let wi = incident(mu);
        let reflected = hemisphere.integral(|node| solution.reflected(wi, hemisphere.nodes[node]));
        assert!((reflected / solution.albedo(mu) - 1.0).abs() < 1e-4, "alpha {alpha}, mu {mu}: {reflected}");
        let below = |node: usize| DVec3::new(1.0, 1.0, -1.0) * hemisphere.nodes[node];
        let transmitted = hemisphere.integral(|node| solution.transmitted(wi, below(node)));
        let transmittance = solution.transmittance(mu);
        assert!(
            (transmitted / transmittance - 1.0).abs() < 2e-3,
            "alpha {alpha}, mu {mu}: {transmitted}, {transmittance}"
        );
    }
}

#[test]
fn reciprocity_holds_to_round_off() {
    for alpha in [1.0, 0.3, 0.1, 1.0 / 31.0] {
        let solution = solve(alpha, 4, 1.0);
        for (one, other) in [(0.9, 0.2), (0.5, 0.51), (0.03, 0.7), (1.0, 0.1)] {
            let (wi, wo) = (incident(one), DVec3::new(-0.6 * sine(other), 0.8 * sine(other), other));
            let (there, back) = (solution.reflected(wi, wo) * wi.z, solution.reflected(wo, wi) * wo.z);
            assert!((there / back - 1.0).abs() < 1e-11, "alpha {alpha}, {one}, {other}: {there:e}, {back:e}");
        }
    }
}

#[test]
fn a_thin_slab_scatters_once() {
    for alpha in [1.0, 0.3, 0.1] {
        for mu in [1.0, 0.3] {
            let excess = [1e-3, 1e-4].map(|thickness| {
                let slab = Slab::new(alpha).with_thickness(thickness);
                let solution = Transport::new(slab, Resolution { modes: 1, ..Default::default() });
                solution.albedo(mu) / slab.single_scattering_albedo(mu) - 1.0
            });
            // The rest is of the order of the thickness times its logarithm.
            assert!(excess[1] > 0.0 && excess[1] < 5e-3, "alpha {alpha}, mu {mu}: {excess:?}");
            assert!((4.0..11.0).contains(&(excess[0] / excess[1])), "alpha {alpha}, mu {mu}: {excess:?}");
        }
    }
}

#[test]
fn dim_albedos_are_clean() {
    // Towards sigma = 0 the lobes of steep light fall off as sigma^3 = alpha^6, and their shape stays the same.
    let [a, b, c] = [0.02, 0.01, 0.005].map(|alpha| solve(alpha, 1, 1.0).albedo(1.0) / f64::powi(alpha, 6));
    assert!((1.4e-12..1.4e-10).contains(&(a * 0.02_f64.powi(6))), "R(0.02, 1) = {:e}", a * 0.02_f64.powi(6));
    assert!((b / a - 1.0).abs() < 0.1 && (c / b - 1.0).abs() < 0.05 && (c / b - 1.0).abs() < (b / a - 1.0).abs());
    let difference = solve(0.01, 1, 1.0).albedo(1.0) / solve(0.01, 1, 1.5).albedo(1.0) - 1.0;
    assert!(difference.abs() < 1e-5, "two meshes: {difference:e}");
}

#[test]
fn the_limit_at_the_horizon_is_reached() {
    // The limit grows towards 1 as alpha falls; the first is known to three digits.
    let limits = [1.0 / 31.0, 0.01, 0.005].map(|alpha| {
        let [one, other] = [1.0, 1.5].map(|refinement| solve(alpha, 1, refinement));
        let [limit, again] = [&one, &other].map(|solution| solution.albedo(0.0));
        assert!((limit / again - 1.0).abs() < 1e-4, "alpha {alpha}: {limit}, {again}");
        let [near, nearer] = [1e-5, 1e-7].map(|mu| limit - one.albedo(mu));
        assert!(nearer > 0.0 && nearer < near && nearer < 2e-3, "alpha {alpha}: {near:e}, {nearer:e}");
        limit
    });
    assert!((limits[0] - 0.880).abs() < 1e-3 && limits[0] < limits[1] && limits[1] < limits[2], "{limits:?}");
}

/// The probability of a walk's transmitted counts, of their number and of their directions, under the solution with its
/// azimuth turned by `turn`.
fn transmitted_probability(alpha: f64, mu: f64, turn: f64) -> f64 {
    let solution = Transport::new(Slab::new(alpha), Resolution { ridge: Some(mu), modes: 8, refinement: 1.0 });
    let walk = Walk { slab: *solution.slab(), mu, first_flight: FirstFlight::Analog, paths: 400_000, seed: 23 };
    let counts = walk.run();
    let transmitted = counts.transmitted() as f64 * walk.share();
    let error = (transmitted * (1.0 - transmitted) * walk.share()).sqrt();
    assert_within(solution.transmittance(mu), transmitted, error, 3.0, &format!("alpha {alpha}, mu {mu}"));
    let more: Vec<u64> = counts.transmitted_more.bins().flatten().copied().collect();
    let lobe = |mu_o: f64, phi: f64| solution.multiple_transmitted(incident(mu), direction(-mu_o, phi + turn));
    chi_square(&more, &shares(6, lobe), 1e-9)
}

#[test]
fn the_transmitted_lobe_agrees_with_the_walks_histogram() {
    for (alpha, mu) in [(1.0, 0.5), (0.7, 0.9), (0.5, 0.2)] {
        let p = transmitted_probability(alpha, mu, 0.0);
        assert!(p > SIGNIFICANCE, "alpha {alpha}, mu {mu}: p = {p:.1e}");
    }
    // The lobe's other side is rejected.
    assert!(transmitted_probability(0.5, 0.2, PI) < REJECTED);
}

#[test]
fn transmission_is_reciprocal() {
    for alpha in [1.0, 0.5] {
        let solution = solve(alpha, 4, 2.0);
        for (one, other) in [(0.9, 0.2), (0.3, 0.6)] {
            let there = solution.transmitted(incident(one), -direction(other, 0.5)) * one;
            let back = solution.transmitted(incident(other), -direction(one, 0.5)) * other;
            assert!((there / back - 1.0).abs() < 1e-5, "alpha {alpha}, {one}, {other}: {there}, {back}");
        }
    }
}

#[test]
fn the_same_slab_gives_the_same_bits() {
    let [one, other] = [(); 2].map(|()| solve(0.3, 4, 1.0));
    let (wi, wo) = (incident(0.4), incident(0.7));
    assert_eq!(one.reflected(wi, wo).to_bits(), other.reflected(wi, wo).to_bits());
}
