//! Points of polygons from the shipped file, against form factors of the polygons' pieces.

use crate::polygons;
use crate::sampling::p_value;
use crate::{device, files};
use glam::{DVec3, Mat3, Vec3, Vec4};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::collections::HashMap;
use velour::reference::convex::Convex;
use velour::reference::polygon::form_factor;

/// A light of convex parts in the shading frame, and a lobe.
#[derive(Clone, Debug)]
pub struct Light {
    pub parts: Vec<Vec<Vec3>>,
    pub m_inv: Mat3,
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
pub struct Drawn {
    pub wo: Vec3,
    pub share: f32,
    pub form_factor: f32,
    pub density: f32,
    padding: [u32; 2],
}

pub fn source() -> String {
    ["ltc.wgsl", "ltc_sample.wgsl"].map(files::source).concat()
}

/// Draws from lights, by index and uniform numbers.
pub fn drawn(source: &str, lights: &[Light], draws: &[(usize, [f32; 2])]) -> Vec<Drawn> {
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
    pub fn contours(&self) -> Vec<Vec<DVec3>> {
        self.parts.iter().map(|part| part.iter().map(|vertex| vertex.as_dvec3()).collect()).collect()
    }

    /// The form factor of all parts.
    pub fn share(&self) -> f64 {
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
pub fn lobes() -> Vec<Mat3> {
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
pub fn outlines() -> Vec<(&'static str, Vec<Vec3>)> {
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
pub fn lights() -> Vec<(&'static str, Light)> {
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
pub fn exact(light: &Light, [u, v]: [f32; 2]) -> Option<DVec3> {
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
    // And parts that touch: a square cut into triangles.
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
        ("is_edge = all(fan.reached == start)", "is_edge = true"),
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
