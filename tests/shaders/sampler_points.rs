//! Points of polygons from the shipped file, one by one: against the reference, and where others fail.

use crate::device;
use crate::polygons::{self, Space, Stand};
use crate::sampler::{Drawn, Light, drawn, exact, lights, lobes, outlines, source};
use glam::{DVec2, DVec3, Mat3, Vec3, Vec4};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::f64::consts::{PI, TAU};

/// A convex light somewhere that has troubled area lights, with a lobe of the sheen or of the specular base.
fn adversary(random: &mut Pcg64) -> Light {
    loop {
        let mut near = |low, high| polygons::log_uniform(random, low, high);
        let (thinness, size, alpha) = (near(0.05, 1.0), near(1e-2, 1e3), near(0.05, 1.0));
        let stand = match near(1.0, 16.0).log2() as u32 {
            0 => Stand::Away(near(0.3, 30.0)),
            1 => Stand::Over(near(1e-3, 1.0)),
            2 => Stand::BesideEdge(near(1e-3, 1.0)),
            _ => Stand::Away(near(0.3, 3.0)),
        };
        let (count, start) = (random.random_range(3..=8), random.random_range(0.0..TAU));
        let corner = |k: i32| {
            let angle = start + TAU * (f64::from(k) + random.random_range(-0.45..0.45)) / f64::from(count);
            0.5 * DVec2::from_angle(angle) * DVec2::new(1.0, thinness)
        };
        let outline: Vec<DVec2> = (0..count).map(corner).collect();
        let stand = polygons::stand(random, &outline, stand);
        let case = polygons::place(random, &outline, stand, size, Space::Local);
        let m_inv = if random.random() { case.m_inv } else { polygons::specular_lobe(random, alpha) };
        let light = Light { parts: case.contours.clone(), m_inv };
        if case.height() > 1e-5 && light.share() > 1e-5 {
            return light;
        }
    }
}

/// How far a direction is outside of a light: the sine of the angle to the edge that it is beyond most.
fn outside(light: &Light, wo: DVec3) -> f64 {
    let beyond = |part: &Vec<DVec3>| {
        let turn = part.iter().sum::<DVec3>();
        let next = part.iter().cycle().skip(1);
        let planes = part.iter().zip(next).map(|(p, q)| p.cross(*q).normalize_or_zero());
        let turn = planes.clone().map(|plane| plane.dot(turn)).sum::<f64>().signum();
        planes.map(|plane| -turn * plane.dot(wo)).fold(0.0, f64::max)
    };
    light.contours().iter().map(beyond).fold(f64::INFINITY, f64::min)
}

struct Errors {
    /// Distances from the reference's points, ascending.
    off: Vec<f64>,
    outside: f64,
    share: f64,
}

fn errors(source: &str, lights: &[Light]) -> Errors {
    let mut random = Pcg64::seed_from_u64(7);
    let draws: Vec<_> = (0..lights.len()).map(|k| (k, [random.random(), random.random()])).collect();
    let found = drawn(source, lights, &draws);
    let mut errors = Errors { off: Vec::new(), outside: 0.0, share: 0.0 };
    for ((light, (_, numbers)), found) in lights.iter().zip(&draws).zip(&found) {
        let wo = found.wo.as_dvec3();
        assert!((wo.length() - 1.0).abs() < 1e-6 && wo.z > 0.0 && found.density > 0.0, "{wo} of {light:?}");
        let narrow = f64::from(light.m_inv.y_axis.y / light.m_inv.x_axis.x);
        errors.off.push(wo.distance(exact(light, *numbers).expect("it has an area")) / narrow);
        errors.outside = errors.outside.max(outside(light, wo) / narrow);
        errors.share = errors.share.max((f64::from(found.share) - light.share()).abs() / narrow);
        assert!((found.share - found.form_factor).abs() < 3e-6, "{} {}", found.share, found.form_factor);
    }
    errors.off.sort_by(f64::total_cmp);
    errors
}

#[test]
fn points_are_those_of_the_reference() {
    let mut random = Pcg64::seed_from_u64(6);
    let lights: Vec<Light> = (0..20_000).map(|_| adversary(&mut random)).collect();
    let found = errors(&source(), &lights);
    let [half, most, nearly] = [0.5, 0.99, 0.999].map(|share| found.off[(share * lights.len() as f64) as usize]);
    println!(
        "off by {half:.1e}, 99% {most:.1e}, 99.9% {nearly:.1e}; outside {:.1e}; share {:.1e}",
        found.outside, found.share
    );
    assert!(half < 1e-6 && most < 1e-3);
    assert!(found.outside < 1e-5 && found.share < 1e-5);
    // The first guess is good: one step shows in one point of a hundred.
    let hasty = errors(&source().replace("LTC_SAMPLE_STEPS = 3u", "LTC_SAMPLE_STEPS = 1u"), &lights);
    assert!(hasty.off[(0.99 * lights.len() as f64) as usize] > 5.0 * most);
}

const LAST: f32 = 1.0 - 1.0 / 16_777_216.0;

#[test]
fn the_corners_of_the_unit_square_give_directions_of_the_light() {
    let (_, around) = &lights()[0];
    assert!(outside(around, DVec3::Z) == 0.0 && outside(around, DVec3::new(1.0, 0.0, 0.7).normalize()) > 0.01);
    for (name, light) in lights() {
        let corners = [0.0, 1e-30, 0.5, LAST].into_iter().flat_map(|u| [0.0, 0.5, LAST].map(|v| (0, [u, v])));
        for found in drawn(&source(), std::slice::from_ref(&light), &corners.collect::<Vec<_>>()) {
            let wo = found.wo.as_dvec3();
            assert!((wo.length() - 1.0).abs() < 1e-6 && wo.z > 0.0 && found.density > 0.0, "{name}: {wo}");
            let beyond = outside(&light, wo);
            assert!(
                beyond < 2e-6 * light.m_inv.y_axis.y.max(1.0) as f64,
                "{name}, {:?}: {wo} is outside by {beyond:e}",
                light.m_inv
            );
        }
    }
}

