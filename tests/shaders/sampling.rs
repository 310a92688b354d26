//! Samples from the shipped file against its density, and its density against the definition.

use crate::{device, files, polygons};
use glam::{DMat3, DVec3, Mat3, Vec3, Vec4};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use statrs::distribution::{ChiSquared, ContinuousCDF};
use std::f64::consts::{PI, TAU};
use velour::math::quadrature::gauss_legendre;

const RINGS: usize = 12;
const SECTORS: usize = 16;

fn shaded(m_inv: Mat3, inputs: &[Vec4]) -> Vec<Vec4> {
    let source = [&files::source("ltc.wgsl"), include_str!("sampling.wgsl")].concat();
    let columns = [0, 1, 2].map(|column| m_inv.col(column).extend(0.0));
    device::run(&source, &[bytemuck::cast_slice(&columns), bytemuck::cast_slice(inputs)], None, inputs.len())
}

/// Lobes from dust to fuzz, with b of both signs, and a matrix that no table holds.
fn lobes() -> [Mat3; 6] {
    let sheen = |a: f32, b: f32| Mat3::from_cols(Vec3::X * a, Vec3::Y * a, Vec3::new(b, 0.0, 1.0));
    let general = Mat3::from_cols_array(&[0.9, 0.3, 0.0, -0.2, 0.5, 0.0, 0.4, -0.3, 1.0]);
    [sheen(1.0, 0.0), sheen(0.6, -0.3), sheen(0.2, -0.9), sheen(0.1, 0.0), sheen(1.2, 0.3), general]
}

/// The density's definition: the cosine's, times the Jacobian of w -> M^-1 w / |M^-1 w| (Heitz et al. 2016, equation 1).
fn density(m_inv: Mat3, direction: DVec3) -> f64 {
    let m_inv: DMat3 = m_inv.as_dmat3();
    let transformed = m_inv * direction;
    let cosine = (transformed.z / transformed.length()).max(0.0);
    cosine / PI * m_inv.determinant() / transformed.length().powi(3)
}

fn direction(z: f64, azimuth: f64) -> DVec3 {
    let radius = (1.0 - z * z).sqrt();
    DVec3::new(radius * azimuth.cos(), radius * azimuth.sin(), z)
}

/// Rings are narrow towards the horizon, where the lobes of fuzz are.
fn ring_edge(k: usize) -> f64 {
    (k as f64 / RINGS as f64).powi(2)
}

/// The probability that a sample falls into each cell of the hemisphere.
fn expected(m_inv: Mat3) -> Vec<f64> {
    let mut cells = Vec::with_capacity(RINGS * SECTORS);
    for ring in 0..RINGS {
        for sector in 0..SECTORS {
            cells.push(nodes(ring, sector).map(|(node, weight)| weight * density(m_inv, node)).sum());
        }
    }
    cells
}

fn nodes(ring: usize, sector: usize) -> impl Iterator<Item = (DVec3, f64)> {
    let heights = gauss_legendre(12, ring_edge(ring), ring_edge(ring + 1));
    let [from, to] = [sector, sector + 1].map(|k| TAU * k as f64 / SECTORS as f64 - PI);
    let azimuths = gauss_legendre(12, from, to);
    heights.into_iter().flat_map(move |(z, dz)| {
        azimuths.clone().into_iter().map(move |(azimuth, width)| (direction(z, azimuth), dz * width))
    })
}

/// The probability of counts at least as far off as these (Pearson's chi-square, cells below five pooled).
pub fn p_value(counts: &[u32], expected: &[f64]) -> f64 {
    let total = f64::from(counts.iter().sum::<u32>());
    let (mut statistic, mut freedom, mut pool) = (0.0, -1.0, (0.0, 0.0));
    let mut add = |count: f64, expected: f64| {
        statistic += (count - expected).powi(2) / expected;
        freedom += 1.0;
    };
    for (&count, share) in counts.iter().zip(expected) {
        if share * total < 5.0 {
            pool = (pool.0 + f64::from(count), pool.1 + share * total);
        } else {
            add(f64::from(count), share * total);
        }
    }
    if pool.1 >= 5.0 {
        add(pool.0, pool.1);
    }
    ChiSquared::new(freedom).expect("more than one cell").sf(statistic)
}

