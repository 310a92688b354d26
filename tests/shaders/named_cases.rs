//! Where others return NaN, leak light or go black: one test for each case.

use crate::polygons::{self, Case, Space, Stand};
use glam::{Mat3, Vec2, Vec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// A few roundings of numbers near 1.
const ROUNDING: f64 = 1e-6;

/// Compares both lobes of every case with the reference, and returns their values.
fn assert_exact(cases: &[Case]) -> Vec<[f32; 2]> {
    let found = polygons::shaded(cases);
    for (case, found) in cases.iter().zip(&found) {
        for (exact, found) in case.exact().into_iter().zip(found) {
            assert!((f64::from(*found) - exact).abs() <= ROUNDING, "{found} instead of {exact}: {case:?}");
        }
    }
    found
}

fn assert_dark(cases: &[Case]) {
    for (case, found) in cases.iter().zip(polygons::shaded(cases)) {
        assert_eq!(found, [0.0, 0.0], "{case:?}");
    }
}

fn sheen(a: f32, b: f32) -> Mat3 {
    Mat3::from_cols(Vec3::X * a, Vec3::Y * a, Vec3::new(b, 0.0, 1.0))
}

/// A square of side 2 over the point, facing down; `shift` moves it.
fn square(shift: Vec3) -> Case {
    let corners = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)];
    let contour = corners.map(|(x, y)| Vec3::new(x, y, 0.0) + shift).to_vec();
    Case { m_inv: sheen(0.4, -0.5), ..Case::local(vec![contour], -Vec3::Z) }
}

/// The same light in an upright plane, half of it below the horizon.
fn wall(shift: Vec3) -> Case {
    let upright = Mat3::from_cols(Vec3::Y, Vec3::Z, Vec3::X);
    let flat = square(upright.transpose() * shift);
    let contours = vec![flat.contours[0].iter().map(|&vertex| upright * vertex).collect()];
    Case { contours, light_normal: -Vec3::X, ..flat }
}

#[test]
fn a_view_along_the_normal_gives_a_frame_and_any_tangent_serves() {
    let mut random = Pcg64::seed_from_u64(1);
    let mut cases = Vec::new();
    for _ in 0..500 {
        let normal = polygons::direction(&mut random).as_vec3();
        let outline = polygons::outline(&mut random, 1.0);
        let stand = polygons::stand(&mut random, &outline, Stand::Away(1.5));
        let placed = polygons::place(&mut random, &outline, stand, 1.0, Space::World);
        // A lobe without a tilt doesn't know which tangent it got.
        let upright = Case { normal, position: placed.position, m_inv: sheen(0.4, 0.0), ..placed };
        let off_by_a_bit = (normal + Vec3::new(6e-8, -6e-8, 6e-8)).normalize();
        cases.extend([normal, -normal, off_by_a_bit].map(|view| Case { view, ..upright.clone() }));
    }
    for pole in [Vec3::Z, -Vec3::Z, Vec3::X, Vec3::Y] {
        cases.push(Case {
            normal: pole,
            view: pole,
            position: Vec3::Z,
            m_inv: sheen(0.4, 0.0),
            ..square(Vec3::ONE * 2.0)
        });
    }
    assert_exact(&cases);
}

#[test]
fn a_view_below_the_horizon_gives_the_frame_of_its_projection() {
    let mut random = Pcg64::seed_from_u64(2);
    let cases: Vec<Case> = std::iter::repeat_with(|| {
        let outline = polygons::outline(&mut random, 1.0);
        let stand = polygons::stand(&mut random, &outline, Stand::Away(1.5));
        let case = polygons::place(&mut random, &outline, stand, 1.0, Space::World);
        let view = if case.view.dot(case.normal) > 0.0 { -case.view } else { case.view };
        Case { view, ..case }
    })
    .take(500)
    .collect();
    assert_exact(&cases);
}

