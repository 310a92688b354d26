use half::f16;
use velour::table::{GgxTable, MAX_SIDE, SheenTable};

/// 3 x 2 nodes, all numbers different.
fn small() -> SheenTable {
    let cells = (0..6).map(|k| [0.1 + f64::from(k), -f64::from(k) / 64.0 + 0.0, f64::from(k) / 8.0]).collect();
    SheenTable::new([3, 2], cells)
}

#[test]
fn lookup_is_bilinear_and_clamped() {
    let table = small();
    assert_eq!(table.lookup(0.0, 0.0), table.cell(0, 0));
    assert_eq!(table.lookup(1.0, 1.0), table.cell(2, 1));
    assert_eq!(table.lookup(0.5, 1.0), table.cell(1, 1));
    assert_eq!(table.lookup(-3.0, 7.0), table.cell(0, 1));
    let [a, _, _] = table.lookup(0.25, 0.5);
    // In the middle between the first four nodes, whose a are 0.1, 1.1, 2.1, 3.1.
    assert!((a - 1.6).abs() < 1e-15);
    let [a, _, _] = table.lookup(0.75, 0.25);
    assert!((a - (0.5 * (2.1 + 4.1) + 0.25)).abs() < 1e-14);
}

#[test]
fn csv_round_trip_is_exact() {
    let table = small();
    let text = table.to_csv(&["first".to_owned(), String::new(), "third, with \"quotes".to_owned()]);
    assert!(text.starts_with("# first\n#\n# third, with \"quotes\nalpha,mu,a,b,r\n0,0,0.1,0,0\n"), "{text}");
    assert_eq!(SheenTable::from_csv(&text).expect("a written table"), table);
}

#[test]
fn csv_is_read_in_every_dress() {
    let rows = "0,0,1,0,0\n0,1,1,0.5,0.25\n1,0,0,-1e-3,1\n1,1,.5,0,0.75";
    let table = SheenTable::from_csv(rows).expect("bare rows");
    assert_eq!(table.cell(0, 1), [1.0, 0.5, 0.25]);
    let dresses = [
        format!("{rows}\n"),
        format!("alpha,mu,a,b,r\n{rows}\n\n"),
        format!("# x\nalpha, mu , a,b,r\n# y\n{rows}"),
        format!("\u{feff}alpha,mu,a,b,r\n{rows}"),
        format!("  # \"quoted\n{}", rows.replace('\n', "\r\n").replace(',', " , ")),
        rows.replace("0,1,1", "0.00009,0.99991,1"),
    ];
    for dress in dresses {
        assert_eq!(SheenTable::from_csv(&dress).unwrap_or_else(|error| panic!("{error}: {dress}")), table);
    }
}

#[test]
fn dds_round_trip_is_the_nearest_half() {
    let table = small();
    let bytes = table.to_dds();
    // Magic, header, DX10 header; 8 bytes a texel.
    assert_eq!(bytes.len(), 4 + 124 + 20 + 6 * 8);
    assert_eq!(&bytes[84..88], b"DX10");
    let read = SheenTable::from_dds(&bytes).expect("a written table");
    assert_eq!(read.size(), [3, 2]);
    for (read, written) in read.cells().iter().zip(table.cells()) {
        assert_eq!(*read, written.map(|value| f16::from_f64(value).to_f64()));
    }
    // Texel (1, 0): x = alpha, y = mu; then A = 1.
    let texel: Vec<f16> =
        bytes[148 + 8..148 + 16].chunks(2).map(|half| f16::from_le_bytes([half[0], half[1]])).collect();
    let [a, b, r] = table.cell(1, 0).map(f16::from_f64);
    assert_eq!(texel, [a, b, r, f16::ONE]);
}

#[test]
fn dds_of_floats_is_read() {
    let table = small();
    let mut bytes = table.to_dds();
    bytes.truncate(148);
    // DXGI_FORMAT_R32G32B32A32_FLOAT.
    bytes[128..132].copy_from_slice(&2_u32.to_le_bytes());
    bytes.extend(table.texels().as_flattened().iter().flat_map(|value| value.to_le_bytes()));
    let read = SheenTable::from_dds(&bytes).expect("a table of floats");
    assert_eq!(read.texels(), table.texels());
    assert_eq!(read.checksum(), table.checksum());
}

