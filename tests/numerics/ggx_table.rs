//! The specular base's table: its lookup and its files, including bad ones.

use half::f16;
use velour::math::sine;
use velour::table::ggx::{GRAZING_MU, LEAST_ASPECT};
use velour::table::{GgxTable, Ltc};

use crate::direction;

/// 3 x 2 nodes, all numbers different.
fn small() -> GgxTable {
    let cells = (0..6).map(f64::from).map(|k| [0.1 * k, -0.03 * k + 0.0, 0.3 + 0.1 * k, 0.5 + 0.07 * k, 0.01 * k]);
    GgxTable::new([3, 2], cells.collect())
}

const ROWS: &str = "0,0,0,0,.1,1,0\n0,1,0,0,.1,1,.5\n1,0,0,0,1,.4,0\n1,1,0,0,1,.4,0.1\n";

#[test]
fn lookup_is_bilinear_in_roughness_and_t() {
    let table = small();
    let [roughness, t] = [0.25, 0.5];
    let mu = 1.0 - t * t;
    // In the middle between the first four nodes, k = 0 to 3.
    let [u, v, s] = [0.15, -0.045, 0.45];
    let lobe = table.lookup(roughness, mu);
    let Ltc { a, b, c } = lobe.ltc;
    for (found, expected) in [
        (c, 1.0 / (s * s)),
        (a / c, mu * mu + u),
        (b / c, mu * sine(mu) + v),
        (lobe.albedo, 0.605),
        (lobe.fresnel, 0.015),
    ] {
        assert!((found - expected).abs() < 1e-12, "{found}, {expected}");
    }
    assert_eq!(table.lookup(-3.0, 7.0), table.lookup(0.0, 1.0));
    // Below the least cosine the mirror's part no longer changes.
    let a = |mu: f64| table.lookup(0.0, mu).ltc.a * 0.4_f64.powi(2);
    assert!((a(0.0) - (GRAZING_MU * GRAZING_MU + 0.1)).abs() < 1e-12);
}

#[test]
fn a_table_that_falls_below_0_keeps_its_matrix_invertible() {
    let table = GgxTable::new([2, 2], vec![[-4.0, 0.0, 1.0, 1.0, 0.0]; 4]);
    assert_eq!(table.lookup(0.5, 0.5).ltc.a, LEAST_ASPECT);
}

#[test]
fn densities_are_what_samples_have() {
    // Uniform numbers from a regular grid, so that nothing is random.
    for ltc in [Ltc { a: 1.0, b: 0.0, c: 1.0 }, Ltc { a: 0.6, b: 0.5, c: 1.7 }] {
        let n = 400;
        let places = |k: usize| (k as f64 + 0.5) / f64::from(n);
        let count = n as usize;
        let mean = |value: &dyn Fn(glam::DVec3) -> f64| {
            let samples = (0..count).flat_map(|i| (0..count).map(move |j| [places(i), places(j)]));
            samples.map(|uniforms| ltc.sample(uniforms)).map(value).sum::<f64>() / f64::from(n * n)
        };
        // The mean of any function over the density is its integral: here of z / pi, which is 1, and of y z, which is
        // 0.
        let found = mean(&|wo| wo.z / std::f64::consts::PI / ltc.density(wo));
        assert!((found - 1.0).abs() < 2e-3, "{ltc:?}: {found}");
        let across = mean(&|wo| wo.y * wo.z / ltc.density(wo));
        assert!(across.abs() < 1e-9, "{ltc:?}: {across}");
        let wo = ltc.sample([0.3, 0.2]);
        assert!((wo.length() - 1.0).abs() < 1e-12 && wo.z > 0.0);
    }
    assert_eq!(Ltc { a: 1.0, b: 0.0, c: 1.0 }.density(direction(-0.3, 0.0)), 0.0);
}

#[test]
fn files_hold_the_table() {
    let table = small();
    let text = table.to_csv(&["about".to_owned()]);
    assert!(text.starts_with("# about\nroughness,t,u,v,s,albedo,fresnel\n0,0,0,0,0.3,0.5,0\n"), "{text}");
    assert_eq!(GgxTable::from_csv(&text).expect("a written table"), table);
    let bytes = table.to_dds();
    // Magic, header, DX10 header; two parts of 8 bytes a texel.
    assert_eq!(bytes.len(), 4 + 124 + 20 + 2 * 6 * 8);
    let read = GgxTable::from_dds(&bytes).expect("a written table");
    assert_eq!((read.size(), read.texture_size()), ([3, 2], [3, 4]));
    for (i, j) in (0..3).flat_map(|i| (0..2).map(move |j| (i, j))) {
        assert_eq!(read.cell(i, j), table.cell(i, j).map(|value| f16::from_f64(value).to_f64()));
        let texels = table.texels();
        let [u, v, s, albedo, fresnel] = table.cell(i, j).map(|value| value as f32);
        assert_eq!([texels[j * 3 + i], texels[(2 + j) * 3 + i]], [[u, v, s, 1.0], [albedo, fresnel, 0.0, 1.0]]);
    }
    assert_ne!(read.checksum(), table.checksum());
    assert_eq!(GgxTable::from_csv(&text).expect("a written table").checksum(), table.checksum());
}

