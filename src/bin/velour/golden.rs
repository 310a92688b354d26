//! `velour golden`: which numbers of a port are off, and which mistake fits them.

use std::io::{self, Read};
use std::path::PathBuf;

use clap::Args;
use serde_json::{Value, json};
use velour::export::golden::{Answers, Golden, Judgement, Off};

use crate::console::say;
use crate::failure::Failure;

/// Longest file that is read, in bytes: far more than all rows with all their digits.
const MAX_BYTES: u64 = 64 << 20;
/// Rows of a function, and numbers of a row, that are shown.
const SHOWN: usize = 4;
/// What fits less than one of so many rows that are off is no cause.
const RARE: usize = 10;
/// Ids that are shown where they are many.
const IDS: usize = 12;

/// The flags of `velour golden`.
#[derive(Args)]
pub struct GoldenCheck {
    /// What the port gives for the inputs in golden.csv: lines of id,number,number,... or JSON, {"id": [numbers]} or [{"id": ...,
    /// "outputs": [numbers]}]; - reads standard input
    pub file: PathBuf,
    /// Prints figures for machines on stdout
    #[arg(long)]
    pub json: bool,
}

pub fn run(arguments: &GoldenCheck) -> Result<(), Failure> {
    let golden = Golden::new();
    let place =
        if arguments.file.as_os_str() == "-" { "standard input".into() } else { arguments.file.to_string_lossy() };
    let text = text(arguments).map_err(|problem| Failure::input(format!("{place}: {problem}")))?;
    let answers = Answers::read(&text, &golden).map_err(|error| Failure::input(format!("{place}: {error}")))?;
    let judgement = Judgement::of(&answers, &golden);
    if arguments.json {
        say(figures(&judgement, &golden, answers.rows.len()));
    } else {
        report(&judgement, &golden, answers.rows.len());
    }
    match judgement.rows_off().len() {
        0 => Ok(()),
        count => Err(Failure::check(format!("{place}: {} off: see above", counted(count, "row is", "rows are")))),
    }
}

/// The file's text, of bounded length.
fn text(arguments: &GoldenCheck) -> Result<String, String> {
    let unreadable = |error: io::Error| format!("cannot be read ({error}); give the file of a port's numbers");
    let mut bytes = Vec::new();
    if arguments.file.as_os_str() == "-" {
        io::stdin().take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    } else {
        let file = std::fs::File::open(&arguments.file).map_err(unreadable)?;
        file.take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    }
    if bytes.len() as u64 > MAX_BYTES {
        return Err(format!("is longer than {MAX_BYTES} bytes; give each row's id and outputs"));
    }
    String::from_utf8(bytes).map_err(|error| {
        if matches!(error.as_bytes(), [0xff, 0xfe, ..] | [0xfe, 0xff, ..]) {
            return "is UTF-16 text; save it as UTF-8".to_owned();
        }
        let at = error.utf8_error().valid_up_to();
        format!("byte {at} is not UTF-8 text; give lines of id,number,number,... or JSON")
    })
}

fn report(judgement: &Judgement, golden: &Golden, given: usize) {
    let ids = judgement.rows_off();
    say(format!("{given} of {} rows given, {} off", golden.rows.len(), ids.len()));
    for (index, function) in golden.functions.iter().enumerate() {
        let of_function = |id: &&u32| golden.row(**id).is_some_and(|row| row.function == index);
        let off: Vec<u32> = ids.iter().filter(of_function).copied().collect();
        if off.is_empty() {
            continue;
        }
        let count =
            golden.rows.iter().filter(|row| row.function == index && !judgement.missing.contains(&row.id)).count();
        say(format!("{}: {} of {} off", function.name, off.len(), counted(count, "row", "rows")));
        for id in off.iter().take(SHOWN) {
            let numbers: Vec<&Off> = judgement.off.iter().filter(|off| off.id == *id).collect();
            report_row(&numbers, golden);
        }
        say_rest(off.len(), SHOWN, "row", "rows");
    }
    report_causes(judgement, ids.len());
    if ids.is_empty() {
        say("all that is given is right");
    }
    if !judgement.missing.is_empty() {
        say(format!("not given: {}", missing(judgement, golden)));
    }
}

