//! The GLSL ES files in a browser's WebGL 2, on the golden numbers. `scripts/setup browser` installs a Chromium.

#[path = "../languages/golden.rs"]
mod golden;
#[path = "../languages/shells.rs"]
mod shells;

use std::path::Path;
use std::process::Command;

use golden::{Rows, assert_right};
use velour::export::shaders::Language;

/// Pixels in a row of the page's target: room for the outputs of any function.
const WIDTH: usize = 64;

#[test]
fn glsl_es_gives_the_golden_numbers() {
    let rows = Rows::shipped();
    let results = results(&fragment(), &rows).unwrap_or_else(|failed| panic!("{failed}"));
    assert_right("GLSL ES 3.00 in WebGL 2", &rows, &results);
}

#[test]
fn a_mistake_is_found() {
    let rows = Rows::shipped();
    let source = fragment();
    let wrong = source.replace("abr.y, 0.0, 1.0)", "-abr.y, 0.0, 1.0)");
    assert_ne!(source, wrong);
    assert!(!rows.off(&results(&wrong, &rows).unwrap()).is_empty());
    assert!(results("#version 300 es\nnothing", &rows).is_err());
}

fn fragment() -> String {
    format!("{}{}{}", include_str!("before.glsl"), shells::rows(Language::GlslEs300), include_str!("after.glsl"))
}

/// The outputs of all rows, drawn by a page; what it says where it fails.
fn results(fragment: &str, rows: &Rows) -> Result<Vec<f32>, String> {
    let heads = rows.heads.iter().enumerate().map(|(index, head)| {
        let inputs = &rows.inputs[head[1] as usize..][..rows.counts(index)[0]];
        let numbers: Vec<f32> = std::iter::once(head[0] as f32).chain(inputs.iter().copied()).collect();
        assert!(numbers.len() <= WIDTH, "a row of {} numbers", numbers.len());
        numbers
    });
    let tables: Vec<serde_json::Value> = rows
        .tables
        .iter()
        .map(|table| serde_json::json!({ "width": table.size[0], "height": table.size[1], "texels": table.texels }))
        .collect();
    let json = |value: serde_json::Value| value.to_string();
    let page = include_str!("page.html")
        .replace("FRAGMENT;", &format!("{};", json(fragment.into())))
        .replace("ROWS;", &format!("{};", json(heads.collect::<Vec<_>>().into())))
        .replace("TABLES;", &format!("{};", json(tables.into())));
    let folder = tempfile::tempdir().expect("there is a place for a folder");
    let path = folder.path().join("page.html");
    std::fs::write(&path, page).expect("the folder takes a file");
    let dom = dom(&path, folder.path());
    let said = dom.rsplit_once("<body>").map_or("", |(_, body)| body);
    let between = |start: &str| Some(said.split_once(start)?.1.split_once(" end")?.0.to_owned());
    let Some(pixels) = between("results: ") else {
        return Err(between("failed: ").unwrap_or_else(|| panic!("the page says nothing: {dom}")));
    };
    let pixels: Vec<f32> =
        pixels.split(' ').map(|bits| f32::from_bits(bits.parse().expect("the bits of a number"))).collect();
    let outputs = |row: usize| &pixels[row * WIDTH..][..rows.counts(row)[1]];
    Ok((0..rows.heads.len()).flat_map(|row| outputs(row).to_vec()).collect())
}

/// A page as it is when its scripts have run. The variable CHROMIUM names another browser of the kind.
fn dom(page: &Path, profile: &Path) -> String {
    let chromium = std::env::var("CHROMIUM").unwrap_or_else(|_| "chromium".to_owned());
    let output = Command::new(&chromium)
        .args(["--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--dump-dom"])
        .args(["--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"])
        .arg(format!("--user-data-dir={}", profile.display()))
        .arg(format!("file://{}", page.display()))
        .output()
        .unwrap_or_else(|error| panic!("{chromium}: {error}: `scripts/setup browser` sees to it"));
    String::from_utf8_lossy(&output.stdout).into_owned()
}
