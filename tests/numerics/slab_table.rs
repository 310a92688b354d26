//! The slab's table: its file, its axes, and whether it is what the code makes.

use half::f16;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use velour::fit::slab::{self, layer};
use velour::table::{LEAST_SLAB_ALPHA, MAX_FILE_BYTES, SLAB_SIDE, SheenTable, SlabTable, SlabWarp, slab_alpha};

const HEADER_BYTES: usize = 148;

/// The largest difference, in steps of half-floats, between a solved layer and the shipped table's at node `k` of
/// alpha.
fn apart(table: &SlabTable, k: usize, layer: &[[f64; 3]]) -> u32 {
    let n = SLAB_SIDE;
    let mut cells: Vec<[f64; 3]> = (0..n.pow(3)).map(|at| table.cell(at / (n * n), at / n % n, at % n)).collect();
    cells[k * n * n..(k + 1) * n * n].copy_from_slice(layer);
    table.half_steps(&SlabTable::new(&cells))
}

#[test]
fn the_shipped_table_is_what_the_code_makes() {
    let shipped = SlabTable::embedded();
    let (calls, most) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().expect("a pool of threads");
    let (made, report) = pool.install(|| {
        slab::fit(|done, all| {
            assert_eq!(all, SLAB_SIDE + 12);
            calls.fetch_add(1, Ordering::Relaxed);
            most.fetch_max(done, Ordering::Relaxed);
        })
    });
    assert_eq!((calls.into_inner(), most.into_inner()), (SLAB_SIDE + 12, SLAB_SIDE + 12));
    assert!(shipped.half_steps(&made) <= 1, "velour fit makes another table");
    let velour::fit::Errors { mean, median, max } = report.lobe;
    let figure = format!("{} lobes off the nodes | mean {mean:.4}, median {median:.4}, max {max:.4}", report.cells);
    let page = include_str!("../../docs/accuracy.md");
    assert!(page.contains(&figure), "docs/accuracy.md does not say '{figure}'");
    // Lobes have a mean error of .0019 and a greatest of .0074; R has .0014 and .0086.
    assert!(report.cells > 200 && report.lobe.mean < 0.0022 && report.lobe.max < 0.009, "{report}");
    assert!(report.albedo.mean < 0.0017 && report.albedo.max < 0.01, "{report}");
}

#[test]
fn one_thread_makes_the_same_layer_and_another_alpha_is_told() {
    let shipped = SlabTable::embedded();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool of threads");
    for k in [9, 26] {
        // One thread gives the same bits as several.
        assert_eq!(pool.install(|| layer(slab_alpha(k as f64))), layer(slab_alpha(k as f64)));
        assert!(apart(&shipped, k, &pool.install(|| layer(slab_alpha(k as f64)))) <= 1, "alpha's node {k}");
        assert!(apart(&shipped, k, &layer(slab_alpha(k as f64) * 0.999)) > 1, "another alpha than that of node {k}");
    }
}

#[test]
fn the_file_is_the_table() {
    let table = SlabTable::embedded();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tables/sheen_slab.dds");
    let bytes = std::fs::read(&path).expect("the shipped volume");
    assert_eq!(bytes.len(), HEADER_BYTES + SLAB_SIDE.pow(3) * 8);
    assert_eq!(table.to_dds(), bytes);
    assert_eq!(SlabTable::load(&path).expect("the shipped volume"), table);
    // x = alpha, y = mu_i, z = mu_o; then A = 1.
    let [x, y, z] = [5, 11, 23];
    let texel = &bytes[HEADER_BYTES + ((z * SLAB_SIDE + y) * SLAB_SIDE + x) * 8..][..8];
    let halves: Vec<f64> = texel.chunks(2).map(|half| f16::from_le_bytes([half[0], half[1]]).to_f64()).collect();
    let [v0, v1, v2] = table.cell(x, y, z);
    assert_eq!(halves, [v0, v1, v2, 1.0]);
    assert!(v0 != table.cell(y, x, z)[0] && v0 != table.cell(z, y, x)[0], "exchanged axes would pass");
}

#[test]
fn numbers_are_rounded_to_the_nearest_half() {
    let n = SLAB_SIDE;
    let value = |k: usize, i: usize, j: usize| {
        [0.123_456 + k as f64 / 7.0 + (i + j) as f64 / 300.0, -0.1 + (i * j) as f64 / 1e4, 1e-3 / (1 + i + j) as f64]
    };
    let cells: Vec<[f64; 3]> = (0..n.pow(3)).map(|at| value(at / (n * n), at / n % n, at % n)).collect();
    let table = SlabTable::new(&cells);
    assert_eq!(SlabTable::from_dds(&table.to_dds()).expect("a written volume"), table);
    for (k, i, j) in [(0, 0, 0), (31, 3, 17), (8, 31, 31)] {
        assert_eq!(table.cell(k, i, j), value(k, i, j).map(|value| f16::from_f64(value).to_f64()));
    }
}

