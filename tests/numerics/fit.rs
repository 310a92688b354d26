use glam::DVec3;
use std::sync::atomic::{AtomicUsize, Ordering};
use velour::fit::hemisphere::Hemisphere;
use velour::fit::least_squares::{Free, LEAST_A, fit, squared_error};
use velour::fit::lobe::{LobeSolver, WalkSolver};
use velour::fit::ltc::Ltc;
use velour::fit::{Options, sheen};
use velour::physics::slab::Slab;
use velour::table::LtcTable;

const SOME: [Ltc; 5] = [
    Ltc { a: 1.0, b: 0.0 },
    Ltc { a: 0.5, b: -0.2 },
    Ltc { a: 0.1, b: -0.15 },
    Ltc { a: 0.02, b: -0.1 },
    Ltc { a: 0.004, b: -0.04 },
];

#[test]
fn density_integrates_to_one() {
    let hemisphere = Hemisphere::default();
    for ltc in SOME {
        let integral = hemisphere.integral(|node| ltc.density(hemisphere.nodes[node]));
        // The quadrature's error, largest for the narrowest.
        assert!((integral - 1.0).abs() < 3e-4, "{ltc:?}: {integral}");
    }
}

#[test]
fn density_is_the_cosines_at_the_identity() {
    let wo = DVec3::new(0.48, 0.6, 0.64);
    assert!((Ltc { a: 1.0, b: 0.0 }.density(wo) - 0.64 / std::f64::consts::PI).abs() < 1e-15);
}

#[test]
fn slopes_are_the_densitys() {
    let wo = DVec3::new(0.48, 0.6, 0.64);
    let step = 1e-5;
    for Ltc { a, b } in SOME {
        let at = |ln_a: f64, b: f64| Ltc { a: ln_a.exp(), b }.density(wo);
        let (density, slopes) = Ltc { a, b }.density_and_slopes(wo);
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
    let hemisphere = Hemisphere::default();
    for truth in SOME {
        let shape: Vec<f64> = hemisphere.nodes.iter().map(|&wo| truth.density(wo)).collect();
        let start = Ltc { a: truth.a * 1.5, b: truth.b - 0.1 };
        let found = fit(&shape, &hemisphere, start, Free::Both);
        assert!((found.a / truth.a - 1.0).abs() < 1e-6 && (found.b - truth.b).abs() < 1e-6, "{truth:?}: {found:?}");
    }
}

#[test]
fn fitted_b_is_not_above_0() {
    let hemisphere = Hemisphere::default();
    let leaning_away = Ltc { a: 0.5, b: 0.2 };
    let shape: Vec<f64> = hemisphere.nodes.iter().map(|&wo| leaning_away.density(wo)).collect();
    let found = fit(&shape, &hemisphere, Ltc { a: 1.0, b: -0.1 }, Free::Both);
    assert_eq!(found.b, 0.0);
    assert!(found.a > LEAST_A);
}

#[test]
fn a_fit_is_a_minimum() {
    let hemisphere = Hemisphere::default();
    for (alpha, mu) in [(0.8, 0.9), (0.5, 0.5), (0.2, 0.05), (0.1, 1e-3)] {
        let lobe = WalkSolver { paths: 50_000, seed: 1 }.solve(Slab::new(alpha), mu, &hemisphere);
        let shape: Vec<f64> = lobe.values.iter().map(|value| value / lobe.albedo).collect();
        let error = |ltc| squared_error(&shape, &hemisphere, ltc);
        let found = fit(&shape, &hemisphere, Ltc { a: alpha, b: -0.01 }, Free::Both);
        for (a, b) in [(1.01, 0.0), (0.99, 0.0), (1.0, 0.003), (1.0, -0.003)] {
            let near = Ltc { a: found.a * a, b: (found.b + b).min(0.0) };
            assert!(near == found || error(near) > error(found), "alpha {alpha}, mu {mu}: {near:?} beats {found:?}");
        }
    }
}

#[test]
fn small_fit_obeys_the_conventions() {
    let options = Options { resolution: 5, paths: 20_000, seed: 1 };
    let (calls, most) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let (table, report) = sheen(options, |done, all| {
        assert_eq!(all, 5 * 4);
        calls.fetch_add(1, Ordering::Relaxed);
        most.fetch_max(done, Ordering::Relaxed);
    });
    assert_eq!((calls.into_inner(), most.into_inner()), (20, 20));
    for i in 0..5 {
        for j in 0..5 {
            let [a, b, r] = table.cell(i, j);
            assert!(a >= LEAST_A && b <= 0.0 && (0.0..1.0).contains(&r), "node ({i}, {j}): {a}, {b}, {r}");
        }
        assert_eq!(table.cell(i, 4)[1], 0.0, "b at mu = 1, alpha's node {i}");
    }
    for j in 0..5 {
        let [a, b, _] = table.cell(1, j);
        assert_eq!(table.cell(0, j), [a, b, 0.0]);
    }
    // R(1, 1) = 0.3413 and R(0.5, 0.5) = 0.1535 within three standard errors of 20,000 paths.
    assert!((table.cell(4, 4)[2] - 0.3413).abs() < 0.009, "{:?}", table.cell(4, 4));
    assert!((table.cell(2, 2)[2] - 0.1535).abs() < 0.007, "{:?}", table.cell(2, 2));
    // Of the order of the full table's 0.09; noise adds to it.
    assert!(report.mean > 0.03 && report.mean < 0.25, "{report}");
    assert_eq!(LtcTable::from_csv(&table.to_csv(&report.header())).expect("a written table"), table);
}

#[test]
fn fit_depends_on_the_seed_and_not_on_threads() {
    let options = Options { resolution: 3, paths: 20_000, seed: 1 };
    let [one, three] = [1, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool of threads");
        pool.install(|| sheen(options, |_, _| ()))
    });
    assert_eq!(one, three);
    assert_ne!(one.0, sheen(Options { seed: 2, ..options }, |_, _| ()).0);
}

#[test]
fn a_walk_too_short_still_makes_a_table() {
    let (table, report) = sheen(Options { resolution: 6, paths: 1, seed: 1 }, |_, _| ());
    assert!(table.cells().iter().all(|[a, b, r]| *a > 0.0 && *b <= 0.0 && (0.0..=1.0).contains(r)));
    assert_eq!(report.copied_shapes, 30);
}
