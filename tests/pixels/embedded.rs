//! What the binary carries.

/// How often a stretch of bytes from the middle of a file, which is in the file once, is found in the binary.
fn times(file: &str) -> usize {
    let read = |path: &str| std::fs::read(path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let (whole, binary) = (read(&format!("{}/{file}", env!("CARGO_MANIFEST_DIR"))), read(env!("CARGO_BIN_EXE_velour")));
    let stretch = &whole[whole.len() / 2..][..64];
    let count = |bytes: &[u8]| bytes.windows(stretch.len()).filter(|window| *window == stretch).count();
    assert_eq!(count(&whole), 1, "{file}");
    count(&binary)
}

#[test]
fn each_scene_and_table_is_in_the_binary_once() {
    for file in ["assets/drape.glb", "assets/dust.glb", "tables/sheen_slab.dds"] {
        assert_eq!(times(file), 1, "{file}");
    }
}
