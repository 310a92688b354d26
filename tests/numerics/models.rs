//! The models of the sheen: their samples have the density that they state, they conserve energy, and they are the
//! slab.

use crate::direction;
use crate::lobes::{AZIMUTH, Bins, assert_calls_are_checked, message};
use crate::statistics::{REJECTED, SIGNIFICANCE, assert_within};
use rand::SeedableRng;
use rand_pcg::Pcg64;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};
use velour::fit::hemisphere::Hemisphere;
use velour::math::warp::uniform;
use velour::models::{Bsdf, LtcSheen, Sample, SlabSheen};
use velour::physics::slab::Slab;
use velour::physics::transport::{Resolution, Transport};
use velour::table::{SheenTable, SlabTable};

/// (alpha, mu): fuzz to dust, grazing to steep.
const CELLS: [(f64, f64); 10] = [
    (1.0 / 31.0, 1e-3),
    (0.04, 0.03),
    (0.06, 0.0),
    (0.1, 0.1),
    (0.15, 0.3),
    (0.2, 0.01),
    (0.3, 0.5),
    (0.5, 0.2),
    (0.7, 1.0),
    (1.0, 0.05),
];

fn ltc(alpha: f64) -> LtcSheen {
    LtcSheen::new(&SheenTable::embedded(), alpha)
}

fn slab(alpha: f64) -> SlabSheen {
    SlabSheen::new(&SlabTable::embedded(), alpha)
}

