use glam::DVec3;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};
use velour::fit::hemisphere::Hemisphere;
use velour::fit::lobe::Lobes;
use velour::fit::sheen;
use velour::fit::sheen::albedo::{self, Albedos};
use velour::fit::sheen::least_squares::{Free, LEAST_A, density_and_slopes, fit, squared_error};
use velour::physics::slab::Slab;
use velour::physics::transport::{Resolution, Transport};
use velour::table::{Ltc, SheenTable};

const SOME: [Ltc; 5] = [
    Ltc::sheen(1.0, 0.0),
    Ltc::sheen(0.5, -0.2),
    Ltc::sheen(0.1, -0.15),
    Ltc::sheen(0.02, -0.1),
    Ltc::sheen(0.004, -0.04),
];

fn lobes(alpha: f64) -> Lobes {
    Lobes::new(Transport::new(Slab::new(alpha), Resolution::default()))
}

/// A quadrature as fine as the narrowest of [`SOME`] needs.
fn hemisphere() -> Hemisphere {
    Hemisphere::new(Transport::new(Slab::new(0.05), Resolution { modes: 1, ..Default::default() }).cosines())
}

#[test]
fn density_integrates_to_one() {
    let hemisphere = hemisphere();
    for ltc in SOME {
        let integral = hemisphere.integral(|node| ltc.density(hemisphere.nodes[node]));
        // The quadrature's error, which is largest for the narrowest.
        assert!((integral - 1.0).abs() < 1e-3, "{ltc:?}: {integral}");
    }
}

#[test]
fn density_is_the_cosines_at_the_identity() {
    let wo = DVec3::new(0.48, 0.6, 0.64);
    assert!((Ltc::sheen(1.0, 0.0).density(wo) - 0.64 / std::f64::consts::PI).abs() < 1e-15);
}

#[test]
fn slopes_are_the_densitys() {
    let wo = DVec3::new(0.48, 0.6, 0.64);
    let step = 1e-5;
    for Ltc { a, b, .. } in SOME {
        let at = |ln_a: f64, b: f64| Ltc::sheen(ln_a.exp(), b).density(wo);
        let (density, slopes) = density_and_slopes(Ltc::sheen(a, b), wo);
        let by_ln_a = (at(a.ln() + step, b) - at(a.ln() - step, b)) / (2.0 * step);
        let by_b = (at(a.ln(), b + step) - at(a.ln(), b - step)) / (2.0 * step);
        for (slope, difference) in slopes.into_iter().zip([by_ln_a, by_b]) {
            // Central differences: step^2 times a third derivative of some tens.
            assert!((slope - difference).abs() < 1e-7 * density.max(slope.abs()), "{a}, {b}: {slope}, {difference}");
        }
    }
}

#[test]
fn a_transformed_cosine_is_fitted_by_itself() {
    let hemisphere = hemisphere();
    for truth in SOME {
        let shape: Vec<f64> = hemisphere.nodes.iter().map(|&wo| truth.density(wo)).collect();
        let start = Ltc::sheen(truth.a * 1.5, truth.b - 0.1);
        let found = fit(&shape, &hemisphere, start, Free::Both);
        assert!((found.a / truth.a - 1.0).abs() < 1e-6 && (found.b - truth.b).abs() < 1e-6, "{truth:?}: {found:?}");
    }
}

#[test]
fn fitted_b_is_not_above_0() {
    let hemisphere = hemisphere();
    let leaning_away = Ltc::sheen(0.5, 0.2);
    let shape: Vec<f64> = hemisphere.nodes.iter().map(|&wo| leaning_away.density(wo)).collect();
    let found = fit(&shape, &hemisphere, Ltc::sheen(1.0, -0.1), Free::Both);
    assert_eq!(found.b, 0.0);
    assert!(found.a > LEAST_A);
}

#[test]
fn a_shape_is_its_lobe_over_its_albedo() {
    for (alpha, mu) in [(0.8, 0.9), (0.3, 0.2), (0.1, 0.01), (0.2, 1.0)] {
        let lobes = lobes(alpha);
        let shape = lobes.shape(mu);
        assert!((lobes.hemisphere.integral(|node| shape[node]) - 1.0).abs() < 1e-4, "alpha {alpha}, mu {mu}");
        let wi = DVec3::new((1.0_f64 - mu * mu).sqrt(), 0.0, mu);
        for node in [5, 400, 1100, shape.len() - 3] {
            let lobe = lobes.transport.reflected(wi, lobes.hemisphere.nodes[node]) / lobes.transport.albedo(mu);
            assert!((shape[node] / lobe - 1.0).abs() < 1e-9, "alpha {alpha}, mu {mu}, node {node}");
        }
    }
}

