//! The lookup of the shipped sheen against the table's own in `f64`.

use crate::{device, files};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use velour::table::SheenTable;

#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Shaded {
    m_inv: [[f32; 4]; 3],
    albedo: f32,
    base_weight: f32,
    lit: f32,
    pad: f32,
}

fn shaded(table: &SheenTable, points: &[[f32; 2]]) -> Vec<Shaded> {
    let source = [
        files::source("ltc.wgsl"),
        files::source("sheen.wgsl"),
        include_str!("ceiling.wgsl").to_owned(),
        include_str!("sheen.wgsl").to_owned(),
    ]
    .concat();
    let texture = device::texture(table.size()[0] as u32, &table.texels());
    device::run(&source, &[bytemuck::cast_slice(points)], Some(&texture), points.len())
}

/// A table of cells that `f32` holds exactly, so that nothing is rounded on its way into the texture.
fn random_table(random: &mut Pcg64, size: [usize; 2]) -> SheenTable {
    let mut number = |low: f32, high: f32| f64::from(random.random_range(low..high));
    SheenTable::new(
        size,
        (0..size[0] * size[1]).map(|_| [number(0.0, 1.5), number(-1.5, 0.5), number(0.0, 1.0)]).collect(),
    )
}

/// Points in and around the unit square, including its corners and the nodes of a table.
fn points(random: &mut Pcg64, size: [usize; 2]) -> Vec<[f32; 2]> {
    let mut points =
        vec![[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0], [-0.0, 0.5], [1.0000001, 0.5], [-3.0, 7.0], [1e9, -1e9]];
    points.extend((0..1000).map(|_| [random.random_range(0.0..=1.0), random.random_range(0.0..=1.0)]));
    for i in 0..size[0] {
        points.extend((0..size[1]).map(|j| [i as f32 / (size[0] - 1) as f32, j as f32 / (size[1] - 1) as f32]));
    }
    points
}

/// The greatest difference from `lookup` over a, b and r.
fn greatest_error(table: &SheenTable, points: &[[f32; 2]], lookup: impl Fn(f64, f64) -> [f64; 3]) -> f64 {
    let mut greatest = 0.0_f64;
    for (&[alpha, mu], shaded) in points.iter().zip(shaded(table, points)) {
        let [x, y, z] = shaded.m_inv;
        let [a, b] = [x[0], z[0]];
        assert_eq!([&x[..3], &y[..3], &z[..3]].concat(), [a, 0.0, 0.0, 0.0, a, 0.0, b, 0.0, 1.0]);
        assert_eq!(shaded.base_weight, 1.0 - 0.5 * shaded.albedo);
        for (found, expected) in [a, b, shaded.albedo].into_iter().zip(lookup(f64::from(alpha), f64::from(mu))) {
            assert!(found.is_finite());
            greatest = greatest.max((f64::from(found) - expected).abs());
        }
    }
    greatest
}

#[test]
fn the_lookup_is_the_tables_own_for_any_size() {
    let mut random = Pcg64::seed_from_u64(1);
    for size in [[32, 32], [2, 2], [5, 17], [64, 3]] {
        let table = random_table(&mut random, size);
        let points = points(&mut random, size);
        let error = greatest_error(&table, &points, |alpha, mu| table.lookup(alpha, mu));
        println!("{size:?}: {error:.1e}");
        // Neighbours differ by up to 2, and their weights carry the rounding of alpha (n - 1): 2^-24 (n - 1) of it.
        assert!(error < 1e-6 + 1.2e-7 * 2.0 * (size[0].max(size[1]) - 1) as f64, "{size:?}: {error:e}");
        // The ruler notices exchanged axes, and centres of texels in place of nodes.
        let [n, m] = size.map(|n| n as f64);
        let centred = |at: f64, n: f64| (at * n - 0.5) / (n - 1.0);
        assert!(greatest_error(&table, &points, |alpha, mu| table.lookup(mu, alpha)) > 0.1);
        assert!(greatest_error(&table, &points, |alpha, mu| table.lookup(centred(alpha, n), centred(mu, m))) > 0.1);
    }
}

#[test]
fn a_light_that_covers_the_hemisphere_gives_the_shipped_tables_albedo() {
    let mut random = Pcg64::seed_from_u64(2);
    let table = SheenTable::embedded();
    let points = points(&mut random, table.size());
    for (&[alpha, mu], shaded) in points.iter().zip(shaded(&table, &points)) {
        let [a, _, r] = table.lookup(f64::from(alpha), f64::from(mu));
        // The ceiling ends 1e-5 above the horizon, which a lobe of this a sees at 1e-5 / a. Besides, there is the
        // lookup's rounding.
        let tolerance = 1e-5 + 1e-9 / (a * a);
        assert!((f64::from(shaded.lit) - r).abs() < tolerance, "{} is not {r} at {alpha}, {mu}", shaded.lit);
    }
}

#[test]
fn where_a_is_zero_the_matrix_lights_nothing() {
    let table = SheenTable::new([2, 2], vec![[0.0, -0.4, 0.7], [0.0, 0.2, 0.6], [0.5, 0.0, 0.5], [0.5, 0.0, 0.5]]);
    let found = shaded(&table, &[[0.0, 0.0], [0.0, 0.3], [0.0, 1.0], [1.0, 0.5]]);
    assert!(found[..3].iter().all(|shaded| shaded.lit == 0.0 && shaded.m_inv[0][0] == 0.0 && shaded.albedo > 0.5));
    assert!(found[3].lit > 0.4999);
}
