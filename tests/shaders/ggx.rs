//! The shipped specular base: its lookup against the table's own in `f64`, its albedos against the models'.

use crate::{device, files};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use velour::models::Schlick;
use velour::table::{GgxLobe, GgxTable};

#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Shaded {
    m_inv: [[f32; 4]; 3],
    albedo: f32,
    fresnel: f32,
    base_weight: f32,
    form_factor: f32,
    shares: [f32; 3],
    pad: f32,
}

fn shaded(texels: &[[f32; 4]], width: usize, points: &[[f32; 4]]) -> Vec<Shaded> {
    let source = [
        files::source("ltc.wgsl"),
        files::source("ggx.wgsl"),
        include_str!("ceiling.wgsl").to_owned(),
        include_str!("ggx.wgsl").to_owned(),
    ]
    .concat();
    let texture = device::texture(width as u32, texels);
    device::run(&source, &[bytemuck::cast_slice(points)], Some(&texture), points.len())
}

fn shaded_by(table: &GgxTable, points: &[[f32; 4]]) -> Vec<Shaded> {
    shaded(&table.texels(), table.size()[0], points)
}

/// A table of cells that `f32` holds exactly, so that nothing is rounded on its way into the texture.
fn random_table(random: &mut Pcg64, size: [usize; 2]) -> GgxTable {
    let mut number = |low: f32, high: f32| f64::from(random.random_range(low..high));
    let cell = |_| [number(0.0, 1.0), number(-1.0, 1.0), number(0.1, 1.5), number(0.5, 1.0), number(0.0, 0.5)];
    GgxTable::new(size, (0..size[0] * size[1]).map(cell).collect())
}

/// Points in and around the unit square of (roughness, mu), including its corners and the nodes of a table; f0 and f90
/// in \[0, 1\].
fn points(random: &mut Pcg64, size: [usize; 2]) -> Vec<[f32; 4]> {
    let mut places =
        vec![[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0], [-0.0, 0.5], [1.0000001, 0.5], [-3.0, 7.0], [1e9, -1e9]];
    places.extend((0..2000).map(|_| [random.random_range(0.0..=1.0), random.random_range(0.0..=1.0)]));
    for i in 0..size[0] {
        let roughness = i as f32 / (size[0] - 1) as f32;
        places.extend((0..size[1]).map(|j| [roughness, 1.0 - (j as f32 / (size[1] - 1) as f32).powi(2)]));
    }
    let ends = [0.0, 0.04, 1.0, 1.0];
    let mut reflectance = || match random.random_range(0..8) {
        end @ 0..4 => ends[end],
        _ => random.random_range(0.0..=1.0),
    };
    places.into_iter().map(|[roughness, mu]| [roughness, mu, reflectance(), reflectance()]).collect()
}

/// Those quantities of a lobe in which the table is linear, apart from a known function of mu.
fn linear([a, b, c, albedo, fresnel]: [f64; 5]) -> [f64; 5] {
    [a / c, b / c, c.powf(-0.5), albedo, fresnel]
}

/// The greatest difference from `lookup`.
fn greatest_error(table: &GgxTable, points: &[[f32; 4]], lookup: impl Fn(f64, f64) -> GgxLobe) -> f64 {
    let mut greatest = 0.0_f64;
    for (&[roughness, mu, ..], shaded) in points.iter().zip(shaded_by(table, points)) {
        let [x, y, z] = shaded.m_inv;
        let [a, b, c] = [x[0], z[0], y[1]];
        assert_eq!([&x[..3], &y[..3], &z[..3]].concat(), [a, 0.0, 0.0, 0.0, c, 0.0, b, 0.0, 1.0]);
        let found = linear([a, b, c, shaded.albedo, shaded.fresnel].map(f64::from));
        let GgxLobe { ltc, albedo, fresnel } = lookup(f64::from(roughness), f64::from(mu));
        for (found, expected) in found.into_iter().zip(linear([ltc.a, ltc.b, ltc.c, albedo, fresnel])) {
            assert!(found.is_finite());
            greatest = greatest.max((found - expected).abs());
        }
    }
    greatest
}