#[test]
fn where_there_is_nothing_to_draw_there_is_no_direction() {
    let of = |corners: &[[f32; 3]]| corners.iter().map(|&corner| Vec3::from(corner)).collect::<Vec<_>>();
    let (p, q) = ([0.3, -0.4, 0.8], [-0.7, 0.2, 0.5]);
    let square = of(&[[-1.0, -1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, 1.0], [-1.0, 1.0, 1.0]]);
    let moved = |by: Vec3| square.iter().map(|corner| *corner + by).collect::<Vec<_>>();
    let nothing = [
        ("behind the horizon", moved(Vec3::Z * -3.0)),
        ("in the light's plane", moved(Vec3::new(0.3, 0.2, -1.0))),
        ("on its edge", moved(Vec3::new(1.0, 0.0, -1.0))),
        ("at its vertex", moved(Vec3::new(1.0, 1.0, -1.0))),
        ("a point", of(&[p])),
        ("a line", of(&[p, q])),
        ("a line, there and back", of(&[p, q, p])),
        ("the origin", vec![Vec3::ZERO; 3]),
        ("on the horizon", of(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]])),
    ];
    let singular = Mat3::from_cols(Vec3::ZERO, Vec3::ZERO, Vec3::new(-0.4, 0.0, 1.0));
    let lobes = [Mat3::IDENTITY, Mat3::from_cols(Vec3::X * 0.4, Vec3::Y * 0.4, Vec3::new(-0.5, 0.0, 1.0))];
    let dark = nothing.iter().flat_map(|(name, part)| lobes.map(|m_inv| (*name, part.clone(), m_inv)));
    for (name, part, m_inv) in dark.chain([("no lobe", square.clone(), singular)]) {
        let light = Light { parts: vec![part], m_inv };
        for found in drawn(&source(), &[light], &[(0, [0.0, 0.0]), (0, [0.5, 0.5]), (0, [LAST, LAST])]) {
            assert!(found.form_factor < 1e-7, "{name}: {found:?}");
            assert!(found.wo == Vec3::ZERO || found.form_factor > 0.0 && found.wo.is_finite(), "{name}: {found:?}");
        }
    }
}

/// The mean of cos / (pi p) over points of density p is the diffuse form factor.
#[test]
fn the_density_is_the_lobes_over_the_form_factor() {
    const COUNT: usize = 100_000;
    let mut random = Pcg64::seed_from_u64(8);
    for name in ["around the zenith", "beside it", "across the horizon", "small"] {
        let part = outlines().into_iter().find(|(other, _)| *other == name).expect("it is there").1;
        for m_inv in lobes().into_iter().take(6) {
            let light = Light { parts: vec![part.clone()], m_inv };
            let draws: Vec<_> = (0..COUNT).map(|_| (0, [random.random(), random.random()])).collect();
            let found = drawn(&source(), std::slice::from_ref(&light), &draws);
            let of = |found: &Drawn| f64::from(found.wo.z / found.density * found.form_factor) / PI;
            let mean = found.iter().map(of).sum::<f64>() / COUNT as f64;
            let square = found.iter().map(|found| of(found).powi(2)).sum::<f64>() / COUNT as f64;
            let deviation = ((square - mean * mean).max(0.0) / COUNT as f64).sqrt();
            let expected = Light { m_inv: Mat3::IDENTITY, ..light }.share();
            // 4.5 standard errors: one set of these 24 in 6000 is off.
            assert!(
                (mean - expected).abs() < 4.5 * deviation + 1e-4 * expected,
                "{name}, {m_inv:?}: {mean} {expected}"
            );
        }
    }
}

/// The file's own copies of two functions give the same bits.
#[test]
fn what_is_copied_from_the_other_file_is_the_same() {
    let main = "
        @group(0) @binding(0) var<storage, read_write> results: array<vec4<u32>>;
        @group(0) @binding(1) var<storage, read> inputs: array<vec4<f32>>;
        @compute @workgroup_size(64)
        fn main(@builtin(global_invocation_id) id: vec3<u32>) {
            if id.x >= arrayLength(&results) { return; }
            let p = inputs[2u * id.x].xyz;
            let q = inputs[2u * id.x + 1u].xyz;
            let crossed = bitcast<vec3<u32>>(ltc_cross(p, q)) ^ bitcast<vec3<u32>>(ltc_sample_cross(p, q));
            let angle = bitcast<u32>(ltc_angle(abs(p.x), q.y)) ^ bitcast<u32>(ltc_sample_angle(abs(p.x), q.y));
            results[id.x] = vec4(crossed, angle);
        }";
    let mut random = Pcg64::seed_from_u64(9);
    let inputs: Vec<Vec4> = (0..200_000)
        .map(|_| polygons::direction(&mut random) * polygons::log_uniform(&mut random, 1e-6, 1e6))
        .map(|v| v.as_vec3().extend(0.0))
        .collect();
    let differ = |source: String| {
        let found: Vec<[u32; 4]> =
            device::run(&[&source, main].concat(), &[bytemuck::cast_slice(&inputs)], None, inputs.len() / 2);
        found.into_iter().filter(|bits| *bits != [0; 4]).count()
    };
    assert_eq!(differ(source()), 0);
    let last = source().rfind("0.99999753").expect("the copy comes last");
    let mut other = source();
    other.replace_range(last..last + 10, "0.99999750");
    assert!(differ(other) > 0);
}
