//! The models of prior work: they are what their papers say, their samples have the density that they state, and where
//! they create light.

use crate::direction;
use crate::lobes::{AZIMUTH, Bins, assert_calls_are_checked, message};
use crate::statistics::{REJECTED, SIGNIFICANCE, assert_within};
use glam::DVec3;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};
use velour::math::warp::uniform;
use velour::models::{Bsdf, Burley, ContyKulla, LEAST_ALPHA, NeubeltPettineo, Patry, Sample, Terminator};
use velour::physics::slab::Slab;

type Model = Box<dyn Bsdf + Sync>;

fn all(alpha: f64) -> [(&'static str, Model); 5] {
    [
        ("burley", Box::new(Burley::new())),
        ("neubelt_pettineo", Box::new(NeubeltPettineo::new(alpha))),
        ("conty_kulla", Box::new(ContyKulla::new(alpha, Terminator::Physical))),
        ("soft conty_kulla", Box::new(ContyKulla::new(alpha, Terminator::Soft))),
        ("patry", Box::new(Patry::new(alpha))),
    ]
}

/// (alpha, mu), off the nodes.
const CELLS: [(f64, f64); 9] =
    [(0.0, 1e-3), (0.05, 0.02), (0.1, 0.0), (0.15, 0.3), (0.2, 2e-4), (0.3, 0.5), (0.5, 0.2), (0.7, 1.0), (1.0, 0.05)];

/// Bins that are the sampler's own cells in elevation and all around: its density is integrated exactly over them.
fn bins() -> Bins {
    Bins::of_cube_root(24, 32)
}

/// Values worked out from the papers' formulas with angles, independently of the library, between (0.8, 0, 0.6) = a,
/// (0, 0.96, 0.28) = b, (-0.8, 0, 0.6) = c and (0.48, 0.64, 0.6) = d: Burley's, and for each alpha those of the others.
#[test]
fn values_are_those_of_the_papers() {
    let [a, b, c, d] = [[0.8, 0.0, 0.6], [0.0, 0.96, 0.28], [-0.8, 0.0, 0.6], [0.48, 0.64, 0.6]].map(DVec3::from_array);
    let n = DVec3::Z;
    for (wi, wo, burley, others) in [
        (
            n,
            n,
            0.0,
            [(0.2, [6.860126857e-2, 0.0, 0.0, 5.504626552e-5]), (1.0, [1.591549431e-2, 0.0, 0.0, 3.440391595e-2])],
        ),
        (
            a,
            a,
            0.0,
            [
                (0.2, [4.900127992e-2, 4.775764159e-2, 4.775574165e-2, 2.354000304e-5]),
                (0.5, [5.767346847e-2, 7.303661970e-2, 7.304786013e-2, 4.603531526e-3]),
            ],
        ),
        (
            a,
            b,
            2.041206377e-4,
            [
                (0.2, [2.697902396e-2, 3.083454992e-2, 2.752961568e-2, 1.820810609e-5]),
                (1.0, [4.037794920e-2, 5.057224411e-2, 4.844219461e-2, 2.518564566e-2]),
            ],
        ),
        (
            b,
            a,
            4.374013665e-4,
            [
                (0.5, [7.481823627e-2, 9.777209035e-2, 9.778108935e-2, 6.287186296e-3]),
                (1.0, [8.652417685e-2, 1.083690945e-1, 1.083845131e-1, 5.396924069e-2]),
            ],
        ),
        (
            a,
            c,
            6.144e-3,
            [(0.2, [4.900090612e-2, 0.0, 0.0, 3.068164651e-6]), (0.5, [2.842052555e-2, 0.0, 0.0, 7.365650442e-4])],
        ),
        (
            d,
            n,
            1.311476115e-5,
            [
                (0.2, [6.860126857e-2, 3.968377539e-3, 3.968377539e-3, 5.777787392e-6]),
                (1.0, [4.506573896e-2, 5.967100970e-2, 5.967100970e-2, 4.628009636e-2]),
            ],
        ),
    ] {
        for (alpha, values) in others {
            let expected = [burley, values[0], values[1], values[2], values[3]];
            for ((name, model), expected) in all(alpha).iter().zip(expected) {
                let value = model.evaluate(wi, wo);
                // To the digits that are given.
                let close = (value - expected).abs() <= 1e-9 * expected + 1e-16;
                assert!(close, "{name}, alpha {alpha}, {wi}, {wo}: {value:.9e}, {expected:.9e}");
            }
        }
    }
}

#[test]
fn of_dust_patry_is_the_slabs_single_scattering() {
    let (patry, slab) = (Patry::new(1.0), Slab::new(1.0));
    let mut most = 0.0_f64;
    for (one, other) in [(0.01, 0.9), (0.3, 0.2), (1.0, 0.6)] {
        let (wi, wo) = (direction(one, 0.0), direction(other, 2.0));
        assert!((patry.evaluate(wi, wo) / slab.single_scattering(wi, wo) - 1.0).abs() < 1e-12);
        let fuzz = Patry::new(0.5).evaluate(wi, wo) / Slab::new(0.5).single_scattering(wi, wo);
        most = most.max((fuzz - 1.0).abs());
    }
    assert!(most > 0.3, "fuzz takes less light along its fibres: {most}");
}

#[test]
fn samples_have_the_density_that_is_said() {
    CELLS.into_par_iter().for_each(|(alpha, mu)| {
        for (name, model) in all(alpha) {
            let p = bins().probability(model.as_ref(), model.as_ref(), mu);
            assert!(p > SIGNIFICANCE, "{name}, alpha {alpha}, mu {mu}: p = {p:.1e}");
        }
    });
}

#[test]
fn another_density_is_told() {
    for ((_, model), (name, other)) in all(0.3).iter().zip(&all(0.4)).skip(1) {
        let p = bins().probability(model.as_ref(), other.as_ref(), 0.2);
        assert!(p < REJECTED, "{name}: 0.3 is taken for 0.4: p = {p:.1e}");
    }
    let [burley, (_, other), ..] = all(0.3);
    assert!(bins().probability(burley.1.as_ref(), other.as_ref(), 0.2) < REJECTED);
    assert!(bins().probability(other.as_ref(), burley.1.as_ref(), 0.2) < REJECTED);
}

/// The largest relative error that a model's documentation allows its albedos.
fn albedo_error(name: &str) -> f64 {
    match name {
        "burley" | "neubelt_pettineo" => 1.5e-3,
        "patry" => 3e-3,
        _ => 5e-3,
    }
}

#[test]
fn the_density_integrates_to_one_and_the_lobe_to_its_albedo() {
    let cells =
        CELLS.into_iter().chain([(0.03, 4e-5), (0.04, 0.97), (0.6, 3e-5), (0.09, 6e-4), (0.03, 0.999), (1.0, 1.0)]);
    cells.collect::<Vec<_>>().into_par_iter().for_each(|(alpha, mu)| {
        let (bins, wi) = (bins(), direction(mu, AZIMUTH));
        for (name, model) in all(alpha) {
            let pdf: f64 = bins.integrals(|wo| model.pdf(wi, wo)).iter().sum();
            assert!((pdf - 1.0).abs() < 1e-6, "{name}, alpha {alpha}, mu {mu}: {pdf}");
            let lobe: f64 = bins.integrals(|wo| model.evaluate(wi, wo)).iter().sum();
            let albedo = model.albedo(mu);
            let error = (albedo / lobe - 1.0).abs();
            assert!(error < albedo_error(name), "{name}, alpha {alpha}, mu {mu}: {lobe}, {albedo}, {error:.1e}");
        }
    });
}

/// The largest albedo over alpha in a range and mu.
fn largest(name: &str, alphas: [f64; 2]) -> f64 {
    let albedo = |alpha: f64| {
        let model = all(alpha).into_iter().find(|(own, _)| *own == name).expect("a model").1;
        (0..=200).map(|k| model.albedo((f64::from(k) / 200.0).powi(4))).fold(0.0, f64::max)
    };
    let alphas = (0..=24).map(|k| alphas[0] + (alphas[1] - alphas[0]) * f64::from(k) / 24.0).collect::<Vec<_>>();
    alphas.into_par_iter().map(albedo).reduce(|| 0.0, f64::max)
}

/// What a white furnace shows: the largest albedo of each model is the one that its documentation states.
#[test]
fn most_models_keep_the_furnace_and_one_does_not() {
    for (name, alphas, expected) in [
        ("burley", [0.0, 0.0], 0.088),
        ("neubelt_pettineo", [0.0, 1.0], 0.866),
        ("patry", [0.0, 1.0], 0.500),
        ("conty_kulla", [0.0, LEAST_ALPHA], 1.335),
        ("conty_kulla", [0.07, 1.0], 0.991),
        ("soft conty_kulla", [0.0, LEAST_ALPHA], 1.141),
        ("soft conty_kulla", [0.045, 1.0], 0.97),
    ] {
        let found = largest(name, alphas);
        assert!((found - expected).abs() < 4e-3, "{name}, alpha {alphas:?}: {found:.4}, not {expected}");
    }
}

#[test]
fn samples_and_their_weights_say_what_evaluation_says() {
    let mut rng = Pcg64::seed_from_u64(41);
    for alpha in (0..=12).map(|k| (f64::from(k) / 12.0).powi(2)) {
        for (name, model) in all(alpha) {
            let (mut most, mut most_over_albedo) = (0.0_f64, 0.0_f64);
            for mu in [0.0, 1e-6, 3e-5, 1e-4, 1e-3, 5e-3, 0.01, 0.04, 0.1, 0.3, 0.6, 0.9, 0.99, 1.0] {
                let (wi, albedo) = (direction(mu, TAU * uniform(&mut rng)), model.albedo(mu));
                for _ in 0..1000 {
                    let uniforms = [(); 2].map(|()| uniform(&mut rng));
                    let Some(Sample { wo, weight, pdf }) = model.sample(wi, uniforms) else {
                        panic!("{name}, alpha {alpha}, mu {mu}: no sample")
                    };
                    let what = format!("{name}, alpha {alpha}, wi {wi}, wo {wo}");
                    assert!((wo.length() - 1.0).abs() < 1e-12 && wo.z > 0.0, "{what}");
                    assert_eq!(pdf, model.pdf(wi, wo), "{what}");
                    let value = model.evaluate(wi, wo);
                    assert!((weight * pdf - value).abs() <= 1e-12 * value, "{what}: {weight}");
                    most = most.max(weight);
                    most_over_albedo = most_over_albedo.max(weight / albedo);
                }
            }
            let bound = if name == "burley" { 0.4 } else { 6.0 };
            assert!(most < bound && most_over_albedo < 12.0, "{name}, alpha {alpha}: {most}, {most_over_albedo} R");
        }
    }
}

#[test]
fn mean_weights_are_albedos() {
    let mut rng = Pcg64::seed_from_u64(42);
    for (alpha, mu) in CELLS {
        for (name, model) in all(alpha) {
            let n = 20_000;
            let mut weight = || {
                let uniforms = [(); 2].map(|()| uniform(&mut rng));
                model.sample(direction(mu, AZIMUTH), uniforms).map_or(0.0, |sample| sample.weight)
            };
            let weights: Vec<f64> = (0..n).map(|_| weight()).collect();
            let mean = weights.iter().sum::<f64>() / f64::from(n);
            let variance = weights.iter().map(|weight| (weight - mean).powi(2)).sum::<f64>() / f64::from(n);
            // The albedo's own error, as a standard deviation.
            let error = (variance / f64::from(n)).sqrt() + 0.25 * albedo_error(name) * mean;
            assert_within(mean, model.albedo(mu), error, 4.0, &format!("{name}, alpha {alpha}, mu {mu}"));
            assert!(variance.sqrt() < 0.6 * mean, "{name}, alpha {alpha}, mu {mu}: {}", variance.sqrt() / mean);
        }
    }
}

#[test]
fn who_is_reciprocal_and_who_is_not() {
    let mut rng = Pcg64::seed_from_u64(43);
    let mut off = [0.0_f64; 5];
    let mut patry_scaled = 0.0_f64;
    for alpha in [0.05, 0.2, 0.6] {
        let models = all(alpha);
        let medium = *Slab::new(alpha).medium();
        for _ in 0..300 {
            let [wi, wo] = [(); 2].map(|()| direction(uniform(&mut rng).powi(3), TAU * uniform(&mut rng)));
            for ((_, model), off) in models.iter().zip(&mut off) {
                let [there, back] = [model.evaluate(wi, wo) * wi.z, model.evaluate(wo, wi) * wo.z];
                if there > 1e-200 {
                    *off = off.max((there / back - 1.0).abs());
                }
            }
            let patry = &models[4].1;
            let [there, back] = [(wi, wo), (wo, wi)].map(|(a, b)| medium.extinction(a.z) * patry.evaluate(a, b) * a.z);
            patry_scaled = patry_scaled.max((there / back - 1.0).abs());
        }
    }
    let [burley, neubelt_pettineo, conty_kulla, soft, patry] = off;
    let reciprocal = [burley, neubelt_pettineo, conty_kulla, patry_scaled];
    assert!(reciprocal.iter().all(|off| *off < 1e-11), "{reciprocal:?}");
    assert!(soft > 0.3 && patry > 0.3, "models that are not reciprocal pass: {soft}, {patry}");
}

#[test]
fn the_soft_terminator_darkens_grazing_light_only() {
    let [physical, soft] = [Terminator::Physical, Terminator::Soft].map(|terminator| ContyKulla::new(0.4, terminator));
    let ratio = |mu: f64| {
        let (wi, wo) = (direction(0.7, 0.0), direction(mu, 1.0));
        soft.evaluate(wi, wo) / physical.evaluate(wi, wo)
    };
    assert!(ratio(0.02) < 0.1 && ratio(0.1) < 0.4, "{}, {}", ratio(0.02), ratio(0.1));
    // Below Lambda = 1 the power lowers it instead, by less than 1%.
    assert!([0.6, 0.8, 1.0].iter().all(|mu| (1.0..1.01).contains(&ratio(*mu))));
}

#[test]
fn smaller_alphas_are_the_least() {
    let (wi, wo) = (direction(0.02, 0.0), direction(0.01, 0.4));
    for (((name, zero), (_, least)), (_, more)) in all(0.0).iter().zip(&all(LEAST_ALPHA)).zip(&all(0.04)) {
        let value = |model: &Model| [model.evaluate(wi, wo), model.pdf(wi, wo), model.albedo(0.02)];
        assert_eq!(value(zero), value(least), "{name}");
        assert!(*name == "burley" || value(zero) != value(more), "{name}");
    }
}

#[test]
fn only_the_angle_between_azimuths_counts() {
    for (alpha, mu) in CELLS {
        for (name, model) in all(alpha) {
            let value = |turn: f64| {
                let (wi, wo) = (direction(mu, turn), direction(0.4, 1.1 + turn));
                [model.evaluate(wi, wo), model.pdf(wi, wo)]
            };
            let still = value(0.0);
            for turn in [1.0, PI, 5.5] {
                for (one, other) in value(turn).into_iter().zip(still) {
                    assert!((one - other).abs() <= 1e-9 * other, "{name}, alpha {alpha}, mu {mu}: {one}, {other}");
                }
            }
        }
    }
}

#[test]
fn nothing_is_below_the_horizon() {
    let (up, down, flat) = (direction(0.4, 0.3), direction(-0.4, 0.3), direction(0.0, 2.0));
    for (name, model) in all(0.3) {
        for (wi, wo) in [(up, down), (down, up), (down, down), (up, flat), (flat, flat)] {
            assert_eq!([model.evaluate(wi, wo), model.pdf(wi, wo)], [0.0; 2], "{name}: {wi}, {wo}");
        }
        assert_eq!(model.sample(down, [0.5; 2]), None, "{name}");
        assert!(model.evaluate(flat, up) > 0.0 && model.sample(flat, [0.5; 2]).is_some(), "{name}");
    }
}

#[test]
fn values_are_finite_and_not_negative_everywhere() {
    let mus = [0.0, f64::MIN_POSITIVE, 1e-200, 1e-160, 1e-12, 1e-5, 0.01, 0.3, 0.999_999, 1.0];
    let opposite = |w: DVec3| DVec3::new(-w.x, -w.y, w.z);
    let directions: Vec<DVec3> = mus.map(|mu| direction(mu, 0.0)).into_iter().collect();
    for (name, model) in [0.0, 0.05, 0.3, 0.99, 1.0].into_iter().flat_map(all) {
        for &wi in &directions {
            let others = directions.iter().flat_map(|w| [*w, opposite(*w), direction(w.z, 3.0)]);
            for wo in others {
                for value in [model.evaluate(wi, wo), model.pdf(wi, wo), model.albedo(wi.z)] {
                    assert!(value >= 0.0 && value.is_finite(), "{name}, {wi}, {wo}: {value}");
                }
            }
            let last = 1.0 - f64::EPSILON / 2.0;
            for uniforms in [[0.0; 2], [last; 2], [0.0, last], [last, 0.0], [1e-9, 0.5], [f64::MIN_POSITIVE; 2]] {
                let sample = model.sample(wi, uniforms);
                let good =
                    |s: Sample| s.wo.z > 0.0 && s.pdf > 0.0 && s.pdf.is_finite() && (0.0..6.0).contains(&s.weight);
                assert!(sample.is_none_or(good), "{name}, {wi}, {uniforms:?}: {sample:?}");
            }
        }
    }
}

#[test]
fn mistakes_of_the_caller_are_told() {
    for alpha in [-0.1, 1.1, f64::NAN] {
        assert!(message(&|| drop(NeubeltPettineo::new(alpha))).contains("alpha is in [0, 1]"));
        assert!(message(&|| drop(ContyKulla::new(alpha, Terminator::Physical))).contains("alpha is in [0, 1]"));
        assert!(message(&|| drop(Patry::new(alpha))).contains("alpha is in [0, 1]"));
    }
    assert_calls_are_checked(&Burley::new());
    assert_calls_are_checked(&NeubeltPettineo::new(0.3));
    assert_calls_are_checked(&ContyKulla::new(0.3, Terminator::Soft));
    assert_calls_are_checked(&Patry::new(0.3));
    // Directions rounded to f32 are close enough to unit length.
    let rough = direction(0.5, 0.7).as_vec3().as_dvec3() * (1.0 + 4e-6);
    assert!(all(0.3).iter().skip(1).all(|(_, model)| model.evaluate(rough, rough) > 0.0));
    assert!(all(0.3).iter().all(|(_, model)| model.evaluate(DVec3::Z * (1.0 + 4e-6), rough) >= 0.0));
}
