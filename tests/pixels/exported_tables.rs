//! `velour export tables`.

use super::run::Bench;

#[test]
fn tables_are_written_in_the_forms_that_are_asked_for() {
    let bench = Bench::new();
    let said = bench.run("export tables -o all");
    let mut names: Vec<String> = std::fs::read_dir(bench.path("all"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    let forms = ["bin", "csv", "dds", "exr", "glsl", "h", "js", "ktx2", "npy", "rs"];
    let expected: Vec<String> =
        ["ggx_ltc", "sheen_ltc"].iter().flat_map(|stem| forms.map(|form| format!("{stem}.{form}"))).collect();
    assert_eq!(names, expected);
    assert_eq!(said.stdout.lines().filter(|line| line.contains("x = alpha with node k at k/31")).count(), 9);
    for name in ["sheen_ltc.csv", "sheen_ltc.dds", "ggx_ltc.csv", "ggx_ltc.dds"] {
        let shipped = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tables").join(name);
        let [shipped, written] = [shipped, bench.path("all").join(name)].map(|path| std::fs::read(path).unwrap());
        assert!(shipped == written, "{name} is not as shipped");
    }
    let said = bench.run("export tables -o two --only ggx --format npy --format bin --format npy");
    assert_eq!(said.stdout.lines().count(), 2, "{}", said.stdout);
    assert_eq!(std::fs::read_dir(bench.path("two")).unwrap().count(), 2);
}

#[test]
fn a_small_table_says_how_far_it_is_off() {
    let bench = Bench::new();
    // The shipped table stays as it is.
    bench.run("export tables -o small --only sheen --format bin");
    let said = bench.run("export tables -o small --only sheen --format bin --format js --size 16");
    assert!(said.stdout.starts_with("Difference from the shipped table at 63 x 63 points: a mean 0.0006"), "{said:?}");
    assert!(
        said.stdout.contains("16 x 16 texels") && said.stdout.contains("resampled from the shipped table"),
        "{said:?}"
    );
    let length = |name: &str| std::fs::read(bench.path("small").join(name)).unwrap().len();
    assert_eq!([length("sheen_ltc.bin"), length("sheen_ltc_16.bin")], [32 * 32 * 8, 16 * 16 * 8]);
    assert!(std::fs::read_to_string(bench.path("small/sheen_ltc_16.js")).unwrap().contains("const sheenLtc16 = "));
}

#[test]
fn what_cannot_be_exported_is_refused() {
    let bench = Bench::new();
    for (arguments, hint) in [
        ("export tables -o out --size 1", "2..=128"),
        ("export tables -o out --size 129", "2..=128"),
        ("export tables -o out --size 16 --only ggx", "--size is the sheen's"),
        ("export tables -o out --format png", "ktx2"),
        ("export tables", "--output"),
        ("export", "export takes shaders, tables or golden; see `velour export --help`"),
        ("export tables -o scene.glb", "scene.glb"),
    ] {
        bench.refused(&mut bench.command(arguments), 2, hint);
    }
}
