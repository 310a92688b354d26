//! Table files that must be refused without a panic, with one line that says what is wrong, where, and what to do.

use std::path::Path;
use velour::table::{MAX_FILE_BYTES, MAX_SIDE, SheenTable};

const ROWS: &str = "0,0,1,0,0\n0,1,1,0,0\n1,0,1,0,0\n1,1,1,0,0\n";

fn csv_error(text: &str) -> String {
    let error = SheenTable::from_csv(text).expect_err(text).to_string();
    assert!(!error.contains('\n') && error.len() < 300, "one line: {error}");
    error
}

fn dds_error(bytes: &[u8]) -> String {
    let error = SheenTable::from_dds(bytes).expect_err("a bad texture").to_string();
    assert!(!error.contains('\n') && error.len() < 300, "one line: {error}");
    error
}

/// A good texture of 2 x 2 texels, to be broken.
fn texture() -> Vec<u8> {
    SheenTable::from_csv(ROWS).expect("good rows").to_dds()
}

/// `texture()` with the little-endian `value` at byte `at`.
fn texture_with(at: usize, value: u32) -> Vec<u8> {
    let mut bytes = texture();
    bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
    bytes
}

#[test]
fn csv_defects_name_their_line() {
    let defects = [
        ("0,0,1,0\n", "line 1: 4 columns"),
        ("0,0,1,0,0,\n", "line 1: 6 columns"),
        ("# x\n0,0,one,0,0\n", "line 2: a must be a finite number: \"one\""),
        ("0,0,1,NaN,0\n", "line 1: b must"),
        ("0,0,inf,0,0\n", "line 1: a must"),
        ("0,0,1e39,0,0\n", "line 1: a, b, r must be finite"),
        ("0,0,-0.1,0,0\n", "line 1: a must be at least 0"),
        ("0,0,1,0,1.01\n", "line 1: r must be in [0, 1]"),
        ("0,0,1,0,-0.01\n", "line 1: r must be in [0, 1]"),
        ("0,0,1,,0\n", "line 1: b must"),
        ("mu,alpha,a,b,r\n", "line 1: alpha must"),
        ("0,0,1,0,0\nalpha,mu,a,b,r\n", "line 2: alpha must"),
    ];
    for (text, message) in defects {
        let error = csv_error(text);
        assert!(error.contains(message), "{text:?}: {error}");
    }
}

#[test]
fn csv_must_fill_its_grid_in_order() {
    assert!(csv_error("").contains("no line of numbers"));
    assert!(csv_error("# only a comment\nalpha,mu,a,b,r\n").contains("no line of numbers"));
    assert!(csv_error("0,0,1,0,0\n").contains("1 x 1 nodes"));
    assert!(csv_error("0,0,1,0,0\n0,1,1,0,0\n").contains("1 x 2 nodes"));
    assert!(csv_error(ROWS.trim_end().rsplit_once('\n').expect("four rows").0).contains("3 rows do not fill"));
    assert!(csv_error("0,0,1,0,0\n1,0,1,0,0\n").contains("2 x 1 nodes of alpha and mu, where each needs 2 or more"));
    // mu-major instead of alpha-major.
    assert!(csv_error("0,0,1,0,0\n1,0,1,0,0\n0,1,1,0,0\n1,1,1,0,0\n").contains("4 x 1 nodes"));
    // A row out of order.
    assert!(csv_error("0,0,1,0,0\n0,1,1,0,0\n1,1,1,0,0\n1,0,1,0,0\n").contains("line 3: mu is 1"));
    // Off its node by more than 1e-4.
    assert!(csv_error(&ROWS.replace("0,1,", "0,0.99989,")).contains("line 2: mu is 0.99989"));
    assert!(csv_error(&ROWS.replace("1,0,1", "0.99989,0,1")).contains("line 3: alpha is 0.99989"));
}

#[test]
fn csv_is_bounded() {
    let wide: String = (0..1025).map(|_| "0,0,1,0,0\n").collect();
    assert!(csv_error(&(wide + "1,0,1,0,0\n")).contains("2 x 1025 nodes"));
    let long: String = (0..2 * 1025).map(|k| format!("{},{},1,0,0\n", k / 2, k % 2)).collect();
    assert!(csv_error(&long).contains("1025 x 2 nodes of alpha and mu, where 1024 a side"));
    let long_field = format!("0,0,{},0,0", "9".repeat(100_000));
    csv_error(&long_field);
    csv_error(&",".repeat(100_000));
}

#[test]
fn no_more_rows_are_read_than_the_largest_table_has() {
    let most = "0,0,1,0,0\n".repeat(MAX_SIDE * MAX_SIDE);
    let error = |text: &str| SheenTable::from_csv(text).expect_err("rows of one place").to_string();
    assert!(error(&most).contains("1 x 1048576 nodes"));
    // What is wrong with the row after the last one, nobody looks at.
    assert!(error(&(most + "no row")).contains("more than 1024 nodes a side"));
}

