//! Lights and points that move in small steps: the shader's form factor changes no faster than the exact one.

use crate::polygons::{self, Case, Space};
use glam::{DVec2, DVec3, Vec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::f64::consts::TAU;

/// The shader's errors at both ends of a step.
const ROUNDING: f64 = 2e-6;
/// What a light beside the point still gives where the shader takes the point for being in the light's plane: there it
/// is up to 4.8e-7 out of that plane, an angle that no lobe enlarges more than twenty times.
const IN_PLANE: f64 = 1e-5;

/// Fails unless each step of both lobes is at most the exact one, to the tolerance; returns the greatest step.
fn assert_follows(steps: &[Case], tolerance: f64) -> f64 {
    let found = polygons::shaded(steps);
    let exact: Vec<[f64; 2]> = steps.iter().map(Case::exact).collect();
    let mut greatest = 0.0_f64;
    for k in 1..steps.len() {
        for lobe in [0, 1] {
            let step = (f64::from(found[k][lobe]) - f64::from(found[k - 1][lobe])).abs();
            let allowed = (exact[k][lobe] - exact[k - 1][lobe]).abs();
            assert!(step <= allowed + tolerance, "{step:e} instead of {allowed:e} up to {:?}", steps[k]);
            greatest = greatest.max(step);
        }
    }
    greatest
}

/// Numbers from -`reach` to `reach`, ever denser towards 0, which is among them.
fn through_zero(reach: f64) -> impl Iterator<Item = f64> {
    let side = |sign: f64| (0..200).map(move |k| sign * reach * f64::powf(1e-8, f64::from(k) / 199.0));
    side(-1.0).chain([0.0]).chain(side(1.0).collect::<Vec<_>>().into_iter().rev())
}

/// The same two-sided light, seen from each of the `stands`.
fn seen_from(seed: u64, outline: &[DVec2], stands: impl Iterator<Item = DVec3>) -> Vec<Case> {
    let place = |stand| polygons::place(&mut Pcg64::seed_from_u64(seed), outline, stand, 1.0, Space::Local);
    stands.map(place).collect()
}

fn two_sided_seeds() -> impl Iterator<Item = u64> {
    let square = [DVec2::ZERO, DVec2::X, DVec2::ONE];
    (0..60).filter(move |&seed| seen_from(seed, &square, std::iter::once(DVec3::Z))[0].two_sided)
}

#[test]
fn a_light_sinks_below_the_horizon_without_a_jump() {
    let mut random = Pcg64::seed_from_u64(1);
    let mut greatest = 0.0_f64;
    for _ in 0..50 {
        // An upright light, so that no height brings the point into its plane.
        let outline = polygons::outline(&mut random, 1.0);
        let m_inv = polygons::sheen_lobe(&mut random);
        let upright: Vec<Vec3> = outline.iter().map(|at| Vec3::new(0.7, -at.x as f32, at.y as f32)).collect();
        let corner = upright[0].z;
        let lifts = (0..1000).map(|k| 0.6 - 0.0012 * k as f32).chain(through_zero(1e-3).map(|z| z as f32 - corner));
        let lifted = |lift: f32| {
            let contour = upright.iter().map(|&vertex| vertex + lift * Vec3::Z).collect();
            Case { m_inv, two_sided: true, ..Case::local(vec![contour], -Vec3::X) }
        };
        let steps: Vec<Case> = lifts.map(lifted).collect();
        greatest = greatest.max(assert_follows(&steps[..1000], ROUNDING)).max(assert_follows(&steps[1000..], ROUNDING));
    }
    assert!(greatest > 1e-4, "the light moves: {greatest:e}");
}

#[test]
fn a_point_passes_through_the_plane_beside_a_light_without_a_jump() {
    let mut random = Pcg64::seed_from_u64(2);
    let mut greatest = 0.0_f64;
    for seed in two_sided_seeds() {
        let outline = polygons::outline(&mut random, 1.0);
        let beside = random.random_range(0.6..2.0) * DVec2::from_angle(random.random_range(0.0..TAU));
        let both = seen_from(seed, &outline, through_zero(0.1).map(|height| beside.extend(height)));
        greatest = greatest.max(assert_follows(&both, IN_PLANE));
        let one: Vec<Case> = both.into_iter().map(|case| Case { two_sided: false, ..case }).collect();
        assert_follows(&one, IN_PLANE);
    }
    assert!(greatest > 1e-4, "the light brightens: {greatest:e}");
}

#[test]
fn a_point_passes_under_the_edges_of_a_light_without_a_jump() {
    let mut random = Pcg64::seed_from_u64(3);
    for seed in two_sided_seeds() {
        let outline = polygons::outline(&mut random, 1.0);
        let [edge, next] = [outline[0], outline[1]];
        for height in [0.3, 1e-3, 1e-5] {
            // Over an edge, at its end, and over its extension beyond the vertex.
            for along in [0.3, 1.0, 1.4] {
                let foot = edge.lerp(next, along);
                let out = (next - edge).perp().normalize();
                let stands = through_zero(0.1).map(|out_by| (foot + out_by * out).extend(height));
                assert_follows(&seen_from(seed, &outline, stands), ROUNDING);
            }
        }
    }
}

#[test]
#[should_panic(expected = "instead of")]
fn a_jump_is_seen() {
    let square = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)].map(|(x, y)| DVec2::new(x, y));
    let stands = through_zero(0.1).map(|height| DVec3::new(0.1, 0.2, height));
    let mut steps = seen_from(two_sided_seeds().next().unwrap(), &square, stands);
    // In the light's plane the exact form factor is dark in a single step, the shader's in a few: within the light's
    // outline that is a jump.
    steps.retain(|case| case.height() > 1e-12);
    assert_follows(&steps, IN_PLANE);
}
