//! Bad input: each in one line on stderr that says what is wrong, with the right exit code and no file left behind.

use std::process::Command;

use serde_json::{Value, json};
use velour::table::SheenTable;

use super::run::{Bench, small_stage};
use super::stage::container;

/// `render scene.glb -o out.png` with these flags is refused.
fn refuse_flags(bench: &Bench, flags: &str, code: i32, hint: &str) {
    bench.refused(&mut bench.command(&format!("render scene.glb -o out.png {flags}")), code, hint);
}

/// A small file with one thing changed in its JSON.
fn spoilt(change: impl FnOnce(&mut Value)) -> Vec<u8> {
    let (mut json, binary) = small_stage().chunks();
    change(&mut json);
    container(json.to_string().as_bytes(), &binary)
}

/// A small file with a number in its buffer replaced: float `at` of its positions and normals.
fn poisoned(at: usize, value: f32) -> Vec<u8> {
    let (json, mut binary) = small_stage().chunks();
    binary[4 * at..][..4].copy_from_slice(&value.to_le_bytes());
    container(json.to_string().as_bytes(), &binary)
}

#[test]
fn flags_out_of_range() {
    let bench = Bench::new();
    for (flags, hint) in [
        ("--alpha 1.5", "--alpha"),
        ("--alpha -0.1", "--alpha"),
        ("--alpha nan", "--alpha"),
        ("--alpha fuzzy", "--alpha"),
        ("--sheen-color 1,0", "--sheen-color"),
        ("--sheen-color 1,0,2", "--sheen-color"),
        ("--size 0x10", "--size"),
        ("--size 10", "--size"),
        ("--size -4x4", "-4"),
        ("--size 99999999999x1", "--size"),
        ("--exposure inf", "--exposure"),
        ("--exposure 1e9", "--exposure"),
        ("--tonemap filmic", "--tonemap"),
        ("--lobes shadow", "--lobes"),
        ("--ambient 1,1", "--ambient"),
        ("--ambient -1,0,0", "--ambient"),
        ("--layering stacked", "--layering"),
        ("--layering manual=2", "--layering"),
        ("--roughness-map cube", "--roughness-map"),
        ("--sheen-model slab", "the sheen-model slab takes a path tracer"),
        ("--set felt", "MATERIAL.KEY=VALUE"),
        ("--set felt.alpha=2", "[0,1]"),
        ("--set felt.hue=2", "the keys are sheen, alpha"),
        ("--lights-visible maybe", "--lights-visible"),
        ("--msaa 2", "--msaa"),
        ("--nonsense", "--nonsense"),
        ("--alpha", "--alpha"),
        ("extra.glb", "extra.glb"),
    ] {
        refuse_flags(&bench, flags, 2, hint);
    }
    for (words, hint) in [
        ("polish scene.glb", "polish"),
        ("render", "required"),
        ("render scene.glb", "--output"),
        ("fit --resolution 1", "--resolution"),
        ("figures -o scene.glb", "scene.glb: the folder cannot be made"),
        ("figures -o", "--output"),
    ] {
        bench.refused(&mut bench.command(words), 2, hint);
    }
}

#[test]
fn what_the_scene_or_the_device_has_not() {
    let bench = Bench::new();
    refuse_flags(&bench, "--camera behind", 2, "behind");
    refuse_flags(&bench, "--camera 7", 2, "7");
    refuse_flags(&bench, "--set silk.alpha=0.5", 2, "silk");
    refuse_flags(&bench, "--set 7.alpha=0.5", 2, "no such material");
    refuse_flags(&bench, "--size 1000000x2", 2, "1000000");
    refuse_flags(&bench, "--size 2x1000000", 2, "1000000");
    refuse_flags(&bench, "--adapter nosuch", 3, "nosuch");
}

#[test]
fn places_where_no_picture_can_stand() {
    let bench = Bench::new();
    std::fs::create_dir(bench.path("folder.png")).unwrap();
    for (output, hint) in [
        ("missing/out.png", "missing"),
        ("scene.glb/out.png", "scene.glb"),
        ("folder.png", "folder"),
        ("out.jpg", "out.jpg"),
        ("out", "out"),
    ] {
        bench.refused(&mut bench.command(&format!("render scene.glb -o {output}")), 2, hint);
    }
}

