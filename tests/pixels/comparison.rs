//! `velour compare`: pictures that are equal, pictures that must be told from equal, and what cannot be compared.

use std::process::Output;

use serde_json::{Value, json};
use velour::picture::{DisplayImage, LinearImage, ToneCurve};

use super::run::Bench;

const WIDTH: u32 = 60;
const HEIGHT: u32 = 40;

fn linear(radiance: impl Fn(u32, u32) -> [f32; 3]) -> LinearImage {
    let pixels = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
    LinearImage { width: WIDTH, height: HEIGHT, pixels: pixels.map(|(x, y)| radiance(x, y)).collect() }
}

/// A slope with texture, and a bright disk.
fn picture(x: u32, y: u32) -> [f32; 3] {
    let [x, y] = [x, y].map(|at| at as f32);
    let base = ((x - 30.0) / 12.0).exp2() * (0.5 + 0.25 * (y * 0.7).sin() * (x * 0.9).cos());
    let disk = if (x - 40.0).powi(2) + (y - 18.0).powi(2) < 64.0 { 2.0 } else { 0.0 };
    [base * 0.5 + disk, base * 0.3 + disk * 0.2, base * 0.15]
}

fn shown(image: &LinearImage) -> DisplayImage {
    image.display(0.0, ToneCurve::None)
}

/// Puts the picture as NAME.exr and NAME.png.
fn put(bench: &Bench, name: &str, image: &LinearImage) {
    bench.put(&format!("{name}.exr"), image.to_exr().unwrap());
    bench.put(&format!("{name}.png"), shown(image).to_png().unwrap());
}

fn figures(bench: &Bench, arguments: &str) -> Value {
    let said = bench.run(&format!("compare {arguments} --json"));
    assert_eq!((said.stdout.lines().count(), said.stderr.as_str()), (1, ""));
    serde_json::from_str(&said.stdout).unwrap()
}

fn near(found: &Value, expected: f64) -> bool {
    found.as_f64().is_some_and(|found| (found - expected).abs() <= 1e-5 * expected.abs())
}

#[test]
fn equal_pictures_are_equal() {
    let bench = Bench::new();
    put(&bench, "a", &linear(picture));
    put(&bench, "b", &linear(picture));
    for kind in ["exr", "png"] {
        let found = figures(&bench, &format!("a.{kind} b.{kind} --fail-above 0"));
        for figure in ["flip", "flip_greatest", "relative_mean_absolute_error", "mean_absolute_error", "mean_error"] {
            assert_eq!(found[figure].as_f64(), Some(0.0), "{figure}: {found}");
        }
        assert_eq!(found["largest_error"]["error"].as_f64(), Some(0.0));
        assert_eq!(found["size"], json!([WIDTH, HEIGHT]));
    }
    // A picture is equal to itself.
    let said = bench.run("compare a.exr a.exr --fail-above 0").stdout;
    assert!(said.contains("FLIP: 0.000000, greatest 0.000000 (HDR, "), "{said}");
    assert_eq!(bench.names(), ["a.exr", "a.png", "b.exr", "b.png", "scene.glb"]);
}

/// Each of these is told from equal: by figures above bounds that are about half of what is measured.
#[test]
fn pairs_that_must_fail() {
    let bench = Bench::new();
    put(&bench, "good", &linear(picture));
    let noise = |x: u32, y: u32| 1.0 + 0.1 * ((x * 7 + y * 131) as f32 * 1.7).sin();
    let triangle = |x: u32, y: u32| (10..20).contains(&y) && x >= 10 && x - 10 <= y - 10;
    let swap = |[red, green, blue]: [f32; 3]| [blue, green, red];
    let cases: [(&str, LinearImage, [f64; 2], f64); 6] = [
        ("shift", linear(|x, y| picture((x + WIDTH - 1) % WIDTH, y)), [0.1, 0.1], 0.05),
        ("blank", linear(|_, _| [0.0; 3]), [0.45, 0.4], 0.5),
        ("triangle", linear(|x, y| if triangle(x, y) { [0.0; 3] } else { picture(x, y) }), [0.02, 0.01], 0.002),
        ("bias", linear(|x, y| picture(x, y).map(|channel| channel * 1.01)), [0.01, 0.01], 0.002),
        ("noise", linear(|x, y| picture(x, y).map(|channel| channel * noise(x, y))), [0.01, 0.008], 0.01),
        ("swapped", linear(|x, y| swap(picture(x, y))), [0.35, 0.3], 0.18),
    ];
    for (name, image, flips, relative) in cases {
        put(&bench, name, &image);
        for (kind, flip) in ["exr", "png"].into_iter().zip(flips) {
            let pair = format!("{name}.{kind} good.{kind}");
            let found = figures(&bench, &pair);
            assert!(found["flip"].as_f64().unwrap() > flip, "{pair}: {found}");
            assert!(found["relative_mean_absolute_error"].as_f64().unwrap() > relative, "{pair}: {found}");
            for limit in [0.0, flip] {
                let output = bench.command(&format!("compare {pair} --fail-above {limit}")).output().unwrap();
                let [stdout, stderr] = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes));
                assert_eq!(output.status.code(), Some(1), "{pair}: {stdout}{stderr}");
                assert!(stdout.starts_with(&format!("{name}.{kind} against good.{kind}: 60x40")), "{stdout}");
                assert!(stderr.starts_with(&format!("velour: {name}.{kind}: FLIP 0.")), "{stderr}");
                assert!(stderr.contains(&format!(" is above {limit}: ")) && stderr.lines().count() == 1, "{stderr}");
            }
            bench.run(&format!("compare {pair} --fail-above {}", 1.000_001 * found["flip"].as_f64().unwrap()));
        }
    }
    // A bias of 1% is 1% and nothing else.
    let found = figures(&bench, "bias.exr good.exr");
    assert!(near(&found["relative_mean_absolute_error"], 0.01), "{found}");
    assert!(found["mean_error"] == found["mean_absolute_error"], "{found}");
}

