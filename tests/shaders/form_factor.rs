//! The polygon integral of the shipped file, run on a device, against the reference's in `f64`, which is fed the same
//! `f32`.

use crate::files;
use crate::polygons::{self, Case, Space, Stand};
use glam::DVec2;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::f64::consts::TAU;

/// Draws at random where the point is and how thin the light is.
type Draw = fn(&mut Pcg64) -> (Stand, f64);

/// Errors of the form factors, of both lobes of each case.
struct Errors {
    greatest: f64,
    mean: f64,
}

impl std::fmt::Debug for Errors {
    fn fmt(&self, out: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(out, "greatest {:.1e}, mean {:.1e}", self.greatest, self.mean)
    }
}

impl Errors {
    fn within(&self, greatest: f64, mean: f64) -> bool {
        self.greatest <= greatest && self.mean <= mean
    }
}

/// The errors of the source `ltc`. Fails where a form factor is not a number in [0, 1].
fn errors(ltc: &str, cases: &[Case]) -> Errors {
    let mut errors = Errors { greatest: 0.0, mean: 0.0 };
    for (case, shaded) in cases.iter().zip(polygons::shaded_by(ltc, cases)) {
        for (exact, shaded) in case.exact().into_iter().zip(shaded) {
            assert!((0.0..=1.0).contains(&shaded), "{shaded} for {case:?}");
            let error = (f64::from(shaded) - exact).abs();
            errors.greatest = errors.greatest.max(error);
            errors.mean += error / (2 * cases.len()) as f64;
        }
    }
    errors
}

/// `count` cases of polygons, for which `draw` gives a stand and a thinness. Points that the shader takes for being in
/// the light's plane have a test of their own: here they are drawn anew.
fn family(seed: u64, count: usize, space: Space, draw: Draw) -> Vec<Case> {
    let mut random = Pcg64::seed_from_u64(seed);
    let mut cases = Vec::with_capacity(count);
    while cases.len() < count {
        let (stand, thinness) = draw(&mut random);
        let outline = polygons::outline(&mut random, thinness);
        let stand = polygons::stand(&mut random, &outline, stand);
        let size = polygons::log_uniform(&mut random, 1e-3, 1e4);
        let case = polygons::place(&mut random, &outline, stand, size, space);
        if case.height() > 6e-7 {
            cases.push(case);
        }
    }
    cases
}

/// Near and far, tiny and huge, grazing, over and beside the light, thin lights; all of them also partly below the
/// horizon.
fn anything(random: &mut Pcg64) -> (Stand, f64) {
    let thinness = polygons::log_uniform(random, 0.1, 1.0);
    match random.random_range(0..5) {
        0 => (Stand::Away(polygons::log_uniform(random, 0.3, 1e3)), thinness),
        1 => (Stand::Over(polygons::log_uniform(random, 1e-3, 1.0)), thinness),
        2 => (Stand::Over(polygons::log_uniform(random, 1e-5, 1e-3)), thinness),
        3 => (Stand::BesideEdge(polygons::log_uniform(random, 3e-3, 1.0)), thinness),
        _ => (Stand::Away(polygons::log_uniform(random, 0.3, 10.0)), polygons::log_uniform(random, 1e-5, 0.1)),
    }
}

#[test]
fn random_polygons_agree_with_the_exact_form_factor() {
    let ltc = files::source("ltc.wgsl");
    let local = errors(&ltc, &family(1, 50_000, Space::Local, anything));
    let world = errors(&ltc, &family(2, 50_000, Space::World, anything));
    println!("vertices in the local frame {local:?}, in the world {world:?}");
    // A handful of roundings of numbers near 1, of 6e-8 each.
    assert!(local.within(1e-6, 5e-8), "{local:?}");
    // Transforming vertices to the local frame rounds them to 1e-7 of their distance, which is 300 times more of a near
    // edge's.
    assert!(world.within(1e-4, 1e-6), "{world:?}");
}