#[test]
fn in_the_plane_of_a_light_it_is_dark() {
    let inside = [(0.0, 0.0), (0.3, -0.9), (1e-6, 0.999)];
    let outside = [(1.5, 0.0), (-20.0, 1.0), (0.0, 1.000001)];
    let edge = [(1.0, 0.0), (0.25, -1.0), (-1.0, 0.999)];
    let vertex = [(1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
    let mut cases = Vec::new();
    for (x, y) in inside.into_iter().chain(outside).chain(edge).chain(vertex) {
        for two_sided in [false, true] {
            cases.push(Case { two_sided, ..square(Vec3::new(x, y, 0.0)) });
            cases.push(Case { two_sided, ..wall(Vec3::new(0.0, x, y)) });
        }
    }
    assert_dark(&cases);
}

#[test]
fn in_the_plane_of_an_oblique_light_it_is_dark_although_both_are_rounded() {
    let mut random = Pcg64::seed_from_u64(3);
    for space in [Space::Local, Space::World] {
        let mut cases = Vec::new();
        while cases.len() < 10_000 {
            let outline = polygons::outline(&mut random, 1.0);
            let stand = polygons::stand(&mut random, &outline, Stand::Over(0.0));
            let case = polygons::place(&mut random, &outline, stand, 1.0, space);
            // Coordinates are rounded relative to their own size: to a point much nearer to a vertex than to the origin
            // that is more. And a sliver's vertices, once rounded, span another plane.
            let near = case.position.length() > case.contours[0][0].distance(case.position);
            if !near && polygons::area_of(&case.contours[0]).length() > 0.1 {
                cases.push(Case { two_sided: true, ..case });
            }
        }
        assert_dark(&cases);
    }
}

#[test]
fn a_hundred_thousandth_of_its_size_above_a_surface_a_light_is_a_light() {
    let mut random = Pcg64::seed_from_u64(4);
    let mut cases = vec![square(Vec3::Z * 2e-5), square(Vec3::new(0.9, -0.9, 2e-5)), wall(Vec3::X * 2e-5)];
    for _ in 0..1000 {
        let outline = polygons::outline(&mut random, 1.0);
        let stand = polygons::stand(&mut random, &outline, Stand::Over(1e-5));
        cases.push(polygons::place(&mut random, &outline, stand, 1.0, Space::Local));
    }
    let found = assert_exact(&cases);
    assert!(found[0][0] > 0.9999 && found[2][0] > 0.49, "{found:?}");
}

#[test]
fn behind_a_one_sided_light_it_is_dark_and_a_two_sided_one_shines_as_brightly() {
    let front = [square(Vec3::new(0.3, 0.2, 0.7)), wall(Vec3::new(0.5, 0.1, 0.2))];
    // Turned over: the outline runs the other way round, and the normal is the opposite.
    let behind = front.clone().map(|case| {
        let contours = case.contours.iter().map(|contour| contour.iter().rev().copied().collect()).collect();
        Case { contours, light_normal: -case.light_normal, ..case }
    });
    assert_dark(&behind);
    let two_sided = behind.map(|case| Case { two_sided: true, ..case });
    for (back, front) in assert_exact(&two_sided).iter().zip(assert_exact(&front)) {
        assert!(back.iter().zip(front).all(|(back, front)| (back - front).abs() < 1e-6 && front > 0.01));
    }
}

#[test]
fn wholly_below_the_horizon_and_on_it_there_is_nothing() {
    let below = square(Vec3::new(0.3, 0.2, -0.7));
    let upside_down = below.contours[0].iter().rev().copied().collect();
    let mut cases = vec![
        Case { contours: vec![upside_down], light_normal: Vec3::Z, ..below.clone() },
        Case { two_sided: true, ..below },
        wall(Vec3::new(1.0, 0.0, -1.0)),
        wall(Vec3::new(1.0, 0.0, -3.0)),
    ];
    // Vertices that touch the horizon from below, with -0 too.
    cases.push(wall(Vec3::new(1.0, 0.0, -1.0)));
    cases[4].contours[0].iter_mut().filter(|vertex| vertex.z == 0.0).for_each(|vertex| vertex.z = -0.0);
    assert_dark(&cases);
    // Lights that stand on the horizon, with vertices on it or off it by less than anything can resolve.
    let standing = [0.0, 1e-30, -1e-30, 1e-12, -1e-12, 1e-7, -1e-7].map(|lift| {
        let mut case = wall(Vec3::new(1.0, 0.0, 1.0));
        case.contours[0].iter_mut().filter(|vertex| vertex.z == 0.0).enumerate().for_each(|(k, vertex)| {
            vertex.z = if k == 0 { lift } else { -lift };
        });
        case
    });
    assert_exact(&standing);
}

#[test]
fn a_comb_that_crosses_the_horizon_two_hundred_times_is_exact() {
    let teeth = (0..200).map(|k| Vec3::new(0.5, 1.0 - 0.01 * k as f32, if k % 2 == 0 { -0.1 } else { 0.05 }));
    let comb: Vec<Vec3> = [Vec3::new(0.5, -1.0, 0.3), Vec3::new(0.5, 1.0, 0.3)].into_iter().chain(teeth).collect();
    let lobes = [Mat3::IDENTITY, sheen(0.1, -0.7), Mat3::from_cols(Vec3::X, Vec3::Y * 1e3, Vec3::new(30.0, 0.0, 1.0))];
    let cases = lobes.map(|m_inv| Case { m_inv, ..Case::local(vec![comb.clone()], -Vec3::X) });
    let errors = |k: usize, found: [f32; 2]| {
        let exact = cases[k].exact();
        [0, 1].map(|lobe| (f64::from(found[lobe]) - exact[lobe]).abs())
    };
    for (k, found) in polygons::shaded(&cases).into_iter().enumerate() {
        assert!(found.iter().all(|&found| found > 1e-4), "{found:?}");
        // One rounding for each of two hundred angles and directions.
        assert!(errors(k, found).iter().all(|&error| error < 200.0 * 6e-8), "{found:?} by {:?}", errors(k, found));
    }
}

#[test]
fn polygons_without_an_area_are_dark_and_repeated_or_collinear_vertices_change_nothing() {
    let [p, q] = [Vec3::new(0.3, -0.4, 0.8), Vec3::new(-0.7, 0.2, 0.5)];
    let lines = [
        vec![p],
        vec![p, q],
        vec![p, p, p],
        vec![p, q, p],
        vec![p, p.lerp(q, 0.5), q, p.lerp(q, 0.5)],
        vec![p, -p],
        vec![p, q * Vec3::new(1.0, 1.0, -1.0)],
        vec![Vec3::ZERO, Vec3::ZERO, Vec3::ZERO],
        vec![Vec3::ZERO, p, Vec3::ZERO],
        vec![Vec3::X, -Vec3::X],
    ];
    for contour in &lines {
        // A light without an area has no normal; whatever a loader makes up for it, nothing arrives.
        for light_normal in [Vec3::ZERO, -Vec3::Z, Vec3::X] {
            let case =
                Case { two_sided: true, m_inv: sheen(0.4, -0.5), ..Case::local(vec![contour.clone()], light_normal) };
            let found = polygons::shaded(&[case])[0];
            assert!(found.iter().all(|found| (0.0..=1e-6).contains(found)), "{found:?} from {contour:?}");
        }
    }
    assert_dark(&[Case::local(vec![lines[0].clone()], Vec3::ZERO)]);

    for case in [square(Vec3::new(0.3, 0.2, 0.7)), wall(Vec3::new(0.5, 0.1, 0.2))] {
        let corners = case.contours[0].clone();
        let twice = corners.iter().flat_map(|&corner| [corner, corner]).collect();
        let next = corners.iter().cycle().skip(1);
        let split = corners.iter().zip(next).flat_map(|(&p, &q)| [p, p.lerp(q, 0.25), p.lerp(q, 0.5)]).collect();
        let with_lines = std::iter::once(corners.clone()).chain(lines[..5].iter().cloned()).collect();
        let variants = [vec![twice], vec![split], with_lines].map(|contours| Case { contours, ..case.clone() });
        let plain = assert_exact(std::slice::from_ref(&case))[0];
        for found in polygons::shaded(&variants) {
            assert!(found.iter().zip(plain).all(|(found, plain)| (found - plain).abs() < 1e-6), "{found:?} {plain:?}");
        }
    }
}

#[test]
fn a_lobe_of_a_zero_contributes_nothing_and_b_may_be_positive() {
    let lights = [square(Vec3::new(0.3, 0.2, 0.7)), wall(Vec3::new(0.5, 0.1, 0.2))];
    for light in &lights {
        for b in [0.0, -0.7, 0.2] {
            let found = polygons::shaded(&[Case { m_inv: sheen(0.0, b), ..light.clone() }])[0];
            assert!(found[0] > 0.01 && found[1] == 0.0, "{found:?}");
        }
    }
    let lobes = [(0.05, 0.03), (0.5, 0.3), (1.2, 0.9), (1e-4, 1e-5), (1e-6, -1.0)];
    let cases = lobes.map(|(a, b)| lights.clone().map(|light| Case { m_inv: sheen(a, b), ..light }));
    assert_exact(cases.as_flattened());
}

#[test]
fn a_lobe_may_be_narrow_one_way_and_wide_the_other() {
    let mut random = Pcg64::seed_from_u64(5);
    let mut cases = Vec::new();
    while cases.len() < 2000 {
        let mut entry = |low, high| polygons::log_uniform(&mut random, low, high) as f32;
        let (a, c) = (entry(1e-2, 10.0), entry(1e-2, 10.0));
        let b = random.random_range(-1.5..1.5);
        let m_inv = Mat3::from_cols(Vec3::X * a, Vec3::Y * c, Vec3::new(b, 0.0, 1.0));
        let outline = polygons::outline(&mut random, 1.0);
        let stand = polygons::stand(&mut random, &outline, Stand::Away(1.0));
        cases.push(Case { m_inv, ..polygons::place(&mut random, &outline, stand, 1.0, Space::Local) });
    }
    assert_exact(&cases);
}

#[test]
fn six_lights_around_a_point_light_every_lobe_wholly() {
    let mut random = Pcg64::seed_from_u64(6);
    for _ in 0..20 {
        let position = Vec3::from_array(std::array::from_fn(|_| random.random_range(-0.99..0.99)));
        let normal = polygons::direction(&mut random).as_vec3();
        let view = polygons::direction(&mut random).as_vec3();
        let m_inv = polygons::sheen_lobe(&mut random);
        let faces: Vec<Case> = [Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y, -Vec3::Z]
            .map(|light_normal| {
                let (s, t) = light_normal.any_orthonormal_pair();
                let corner = |at: Vec2| -light_normal + s * at.x + t * at.y;
                let corners = [Vec2::new(1.0, 1.0), Vec2::new(-1.0, 1.0), Vec2::new(-1.0, -1.0), Vec2::new(1.0, -1.0)];
                let contours = vec![corners.map(corner).to_vec()];
                Case { position, normal, view, m_inv, ..Case::local(contours, light_normal) }
            })
            .to_vec();
        let found = polygons::shaded(&faces);
        for lobe in [0, 1] {
            let sum: f32 = found.iter().map(|found| found[lobe]).sum();
            // The rounding of six walks of four edges.
            assert!((sum - 1.0).abs() < 3e-6, "{sum} at {position} facing {normal}");
        }
    }
}