#[test]
fn dds_of_direct3d_9_is_read() {
    let table = small();
    let with_code =
        |bytes: &[u8], code: u32| [&bytes[..84], &code.to_le_bytes(), &bytes[88..128], &bytes[148..]].concat();
    let halves = table.to_dds();
    let read = SheenTable::from_dds(&with_code(&halves, 113)).expect("D3DFMT_A16B16G16R16F");
    assert_eq!(read, SheenTable::from_dds(&halves).expect("a written table"));
    let floats: Vec<u8> = table.texels().as_flattened().iter().flat_map(|value| value.to_le_bytes()).collect();
    let floats = [&halves[..148], &floats].concat();
    let read = SheenTable::from_dds(&with_code(&floats, 116)).expect("D3DFMT_A32B32G32R32F");
    assert_eq!(read.texels(), table.texels());
    // The last r is 2.
    let mut wrong = with_code(&floats, 116);
    let last = wrong.len() - 16;
    wrong[last + 8..last + 12].copy_from_slice(&2.0_f32.to_le_bytes());
    let error = SheenTable::from_dds(&wrong).expect_err("a wrong r").to_string();
    assert!(error.contains("byte 208, texel (2, 1): r must be in [0, 1]: 2"), "{error}");
}

#[test]
fn half_steps_count_through_0() {
    let table = |b: f64| SheenTable::new([2, 2], vec![[1.0, b, 0.0]; 4]);
    let least = 2.0_f64.powi(-24);
    assert_eq!(table(-least).half_steps(&table(2.0 * least)), Some(3));
    assert_eq!(table(2.0 * least).half_steps(&table(-least)), Some(3));
}

/// The message of a panic.
fn panics<T>(of: impl FnOnce() -> T + std::panic::UnwindSafe) -> String {
    let caught = std::panic::catch_unwind(|| drop(of())).expect_err("a panic");
    caught.downcast_ref::<String>().expect("a message").clone()
}

#[test]
fn what_is_no_table_is_told() {
    const CELL: [f64; 3] = [1.0, 0.0, 0.5];
    for size in [[1, 2], [2, 1], [MAX_SIDE + 1, 2], [2, MAX_SIDE + 1]] {
        let message = panics(|| SheenTable::new(size, vec![CELL; size[0] * size[1]]));
        assert!(message.contains(&format!("sides are in [2, 1024]: {size:?}")), "{message}");
    }
    for count in [3, 5] {
        let message = panics(|| SheenTable::new([2, 2], vec![CELL; count]));
        assert!(message.contains("cells of a table of [2, 2] nodes"), "{message}");
    }
    let message = panics(|| SheenTable::new([2, 2], vec![CELL, CELL, [-1.0, 0.0, 0.5], CELL]));
    assert!(message.contains("cell 2: a must be at least 0: -1"), "{message}");
}

#[test]
fn what_is_not_on_a_table_is_told() {
    let (sheen, ggx) = (small(), GgxTable::embedded());
    for (i, j) in [(3, 0), (0, 2)] {
        let message = panics(|| sheen.cell(i, j));
        assert!(message.contains(&format!("node ({i}, {j}) of a table of [3, 2]")), "{message}");
    }
    for [x, y] in [[f64::NAN, 0.5], [0.5, f64::NAN]] {
        let message = panics(|| sheen.lookup(x, y));
        assert!(message.contains(&format!("lookup at alpha {x}, mu {y}")), "{message}");
        let message = panics(|| ggx.lookup(x, y));
        assert!(message.contains(&format!("lookup at roughness {x}, mu {y}")), "{message}");
    }
}

#[test]
fn texels_run_along_alpha() {
    let table = small();
    let texels = table.texels();
    assert_eq!(texels.len(), 6);
    for (index, texel) in texels.iter().enumerate() {
        let [a, b, r] = table.cell(index % 3, index / 3).map(|value| value as f32);
        assert_eq!(*texel, [a, b, r, 1.0]);
    }
}

#[test]
fn checksum_tells_tables_apart() {
    let table = small();
    let mut cells = table.cells().to_vec();
    cells[3][1] += 1e-6;
    assert_ne!(SheenTable::new([3, 2], cells).checksum(), table.checksum());
}

#[test]
fn the_largest_table_is_read() {
    let table = SheenTable::new([MAX_SIDE, 2], vec![[0.123_456_7, -0.123_456_7, 0.5]; MAX_SIDE * 2]);
    assert_eq!(SheenTable::from_csv(&table.to_csv(&[])).expect("a written table"), table);
    assert_eq!(SheenTable::from_dds(&table.to_dds()).expect("a written table").size(), [MAX_SIDE, 2]);
}

#[test]
fn files_are_told_apart_by_extension() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let table = small();
    let [text, texture] = ["t.CSV", "t.dds"].map(|name| folder.path().join(name));
    std::fs::write(&text, table.to_csv(&[])).expect("writing in the test's folder");
    std::fs::write(&texture, table.to_dds()).expect("writing in the test's folder");
    assert_eq!(SheenTable::load(&text).expect("a written table"), table);
    assert_eq!(SheenTable::load(&texture).expect("a written table").size(), [3, 2]);
}