/// Two pixels: the numbers by hand.
#[test]
fn figures_by_hand() {
    let bench = Bench::new();
    let tiny = |pixels: [[f32; 3]; 2]| LinearImage { width: 2, height: 1, pixels: pixels.to_vec() };
    bench.put("a.exr", tiny([[1.25, 2.5, 2.0], [0.0, 3.0, 2.25]]).to_exr().unwrap());
    bench.put("b.exr", tiny([[1.0, 2.0, 4.0], [0.0, 3.0, 2.0]]).to_exr().unwrap());
    let found = figures(&bench, "a.exr b.exr");
    assert_eq!(found["mean_absolute_error"], json!(0.5));
    assert_eq!(found["relative_mean_absolute_error"], json!(0.25));
    assert!(near(&found["mean_error"], -1.0 / 6.0), "{found}");
    let largest = json!({ "error": -2.0, "at": [0, 0], "channel": "blue", "a": 2.0, "b": 4.0 });
    assert_eq!(found["largest_error"], largest);
    assert_eq!((&found["values"], &found["heatmap"]), (&json!("linear"), &Value::Null));

    let bytes = |pixels: [[u8; 3]; 2]| DisplayImage { width: 2, height: 1, pixels: pixels.to_vec() }.to_png().unwrap();
    bench.put("black.png", bytes([[0; 3]; 2]));
    bench.put("white.png", bytes([[255; 3]; 2]));
    let found = figures(&bench, "black.png white.png");
    assert_eq!((&found["relative_mean_absolute_error"], &found["mean_error"]), (&json!(1.0), &json!(-1.0)));
    assert_eq!((&found["values"], &found["flip_exposures"]), (&json!("shown"), &Value::Null));
    // White against black by the formula, see the unit tests.
    assert!((found["flip"].as_f64().unwrap() - 0.96739).abs() < 1e-5, "{found}");
    // Against black nothing is relative.
    let found = figures(&bench, "white.png black.png");
    assert_eq!((&found["relative_mean_absolute_error"], &found["mean_error"]), (&Value::Null, &json!(1.0)));
    let said = bench.run("compare white.png black.png").stdout;
    assert!(said.contains("relative mean absolute error: none, the reference is black"), "{said}");
}

#[test]
fn the_heat_map_shows_where() {
    let bench = Bench::new();
    put(&bench, "good", &linear(picture));
    put(&bench, "bad", &linear(|x, y| if x < 20 && y < 20 { [0.0; 3] } else { picture(x, y) }));
    for kind in ["exr", "png"] {
        let pair = format!("bad.{kind} good.{kind}");
        bench.put("heat.png", "an older picture");
        let said = bench.run(&format!("compare {pair} --heatmap heat.png")).stdout;
        assert!(said.ends_with("heat map: heat.png\n"), "{said}");
        let heat = DisplayImage::from_png(&std::fs::read(bench.path("heat.png")).unwrap()).unwrap();
        assert_eq!([heat.width, heat.height], [WIDTH, HEIGHT]);
        let sum =
            |x: u32, y: u32| heat.pixels[(y * WIDTH + x) as usize].iter().map(|byte| u32::from(*byte)).sum::<u32>();
        // Twelve pixels away, where no filter reaches: magma's black is (0, 0, 4).
        for (x, y) in [(33, 5), (59, 0), (5, 33), (59, 39)] {
            assert!(sum(x, y) == 4, "{pair}: {x},{y}: {}", sum(x, y));
        }
        assert!(sum(8, 8) > 350, "{pair}: {}", sum(8, 8));
        assert_eq!(figures(&bench, &format!("{pair} --heatmap heat.png"))["heatmap"], "heat.png");
    }
    // It is written when the comparison fails, too: that is when it is wanted.
    std::fs::remove_file(bench.path("heat.png")).unwrap();
    let Output { status, .. } =
        bench.command("compare bad.exr good.exr --heatmap heat.png --fail-above 0").output().unwrap();
    assert_eq!(status.code(), Some(1));
    assert!(bench.path("heat.png").is_file());
}