#[test]
fn every_truncated_texture_is_refused() {
    let bytes = texture();
    for length in 0..bytes.len() {
        dds_error(&bytes[..length]);
    }
    let mut longer = bytes;
    longer.push(0);
    assert!(dds_error(&longer).contains("33 bytes of texels"));
}

#[test]
fn textures_of_other_kinds_are_refused() {
    assert!(dds_error(b"\x89PNG\r\n\x1a\n and so on").contains("no .dds texture"));
    // Height and width.
    for at in [12, 16] {
        for side in [0, 1, 3, 1025, u32::MAX] {
            assert!(dds_error(&texture_with(at, side)).contains("texels"), "byte {at}: {side}");
        }
    }
    let depth_flagged = texture_with(8, 0x0080_100f);
    let mut volume = depth_flagged;
    volume[24..28].copy_from_slice(&2_u32.to_le_bytes());
    assert!(dds_error(&volume).contains("volume"));
    let mut mips = texture_with(8, 0x0002_100f);
    mips[28..32].copy_from_slice(&2_u32.to_le_bytes());
    assert!(dds_error(&mips).contains("mips"));
    // caps2: a cube, a volume.
    assert!(dds_error(&texture_with(112, 0xfe00)).contains("cube"));
    assert!(dds_error(&texture_with(112, 0x0020_0000)).contains("volume"));
    // DX10: format, dimension, cube flag, array size.
    assert!(dds_error(&texture_with(128, 28)).contains("R8G8B8A8"));
    assert!(dds_error(&texture_with(128, 9999)).contains("no .dds texture"));
    assert!(dds_error(&texture_with(132, 4)).contains("volume"));
    assert!(dds_error(&texture_with(136, 4)).contains("cube"));
    for array in [0, 2, u32::MAX] {
        assert!(dds_error(&texture_with(140, array)).contains("array"), "{array}");
    }
    // No DX10 header: with DXT1, what used to be that header counts as texels.
    assert!(dds_error(&texture_with(84, u32::from_le_bytes(*b"DXT1"))).contains("without a DX10 header"));
}

#[test]
fn bad_texels_name_their_place() {
    let nan = 0x7e00;
    let at = 148 + 8 + 2;
    let mut bytes = texture();
    bytes[at..at + 2].copy_from_slice(&u16::to_le_bytes(nan));
    assert!(dds_error(&bytes).contains("byte 156, texel (1, 0): a, b, r must be finite"));
    let mut bytes = texture();
    bytes[at + 2..at + 4].copy_from_slice(&u16::to_le_bytes(nan));
    assert!(dds_error(&bytes).contains("byte 156, texel (1, 0): a, b, r must be finite"));
    // r = 2.
    let mut bytes = texture();
    bytes[148 + 4..148 + 6].copy_from_slice(&u16::to_le_bytes(0x4000));
    assert!(dds_error(&bytes).contains("texel (0, 0): r must be in [0, 1]"));
}

#[test]
fn no_flipped_bit_panics() {
    let good = texture();
    for bit in 0..good.len() * 8 {
        let mut bytes = good.clone();
        bytes[bit / 8] ^= 1 << (bit % 8);
        // Most are refused, some are other tables: none may panic.
        let _ = SheenTable::from_dds(&bytes);
    }
}

#[test]
fn bad_files_are_named() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let path = |name: &str| folder.path().join(name);
    let error = |path: &Path| {
        let error = SheenTable::load(path).expect_err("a bad file").to_string();
        assert!(error.starts_with(&format!("{}: ", path.display())) && !error.contains('\n'), "{error}");
        error
    };
    assert!(error(&path("absent.csv")).contains("cannot be read"));
    assert!(error(&path("table.txt")).contains("neither .csv nor .dds"));
    assert!(error(&path("table")).contains("neither .csv nor .dds"));
    std::fs::create_dir(path("folder.csv")).expect("a folder in the test's folder");
    assert!(error(&path("folder.csv")).contains("no ordinary file"));
    std::fs::write(path("bytes.csv"), b"0,0,\xff\xfe").expect("writing in the test's folder");
    assert!(error(&path("bytes.csv")).contains("byte 4 is not UTF-8"));
    std::fs::write(path("text.dds"), ROWS).expect("writing in the test's folder");
    assert!(error(&path("text.dds")).contains("no .dds texture"));
    // Sparse, so that it takes no room on the disk.
    let huge = std::fs::File::create(path("huge.dds")).expect("a file in the test's folder");
    huge.set_len(MAX_FILE_BYTES + 1).expect("a sparse file");
    assert!(error(&path("huge.dds")).contains("is longer than"));
    // Reading from a socket or a pipe that nobody writes to would never end.
    #[cfg(unix)]
    {
        let socket = std::os::unix::net::UnixListener::bind(path("socket.csv")).expect("a socket in the test's folder");
        assert!(error(&path("socket.csv")).contains("no ordinary file"));
        drop(socket);
    }
}
