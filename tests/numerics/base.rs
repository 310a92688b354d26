//! The models of the base, specular and diffuse: their samples have the density that they state, they conserve energy,
//! and they agree with the table and the facets.

use crate::direction;
use crate::statistics::{REJECTED, SIGNIFICANCE, assert_within, chi_square};
use glam::DVec3;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use rayon::prelude::*;
use std::f64::consts::TAU;
use velour::math::quadrature::gauss_legendre;
use velour::math::warp::uniform;
use velour::models::{Bsdf, Ggx, Lambert, LtcGgx, Sample, Schlick};
use velour::physics::microfacet;
use velour::table::GgxTable;

/// (roughness, mu) of lobes that the bins can tell apart.
const CELLS: [(f64, f64); 7] = [(0.4, 0.9), (0.4, 0.3), (0.55, 0.02), (0.6, 0.6), (0.8, 0.1), (1.0, 1.0), (1.0, 0.4)];

/// The azimuth of `wi`, along neither of the axes.
const AZIMUTH: f64 = 2.2;

fn plastic() -> Schlick {
    Schlick::new(0.04, 1.0)
}

fn all(roughness: f64) -> [(&'static str, Box<dyn Bsdf>); 3] {
    let table = GgxTable::embedded();
    [
        ("facets", Box::new(Ggx::new(roughness, plastic()))),
        ("cosine", Box::new(LtcGgx::new(&table, roughness, plastic()))),
        ("diffuse", Box::new(Lambert)),
    ]
}

const ELEVATIONS: usize = 24;
const AZIMUTHS: usize = 32;

/// The bin of a direction, in equal steps of its cosine and of its azimuth from `wi`.
fn bin(wo: DVec3) -> usize {
    let phi = (wo.y.atan2(wo.x) - AZIMUTH).rem_euclid(TAU) / TAU;
    let part = |x: f64, parts: usize| ((x * parts as f64) as usize).min(parts - 1);
    part(wo.z, ELEVATIONS) * AZIMUTHS + part(phi, AZIMUTHS)
}

/// The integral of a function of directions over each bin, by Gauss nodes that are densest at each bin's lower edge.
fn integrals(value: impl Fn(DVec3) -> f64) -> Vec<f64> {
    let mut integrals = vec![0.0; ELEVATIONS * AZIMUTHS];
    for (at, integral) in integrals.iter_mut().enumerate() {
        let (low, width) = ((at / AZIMUTHS) as f64 / ELEVATIONS as f64, TAU / AZIMUTHS as f64);
        for (x, x_weight) in gauss_legendre(12, 0.0, 1.0) {
            let (mu, mu_weight) = (low + x * x / ELEVATIONS as f64, 2.0 * x * x_weight / ELEVATIONS as f64);
            let first = (at % AZIMUTHS) as f64 * width;
            for (phi, phi_weight) in gauss_legendre(10, first, first + width) {
                *integral += mu_weight * phi_weight * value(direction(mu, AZIMUTH + phi));
            }
        }
    }
    integrals
}

/// The probability of the samples of one model under the density of another; calls that give no sample have a cell of
/// their own.
fn probability(sampled: &dyn Bsdf, said: &dyn Bsdf, mu: f64) -> f64 {
    let wi = direction(mu, AZIMUTH);
    let mut rng = Pcg64::seed_from_u64(71);
    let mut counts = vec![0; ELEVATIONS * AZIMUTHS + 1];
    for _ in 0..200_000 {
        let sample = sampled.sample(wi, [(); 2].map(|()| uniform(&mut rng)));
        counts[sample.map_or(ELEVATIONS * AZIMUTHS, |sample| bin(sample.wo))] += 1;
    }
    let mut probabilities = integrals(|wo| said.pdf(wi, wo));
    probabilities.push(1.0 - probabilities.iter().sum::<f64>());
    assert!(probabilities.iter().all(|p| *p > -2e-4), "a density of more than 1");
    chi_square(&counts, &probabilities.into_iter().map(|p| p.max(0.0)).collect::<Vec<_>>(), 3e-4)
}

#[test]
fn samples_have_the_density_that_is_said() {
    CELLS.into_par_iter().for_each(|(roughness, mu)| {
        for (name, model) in all(roughness) {
            let p = probability(model.as_ref(), model.as_ref(), mu);
            assert!(p > SIGNIFICANCE, "{name}, roughness {roughness}, mu {mu}: p = {p:.1e}");
        }
    });
}

#[test]
fn another_density_is_told() {
    for ((name, model), (_, other)) in all(0.6).into_iter().zip(all(0.63)).take(2) {
        let p = probability(model.as_ref(), other.as_ref(), 0.5);
        assert!(p < REJECTED, "{name}: roughness 0.6 is taken for 0.63: p = {p:.1e}");
    }
    let [(_, facets), (_, cosine), (_, diffuse)] = all(0.6);
    assert!(probability(facets.as_ref(), cosine.as_ref(), 0.5) < REJECTED);
    assert!(probability(diffuse.as_ref(), facets.as_ref(), 0.5) < REJECTED);
}

#[test]
fn samples_and_their_weights_say_what_evaluation_says() {
    let mut rng = Pcg64::seed_from_u64(72);
    for roughness in [0.0, 0.03, 0.1, 0.3, 0.6, 1.0] {
        for (name, model) in all(roughness) {
            for mu in [0.0, 1e-5, 0.01, 0.1, 0.5, 1.0] {
                let wi = direction(mu, TAU * uniform(&mut rng));
                for _ in 0..200 {
                    let Some(Sample { wo, weight, pdf }) = model.sample(wi, [(); 2].map(|()| uniform(&mut rng))) else {
                        assert_eq!(name, "facets", "roughness {roughness}, mu {mu}: no sample");
                        continue;
                    };
                    let what = format!("{name}, roughness {roughness}, wi {wi}, wo {wo}");
                    assert!((wo.length() - 1.0).abs() < 1e-9 && wo.z > 0.0, "{what}");
                    // In a sharp lobe, the directions' last digits count for more.
                    let near = |one: f64, other: f64| (one - other).abs() <= 1e-6 * other;
                    assert!(near(pdf, model.pdf(wi, wo)), "{what}: {pdf}, {}", model.pdf(wi, wo));
                    assert!(near(weight * pdf, model.evaluate(wi, wo)), "{what}: {weight}");
                    assert!((0.0..1.1).contains(&weight), "{what}: {weight}");
                }
            }
        }
    }
}

#[test]
fn mean_weights_are_albedos() {
    let mut rng = Pcg64::seed_from_u64(73);
    let cells = CELLS.into_iter().chain([(0.0, 0.5), (0.02, 0.03), (0.15, 0.05), (0.3, 0.0)]);
    for (roughness, mu) in cells {
        for (name, model) in all(roughness) {
            let n = 40_000;
            let weight = |_| {
                let uniforms = [(); 2].map(|()| uniform(&mut rng));
                model.sample(direction(mu, AZIMUTH), uniforms).map_or(0.0, |sample| sample.weight)
            };
            let weights: Vec<f64> = (0..n).map(weight).collect();
            let mean = weights.iter().sum::<f64>() / f64::from(n);
            let variance = weights.iter().map(|weight| (weight - mean).powi(2)).sum::<f64>() / f64::from(n);
            // The facets' shares are interpolated linearly, which errs by up to 1e-3 of them.
            let error = (variance / f64::from(n)).sqrt() + 3e-4 * mean;
            assert_within(mean, model.albedo(mu), error, 4.0, &format!("{name}, roughness {roughness}, mu {mu}"));
        }
    }
}

#[test]
fn a_mirror_in_a_white_furnace_is_not_seen() {
    let table = GgxTable::embedded();
    (0..=20).into_par_iter().map(|k| f64::from(k) / 20.0).for_each(|roughness| {
        for (f0, f90) in [(0.0, 0.0), (0.04, 1.0), (0.5, 0.5), (1.0, 0.0), (0.9, 1.0), (1.0, 1.0)] {
            let schlick = Schlick::new(f0, f90);
            let (facets, cosine) = (Ggx::new(roughness, schlick), LtcGgx::new(&table, roughness, schlick));
            for mu in (0..=20).map(|k| f64::from(k) / 20.0) {
                let both = [facets.albedo(mu), cosine.albedo(mu)];
                let at = format!("roughness {roughness}, mu {mu}, f0 {f0}, f90 {f90}: {both:?}");
                assert!(both.iter().all(|albedo| (0.0..1.0 + 1e-12).contains(albedo)), "{at}");
                assert!(f0 < 1.0 || f90 < 1.0 || both.iter().all(|albedo| *albedo > 1.0 - 1e-12), "{at}");
                // The table is off most where R dips next to the horizon; on average it is off by a hundredth of that.
                assert!((both[0] - both[1]).abs() < if mu == 0.0 { 0.07 } else { 0.02 }, "{at}");
            }
        }
    });
}

#[test]
fn facets_are_mirrors_of_schlicks_reflectance() {
    let (wi, wo) = (direction(0.4, 1.0), direction(0.7, 3.0));
    let [black, white] = [(0.0, 1.0), (1.0, 1.0)].map(|(f0, f90)| Ggx::new(0.5, Schlick::new(f0, f90)));
    let cosine = wi.dot((wi + wo).normalize());
    let lobe = microfacet::Ggx::from_roughness(0.5).lobe(wi, wo);
    // Without f0 there is nothing to compensate for.
    assert!((black.evaluate(wi, wo) / (lobe * (1.0 - cosine).powi(5)) - 1.0).abs() < 1e-12);
    let reflected = microfacet::Ggx::from_roughness(0.5).reflected(0.4).albedo;
    assert!((white.evaluate(wi, wo) / (lobe / reflected) - 1.0).abs() < 1e-3);
}

#[test]
fn the_transformed_cosine_is_the_tables() {
    let table = GgxTable::embedded();
    for (roughness, mu) in CELLS {
        let model = LtcGgx::new(&table, roughness, Schlick::MIRROR);
        let (wi, wo, turn) = (direction(mu, AZIMUTH), direction(0.3, 0.7 + AZIMUTH), direction(0.3, 0.7));
        let density = table.lookup(roughness, mu).ltc.density(turn);
        assert!((model.evaluate(wi, wo) / density - 1.0).abs() < 1e-9, "roughness {roughness}, mu {mu}");
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
        assert!(model.evaluate(flat, up) > 0.0 && model.sample(flat, [0.3; 2]).is_none_or(|s| s.weight.is_finite()));
    }
}

#[test]
fn shares_between_nodes_are_the_facets() {
    for roughness in [0.0, 0.05, 0.1, 0.2, 0.5, 1.0] {
        let facets = microfacet::Ggx::from_roughness(roughness);
        let [half, grazing] = [(0.5, 0.5), (0.0, 1.0)].map(|(f0, f90)| Schlick::new(f0, f90));
        let models = [half, grazing].map(|schlick| (schlick, Ggx::new(roughness, schlick)));
        for mu in (0..200).map(|k| ((f64::from(k) + 0.5) / 200.0).powi(2)) {
            let truth = facets.reflected(mu);
            for (schlick, model) in &models {
                let (found, expected) = (model.albedo(mu), schlick.albedo(truth.albedo, truth.fresnel));
                assert!((found - expected).abs() < 1e-3, "roughness {roughness}, mu {mu}: {found}, {expected}");
            }
        }
    }
}
