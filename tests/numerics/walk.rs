use crate::statistics::{REJECTED, SIGNIFICANCE, assert_within, chi_square};
use glam::DVec3;
use velour::math::quadrature::gauss_legendre;
use velour::physics::slab::Slab;
use velour::physics::walk::{FirstFlight, Histogram, Walk};

fn walk(alpha: f64, mu: f64, first_flight: FirstFlight, paths: u64, seed: u64) -> Walk {
    Walk { slab: Slab::new(alpha), mu, first_flight, paths, seed }
}

/// The standard error of a share that a walk of `paths` paths found to be `share`.
fn binomial_error(share: f64, paths: u64) -> f64 {
    (share * (1.0 - share) / paths as f64).sqrt()
}

#[test]
fn every_path_leaves_once() {
    for (alpha, mu) in [(1.0, 1.0), (0.5, 0.5), (0.2, 0.01), (1.0 / 31.0, 1e-3), (1.0 / 31.0, 1.0)] {
        let analog = walk(alpha, mu, FirstFlight::Analog, 20_001, 1).run();
        assert_eq!(analog.reflected() + analog.transmitted() + analog.unscattered, 20_001, "alpha {alpha}, mu {mu}");
        let scattered = walk(alpha, mu, FirstFlight::Scattered, 20_001, 1).run();
        assert_eq!(scattered.reflected() + scattered.transmitted(), 20_001, "alpha {alpha}, mu {mu}");
    }
}

#[test]
fn unscattered_light_falls_exponentially() {
    for (alpha, mu) in [(1.0, 1.0), (1.0, 0.3), (0.5, 0.7), (0.2, 0.9), (1.0 / 31.0, 0.9)] {
        let walk = walk(alpha, mu, FirstFlight::Analog, 100_000, 2);
        let truth = walk.slab.unscattered(mu);
        let measured = walk.run().unscattered as f64 * walk.share();
        assert_within(measured, truth, binomial_error(truth, walk.paths), 3.0, &format!("alpha {alpha}, mu {mu}"));
    }
}

#[test]
fn leaving_out_unscattered_paths_changes_no_share() {
    for (alpha, mu) in [(1.0, 1.0), (0.5, 0.5), (0.3, 0.9)] {
        let [analog, scattered] = [FirstFlight::Analog, FirstFlight::Scattered].map(|first_flight| {
            let walk = walk(alpha, mu, first_flight, 200_000, 3);
            let counts = walk.run();
            [counts.reflected_once.total(), counts.reflected_more.total()].map(|count| count as f64 * walk.share())
        });
        for (order, (one, other)) in analog.into_iter().zip(scattered).enumerate() {
            let error = 2.0_f64.sqrt() * binomial_error(one, 200_000);
            assert_within(other, one, error, 3.0, &format!("alpha {alpha}, mu {mu}, order {}", order + 1));
        }
    }
}

/// Shares of singly scattered reflected light in the histogram's bins, from the closed form.
fn single_shares(slab: Slab, mu: f64) -> Vec<f64> {
    let wi = DVec3::new((1.0 - mu * mu).sqrt(), 0.0, mu);
    let mut shares = Vec::new();
    for row in 0..Histogram::MU_BINS {
        for column in 0..Histogram::PHI_BINS {
            let ([low, high], [first, last]) = (Histogram::mu_range(row), Histogram::phi_range(column));
            let mut share = 0.0;
            for (mu_o, mu_weight) in gauss_legendre(4, low, high) {
                for (phi, phi_weight) in gauss_legendre(4, first, last) {
                    let s = (1.0 - mu_o * mu_o).sqrt();
                    let wo = DVec3::new(s * phi.cos(), s * phi.sin(), mu_o);
                    share += 2.0 * mu_weight * phi_weight * slab.single_scattering(wi, wo);
                }
            }
            shares.push(share);
        }
    }
    let whole: f64 = shares.iter().sum();
    shares.iter_mut().for_each(|share| *share /= whole);
    shares
}

#[test]
fn first_order_is_single_scattering() {
    for (alpha, mu) in [(1.0, 1.0), (1.0, 0.1), (0.5, 0.5), (0.3, 0.15), (0.1, 0.01)] {
        let walk = walk(alpha, mu, FirstFlight::Scattered, 400_000, 4);
        let once = walk.run().reflected_once;
        let what = format!("alpha {alpha}, mu {mu}");
        let exact = walk.slab.single_scattering_albedo(mu);
        let error = walk.share() * (once.total() as f64).sqrt();
        assert_within(once.total() as f64 * walk.share(), exact, error, 3.0, &what);
        let counts: Vec<u64> = once.bins().flatten().copied().collect();
        let p = chi_square(&counts, &single_shares(walk.slab, mu), 1e-9);
        assert!(p > SIGNIFICANCE, "{what}: p = {p:.1e}");
    }
}

#[test]
fn another_slabs_single_scattering_is_told() {
    let counts = walk(0.5, 0.5, FirstFlight::Scattered, 400_000, 4).run().reflected_once;
    let counts: Vec<u64> = counts.bins().flatten().copied().collect();
    for (alpha, mu) in [(0.7, 0.5), (0.5, 0.3)] {
        let p = chi_square(&counts, &single_shares(Slab::new(alpha), mu), 1e-9);
        assert!(p < REJECTED, "taken for alpha {alpha}, mu {mu}: p = {p:.1e}");
    }
}

#[test]
fn albedos_are_the_known_ones() {
    // From walks of 1e8 paths or more by another program, each known to 5e-5.
    let known = [(1.0, 1.0, 0.3413), (1.0, 0.01, 0.7498), (0.7, 0.4, 0.3768), (0.5, 0.5, 0.1535), (0.3, 0.15, 0.3274)];
    for (alpha, mu, truth) in known {
        let walk = walk(alpha, mu, FirstFlight::Analog, 1_000_000, 5);
        let albedo = walk.run().reflected() as f64 * walk.share();
        let error = binomial_error(truth, walk.paths).hypot(5e-5);
        assert_within(albedo, truth, error, 3.0, &format!("alpha {alpha}, mu {mu}"));
    }
}

#[test]
fn long_paths_count() {
    // At low alpha and grazing angles, most of R is light that has scattered many times: a walk cut off at 16 loses
    // four fifths of it.
    let walk = walk(0.032, 0.01, FirstFlight::Scattered, 100_000, 6);
    let counts = walk.run();
    assert!(counts.reflected_more.total() > 9 * counts.reflected_once.total());
}

#[test]
fn counts_depend_on_the_seed_and_not_on_threads() {
    let walk = walk(0.3, 0.2, FirstFlight::Analog, 100_000, 8);
    let [one, three] = [1, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool of threads");
        pool.install(|| walk.run())
    });
    assert_eq!(one, three);
    assert_ne!(one, Walk { seed: 9, ..walk }.run());
}
