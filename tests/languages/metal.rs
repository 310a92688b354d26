//! Metal, as C++: compiled, and run by the processor.

use velour::export::shaders::{Language, SOURCES};

use super::compilers::{compiles, folder, metal, run};
use super::golden::{Rows, assert_right};
use super::shells;
use super::theirs::theirs;

#[test]
fn metal_gives_the_golden_numbers() {
    let (_folder, path) = folder();
    let rows = Rows::shipped();
    let (before, after) = (include_str!("shells/before.metal"), include_str!("shells/after.metal"));
    let source = format!("{before}{}{after}", shells::rows(Language::Msl));
    assert_right("Metal", &rows, &results(&path, &source, &rows));
}

/// Each once, behind those that it needs: no two clash.
#[test]
fn every_metal_file_compiles() {
    let (_folder, path) = folder();
    let check = |files: &str| compiles(&path, "shader.metal", files, |path| metal(path, &["-fsyntax-only"]));
    let files: String = SOURCES
        .iter()
        .map(|source| {
            let file = source.in_language(Language::Msl).expect("it is translated");
            format!("{}{file}", theirs(source, Language::Msl))
        })
        .collect();
    check(&format!("#include <metal_stdlib>\n{files}")).unwrap_or_else(|said| panic!("{said}"));
    assert!(check("float f() { return nothing; }\n").is_err(), "it tells errors");
}

/// What the program gives for all rows.
fn results(folder: &std::path::Path, source: &str, rows: &Rows) -> Vec<f32> {
    let (path, program) = (folder.join("rows.metal"), folder.join("rows"));
    std::fs::write(&path, source).expect("the folder takes a file");
    run(metal(&path, &["-o"]).arg(&program), &[]);
    let mut input = Vec::new();
    for table in &rows.tables {
        input.extend(table.size.iter().flat_map(|side| side.to_le_bytes()));
        input.extend(table.texels.iter().flat_map(|number| number.to_le_bytes()));
    }
    for (index, head) in rows.heads.iter().enumerate() {
        let [inputs, outputs] = rows.counts(index);
        input.extend([head[0], inputs as u32, outputs as u32].iter().flat_map(|count| count.to_le_bytes()));
        let first = head[1] as usize;
        input.extend(rows.inputs[first..first + inputs].iter().flat_map(|number| number.to_le_bytes()));
    }
    let bytes = run(&mut std::process::Command::new(program), &input);
    bytes.chunks_exact(4).map(|number| f32::from_le_bytes([number[0], number[1], number[2], number[3]])).collect()
}