#[test]
fn a_fit_is_the_minimum_from_wherever_it_starts() {
    let starts = [(1.0, 0.0), (0.5, -0.3), (0.1, -0.1), (0.02, 0.0), (0.3, -0.01)];
    [(0.8, 0.9), (0.5, 0.5), (0.2, 0.05), (0.1, 0.01), (1.0 / 31.0, 1.0 / 31.0)].par_iter().for_each(|&(alpha, mu)| {
        let lobes = lobes(alpha);
        let shape = lobes.shape(mu);
        let error = |ltc| squared_error(&shape, &lobes.hemisphere, ltc);
        let found = fit(&shape, &lobes.hemisphere, Ltc::sheen(alpha, -0.01), Free::Both);
        for (a, b) in [(1.01, 0.0), (0.99, 0.0), (1.0, 0.003), (1.0, -0.003)] {
            let near = Ltc::sheen(found.a * a, (found.b + b).min(0.0));
            assert!(near == found || error(near) > error(found), "alpha {alpha}, mu {mu}: {near:?} beats {found:?}");
        }
        for (a, b) in starts {
            let other = fit(&shape, &lobes.hemisphere, Ltc::sheen(a, b), Free::Both);
            let better = error(found) - error(other);
            assert!(better < 1e-9 * error(found), "alpha {alpha}, mu {mu}: {other:?} from {a}, {b} beats {found:?}");
        }
    });
}

#[test]
fn bilinear_albedos_are_found_again() {
    // Where the table can hold R exactly, r must be R; the pull towards R at the nodes agrees with that.
    let n = 5;
    let plane = |alpha: f64, mu: f64| alpha * (0.7 - 0.5 * mu);
    let positions = Albedos::samples(n);
    let values = positions.iter().flat_map(|&alpha| positions.iter().map(move |&mu| plane(alpha, mu))).collect();
    let samples = Albedos { alphas: positions.clone(), mus: positions, values };
    let nodes: Vec<f64> = (0..n * n).map(|k| plane((k / n) as f64 / 4.0, (k % n) as f64 / 4.0)).collect();
    for (found, expected) in albedo::fit(n, &samples, &nodes).iter().zip(&nodes) {
        assert!((found - expected).abs() < 1e-9, "{found}, {expected}");
    }
}

#[test]
fn r_is_better_between_the_nodes_than_the_albedo_at_them() {
    let n = 9;
    let positions = Albedos::samples(n);
    let samples = Albedos::new(positions.clone(), positions, || ());
    let nodes = |k: usize| k as f64 / (n - 1) as f64;
    let at_nodes = Albedos::new((1..n).map(nodes).collect(), (0..n).map(nodes).collect(), || ());
    let plain: Vec<f64> = vec![0.0; n].into_iter().chain(at_nodes.values).collect();
    let fitted = albedo::fit(n, &samples, &plain);
    assert!(fitted.iter().all(|r| (0.0..=1.0).contains(r)));
    let error = |r: &[f64]| {
        let table = SheenTable::new([n; 2], r.iter().map(|&r| [1.0, 0.0, r]).collect());
        let places = samples.alphas.iter().flat_map(|&alpha| samples.mus.iter().map(move |&mu| (alpha, mu)));
        let pairs = places.zip(&samples.values).filter(|(_, value)| **value > 1e-3);
        let errors: Vec<f64> =
            pairs.map(|((alpha, mu), value)| (table.lookup(alpha, mu)[2] / value - 1.0).abs()).collect();
        errors.iter().sum::<f64>() / errors.len() as f64
    };
    assert!(error(&fitted) < 0.5 * error(&plain), "{}, {}", error(&fitted), error(&plain));
}

#[test]
fn small_fit_obeys_the_conventions() {
    let (calls, most, all_steps) = (AtomicUsize::new(0), AtomicUsize::new(0), AtomicUsize::new(0));
    let (table, report) = sheen::fit(5, |done, all| {
        calls.fetch_add(1, Ordering::Relaxed);
        most.fetch_max(done, Ordering::Relaxed);
        all_steps.store(all, Ordering::Relaxed);
    });
    let all = all_steps.into_inner();
    assert_eq!((calls.into_inner(), most.into_inner()), (all, all), "each step is reported once");
    for i in 0..5 {
        for j in 0..5 {
            let [a, b, r] = table.cell(i, j);
            assert!(a >= LEAST_A && b <= 0.0 && (0.0..1.0).contains(&r), "node ({i}, {j}): {a}, {b}, {r}");
        }
        assert_eq!(table.cell(i, 4)[1], 0.0, "b at mu = 1, alpha's node {i}");
        let [a, b, _] = table.cell(1, i);
        assert_eq!(table.cell(0, i), [a, b, 0.0]);
    }
    assert!(report.lobe.mean > 0.03 && report.lobe.mean < 0.25, "{report}");
    assert_eq!(SheenTable::from_csv(&table.to_csv(&report.header())).expect("a written table"), table);
}

#[test]
fn a_fit_is_the_same_on_any_number_of_threads() {
    let [one, three] = [1, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool of threads");
        pool.install(|| sheen::fit(4, |_, _| ()))
    });
    assert_eq!(one, three);
}