#[test]
fn half_steps_count_past_what_is_negligible() {
    let table = small();
    let moved = |by: f64| {
        let mut cells: Vec<[f64; 5]> = (0..6).map(|at| table.cell(at / 2, at % 2)).collect();
        cells[0][0] += by;
        table.half_steps(&GgxTable::new([3, 2], cells)).expect("the same size")
    };
    assert_eq!(moved(5e-6), 0);
    assert!(moved(1e-3) > 100);
    assert_eq!(table.half_steps(&GgxTable::from_csv(ROWS).expect("good rows")), None);
}

#[test]
fn bad_text_is_refused_with_its_line() {
    for (wrong, message) in [
        (ROWS.replace("1,0,0,0,1,.4,0\n", "1,0,0,0,1,.4\n"), "line 3: 6 columns instead of the 7 of roughness,t,u,v,s"),
        (ROWS.replace("0,1,0,0,.1,1,.5", "0,1,0,0,0,1,.5"), "line 2: s must be in [0.01, 16]: 0"),
        (ROWS.replace("0,1,0,0,.1,1,.5", "0,1,99,0,.1,1,.5"), "line 2: u and v must be in [-16, 16]: 99"),
        (ROWS.replace("0,1,0,0,.1,1,.5", "0,1,0,-99,.1,1,.5"), "line 2: u and v must be in [-16, 16]: 0, -99"),
        (ROWS.replace("0,1,0,0,.1,1,.5", "0,1,0,nan,.1,1,.5"), "line 2: v must be a finite number"),
        (ROWS.replace("0,1,0,0,.1,1,.5", "0,1,0,0,17,1,.5"), "line 2: s must be in [0.01, 16]: 17"),
        (ROWS.replace("0,1,0,0,.1,1,.5", "0,1,0,0,.1,1.01,.5"), "line 2: albedo must be in [0.01, 1]"),
        (ROWS.replace("0,1,0,0,.1,1,.5", "0,1,0,0,.1,0,0"), "line 2: albedo must be"),
        (ROWS.replace("0,1,0,0,.1,1,.5", "0,1,0,0,.1,.4,.5"), "line 2: fresnel must be in [0, albedo]: 0.5, 0.4"),
        (ROWS.replace("0,1,0,0,.1,1,.5", "0,1,0,0,.1,1,-.1"), "line 2: fresnel must be in [0, albedo]: -0.1, 1"),
        (ROWS.replace("0,1,", "0,.9,"), "line 2: t is 0.9, but row 1"),
        ("0,0,0,0,.1,1,0\n".to_owned(), "lines of roughness,t,u,v,s,albedo,fresnel"),
    ] {
        let error = GgxTable::from_csv(&wrong).expect_err(message).to_string();
        assert!(error.contains(message) && !error.contains('\n'), "{error}");
    }
}

#[test]
fn bad_textures_are_refused_and_none_panics() {
    let good = GgxTable::from_csv(ROWS).expect("good rows").to_dds();
    let error = |bytes: &[u8]| {
        let error = GgxTable::from_dds(bytes).expect_err("a bad texture").to_string();
        assert!(!error.contains('\n') && error.len() < 300, "one line: {error}");
        error
    };
    for length in 0..good.len() {
        error(&good[..length]);
    }
    // Heights that cannot be split into two parts, or that leave each part a single node.
    for height in [0, 1, 2, 3, 5, 4096, u32::MAX] {
        let mut bytes = good.clone();
        bytes[12..16].copy_from_slice(&height.to_le_bytes());
        assert!(error(&bytes).contains("height over 2"), "{height}");
    }
    // s = 0 in the second texel; fresnel above albedo in the last of the lower part.
    let mut bytes = good.clone();
    bytes[148 + 8 + 4..148 + 8 + 6].fill(0);
    assert!(error(&bytes).contains("byte 156, texel (1, 0): s must be"));
    let mut bytes = good.clone();
    let last = bytes.len() - 8;
    bytes[last + 2..last + 4].copy_from_slice(&f16::ONE.to_le_bytes());
    assert!(error(&bytes).contains("texel (1, 1): fresnel must be"));
    for bit in 0..good.len() * 8 {
        let mut bytes = good.clone();
        bytes[bit / 8] ^= 1 << (bit % 8);
        let _ = GgxTable::from_dds(&bytes);
    }
    let folder = tempfile::tempdir().expect("a folder for the test");
    let path = folder.path().join("ggx.dds");
    std::fs::write(&path, ROWS).expect("writing in the test's folder");
    let error = GgxTable::load(&path).expect_err("text").to_string();
    assert!(error.contains("ggx.dds: no .dds texture"), "{error}");
}

#[test]
fn the_sheens_table_is_not_taken_for_it() {
    let bytes = include_bytes!("../../tables/sheen_ltc.dds");
    assert!(GgxTable::from_dds(bytes).is_err());
    assert!(GgxTable::from_csv(include_str!("../../tables/sheen_ltc.csv")).is_err());
}