#[test]
fn the_lookup_is_the_tables_own_for_any_size() {
    let mut random = Pcg64::seed_from_u64(61);
    let shipped = GgxTable::embedded();
    let random_tables = [[32, 32], [2, 2], [5, 17], [64, 3]].map(|size| random_table(&mut random, size));
    for (table, difference) in random_tables.iter().map(|table| (table, 2.0)).chain([(&shipped, 0.1)]) {
        let size = table.size();
        let points = points(&mut random, size);
        let error = greatest_error(table, &points, |roughness, mu| table.lookup(roughness, mu));
        println!("{size:?}: {error:.1e}");
        // Some roundings of numbers up to 2; besides, neighbours differ, and their weights carry the rounding of the
        // place.
        assert!(error < 1e-6 + 1.2e-7 * difference * (size[0].max(size[1]) - 1) as f64, "{size:?}: {error:e}");
        // The ruler notices exchanged axes, and mu itself in place of t.
        assert!(greatest_error(table, &points, |roughness, mu| table.lookup(mu, roughness)) > 0.1);
        let straight = |mu: f64| 1.0 - (1.0 - mu.clamp(0.0, 1.0)).powi(2);
        assert!(greatest_error(table, &points, |roughness, mu| table.lookup(roughness, straight(mu))) > 0.1);
    }
}

#[test]
fn a_light_that_covers_the_hemisphere_gives_the_albedo() {
    let mut random = Pcg64::seed_from_u64(62);
    let table = GgxTable::embedded();
    let points = points(&mut random, table.size());
    for (point, shaded) in points.iter().zip(shaded_by(&table, &points)) {
        let a = f64::from(shaded.m_inv[0][0]);
        // The ceiling ends 1e-5 above the horizon, which a lobe of this a sees at 1e-5 / a.
        let tolerance = 2e-6 + 1e-9 / (a * a);
        assert!((f64::from(shaded.form_factor) - 1.0).abs() < tolerance, "{} at {point:?}", shaded.form_factor);
    }
}

#[test]
fn no_more_light_comes_back_than_came() {
    let mut random = Pcg64::seed_from_u64(63);
    let table = GgxTable::embedded();
    let points = points(&mut random, table.size());
    let mut white = 0;
    for (&[roughness, mu, f0, f90], shaded) in points.iter().zip(shaded_by(&table, &points)) {
        let at = format!("roughness {roughness}, mu {mu}, f0 {f0}, f90 {f90}");
        let GgxLobe { albedo, fresnel, .. } = table.lookup(roughness.into(), mu.into());
        for ((share, f0), f90) in shaded.shares.into_iter().zip([f0, 0.5 * f0, 0.0]).zip([f90, f90, 0.25 * f90]) {
            assert!((0.0..=1.0).contains(&share), "{at}: {share}");
            let expected = Schlick::new(f0.into(), f90.into()).albedo(albedo, fresnel);
            assert!(expected < 1.0 + 1e-12, "{at}: {expected}");
            // Rounding, twice as much as that of a place in the table.
            assert!((f64::from(share) - expected).abs() < 4e-6, "{at}: {share}, {expected}");
        }
        let [red, green, blue] = shaded.shares;
        assert_eq!(shaded.base_weight, 1.0 - red.max(green).max(blue), "{at}");
        if f0 == 1.0 && f90 == 1.0 {
            assert!(red > 1.0 - 1e-6, "{at}: a perfect mirror sends back {red}");
            white += 1;
        }
    }
    assert!(white > 50, "{white} perfect mirrors");
}

#[test]
fn an_empty_texture_gives_numbers() {
    for texel in [[0.0; 4], [-9.0, 9.0, -1.0, 0.0]] {
        for shaded in shaded(&[texel; 8], 2, &[[0.3, 0.0, 1.0, 1.0], [0.7, 0.6, 0.5, 1.0], [0.0, 1.0, 0.0, 0.0]]) {
            let numbers = [shaded.m_inv.concat(), vec![shaded.form_factor, shaded.base_weight], shaded.shares.to_vec()];
            assert!(numbers.concat().iter().all(|number| number.is_finite()), "{texel:?}");
            assert!((0.0..=1.0).contains(&shaded.base_weight) && (0.0..=1.0).contains(&shaded.form_factor));
        }
    }
}
