//! The golden numbers on the command line: making them, and judging a port by them.

use std::io::Write;
use std::process::Stdio;

use serde_json::Value;

use super::run::Bench;

/// What a right port prints, changed by `edit`: a row's function and its outputs.
fn port(edit: impl Fn(&str, &mut [f64])) -> String {
    let golden: Value = serde_json::from_str(include_str!("../../tables/golden.json")).unwrap();
    let line = |row: &Value| {
        let mut outputs: Vec<f64> = row["outputs"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
        edit(row["function"].as_str().unwrap(), &mut outputs);
        outputs.iter().fold(row["id"].to_string(), |line, output| line + "," + &(*output as f32).to_string())
    };
    golden["rows"].as_array().unwrap().iter().map(|row| line(row) + "\n").collect()
}

/// b has the wrong sign in the sheen's lobe, and one number is none at all.
fn wrong(function: &str, outputs: &mut [f64]) {
    match function {
        "sheen_lobe" => outputs[6] = -outputs[6],
        "ltc_begin" => outputs[0] = f64::NAN,
        _ => {}
    }
}

#[test]
fn export_writes_both_files() {
    let bench = Bench::new();
    assert_eq!(bench.run("export golden -o made").stdout.lines().count(), 2);
    for (name, kept) in [
        ("golden.csv", include_str!("../../tables/golden.csv")),
        ("golden.json", include_str!("../../tables/golden.json")),
    ] {
        let made = std::fs::read_to_string(bench.path("made").join(name)).unwrap();
        assert_eq!(made.lines().count(), kept.lines().count(), "{name}");
        assert_eq!(made.lines().next(), kept.lines().next(), "{name}");
    }
    bench.put("file", "");
    bench.refused(&mut bench.command("export golden -o file"), 2, "cannot be made");
}

#[test]
fn a_right_port_passes_and_a_wrong_one_is_told_why() {
    let bench = Bench::new();
    bench.put("right.csv", port(|_, _| {}));
    let rows = port(|_, _| {}).lines().count();
    let right = format!("{rows} of {rows} rows given, 0 off\nall that is given is right\n");
    assert_eq!(bench.run("golden right.csv").stdout, right);

    bench.put("wrong.csv", port(wrong));
    let output = bench.command("golden wrong.csv").output().unwrap();
    let (said, told) = (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    assert_eq!(output.status.code(), Some(1), "{said}");
    for part in [
        "sheen_lobe: 18 of 24 rows off",
        "b_sign (18 of 20 rows): b has the wrong sign: ",
        "not a number in 2 rows (300, 301)",
        "no mistake of the key fits 2 rows (300, 301); 'Nearly right' in docs/golden.md",
    ] {
        assert!(said.contains(part), "no '{part}' in {said}");
    }
    assert!(
        said.contains("m_inv[2].x is ") && said.contains(" and 14 rows more") && said.contains("NaN instead of"),
        "{said}"
    );
    assert!(said.lines().count() < 40, "{said}");
    assert_eq!(told, "velour: wrong.csv: 20 rows are off: see above\n");
}

/// A right port of which some functions are given, and one with a single number off that a mistake happens to give.
#[test]
fn functions_that_are_not_given_are_named_and_chance_is_no_cause() {
    let bench = Bench::new();
    let some: Vec<String> = port(|_, _| {}).lines().filter(|line| line.starts_with("24")).map(str::to_owned).collect();
    bench.put("some.csv", some.join("\n"));
    let said = bench.run("golden some.csv").stdout;
    assert!(
        said.contains("\nall that is given is right\nnot given: ") && said.contains(" rows of ltc_frame, "),
        "{said}"
    );
    assert!(!said.contains("rows of lights_factors"), "{said}");

    // Everything is doubled but one row, in which b alone has the wrong sign.
    let is_first = std::cell::Cell::new(true);
    let text = port(|function, outputs| match function {
        "sheen_lobe" if outputs[6] < -1e-2 && is_first.replace(false) => outputs[6] = -outputs[6],
        _ => outputs.iter_mut().for_each(|output| *output = 2.0 * *output + 0.5),
    });
    bench.put("doubled.csv", text);
    let output = bench.command("golden doubled.csv").output().unwrap();
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(said.contains("perhaps by chance") && !said.contains("keep the sign of the table"), "{said}");
}

#[test]
fn some_rows_are_judged_from_standard_input_and_for_machines() {
    let bench = Bench::new();
    let mut command = bench.command("golden - --json");
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let some: Vec<String> = port(wrong).lines().filter(|line| line.starts_with("18")).map(str::to_owned).collect();
    child.stdin.take().unwrap().write_all(some.join("\n").as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    let said: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(said["given"], 24);
    assert_eq!(said["missing"].as_array().unwrap().len() as u64, said["rows"].as_u64().unwrap() - 24);
    assert_eq!(said["causes"][0]["mistake"], "b_sign");
    let off = &said["off"][0];
    assert_eq!((&off["function"], &off["numbers"][0]["name"]), (&"sheen_lobe".into(), &"m_inv[2].x".into()));
    assert_eq!(off["numbers"][0]["index"], 6);
}

#[test]
fn what_cannot_be_judged_is_refused_in_one_line() {
    let bench = Bench::new();
    for (text, hint) in [
        ("", "port: no row of numbers"),
        ("200,1\n77,1\n", "port: line 2: \"77\" is no row's id"),
        ("200,1,1\n", "port: line 1: row 200 has 2 numbers where ltc_side gives 1: side"),
        ("200,one\n", "port: line 1: \"one\" is no number"),
        ("{\"200\": [1]", "port: line 1: EOF"),
        ("id,outputs\n200,1\n200,1\n", "port: line 3: row 200 is given a second time"),
    ] {
        bench.put("port", text);
        bench.refused(&mut bench.command("golden port"), 2, hint);
    }
    bench.put("port", [0xff, 0xfe, 0x00]);
    bench.refused(&mut bench.command("golden port"), 2, "port: is UTF-16 text; save it as UTF-8");
    bench.put("port", [0xff, 0x00]);
    bench.refused(&mut bench.command("golden port"), 2, "byte 0 is not UTF-8");
    for golden in [include_str!("../../tables/golden.csv"), include_str!("../../tables/golden.json")] {
        bench.put("port", golden);
        bench.refused(&mut bench.command("golden port"), 2, "port: is the file of inputs; give what your port prints");
    }
    bench.refused(&mut bench.command("golden gone.csv"), 2, "gone.csv: cannot be read");
    bench.refused(&mut bench.command("golden ."), 2, "cannot be read");
    bench.refused(&mut bench.command("golden"), 2, "required");
}