#[test]
fn files_that_are_no_scene() {
    let bench = Bench::new();
    let whole = small_stage().glb();
    std::fs::create_dir(bench.path("folder.glb")).unwrap();
    bench.put("empty.glb", "");
    bench.put("text.glb", "Velvet is a woven fabric.\nIt has a pile.\n");
    bench.put("text.gltf", "{\"asset\": ");
    bench.put("half.glb", &whole[..whole.len() / 2]);
    bench.put("most.glb", &whole[..whole.len() - 1]);
    bench.put("head.glb", &whole[..10]);
    bench.put(
        "beside.gltf",
        json!({ "asset": { "version": "2.0" }, "buffers": [{ "byteLength": 4, "uri": "gone.bin" }] }).to_string(),
    );
    for name in [
        "gone.glb",
        "gone/scene.glb",
        "folder.glb",
        "empty.glb",
        "text.glb",
        "text.gltf",
        "half.glb",
        "most.glb",
        "head.glb",
        "beside.gltf",
    ] {
        bench.refused(&mut bench.command(&format!("render {name} -o out.png")), 2, name);
        bench.refused(&mut bench.command(&format!("view {name}")), 2, name);
        bench.refused(&mut bench.command(name), 2, name);
    }
}

#[test]
fn words_that_are_neither_command_nor_scene() {
    let bench = Bench::new();
    for line in ["rendre", "rendre scene.glb -o out.png", "gone.glb --msaa 1"] {
        bench.refused(&mut bench.command(line), 2, "neither a command nor a file");
    }
    for line in ["-o out.png", "scene.glb -o out.png", "scene.glb scene.glb", "scene.glb render"] {
        bench.refused(&mut bench.command(line), 2, "velour --help");
    }
    // The picture would take the scene's place.
    bench.put("velour.png", small_stage().glb());
    bench.refused(&mut bench.command("velour.png"), 2, "is the scene itself");
}