/// An OpenEXR file without compression: `kind` 1 is half floats, 2 floats; all channels of all pixels hold `value`.
fn raw_exr([width, height]: [i32; 2], channels: &[&str], kind: i32, value: &[u8], rows: i32) -> Vec<u8> {
    let ints = |numbers: &[i32]| numbers.iter().flat_map(|number| number.to_le_bytes()).collect::<Vec<u8>>();
    let mut file = ints(&[20_000_630, 2]);
    let mut attribute = |name: &str, about: &str, bytes: &[u8]| {
        file.extend([name.as_bytes(), &[0], about.as_bytes(), &[0], &ints(&[bytes.len() as i32]), bytes].concat());
    };
    let entry = |name: &&str| [name.as_bytes(), &[0], &ints(&[kind, 0, 1, 1])].concat();
    let list: Vec<u8> = channels.iter().flat_map(entry).chain([0]).collect();
    let window = ints(&[0, 0, width - 1, height - 1]);
    attribute("channels", "chlist", &list);
    attribute("compression", "compression", &[0]);
    attribute("dataWindow", "box2i", &window);
    attribute("displayWindow", "box2i", &window);
    attribute("lineOrder", "lineOrder", &[0]);
    attribute("pixelAspectRatio", "float", &1.0_f32.to_le_bytes());
    attribute("screenWindowCenter", "v2f", &[0; 8]);
    attribute("screenWindowWidth", "float", &1.0_f32.to_le_bytes());
    file.push(0);
    let line = value.repeat(channels.len() * width.min(4096) as usize);
    let first = file.len() as u64 + 8 * rows as u64;
    (0..rows).for_each(|y| file.extend((first + y as u64 * (8 + line.len() as u64)).to_le_bytes()));
    (0..rows).for_each(|y| file.extend([ints(&[y, line.len() as i32]), line.clone()].concat()));
    file
}

#[test]
fn halves_are_radiance_too() {
    let bench = Bench::new();
    bench.put("half.exr", raw_exr([16, 12], &["B", "G", "R"], 1, &0x3800_u16.to_le_bytes(), 12));
    bench.put("alpha.exr", raw_exr([16, 12], &["A", "B", "G", "R"], 2, &0.5_f32.to_le_bytes(), 12));
    bench.put("float.exr", raw_exr([16, 12], &["B", "G", "R"], 2, &0.75_f32.to_le_bytes(), 12));
    assert_eq!(figures(&bench, "half.exr alpha.exr")["mean_absolute_error"], json!(0.0));
    assert_eq!(figures(&bench, "float.exr half.exr")["relative_mean_absolute_error"], json!(0.5));
}

/// A PNG's signature and head, which promises a picture of this size.
fn png_head(width: u32, height: u32) -> Vec<u8> {
    let head = [b"IHDR", &width.to_be_bytes()[..], &height.to_be_bytes(), &[16, 6, 0, 0, 0]].concat();
    let sum = crc32fast::hash(&head).to_be_bytes();
    let data = [b"IDAT", &crc32fast::hash(b"IDAT").to_be_bytes()[..]].concat();
    [b"\x89PNG\r\n\x1a\n", &13_u32.to_be_bytes()[..], &head, &sum, &[0; 4], &data].concat()
}