/// The mistakes that fit. One that fits a few rows of many may do so by chance: it is named without advice.
fn report_causes(judgement: &Judgement, off: usize) {
    let is_chance = |count: usize| RARE * count < off;
    for cause in &judgement.causes {
        let count = cause.rows.len();
        let share = format!("{count} of {}", counted(off, "row", "rows"));
        let name = cause.mistake.name();
        if is_chance(count) {
            say(format!("{name} fits {share}, perhaps by chance: {}", listed(&cause.rows)));
        } else {
            say(format!("{name} ({share}): {}", cause.mistake.advice()));
        }
    }
    let mut none: Vec<u32> = judgement.off.iter().filter(|off| off.given.is_nan()).map(|off| off.id).collect();
    none.dedup();
    if !none.is_empty() {
        say(format!("not a number in {}", listed(&none)));
    }
    if !judgement.unexplained.is_empty() {
        let rows = listed(&judgement.unexplained);
        say(format!(
            "no mistake of the key fits {rows}; 'Nearly right' in docs/golden.md has what small differences come from"
        ));
    }
}

/// Functions and how many of their rows were not given.
fn missing(judgement: &Judgement, golden: &Golden) -> String {
    let rows: Vec<usize> = judgement.missing.iter().filter_map(|id| golden.row(*id)).map(|row| row.function).collect();
    let named = golden.functions.iter().enumerate().filter_map(|(index, function)| {
        let count = rows.iter().filter(|row| **row == index).count();
        (count > 0).then(|| format!("{} of {}", counted(count, "row", "rows"), function.name))
    });
    named.collect::<Vec<_>>().join(", ")
}

/// The numbers that are off in one row.
fn report_row(numbers: &[&Off], golden: &Golden) {
    let Some(row) = numbers.first().and_then(|first| golden.row(first.id)) else { return };
    say(format!("  {} {}", row.id, row.case));
    for off in numbers.iter().take(SHOWN) {
        let name = &golden.functions[row.function].outputs[off.output];
        let Off { expected, given, tolerance, .. } = off;
        say(format!(
            "    {name} is {} instead of {}, which may be off by {tolerance:.1e}",
            figure(*given),
            figure(*expected)
        ));
    }
    if numbers.len() > SHOWN {
        say(format!("    and {} more", counted(numbers.len() - SHOWN, "number", "numbers")));
    }
}

fn say_rest(count: usize, shown: usize, one: &str, many: &str) {
    if count > shown {
        say(format!("  and {} more", counted(count - shown, one, many)));
    }
}

/// With nine digits, with which an `f32` is told from others.
fn figure(value: f64) -> String {
    let text = format!("{value:.8e}");
    let Ok(rounded) = text.parse::<f64>() else { return text };
    format!("{rounded:?}")
}

fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

/// Rows by their ids.
fn listed(ids: &[u32]) -> String {
    let first = ids.iter().take(IDS).map(u32::to_string).collect::<Vec<_>>().join(", ");
    let rest = if ids.len() > IDS { format!(" and {} more", ids.len() - IDS) } else { String::new() };
    format!("{} ({first}{rest})", counted(ids.len(), "row", "rows"))
}

fn figures(judgement: &Judgement, golden: &Golden, given: usize) -> Value {
    // JSON has no NaN: null.
    let rows = judgement.rows_off().into_iter().filter_map(|id| golden.row(id)).map(|row| {
        let function = &golden.functions[row.function];
        let numbers = judgement.off.iter().filter(|off| off.id == row.id).map(|off| {
            json!({
                "name": function.outputs[off.output],
                "index": off.output,
                "expected": off.expected,
                "given": off.given,
                "tolerance": off.tolerance,
            })
        });
        json!({ "id": row.id, "function": function.name, "case": row.case, "numbers": numbers.collect::<Vec<_>>() })
    });
    let causes = judgement
        .causes
        .iter()
        .map(|cause| json!({ "mistake": cause.mistake.name(), "advice": cause.mistake.advice(), "rows": cause.rows }));
    json!({
        "rows": golden.rows.len(),
        "given": given,
        "missing": judgement.missing,
        "off": rows.collect::<Vec<_>>(),
        "causes": causes.collect::<Vec<_>>(),
        "unexplained": judgement.unexplained,
    })
}
