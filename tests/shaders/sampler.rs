//! Points of polygons from the shipped file: against form factors of the polygons' pieces, and one by one against the reference.

use crate::polygons::{self, Space, Stand};
use crate::sampling::p_value;
use crate::{device, files};
use glam::{DVec2, DVec3, Mat3, Vec3, Vec4};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::collections::HashMap;
use std::f64::consts::TAU;
use velour::reference::convex::Convex;
use velour::reference::polygon::form_factor;

/// A light of convex parts in the shading frame, and a lobe.
#[derive(Clone, Debug)]
struct Light {
    parts: Vec<Vec<Vec3>>,
    m_inv: Mat3,
}

#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct PackedLight {
    m_inv: [[f32; 4]; 3],
    first: u32,
    count: u32,
    padding: [u32; 2],
}

/// What the device gives back.
#[repr(C)]
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
struct Drawn {
    wo: Vec3,
    share: f32,
    form_factor: f32,
    density: f32,
    padding: [u32; 2],
}

fn source() -> String {
    ["ltc.wgsl", "ltc_sample.wgsl"].map(files::source).concat()
}

/// Draws from lights, by index and uniform numbers.
fn drawn(source: &str, lights: &[Light], draws: &[(usize, [f32; 2])]) -> Vec<Drawn> {
    let (mut packed, mut parts, mut vertices) = (Vec::new(), Vec::<[u32; 2]>::new(), Vec::<Vec4>::new());
    for light in lights {
        let m_inv = [0, 1, 2].map(|column| light.m_inv.col(column).extend(0.0).to_array());
        packed.push(PackedLight { m_inv, first: parts.len() as u32, count: light.parts.len() as u32, padding: [0; 2] });
        for part in &light.parts {
            parts.push([vertices.len() as u32, part.len() as u32]);
            vertices.extend(part.iter().map(|vertex| vertex.extend(0.0)));
            vertices.push(polygons::area_of(part).normalize_or_zero().as_vec3().extend(0.0));
        }
    }
    let draws: Vec<Vec4> =
        draws.iter().map(|&(light, [u, v])| Vec4::new(u, v, f32::from_bits(light as u32), 0.0)).collect();
    let source = [source, include_str!("sampler.wgsl")].concat();
    let inputs = [
        bytemuck::cast_slice(&packed),
        bytemuck::cast_slice(&parts),
        bytemuck::cast_slice(&vertices),
        bytemuck::cast_slice(&draws),
    ];
    device::run(&source, &inputs, None, draws.len())
}

impl Light {
    fn contours(&self) -> Vec<Vec<DVec3>> {
        self.parts.iter().map(|part| part.iter().map(|vertex| vertex.as_dvec3()).collect()).collect()
    }

    /// The form factor of all parts.
    fn share(&self) -> f64 {
        share(&self.contours(), self.m_inv)
    }
}

fn share(parts: &[Vec<DVec3>], m_inv: Mat3) -> f64 {
    parts.iter().map(|part| form_factor(std::slice::from_ref(part), m_inv.as_dmat3(), true)).sum()
}

fn clip(outline: &[DVec3], plane: DVec3) -> Vec<DVec3> {
    let mut kept = Vec::new();
    for (p, q) in outline.iter().zip(outline.iter().cycle().skip(1)) {
        let [start, end] = [p, q].map(|vertex| plane.dot(*vertex));
        if start >= 0.0 {
            kept.push(*p);
        }
        if (start < 0.0) != (end < 0.0) {
            kept.push(p.lerp(*q, start / (start - end)));
        }
    }
    kept
}

/// The pieces into which planes cut parts, by the sides on which they are, with their shares of the lobe.
fn pieces(light: &Light, planes: &[DVec3]) -> HashMap<u32, f64> {
    let mut pieces = vec![(0, light.contours())];
    for (k, plane) in planes.iter().enumerate() {
        let halves = pieces.into_iter().flat_map(|(sides, parts)| {
            let half = |plane: DVec3| parts.iter().map(|part| clip(part, plane)).collect::<Vec<_>>();
            [(sides, half(-*plane)), (sides | 1 << k, half(*plane))]
        });
        pieces = halves.filter(|(_, parts)| parts.iter().any(|part| part.len() > 2)).collect();
    }
    pieces.into_iter().map(|(sides, parts)| (sides, share(&parts, light.m_inv))).collect()
}

/// Lobes from dust to fuzz, and specular ones down to a narrow one that leans.
fn lobes() -> Vec<Mat3> {
    let lobe = |a: f32, c: f32, b: f32| Mat3::from_cols(Vec3::X * a, Vec3::Y * c, Vec3::new(b, 0.0, 1.0));
    vec![
        Mat3::IDENTITY,
        lobe(0.6, 0.6, -0.3),
        lobe(0.2, 0.2, -0.9),
        lobe(0.1, 0.1, -0.2),
        lobe(1.2, 1.2, 0.3),
        lobe(2.5, 5.0, 2.4),
        lobe(8.0, 20.0, 9.0),
    ]
}