#[test]
fn axes_run_there_and_back() {
    for alpha in [0.003, 0.0094, 0.04, 0.3, 1.0] {
        let warp = SlabWarp::new(alpha);
        assert_eq!((warp.root(0.0), warp.mu(0.0)), (0.0, 0.0));
        assert!((warp.root(1.0) - 1.0).abs() < 1e-12 && (warp.mu(1.0) - 1.0).abs() < 1e-12);
        let mut before = 0.0;
        for k in 1..=200 {
            let mu = (f64::from(k) / 200.0).powi(4);
            let root = warp.root(mu);
            assert!(root > before, "alpha {alpha}, mu {mu}");
            before = root;
            let place = warp.place(mu);
            assert!((SlabWarp::root_from_place(place) / root - 1.0).abs() < 1e-12, "alpha {alpha}, mu {mu}");
            // Where w is 1 but for round-off, its inverse divides by that round-off.
            let limit = if root < 0.999 { 1e-11 } else { 1e-6 };
            assert!((warp.mu(root) / mu - 1.0).abs() < limit, "alpha {alpha}, mu {mu}: {}", warp.mu(root));
            let step = 1e-5 * mu;
            let slope = (warp.root(mu) - warp.root(mu - step)) / step;
            assert!((slope / warp.root_slope(mu - step / 2.0) - 1.0).abs() < 1e-5, "alpha {alpha}, mu {mu}");
        }
    }
}

#[test]
fn lookup_is_linear_along_each_axis_and_symmetric() {
    let table = SlabTable::embedded();
    for k in [0, 7, 31] {
        let slice = table.slice(slab_alpha(k as f64));
        for (i, j) in [(0, 0), (0, 31), (31, 31), (4, 19), (30, 1)] {
            let modes = slice.at([i, j].map(|node| node as f64 / 31.0));
            let [v0, v1, v2] = table.cell(k, i, j);
            assert!((modes.growth / v0.exp() - 1.0).abs() < 2e-6, "node ({k}, {i}, {j})");
            assert!((modes.first - v1).abs() < 1e-6 && (modes.second - v2).abs() < 1e-6, "node ({k}, {i}, {j})");
        }
    }
    // In the middle of a cell of alpha: the mean of its corners.
    let alpha = ((14.0 + 12.5) / 45.0_f64).powi(4);
    let modes = table.slice(alpha).at([6.5 / 31.0, 20.25 / 31.0]);
    let mut mean = 0.0;
    for (k, i, j, weight) in (0..8).map(|at| (12 + at / 4, 6 + at / 2 % 2, 20 + at % 2, [0.75, 0.25][at % 2] / 4.0)) {
        mean += weight * table.cell(k, i, j)[1];
    }
    assert!((modes.first - mean).abs() < 1e-7, "{} is not {mean}", modes.first);
    let slice = table.slice(0.123);
    for (one, other) in [(0.0, 1.0), (0.3, 0.02), (0.77, 0.5)] {
        assert_eq!(slice.lookup(one, other), slice.lookup(other, one));
    }
}

#[test]
fn below_the_first_alpha_values_go_on_straight_and_then_stand() {
    let table = SlabTable::embedded();
    let texel = |alpha: f64| 45.0 * alpha.powf(0.25) - 14.0;
    let at = |alpha: f64, i: usize, j: usize| table.slice(alpha).at([i, j].map(|node| node as f64 / 31.0));
    for (i, j) in [(0, 0), (5, 9), (31, 20)] {
        let [first, second] = [0, 1].map(|k| table.cell(k, i, j)[0]);
        let straight = first + texel(0.007) * (second - first);
        assert!((at(0.007, i, j).growth.ln() - straight).abs() < 1e-5, "node ({i}, {j})");
        assert_eq!(at(LEAST_SLAB_ALPHA, i, j), at(1e-4, i, j));
        assert_ne!(at(LEAST_SLAB_ALPHA, i, j), at(LEAST_SLAB_ALPHA * 1.1, i, j));
    }
}

fn error(bytes: &[u8]) -> String {
    let error = SlabTable::from_dds(bytes).expect_err("a bad volume").to_string();
    assert!(!error.contains('\n') && error.len() < 300, "one line: {error}");
    error
}