fn histogram(samples: &[Vec4]) -> Vec<u32> {
    let mut counts = vec![0; RINGS * SECTORS];
    for sample in samples {
        assert!((sample.truncate().length() - 1.0).abs() < 1e-6 && sample.z >= 0.0 && sample.w.is_finite(), "{sample}");
        let ring = (f64::from(sample.z).sqrt() * RINGS as f64) as usize;
        let sector = (f64::from(sample.y).atan2(f64::from(sample.x)) + PI) / TAU * SECTORS as f64;
        counts[ring.min(RINGS - 1) * SECTORS + (sector as usize).min(SECTORS - 1)] += 1;
    }
    counts
}

#[test]
fn samples_fall_as_the_density_says() {
    let mut random = Pcg64::seed_from_u64(1);
    for m_inv in lobes() {
        let uniforms: Vec<Vec4> = (0..200_000).map(|_| Vec4::new(random.random(), random.random(), 0.0, 1.0)).collect();
        let counts = histogram(&shaded(m_inv, &uniforms));
        let p = p_value(&counts, &expected(m_inv));
        println!("p = {p:.3} for {m_inv:?}");
        // One correct sampler in a thousand would fail for one of the six lobes.
        assert!(p > 1e-3 / 6.0, "p = {p:e} for {m_inv:?}");
        // Lobes that are 4% wider, or that lean further by as much, must be rejected.
        for (widen, lean) in [(1.04, 0.0), (1.0, 0.04)] {
            let other = Mat3::from_cols(m_inv.x_axis * widen, m_inv.y_axis * widen, m_inv.z_axis + Vec3::X * lean);
            let p = p_value(&counts, &expected(other));
            assert!(p < 1e-6, "p = {p:e} for {m_inv:?} taken for {other:?}");
        }
    }
}

#[test]
fn the_density_is_the_definitions_and_integrates_to_one() {
    for m_inv in lobes() {
        let cells = (0..RINGS).flat_map(|ring| (0..SECTORS).map(move |sector| (ring, sector)));
        let (directions, weights): (Vec<Vec4>, Vec<f64>) = cells
            .flat_map(|(ring, sector)| nodes(ring, sector))
            .map(|(node, weight)| (node.as_vec3().extend(0.0), weight))
            .unzip();
        let found = shaded(m_inv, &directions);
        for (found, given) in found.iter().zip(&directions) {
            let exact = density(m_inv, given.truncate().as_dvec3());
            // The density holds the square of a squared length, whose rounding a narrow lobe's lean enlarges.
            assert!((f64::from(found.w) - exact).abs() < 2e-5 * exact, "{} is not {exact} at {given}", found.w);
        }
        let integral: f64 = found.iter().zip(weights).map(|(found, weight)| f64::from(found.w) * weight).sum();
        assert!((integral - 1.0).abs() < 1e-5, "{integral}");
    }
}

#[test]
fn below_the_horizon_and_of_a_singular_lobe_the_density_is_zero() {
    let mut random = Pcg64::seed_from_u64(2);
    let below: Vec<Vec4> = (0..100)
        .map(|_| polygons::direction(&mut random).as_vec3())
        .map(|w| w.with_z(-w.z.abs()).extend(0.0))
        .collect();
    assert!(shaded(lobes()[1], &below).iter().all(|found| found.w == 0.0));
    for b in [0.0, -0.5] {
        let singular = Mat3::from_cols(Vec3::ZERO, Vec3::ZERO, Vec3::new(b, 0.0, 1.0));
        let inputs =
            [Vec4::new(0.3, 0.6, 0.0, 1.0), Vec4::W, Vec4::X, Vec4::Z, Vec4::new(-0.447_213_6, 0.0, 0.894_427_2, 0.0)];
        let found = shaded(singular, &inputs);
        assert!(found.iter().all(|found| found.w == 0.0), "{found:?}");
        assert!(found[..2].iter().all(|found| found.truncate() == Vec3::Z), "{found:?}");
    }
}

#[test]
fn the_corners_of_the_unit_square_give_directions() {
    let last = 1.0_f32.next_down();
    for m_inv in lobes() {
        let corners = [(0.0, 0.0), (0.0, last), (last, 0.0), (last, last)].map(|(u, v)| Vec4::new(u, v, 0.0, 1.0));
        histogram(&shaded(m_inv, &corners));
    }
}