fn both(alpha: f64) -> [(&'static str, Box<dyn Bsdf>); 2] {
    [("ltc", Box::new(ltc(alpha))), ("slab", Box::new(slab(alpha)))]
}

#[test]
fn samples_have_the_density_that_is_said() {
    CELLS.into_par_iter().for_each(|(alpha, mu)| {
        for (name, model) in both(alpha) {
            let p = Bins::of_slab(alpha).probability(model.as_ref(), model.as_ref(), mu);
            assert!(p > SIGNIFICANCE, "{name}, alpha {alpha}, mu {mu}: p = {p:.1e}");
        }
    });
}

#[test]
fn another_density_is_told() {
    for ((_, model), (name, other)) in both(0.3).into_iter().zip(both(0.33)) {
        let p = Bins::of_slab(0.3).probability(model.as_ref(), other.as_ref(), 0.2);
        assert!(p < REJECTED, "{name}: 0.3 is taken for 0.33: p = {p:.1e}");
    }
    let [(_, one), (_, other)] = both(0.3);
    assert!(Bins::of_slab(0.3).probability(one.as_ref(), other.as_ref(), 0.2) < REJECTED);
}

#[test]
fn the_density_integrates_to_one_and_the_lobe_to_its_albedo() {
    let cells = CELLS.into_iter().chain([(0.02, 0.01), (0.012, 2e-3), (0.09, 0.0), (0.45, 1e-5), (0.8, 1.0)]);
    cells.collect::<Vec<_>>().into_par_iter().for_each(|(alpha, mu)| {
        let (bins, wi) = (Bins::of_slab(alpha), direction(mu, AZIMUTH));
        for (name, model) in both(alpha) {
            let pdf: f64 = bins.integrals(|wo| model.pdf(wi, wo)).iter().sum();
            assert!((pdf - 1.0).abs() < 1e-4, "{name}, alpha {alpha}, mu {mu}: {pdf}");
            let lobe: f64 = bins.integrals(|wo| model.evaluate(wi, wo)).iter().sum();
            let albedo = model.albedo(mu);
            assert!(
                (lobe / albedo - 1.0).abs() < 5e-4 && lobe <= 1.0,
                "{name}, alpha {alpha}, mu {mu}: {lobe}, {albedo}"
            );
        }
    });
}

#[test]
fn no_more_light_comes_back_than_came() {
    for alpha in (0..=60).map(|k| (f64::from(k) / 60.0).powi(3)) {
        for (name, model) in both(alpha) {
            for mu in (0..=100).map(|k| (f64::from(k) / 100.0).powi(4)) {
                let albedo = model.albedo(mu);
                // The slab's stays below this even towards alpha = 0 at the horizon; the table's r is fitted to what
                // lies between nodes.
                let most = if name == "slab" { 0.96 } else { 1.0 };
                assert!((0.0..=most).contains(&albedo), "{name}, alpha {alpha}, mu {mu}: {albedo}");
            }
        }
    }
}

#[test]
fn samples_and_their_weights_say_what_evaluation_says() {
    let mut rng = Pcg64::seed_from_u64(32);
    let alphas = (1..=30).map(|k| (f64::from(k) / 30.0).powi(2));
    for alpha in alphas.chain([1e-3]) {
        for (name, model) in both(alpha) {
            for mu in [0.0, 1e-6, 1e-4, 1e-3, 0.01, 0.04, 0.1, 0.3, 0.6, 1.0] {
                let (wi, albedo) = (direction(mu, TAU * uniform(&mut rng)), model.albedo(mu));
                for _ in 0..200 {
                    let Some(Sample { wo, weight, pdf }) = model.sample(wi, [(); 2].map(|()| uniform(&mut rng))) else {
                        panic!("{name}, alpha {alpha}, mu {mu}: no sample")
                    };
                    let what = format!("{name}, alpha {alpha}, wi {wi}, wo {wo}");
                    assert!((wo.length() - 1.0).abs() < 1e-12 && wo.z > 0.0, "{what}");
                    let near = |one: f64, other: f64| (one - other).abs() <= 1e-7 * other;
                    assert!(near(pdf, model.pdf(wi, wo)), "{what}: {pdf}, {}", model.pdf(wi, wo));
                    assert!(near(weight * pdf, model.evaluate(wi, wo)), "{what}: {weight}");
                    assert!((0.0..1.3).contains(&weight), "{what}: {weight}");
                    if alpha >= 1.0 / 31.0 && albedo > 1e-3 {
                        assert!(weight < 1.7 * albedo, "{what}: {weight}, {albedo}");
                    }
                }
            }
        }
    }
}

#[test]
fn mean_weights_are_albedos() {
    let mut rng = Pcg64::seed_from_u64(33);
    for (alpha, mu) in CELLS {
        let model = slab(alpha);
        let n = 20_000;
        let weights: Vec<f64> = (0..n)
            .map(|_| {
                model.sample(direction(mu, AZIMUTH), [(); 2].map(|()| uniform(&mut rng))).map_or(0.0, |s| s.weight)
            })
            .collect();
        let mean = weights.iter().sum::<f64>() / f64::from(n);
        let variance = weights.iter().map(|weight| (weight - mean).powi(2)).sum::<f64>() / f64::from(n);
        // The albedo's own error is 1e-4 of it.
        let error = (variance / f64::from(n)).sqrt() + 1e-4 * mean;
        assert_within(mean, model.albedo(mu), error, 4.0, &format!("alpha {alpha}, mu {mu}"));
        assert!(variance.sqrt() < 0.2 * mean, "alpha {alpha}, mu {mu}: {}", variance.sqrt() / mean);
    }
}

#[test]
fn the_slab_is_reciprocal() {
    let mut rng = Pcg64::seed_from_u64(34);
    let mut least_ltc = f64::MAX;
    for alpha in [0.006, 1.0 / 31.0, 0.1, 0.37, 1.0] {
        for _ in 0..300 {
            let [wi, wo] = [(); 2].map(|()| direction(uniform(&mut rng).powi(3), TAU * uniform(&mut rng)));
            let there_and_back = |model: &dyn Bsdf| model.evaluate(wi, wo) * wi.z / (model.evaluate(wo, wi) * wo.z);
            let ratio = there_and_back(&slab(alpha));
            assert!((ratio - 1.0).abs() < 1e-12, "alpha {alpha}, {wi}, {wo}: {ratio}");
            least_ltc = least_ltc.min(there_and_back(&ltc(alpha)));
        }
    }
    assert!(least_ltc < 0.9, "the transformed cosine passes for reciprocal: {least_ltc}");
}

/// Relative L2 distance of the model's lobe from the solved slab's, and relative error of its albedo.
fn distance(model: &SlabSheen, truth: &Transport, hemisphere: &Hemisphere, mu: f64) -> [f64; 2] {
    let wi = direction(mu, 0.0);
    let [mut square, mut norm] = [0.0; 2];
    for (&wo, weight) in hemisphere.nodes.iter().zip(&hemisphere.weights) {
        let value = truth.reflected(wi, wo);
        square += weight * (model.evaluate(wi, wo) - value).powi(2);
        norm += weight * value * value;
    }
    [(square / norm).sqrt(), (model.albedo(mu) / truth.albedo(mu) - 1.0).abs()]
}

#[test]
fn the_slab_is_the_solved_one() {
    // Between the table's alphas, in steps unrelated to them.
    let alphas: Vec<f64> = (0..14).map(|k| ((19.3 + 1.81 * f64::from(k)) / 45.0).powi(4)).collect();
    assert!(alphas[0] > 1.0 / 31.0 && alphas[13] < 1.0);
    let found = alphas.par_iter().map(|&alpha| {
        let truth = Transport::new(Slab::new(alpha), Resolution::default());
        let hemisphere = Hemisphere::new(truth.cosines());
        let mus = (0..16).map(|k| ((f64::from(k) + 0.6) / 16.0).powi(3)).filter(|mu| truth.albedo(*mu) > 1e-3);
        let (model, other) = (slab(alpha), slab(alpha * 1.02));
        let found: Vec<[f64; 2]> = mus.map(|mu| distance(&model, &truth, &hemisphere, mu)).collect();
        let told = distance(&other, &truth, &hemisphere, 0.05)[0];
        assert!(told > 0.01, "alpha {alpha} passes for 2% more: {told:.1e}");
        found
    });
    let found: Vec<[f64; 2]> = found.collect::<Vec<_>>().concat();
    assert!(found.len() > 150, "{} cells", found.len());
    let [lobes, albedos] = [0, 1].map(|which| found.iter().map(|errors| errors[which]).collect::<Vec<f64>>());
    for (what, errors, most_mean, most) in [("lobe", lobes, 0.0025, 0.01), ("R", albedos, 0.002, 0.01)] {
        let (mean, max) =
            (errors.iter().sum::<f64>() / errors.len() as f64, errors.iter().copied().fold(0.0, f64::max));
        println!("{what}: mean {mean:.5}, max {max:.5}");
        assert!(mean < most_mean && max < most, "{what}: mean {mean:.2e}, max {max:.2e}");
    }
}

#[test]
fn the_transformed_cosine_is_the_tables() {
    let table = SheenTable::embedded();
    for (alpha, mu) in CELLS {
        let [a, b, r] = table.lookup(alpha, mu);
        let (model, wo) = (ltc(alpha), direction(0.3, 0.7));
        let value = r * velour::table::Ltc::sheen(a, b).density(wo);
        let found = model.evaluate(direction(mu, 0.0), wo);
        assert!((found / value - 1.0).abs() < 1e-12, "alpha {alpha}, mu {mu}: {found}, {value}");
        assert!((model.albedo(mu) - r).abs() < 1e-15);
    }
}

#[test]
fn only_the_angle_between_azimuths_counts() {
    for (alpha, mu) in CELLS {
        for (name, model) in both(alpha) {
            let value = |turn: f64| {
                let (wi, wo) = (direction(mu, turn), direction(0.4, 1.1 + turn));
                [model.evaluate(wi, wo), model.pdf(wi, wo)]
            };
            let still = value(0.0);
            // mu = 1 has no azimuth: there the frame is the surface's.
            for turn in [1.0, PI, 5.5] {
                for (one, other) in value(turn).into_iter().zip(still) {
                    assert!((one / other - 1.0).abs() < 1e-10, "{name}, alpha {alpha}, mu {mu}: {one}, {other}");
                }
            }
        }
    }
}

#[test]
fn nothing_is_below_the_horizon_or_where_there_are_no_fibres() {
    let (up, down, flat) = (direction(0.4, 0.3), direction(-0.4, 0.3), direction(0.0, 2.0));
    for (name, model) in both(0.3) {
        for (wi, wo) in [(up, down), (down, up), (down, down), (up, flat), (flat, flat)] {
            assert_eq!([model.evaluate(wi, wo), model.pdf(wi, wo)], [0.0; 2], "{name}: {wi}, {wo}");
        }
        assert_eq!(model.sample(down, [0.5; 2]), None, "{name}");
        assert!(model.evaluate(flat, up) > 0.0 && model.sample(flat, [0.0; 2]).is_none_or(|s| s.weight.is_finite()));
    }
    for (name, model) in both(0.0) {
        assert_eq!([model.evaluate(up, up), model.pdf(up, up), model.albedo(0.4)], [0.0; 3], "{name}");
        assert_eq!(model.sample(up, [0.5; 2]), None, "{name}");
    }
    assert_eq!(slab(0.99e-3).albedo(0.0), 0.0);
}

#[test]
fn values_are_finite_and_not_negative_everywhere() {
    let mus = [0.0, f64::MIN_POSITIVE, 1e-200, 1e-12, 1e-5, 0.01, 0.3, 0.999_999, 1.0];
    for alpha in [1e-3, 2e-3, 0.004, 0.005, 0.0093, 0.02, 0.3, 0.99, 1.0] {
        for (name, model) in both(alpha) {
            for (wi, wo) in mus.iter().flat_map(|one| mus.map(|other| (direction(*one, 0.0), direction(other, 3.0)))) {
                for value in [model.evaluate(wi, wo), model.pdf(wi, wo), model.albedo(wi.z)] {
                    assert!(value >= 0.0 && value.is_finite(), "{name}, alpha {alpha}, {wi}, {wo}: {value}");
                }
                let last = 1.0 - f64::EPSILON / 2.0;
                for uniforms in [[0.0, 0.0], [last, last], [0.0, last], [1e-9, 0.5], [f64::MIN_POSITIVE; 2]] {
                    let sample = model.sample(wi, uniforms);
                    let good = |s: Sample| s.wo.z > 0.0 && s.pdf > 0.0 && (0.0..1.3).contains(&s.weight);
                    assert!(sample.is_none_or(good), "{name}, alpha {alpha}, {wi}, {uniforms:?}: {sample:?}");
                }
            }
        }
    }
}

#[test]
fn mistakes_of_the_caller_are_told() {
    for alpha in [-0.1, 1.1, f64::NAN] {
        assert!(message(&|| drop(slab(alpha))).contains("alpha is in [0, 1]"));
        assert!(message(&|| drop(ltc(alpha))).contains("alpha is in [0, 1]"));
    }
    let (slab, ltc) = (slab(0.3), ltc(0.3));
    let models: [&(dyn Bsdf + std::panic::RefUnwindSafe); 2] = [&slab, &ltc];
    let up = direction(0.5, 0.0);
    models.into_iter().for_each(assert_calls_are_checked);
    // Directions rounded to f32 are close enough to unit length.
    let rough = up.as_vec3().as_dvec3();
    assert!(models.iter().all(|model| model.evaluate(rough, rough) > 0.0));
}