/// The shipped volume with the little-endian `value` at byte `at`.
fn with(at: usize, value: u32) -> Vec<u8> {
    let mut bytes = SlabTable::embedded().to_dds();
    bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
    bytes
}

#[test]
fn truncated_and_longer_volumes_are_refused() {
    let bytes = SlabTable::embedded().to_dds();
    for length in (0..400).chain((400..bytes.len()).step_by(7919)).chain([bytes.len() - 1]) {
        error(&bytes[..length]);
    }
    let mut longer = bytes;
    longer.extend([0; 8]);
    assert!(error(&longer).contains("262152 bytes of texels"));
}

#[test]
fn textures_of_other_kinds_are_refused() {
    assert!(error(b"\x89PNG\r\n\x1a\n and so on").contains("no .dds texture"));
    assert!(error(&SheenTable::embedded().to_dds()).contains("no volume"));
    // Height, width, depth.
    for at in [12, 16, 24] {
        for side in [0, 1, 31, 33, u32::MAX] {
            assert!(error(&with(at, side)).contains("texels"), "byte {at}: {side}");
        }
    }
    let flags = u32::from_le_bytes(SlabTable::embedded().to_dds()[8..12].try_into().expect("four bytes"));
    let mut mips = with(8, flags | 0x0002_0000);
    mips[28..32].copy_from_slice(&2_u32.to_le_bytes());
    assert!(error(&mips).contains("mips"));
    // The flags say that there is no depth.
    assert!(error(&with(8, flags & !0x0080_0000)).contains("32 x 32 x 0 texels"));
    assert!(error(&with(112, 0xfe00)).contains("cube"));
    // DX10: format, dimension, cube flag, array size.
    assert!(error(&with(128, 2)).contains("R32G32B32A32"));
    assert!(error(&with(128, 9999)).contains("no .dds texture"));
    assert!(error(&with(132, 3)).contains("no volume"));
    assert!(error(&with(136, 4)).contains("cube"));
    assert!(error(&with(140, 2)).contains("array"));
    assert!(error(&with(84, u32::from_le_bytes(*b"DXT1"))).contains("without a DX10 header"));
}

#[test]
fn bad_texels_name_their_place() {
    let place = |x: usize, y: usize, z: usize| HEADER_BYTES + ((z * SLAB_SIDE + y) * SLAB_SIDE + x) * 8;
    let set = |at: usize, half: u16| {
        let mut bytes = SlabTable::embedded().to_dds();
        bytes[at..at + 2].copy_from_slice(&half.to_le_bytes());
        bytes
    };
    let at = place(2, 3, 3);
    for bad in [f16::NAN, f16::INFINITY, f16::from_f64(-2.0), f16::from_f64(20.0)] {
        let found = error(&set(at, bad.to_bits()));
        assert!(found.contains(&format!("byte {at}, texel (2, 3, 3): v0 must be in [-1, 16]")), "{found}");
    }
    assert!(error(&set(at + 4, f16::from_f64(1.5).to_bits())).contains("v2 must be in [-1, 1]"));
    assert!(error(&set(place(2, 3, 4), f16::ONE.to_bits())).contains("exchanged"));
    // A texel's A does not matter.
    assert!(SlabTable::from_dds(&set(at + 6, f16::NAN.to_bits())).is_ok());
}

#[test]
fn no_flipped_bit_panics() {
    let good = SlabTable::embedded().to_dds();
    for bit in 0..HEADER_BYTES * 8 {
        let mut bytes = good.clone();
        bytes[bit / 8] ^= 1 << (bit % 8);
        // Most are refused, while some bits of the headers mean nothing: none may panic.
        let _ = SlabTable::from_dds(&bytes);
    }
}

#[test]
fn bad_files_are_named() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let path = |name: &str| folder.path().join(name);
    let error = |path: &Path| {
        let error = SlabTable::load(path).expect_err("a bad file").to_string();
        assert!(error.starts_with(&format!("{}: ", path.display())) && !error.contains('\n'), "{error}");
        error
    };
    assert!(error(&path("absent.dds")).contains("cannot be read"));
    assert!(error(folder.path()).contains("no ordinary file"));
    std::fs::write(path("text.dds"), "alpha,mu,a,b,r\n").expect("writing in the test's folder");
    assert!(error(&path("text.dds")).contains("no .dds texture"));
    let huge = std::fs::File::create(path("huge.dds")).expect("a file in the test's folder");
    huge.set_len(MAX_FILE_BYTES + 1).expect("a sparse file");
    assert!(error(&path("huge.dds")).contains("is longer than"));
}
