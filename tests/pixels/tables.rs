//! `velour fit`: what it writes, what it checks, and what it refuses.

use velour::table::{GgxTable, SLAB_SIDE, SheenTable, SlabTable};

use super::run::Bench;

#[test]
fn a_fitted_table_is_what_its_check_expects() {
    let bench = Bench::new();
    let said = bench.run("fit --only sheen --resolution 4 -o new/tables").stdout;
    assert!(said.contains("Relative L2 error") && said.contains("new/tables/sheen_ltc.csv"), "{said}");
    let path = bench.path("new/tables/sheen_ltc.csv");
    let table = SheenTable::load(&path).unwrap();
    assert_eq!(table.size(), [4, 4]);
    assert_eq!(table.to_dds(), std::fs::read(path.with_extension("dds")).unwrap());
    let check = "fit --check --only sheen --resolution 4 -o new/tables";
    let before = std::fs::read(&path).unwrap();
    assert_eq!(bench.run(check).stdout.lines().count(), 2);
    assert_eq!(std::fs::read(&path).unwrap(), before, "a check writes nothing");

    let mut cells = table.cells().to_vec();
    cells[9][2] += 0.01;
    std::fs::write(&path, SheenTable::new([4, 4], cells).to_csv(&[])).unwrap();
    let good = std::fs::read(bench.path("new/tables/sheen_ltc.dds")).unwrap();
    std::fs::write(bench.path("new/tables/sheen_ltc.dds"), SheenTable::load(&path).unwrap().to_dds()).unwrap();
    bench.refused(&mut bench.command(check), 1, "half-float steps off");
    std::fs::write(bench.path("new/tables/sheen_ltc.dds"), good).unwrap();
    bench.refused(&mut bench.command(&check.replace('4', "5")), 1, "another size");
    for other in ["slab", "ggx"] {
        bench.refused(&mut bench.command(&format!("fit --only {other} --resolution 16")), 2, "leave it out");
    }
}

#[test]
fn the_slabs_table_is_checked() {
    let bench = Bench::new();
    let shipped = SlabTable::embedded();
    let n = SLAB_SIDE;
    let mut cells: Vec<[f64; 3]> = (0..n.pow(3)).map(|at| shipped.cell(at / (n * n), at / n % n, at % n)).collect();
    cells[(20 * n + 7) * n + 7][0] += 0.01;
    bench.put("sheen_slab.dds", SlabTable::new(&cells).to_dds());
    bench.refused(
        &mut bench.command("fit --check --only slab -o ."),
        1,
        "sheen_slab.dds: is not what the program makes",
    );
}

#[test]
fn the_specular_bases_table_is_checked() {
    let bench = Bench::new();
    let shipped = GgxTable::embedded();
    let [n, m] = shipped.size();
    let mut cells: Vec<[f64; 5]> = (0..n * m).map(|at| shipped.cell(at / m, at % m)).collect();
    cells[20 * m + 7][2] += 0.01;
    let wrong = GgxTable::new([n, m], cells);
    bench.put("ggx_ltc.csv", wrong.to_csv(&[]));
    bench.put("ggx_ltc.dds", wrong.to_dds());
    for name in ["csv", "dds"] {
        let check = &mut bench.command("fit --check --only ggx -o .");
        bench.refused(check, 1, &format!("ggx_ltc.{name}: is not what the program makes"));
    }
}

#[test]
fn what_cannot_be_read_or_written_is_said_before_the_work() {
    let bench = Bench::new();
    bench.refused(&mut bench.command("fit --check -o nowhere"), 2, "nowhere/sheen_ltc.csv: cannot be read");
    let shipped = SheenTable::embedded();
    bench.put("sheen_ltc.csv", shipped.to_csv(&[]));
    bench.put("sheen_ltc.dds", shipped.to_dds());
    // The second table's file is checked before the first table is made.
    bench.refused(&mut bench.command("fit --check -o ."), 2, "sheen_slab.dds: cannot be read");
    bench.put("sheen_slab.dds", "no texture");
    bench.refused(&mut bench.command("fit --check --only slab -o ."), 2, "sheen_slab.dds: no .dds texture");
    bench.refused(&mut bench.command("fit -o scene.glb"), 2, "scene.glb: the folder cannot be made");
    bench.refused(&mut bench.command("fit --only fuzz"), 2, "--only");
}
