//! GGX microfacets: their formulas agree with each other, and their albedos with samples.

use crate::direction;
use crate::statistics::assert_within;
use glam::DVec3;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use rayon::prelude::*;
use std::f64::consts::{LN_2, PI};
use velour::math::quadrature::gauss_legendre;
use velour::math::warp::uniform;
use velour::physics::microfacet::{Ggx, LEAST_ALPHA};

const ALPHAS: [f64; 6] = [LEAST_ALPHA, 0.01, 0.1, 0.3, 0.6, 1.0];
const MUS: [f64; 7] = [0.0, 1e-3, 0.01, 0.1, 0.4, 0.8, 1.0];

fn cells() -> impl Iterator<Item = (f64, f64)> {
    ALPHAS.into_iter().flat_map(|alpha| MUS.map(|mu| (alpha, mu)))
}

#[test]
fn facets_cover_the_surface() {
    // The projected area of all facets, integral of D m_z over the hemisphere, is that of the surface.
    for alpha in ALPHAS {
        let ggx = Ggx::new(alpha);
        // In the angle chi of tan theta = alpha tan chi the integrand is smooth.
        let area: f64 = gauss_legendre(32, 0.0, PI / 2.0)
            .into_iter()
            .map(|(chi, weight)| {
                let (theta, stretch) = ((alpha * chi.tan()).atan(), alpha / chi.cos().powi(2));
                let slope = stretch * theta.cos().powi(2);
                weight * slope * 2.0 * PI * theta.sin() * theta.cos() * ggx.normal_density(theta.cos())
            })
            .sum();
        assert!((area - 1.0).abs() < 1e-8, "alpha {alpha}: {area}");
    }
}

#[test]
fn lobes_are_reciprocal() {
    for (alpha, mu) in cells().filter(|(_, mu)| *mu > 0.0) {
        let ggx = Ggx::new(alpha);
        for other in MUS.into_iter().filter(|mu| *mu > 0.0) {
            let (wi, wo) = (direction(mu, 0.4), direction(other, 2.9));
            let [one, other] = [ggx.lobe(wi, wo) / wo.z, ggx.lobe(wo, wi) / wi.z];
            assert!((one / other - 1.0).abs() < 1e-12, "alpha {alpha}, {wi}, {wo}: {one}, {other}");
        }
    }
}

#[test]
fn the_density_of_samples_is_the_lobes_but_for_shadowing() {
    // f_r mu_o / pdf = G2 / G1 = (1 + Lambda_i) / (1 + Lambda_i + Lambda_o), with Heitz' Lambda (2014).
    for (alpha, mu) in cells().filter(|(_, mu)| *mu > 0.0) {
        let ggx = Ggx::new(alpha);
        let lambda = |mu: f64| ((1.0 + alpha * alpha * (1.0 / (mu * mu) - 1.0)).sqrt() - 1.0) / 2.0;
        for other in MUS.into_iter().filter(|mu| *mu > 0.0) {
            let (wi, wo) = (direction(mu, 0.4), direction(other, 2.9));
            let expected = (1.0 + lambda(mu)) / (1.0 + lambda(mu) + lambda(other));
            let found = ggx.lobe(wi, wo) / ggx.pdf(wi, wo);
            assert!((found / expected - 1.0).abs() < 1e-9, "alpha {alpha}, {mu}, {other}: {found}, {expected}");
        }
    }
}

#[test]
fn albedos_in_closed_form_are_found() {
    // alpha = 1, mu = 1: D = 1 / pi, f_r mu_o = mu_o / (2 pi (1 + mu_o)), whose integral is 1 - ln 2.
    assert!((Ggx::new(1.0).reflected(1.0).albedo - (1.0 - LN_2)).abs() < 1e-12);
    for alpha in ALPHAS {
        // For light along the surface, every visible facet reflects upwards, and nothing is shadowed that was not
        // masked.
        assert!((Ggx::new(alpha).reflected(0.0).albedo - 1.0).abs() < 1e-12, "alpha {alpha}");
    }
}

#[test]
fn albedos_are_the_mean_weights_of_samples() {
    cells().collect::<Vec<_>>().into_par_iter().for_each(|(alpha, mu)| {
        let (ggx, wi) = (Ggx::new(alpha), direction(mu, 0.0));
        let mut rng = Pcg64::seed_from_u64(51);
        let n = 100_000;
        let weights: Vec<[f64; 2]> = (0..n)
            .map(|_| {
                let wo = ggx.sample(wi, [(); 2].map(|()| uniform(&mut rng)));
                let weight = ggx.lobe(wi, wo) / ggx.pdf(wi, wo);
                [weight, weight * (1.0 - (wi + wo).length() / 2.0).max(0.0).powi(5)]
            })
            .collect();
        let reflected = ggx.reflected(mu);
        for (k, truth) in [reflected.albedo, reflected.fresnel].into_iter().enumerate() {
            let mean = weights.iter().map(|weight| weight[k]).sum::<f64>() / f64::from(n);
            let variance = weights.iter().map(|weight| (weight[k] - mean).powi(2)).sum::<f64>() / f64::from(n);
            let error = (variance / f64::from(n)).sqrt() + 1e-5;
            assert_within(mean, truth, error, 4.0, &format!("alpha {alpha}, mu {mu}, share {k}"));
        }
    });
}

#[test]
fn the_quadrature_is_fine_enough() {
    cells().collect::<Vec<_>>().into_par_iter().for_each(|(alpha, mu)| {
        let ggx = Ggx::new(alpha);
        let fine: f64 = ggx.quadrature(mu, [150, 150]).iter().map(|node| node.weight * node.lobe).sum();
        let found = ggx.reflected(mu).albedo;
        assert!((found - fine).abs() < 1e-5, "alpha {alpha}, mu {mu}: {found}, {fine}");
        let coarse: f64 = ggx.quadrature(mu, [4, 4]).iter().map(|node| node.weight * node.lobe).sum();
        assert!(mu == 0.0 || alpha > 0.3 || (coarse - fine).abs() > 1e-8, "a coarse quadrature passes: {alpha}, {mu}");
        // Solid angles add up to the hemisphere's where the distribution reaches all of it.
        let whole: f64 = ggx.quadrature(mu, [40, 40]).iter().map(|node| node.weight).sum();
        assert!(alpha < 0.1 || (whole / (2.0 * PI) - 1.0).abs() < 1e-5, "alpha {alpha}, mu {mu}: {whole}");
    });
}

#[test]
fn nodes_hold_the_lobe_in_their_direction() {
    for (alpha, mu) in cells() {
        let (ggx, wi) = (Ggx::new(alpha), direction(mu, 0.0));
        for node in ggx.quadrature(mu, [7, 5]) {
            assert!((node.wo.length() - 1.0).abs() < 1e-12 && node.wo.z > 0.0);
            let half: DVec3 = (wi + node.wo).normalize();
            assert!((wi.dot(half) - node.cosine).abs() < 1e-9, "alpha {alpha}, mu {mu}");
            let lobe = ggx.lobe(wi, node.wo);
            // Half vectors of nearly opposite directions lose digits that a sharp distribution needs.
            assert!((lobe / node.lobe - 1.0).abs() < 1e-6, "alpha {alpha}, mu {mu}: {lobe}, {}", node.lobe);
        }
    }
}

#[test]
#[should_panic(expected = "alpha of microfacets is in [0.001, 1]: 0")]
fn mirrors_are_refused() {
    Ggx::new(0.0);
}