#[test]
fn scenes_with_something_wrong() {
    let bench = Bench::new();
    let mut cases: Vec<(&str, Vec<u8>)> = vec![
        ("accessor", spoilt(|json| json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = json!(99))),
        ("accessor", spoilt(|json| json["meshes"][0]["primitives"][0]["indices"] = json!(99))),
        ("material", spoilt(|json| json["meshes"][0]["primitives"][0]["material"] = json!(99))),
        ("mesh 99", spoilt(|json| json["nodes"][0]["mesh"] = json!(99))),
        ("node", spoilt(|json| json["scenes"][0]["nodes"] = json!([99]))),
        ("normals", spoilt(|json| json["accessors"][0]["count"] = json!(3))),
        ("accessor 0", spoilt(|json| json["accessors"][0]["count"] = json!(1_000_000_000))),
        ("accessor 0", spoilt(|json| json["accessors"][0]["byteOffset"] = json!(1_000_000))),
        ("bufferView 0", spoilt(|json| json["bufferViews"][0]["byteLength"] = json!(1_000_000_000_000_u64))),
        ("bufferView 1", spoilt(|json| json["bufferViews"][1]["byteOffset"] = json!(u64::MAX))),
        ("buffer", spoilt(|json| json["buffers"][0]["byteLength"] = json!(1_u64 << 40))),
        ("node", spoilt(|json| json["nodes"][0]["children"] = json!([0]))),
        (
            "node",
            spoilt(|json| (json["nodes"][0]["children"], json["nodes"][1]["children"]) = (json!([1]), json!([0]))),
        ),
        ("roughness", spoilt(|json| json["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = json!("rough"))),
        (
            "roughness",
            spoilt(|json| {
                json["materials"][0]["extensions"]["KHR_materials_sheen"]["sheenRoughnessFactor"] = json!([1])
            }),
        ),
        (
            "sheenColor",
            spoilt(|json| json["materials"][0]["extensions"]["KHR_materials_sheen"]["sheenColorFactor"] = json!("red")),
        ),
        (
            "emissiveStrength",
            spoilt(|json| {
                json["materials"][1]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = json!(1e39)
            }),
        ),
        (
            "pbrMetallicRoughness",
            spoilt(|json| json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = json!([2, 0, 0])),
        ),
        ("yfov", spoilt(|json| json["cameras"][0]["perspective"]["yfov"] = json!(-1.0))),
        ("znear", spoilt(|json| json["cameras"][0]["perspective"]["znear"] = json!(0.0))),
        ("zfar", spoilt(|json| json["cameras"][0]["perspective"]["zfar"] = json!(0.01))),
        ("EXT_nobody_has", spoilt(|json| json["extensionsRequired"] = json!(["EXT_nobody_has"]))),
        ("version", spoilt(|json| json["asset"]["version"] = json!("1.0"))),
        ("matrix", spoilt(|json| json["nodes"][0]["matrix"] = json!([1, 2, 3]))),
        ("triangles", spoilt(|json| json["scenes"][0]["nodes"] = json!([]))),
    ];
    // The floor's positions are the first 12 floats, its normals the next; then come 6 indices, and the light likewise.
    for (at, value) in [(0, f32::NAN), (4, f32::INFINITY), (13, f32::NAN), (30, f32::NAN), (31, f32::NEG_INFINITY)] {
        cases.push(("finite", poisoned(at, value)));
    }
    for (index, (hint, bytes)) in cases.iter().enumerate() {
        let name = format!("bad{index}.glb");
        bench.put(&name, bytes);
        let command = &mut bench.command(&format!("render {name} -o out.png --size 16x16"));
        bench.refused(command, 2, hint);
        bench.refused(command, 2, &name);
    }
}

#[test]
fn tables_with_something_wrong() {
    let bench = Bench::new();
    let table = SheenTable::embedded();
    let (text, texture) = (table.to_csv(&[]), table.to_dds());
    let line = |number: usize, new: &str| {
        let mut lines: Vec<&str> = text.lines().collect();
        lines[number] = new;
        lines.join("\n")
    };
    let cut = text.lines().take(500).collect::<Vec<_>>().join("\n");
    let dds: [&[u8]; 3] = [&texture[..texture.len() - 1], &texture[..60], b"DDS what else"];
    let bad_texel = [&texture[..texture.len() - 8], &[0xff; 8]].concat();
    let mut cases: Vec<(&str, Vec<u8>)> = vec![
        ("table.txt", text.clone().into_bytes()),
        ("empty.csv", Vec::new()),
        ("cut.csv", cut.into_bytes()),
        ("nan.csv", line(40, "0.0322581,0.2258065,nan,0,0.1").into_bytes()),
        ("negative.csv", line(40, "0.0322581,0.2258065,-1,0,0.1").into_bytes()),
        ("albedo.csv", line(40, "0.0322581,0.2258065,1,0,1.1").into_bytes()),
        ("node.csv", line(40, "0.5,0.5,1,0,0.5").into_bytes()),
        ("short.csv", line(40, "0.0322581,0.2258065,1").into_bytes()),
        ("binary.csv", texture.clone()),
        ("text.dds", text.clone().into_bytes()),
        ("nan.dds", bad_texel),
    ];
    cases.extend(["last.dds", "head.dds", "what.dds"].into_iter().zip(dds.map(<[u8]>::to_vec)));
    for (name, bytes) in &cases {
        bench.put(name, bytes);
        refuse_flags(&bench, &format!("--sheen-table {name}"), 2, name);
    }
    refuse_flags(&bench, "--sheen-table gone.csv", 2, "gone.csv");
    refuse_flags(&bench, "--sheen-table .", 2, ".");
}

/// A machine where neither Vulkan nor OpenGL finds a driver.
pub fn deviceless(mut command: Command) -> Command {
    for variable in ["VK_DRIVER_FILES", "VK_ICD_FILENAMES", "__EGL_VENDOR_LIBRARY_FILENAMES"] {
        command.env(variable, "/nowhere/driver.json");
    }
    command
}

#[test]
fn machines_without_a_device_or_a_display() {
    let bench = Bench::new();
    let hint = "no graphics adapter";
    bench.refused(&mut deviceless(bench.command("render scene.glb -o out.png --adapter llvmpipe")), 3, hint);
    bench.refused(&mut bench.command("view scene.glb"), 3, "display");
    // What is wrong with the input comes first, on any machine.
    bench.refused(&mut deviceless(bench.command("render gone.glb -o out.png")), 2, "gone.glb");
}

#[test]
fn an_older_picture_survives_a_failure() {
    let bench = Bench::new();
    bench.put("out.png", "an older picture");
    refuse_flags(&bench, "--camera behind", 2, "behind");
    assert_eq!(std::fs::read(bench.path("out.png")).unwrap(), b"an older picture");
}
