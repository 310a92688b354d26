//! What the binary carries.

/// Scenes and tables are in the binary once: a stretch from the middle of each is there as often as in the file itself.
#[test]
fn each_scene_and_table_is_in_the_binary_once() {
    let read = |path: &str| std::fs::read(path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let binary = read(env!("CARGO_BIN_EXE_velour"));
    for file in ["assets/drape.glb", "assets/dust.glb", "tables/sheen_slab.dds"] {
        let whole = read(&format!("{}/{file}", env!("CARGO_MANIFEST_DIR")));
        let stretch = &whole[whole.len() / 2..][..64];
        let count = |bytes: &[u8]| bytes.windows(stretch.len()).filter(|window| *window == stretch).count();
        assert_eq!(count(&binary), count(&whole), "{file}");
    }
}