#[test]
fn a_hair_from_an_edge_costs_nothing_but_the_rounding_of_the_vertices() {
    let ltc = files::source("ltc.wgsl");
    let near: [Draw; 4] = [
        |random| (Stand::BesideEdge(1e-3), polygons::log_uniform(random, 0.1, 1.0)),
        |random| (Stand::BesideEdge(1e-4), polygons::log_uniform(random, 0.1, 1.0)),
        |random| (Stand::BesideEdge(1e-5), polygons::log_uniform(random, 0.1, 1.0)),
        |random| (Stand::BesideEdge(1e-6), polygons::log_uniform(random, 0.1, 1.0)),
    ];
    for (k, draw) in near.into_iter().enumerate() {
        let distance = 1e-3 / 10_f64.powi(k as i32);
        let local = errors(&ltc, &family(3, 10_000, Space::Local, draw));
        let world = errors(&ltc, &family(4, 10_000, Space::World, draw));
        println!("{distance:e} of its size from an edge: local {local:?}, world {world:?}");
        // Products of split factors are good to 2^-35 of the product of two distances.
        assert!(local.within(1e-6 + 1e-11 / distance, 1e-7 + 1e-13 / distance), "{distance:e}: {local:?}");
        // What the caller rounded before the walk began: about 2^-23 of the size, as an angle seen from that distance.
        assert!(world.within(2e-7 / distance, 2e-9 / distance), "{distance:e}: {world:?}");
    }
}

#[test]
fn a_hair_above_the_surface_light_of_any_width_is_exact() {
    let ltc = files::source("ltc.wgsl");
    let cases = family(5, 20_000, Space::Local, |random| (Stand::Over(polygons::log_uniform(random, 2e-6, 1e-4)), 1.0));
    let local = errors(&ltc, &cases);
    println!("2e-6 to 1e-4 of its size over a light: {local:?}");
    assert!(local.within(1e-6, 5e-8), "{local:?}");
}

#[test]
fn several_contours_are_one_polygon() {
    let mut random = Pcg64::seed_from_u64(6);
    let mut cases = Vec::new();
    while cases.len() < 20_000 {
        let (stand, thinness) = anything(&mut random);
        let outline = polygons::outline(&mut random, thinness);
        let stand = polygons::stand(&mut random, &outline, stand);
        // An outline of few corners may not contain the centre, around which the hole is a smaller copy of the outline.
        if (0..outline.len()).any(|k| outline[k].perp_dot(outline[(k + 1) % outline.len()]) <= 0.0) {
            continue;
        }
        let scale = random.random_range(0.1..0.9);
        let hole = outline.iter().rev().map(|&vertex| scale * vertex).collect();
        // A second outline lies beside the first.
        let aside = 1.1 * DVec2::from_angle(random.random_range(0.0..TAU));
        let island = outline.iter().map(|&vertex| vertex + aside).collect();
        let size = polygons::log_uniform(&mut random, 1e-3, 1e4);
        let case = polygons::place_contours(&mut random, &[outline, hole, island], stand, size, Space::Local);
        if case.height() > 6e-7 {
            cases.push(case);
        }
    }
    let errors = errors(&files::source("ltc.wgsl"), &cases);
    println!("with a hole and an island: {errors:?}");
    assert!(errors.within(1e-6, 5e-8), "{errors:?}");
}

#[test]
fn errors_are_seen_where_clipping_precision_or_a_sign_is_missing() {
    let shipped = files::source("ltc.wgsl");
    let broken = |from: &str, to: &str| {
        assert_eq!(shipped.matches(from).count(), 1, "'{from}' stands once in the file");
        shipped.replace(from, to)
    };
    let cases = family(1, 2_000, Space::Local, anything);
    assert!(errors(&shipped, &cases).within(1e-6, 5e-8));
    // No clipping; no path along the horizon; that path taken in the wrong sense; an angle that is only roughly right.
    for (from, to) in [
        ("const LTC_HORIZON = 1e-20;", "const LTC_HORIZON = -1e30;"),
        ("abs(side) * ltc_angle(", "0.0 * ltc_angle("),
        ("abs(side) * ltc_angle(", "-abs(side) * ltc_angle("),
        ("0.99999753", "0.9999"),
    ] {
        let found = errors(&broken(from, to), &cases);
        assert!(!found.within(1e-6, 5e-8), "'{to}' goes unnoticed: {found:?}");
    }
    // Near an edge it shows where products aren't split.
    let near = family(3, 2_000, Space::Local, |_| (Stand::BesideEdge(1e-4), 1.0));
    let found = errors(&broken("+ 0.5 * rest", "+ 0.4 * rest"), &near);
    assert!(!found.within(1e-6, 1e-7), "{found:?}");
}