/// Polygons that have something to be wrong about.
fn outlines() -> Vec<(&'static str, Vec<Vec3>)> {
    let disk = (0..32).map(|k| {
        let (sin, cos) = (std::f32::consts::TAU * k as f32 / 32.0).sin_cos();
        Vec3::new(0.3 + cos, sin, 0.8)
    });
    let of = |corners: &[[f32; 3]]| corners.iter().map(|&corner| Vec3::from(corner)).collect::<Vec<_>>();
    vec![
        ("around the zenith", of(&[[-1.0, -1.0, 1.0], [1.0, -1.0, 0.5], [1.0, 1.0, 1.0], [-1.0, 1.0, 1.5]])),
        ("beside it", of(&[[0.2, 0.1, 1.0], [1.0, 0.3, 0.7], [0.5, 1.0, 0.2]])),
        ("zenith on an edge", of(&[[0.0, -1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, 1.0], [0.0, 1.0, 1.0]])),
        ("zenith at a vertex", of(&[[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.0]])),
        ("zenith on a diagonal", of(&[[-1.0, -1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, 1.0], [-1.0, 1.0, 1.0]])),
        ("on the horizon", of(&[[1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [1.0, -1.0, 1.0]])),
        ("a vertex on it", of(&[[1.0, 0.2, 0.0], [1.2, 1.0, 0.6], [0.8, -0.4, 0.9]])),
        ("across the horizon", of(&[[1.0, -1.0, -0.5], [1.0, 1.0, -0.7], [1.0, 1.0, 1.0], [1.0, -1.0, 1.0]])),
        ("one vertex above it", of(&[[1.0, -1.0, -0.5], [1.0, 1.0, -0.7], [1.0, 0.0, 1.0]])),
        ("a hair over a light", of(&[[-1.0, -1.0, 1e-4], [1.0, -1.0, 1e-4], [1.0, 1.0, 1e-4], [-1.0, 1.0, 1e-4]])),
        ("a hair before a wall", of(&[[1e-4, -1.0, -1.0], [1e-4, 1.0, -1.0], [1e-4, 1.0, 1.0], [1e-4, -1.0, 1.0]])),
        ("beside an edge", of(&[[1e-4, -1.0, 1e-4], [1.0, -1.0, 1e-4], [1.0, 1.0, 1e-4], [1e-4, 1.0, 1e-4]])),
        ("a low strip", of(&[[-3.0, 2.0, 0.0], [3.0, 2.0, 0.0], [3.0, 2.0, 0.1], [-3.0, 2.0, 0.2]])),
        ("small", of(&[[0.5, 0.5, 1.0], [0.51, 0.5, 1.0], [0.51, 0.51, 1.0], [0.5, 0.51, 1.0]])),
        ("narrow", of(&[[0.5, 0.5, 1.0], [0.5, -1.5, 0.5], [0.501, -1.5, 0.5], [0.501, 0.5, 1.0]])),
        ("narrow over the zenith", of(&[[-1.0, -0.5, 1.0], [1.0, 0.5, 1.0], [1.0, 0.503, 1.0], [-1.0, -0.497, 1.0]])),
        ("far", of(&[[5e3, 5e3, 9e3], [5.3e3, 5e3, 9e3], [5.3e3, 5.2e3, 9e3], [5e3, 5.2e3, 9e3]])),
        ("of many sides", disk.collect()),
    ]
}

/// Every polygon under every lobe, each second one run the other way round.
fn lights() -> Vec<(&'static str, Light)> {
    let mut lights = Vec::new();
    for (name, polygon) in outlines() {
        for (k, m_inv) in lobes().into_iter().enumerate() {
            // Of the narrowest lobe 2e-6 fall on strips; by how far their points are moved along them can be seen.
            if k == 6 && (name == "narrow" || name == "a low strip") {
                continue;
            }
            let mut part = polygon.clone();
            if lights.len() % 2 == 1 {
                part.reverse();
            }
            lights.push((name, Light { parts: vec![part], m_inv }));
        }
    }
    lights
}

/// The reference's point for the same numbers.
fn exact(light: &Light, [u, v]: [f32; 2]) -> Option<DVec3> {
    let [part] = &light.contours()[..] else { panic!("one part") };
    let m_inv = light.m_inv.as_dmat3();
    // A walk begins at the last vertex.
    let mut walked = part.clone();
    walked.rotate_right(1);
    let above: Vec<DVec3> = clip(&walked, DVec3::Z).iter().map(|vertex| (m_inv * *vertex).with_z(vertex.z)).collect();
    let cosine = Convex::new(&above).sample([f64::from(u), f64::from(v)])?;
    Some((m_inv.inverse() * cosine).normalize())
}

const SAMPLES: usize = 30_000;

/// How likely counts as far off are that samples fall on the pieces in proportion to their shares: one p for each light.
fn p_values(source: &str, lights: &[Light], seed: u64) -> Vec<f64> {
    let mut random = Pcg64::seed_from_u64(seed);
    let draws: Vec<_> =
        (0..lights.len() * SAMPLES).map(|k| (k / SAMPLES, [random.random(), random.random()])).collect();
    let found = drawn(source, lights, &draws);
    lights
        .iter()
        .zip(found.chunks(SAMPLES))
        .map(|(light, samples)| {
            // Through a point each, at any angle.
            let planes: Vec<DVec3> = std::iter::repeat_with(|| {
                let part = light.parts[random.random_range(0..light.parts.len())].clone();
                let part = Light { parts: vec![part], m_inv: light.m_inv };
                let through = exact(&part, [random.random(), random.random()]).expect("it has an area");
                through.cross(polygons::direction(&mut random)).normalize()
            })
            .take(7)
            .collect();
            let pieces = pieces(light, &planes);
            let mut counts: HashMap<u32, u32> = HashMap::new();
            for sample in samples {
                let wo = sample.wo.as_dvec3();
                let sides = planes.iter().enumerate().map(|(k, plane)| u32::from(plane.dot(wo) > 0.0) << k).sum();
                *counts.entry(sides).or_default() += 1;
            }
            // What fell outside of all pieces counts as a piece of no share.
            let whole = light.share();
            let strays: u32 =
                counts.iter().filter(|(sides, _)| !pieces.contains_key(sides)).map(|(_, count)| count).sum();
            let (mut seen, mut expected) = (vec![strays], vec![0.0]);
            for (sides, share) in &pieces {
                seen.push(counts.get(sides).copied().unwrap_or(0));
                expected.push(share / whole);
            }
            p_value(&seen, &expected)
        })
        .collect()
}

#[test]
fn samples_fall_on_each_piece_in_proportion_to_its_form_factor() {
    let (names, lights): (Vec<_>, Vec<_>) = lights().into_iter().unzip();
    let p = p_values(&source(), &lights, 1);
    for ((name, light), p) in names.iter().zip(&lights).zip(&p) {
        // One correct sampler in a thousand would fail for one of the lights.
        assert!(*p > 1e-3 / lights.len() as f64, "{p:e}: {name}, {:?}", light.m_inv);
    }
}

#[test]
fn a_light_of_several_parts_is_sampled_on_each_by_its_share() {
    let of = |name: &str| outlines().into_iter().find(|(other, _)| *other == name).expect("it is there").1;
    let parts = ["beside it", "across the horizon", "narrow"].map(of).to_vec();
    // The same point from parts that touch: a square of three triangles of its own.
    let square = of("around the zenith");
    let middle = square.iter().sum::<Vec3>() / 4.0;
    let cut = (0..4).map(|k| vec![square[k], square[(k + 1) % 4], middle]).collect();
    let lights: Vec<Light> = lobes()[..6]
        .iter()
        .flat_map(|&m_inv| [&parts, &cut].map(|parts: &Vec<_>| Light { parts: parts.clone(), m_inv }))
        .collect();
    let p = p_values(&source(), &lights, 2);
    assert!(p.iter().all(|p| *p > 1e-3 / lights.len() as f64), "{p:?}");
}

#[test]
fn wrong_samplers_are_found_out() {
    let lights: Vec<Light> = lights().into_iter().map(|(_, light)| light).step_by(4).collect();
    for (from, to) in [
        // Uniform in the radius; no steps; no side along the horizon; wedges taken for sectors; in the wrong order of areas.
        ("let inward = number *", "let inward = number * number *"),
        ("LTC_SAMPLE_STEPS = 3u", "LTC_SAMPLE_STEPS = 0u"),
        ("else if any(fan.reached != start)", "else if false"),
        ("let is_around = !any(below);", "let is_around = true;"),
        ("fan.left -= area;", "fan.left -= 0.9 * area;"),
        ("left = share * (area +", "left = share * (0.9 * area +"),
    ] {
        let shipped = source();
        assert_eq!(shipped.matches(from).count(), 1, "'{from}' stands once in the files");
        let least = p_values(&shipped.replace(from, to), &lights, 3).into_iter().fold(1.0, f64::min);
        println!("{least:e} {to}");
        assert!(least < 1e-9, "'{to}' goes unnoticed: {least:e}");
    }
}

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
            let of = |found: &Drawn| f64::from(found.wo.z / found.density * found.form_factor) / std::f64::consts::PI;
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
