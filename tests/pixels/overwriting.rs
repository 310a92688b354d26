//! Files that are read are never written over.

use std::path::Path;

use super::run::{Bench, small_stage};

/// `scene.gltf` with its buffer in `data.exr` and an image in `cloth.png`, and a table in `table.csv`.
fn bench() -> Bench {
    let bench = Bench::new();
    let (mut json, binary) = small_stage().chunks();
    json["buffers"][0]["uri"] = "data.exr".into();
    json["images"] = serde_json::json!([{ "uri": "cloth.png" }]);
    bench.put("scene.gltf", json.to_string());
    bench.put("data.exr", binary);
    let cloth = velour::picture::DisplayImage { width: 1, height: 1, pixels: vec![[200; 3]] };
    bench.put("cloth.png", cloth.to_png().unwrap());
    bench.put("state.toml", "exposure = 1\n");
    bench.put("table.csv", velour::table::SheenTable::embedded().to_csv(&["of a test".to_owned()]));
    bench
}

fn all(bench: &Bench) -> Vec<Vec<u8>> {
    bench.names().iter().map(|name| std::fs::read(bench.path(name)).unwrap()).collect()
}

fn refused(bench: &Bench, arguments: &str, hint: &str) {
    let before = all(bench);
    bench.refused(&mut bench.command(arguments), 2, hint);
    assert!(all(bench) == before, "velour {arguments} changes a file");
}

#[test]
fn a_picture_goes_over_no_file_of_its_scene() {
    let bench = bench();
    for command in ["render", "reference"] {
        refused(&bench, &format!("{command} scene.gltf -o data.exr"), "data.exr: is a file of the scene");
        refused(&bench, &format!("{command} scene.gltf -o ./cloth.png"), "cloth.png: is a file of the scene");
    }
    refused(&bench, "reference scene.gltf -o out.png --errors data.exr", "data.exr: is a file of the scene");
    bench.run("render scene.gltf -o out.exr --size 16x16");
}

/// Under another name too.
#[cfg(unix)]
#[test]
fn links_lead_to_the_same_files() {
    let bench = bench();
    let link = |name: &str, link: &str| {
        std::fs::hard_link(bench.path(name), bench.path(&format!("hard_{link}"))).unwrap();
        std::os::unix::fs::symlink(Path::new(name), bench.path(&format!("soft_{link}"))).unwrap();
    };
    link("data.exr", "data.exr");
    link("cloth.png", "cloth.png");
    link("scene.gltf", "scene.png");
    link("table.csv", "table.png");
    link("state.toml", "state.png");
    for kind in ["hard", "soft"] {
        for (name, hint) in [
            ("data.exr", "a file of the scene"),
            ("cloth.png", "a file of the scene"),
            ("scene.png", "the scene itself"),
            ("table.png", "the table that is read"),
            ("state.png", "the state that is read"),
        ] {
            let read = "--sheen-table table.csv --state state.toml";
            refused(&bench, &format!("render scene.gltf {read} -o {kind}_{name}"), hint);
        }
        let compare = format!("compare cloth.png cloth.png --heatmap {kind}_cloth.png");
        refused(&bench, &compare, "is a picture to be compared");
    }
}

/// The head of a short .exr may claim any size: no memory is taken on its word.
#[cfg(unix)]
#[test]
fn claims_of_a_head_take_no_memory() {
    let bench = Bench::new();
    let small = velour::picture::LinearImage { width: 9, height: 7, pixels: vec![[0.5; 3]; 63] };
    let mut bytes = small.to_exr().unwrap();
    let name = b"dataWindow\0box2i\0";
    let at = bytes.windows(name.len()).position(|window| window == name).unwrap() + name.len() + 4;
    for (corner, hint) in [([99_999_999, 99], "100000000x100 is too large"), ([8191, 4095], "cannot be read")] {
        for (place, number) in bytes[at + 8..].chunks_exact_mut(4).zip(corner) {
            place.copy_from_slice(&i32::to_le_bytes(number));
        }
        bench.put("claims.exr", &bytes);
        let mut command = std::process::Command::new("sh");
        let line = "ulimit -v 1000000 && exec \"$0\" compare claims.exr claims.exr";
        command.args(["-c", line, env!("CARGO_BIN_EXE_velour")]).current_dir(bench.path(""));
        bench.refused(&mut command, 2, hint);
    }
}