/// `good.exr` and `good.png`, and others that have something wrong.
fn put_bad_pictures(bench: &Bench) {
    put(bench, "good", &linear(picture));
    let (exr, png) = (std::fs::read(bench.path("good.exr")).unwrap(), std::fs::read(bench.path("good.png")).unwrap());
    let rgb = ["B", "G", "R"];
    let one = 1.0_f32.to_le_bytes();
    bench.put("small.exr", raw_exr([60, 39], &rgb, 2, &one, 39));
    bench.put("small.png", DisplayImage { width: 1, height: 1, pixels: vec![[0; 3]] }.to_png().unwrap());
    bench.put("nan.exr", raw_exr([60, 40], &rgb, 2, &f32::NAN.to_le_bytes(), 40));
    bench.put("infinite.exr", raw_exr([60, 40], &rgb, 1, &0x7c00_u16.to_le_bytes(), 40));
    bench.put("depth.exr", raw_exr([60, 40], &["Z"], 2, &one, 40));
    bench.put("wide.exr", raw_exr([100_000, 40], &rgb, 2, &one, 40));
    bench.put("huge.exr", raw_exr([16_000, 16_000], &rgb, 2, &one, 1));
    bench.put("vast.exr", raw_exr([i32::MAX, i32::MAX], &rgb, 2, &one, 1));
    bench.put("long.exr", raw_exr([60, 10_000], &rgb, 2, &one, 40));
    bench.put("wide.png", png_head(100_000, 1));
    bench.put("huge.png", png_head(16_384, 16_384));
    bench.put("vast.png", png_head(0x7fff_ffff, 0x7fff_ffff));
    bench.put("long.png", png_head(60, 10_000));
    bench.put("half.exr", &exr[..exr.len() / 2]);
    bench.put("half.png", &png[..png.len() / 2]);
    bench.put("head.exr", &exr[..40]);
    bench.put("head.png", &png[..20]);
    for kind in ["exr", "png"] {
        bench.put(&format!("empty.{kind}"), "");
        bench.put(&format!("text.{kind}"), "Velvet is a woven fabric.\n");
        std::fs::create_dir(bench.path(&format!("folder.{kind}"))).unwrap();
    }
    bench.put("exr.png", &exr);
    bench.put("png.exr", &png);
}

#[test]
fn pictures_that_cannot_be_compared() {
    let bench = Bench::new();
    put_bad_pictures(&bench);
    for (name, hint) in [
        ("small", "60x40"),
        ("nan.exr", "2400 pixels are infinite or not a number, the first at 0,0"),
        ("infinite.exr", "2400 pixels are infinite or not a number, the first at 0,0"),
        ("depth.exr", "has no layer of red, green and blue"),
        ("wide", "100000x"),
        ("huge", "too large"),
        ("vast", "vast"),
        ("long", "cannot be read"),
        ("half", "cannot be read"),
        ("head", "cannot be read"),
        ("empty", "cannot be read"),
        ("text", "cannot be read"),
        ("folder", "is no file"),
        ("gone", "cannot be opened"),
        ("exr.png", "cannot be read as PNG"),
        ("png.exr", "cannot be read as OpenEXR"),
    ] {
        let kinds = if let Some((_, kind)) = name.split_once('.') { vec![kind] } else { vec!["exr", "png"] };
        for kind in kinds {
            let file = format!("{}.{kind}", name.split('.').next().unwrap());
            for pair in [format!("{file} good.{kind}"), format!("good.{kind} {file}")] {
                let command = &mut bench.command(&format!("compare {pair} --heatmap heat.png --fail-above 1"));
                bench.refused(command, 2, hint);
                bench.refused(command, 2, &file);
            }
        }
    }
    for (pair, hint) in [
        ("good.exr good.png", "good.exr is linear radiance and good.png is as shown"),
        ("good.png good.exr", "good.exr is linear radiance and good.png is as shown"),
        ("scene.glb good.exr", "scene.glb: the extension"),
        ("good.png good", "good: the extension"),
    ] {
        bench.refused(&mut bench.command(&format!("compare {pair} --heatmap heat.png")), 2, hint);
    }
}

#[test]
fn flags_of_compare_out_of_range() {
    let bench = Bench::new();
    put(&bench, "a", &linear(picture));
    put(&bench, "b", &linear(picture));
    std::fs::create_dir(bench.path("folder.png")).unwrap();
    for (flags, hint) in [
        ("--fail-above -0.1", "--fail-above"),
        ("--fail-above nan", "--fail-above"),
        ("--fail-above inf", "--fail-above"),
        ("--fail-above most", "from 0 up"),
        ("--fail-above", "--fail-above"),
        ("--heatmap heat.exr", "a heat map is a .png"),
        ("--heatmap heat", "a heat map is a .png"),
        ("--heatmap missing/heat.png", "missing"),
        ("--heatmap folder.png", "folder"),
        ("--heatmap a.png", "a.png: is a picture to be compared"),
        ("--heatmap folder.png/../b.png", "b.png: is a picture to be compared"),
        ("--tonemap agx", "--tonemap"),
        ("c.png", "c.png"),
    ] {
        bench.refused(&mut bench.command(&format!("compare a.png b.png {flags}")), 2, hint);
    }
    bench.refused(&mut bench.command("compare a.png"), 2, "required");
    // A bad place for the heat map is reported before pictures are read.
    bench.refused(&mut bench.command("compare gone.png b.png --heatmap missing/heat.png"), 2, "missing");
}
