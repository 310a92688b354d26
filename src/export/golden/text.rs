//! Golden numbers as files: .csv and .json, with the same numbers.

use super::function::{Function, Row};
use super::mistake::Mistake;
use super::numbers::Golden;
use serde::Serialize;
use std::collections::BTreeMap;

/// What stands at the head of both files.
const ABOUT: [&str; 14] = [
    "SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD",
    "SPDX-FileCopyrightText: 2026 The Velour authors",
    "Golden numbers: what every function of shaders/{ltc,ltc_sample,sheen,sheen_fit,ggx}.wgsl gives for some inputs, to check a port by.",
    "Inputs are exact 32-bit floats. Outputs are computed in 64 bits from the halves in tables/*.dds: form factors of the whole by a clipped \
     polygon, lookups by the library, angles and matrices by arctangents, inverses and determinants, independently of the shaders. Where a \
     definition is a formula (ltc_next's crossing, the closing angle, weights of layers, sheen_fit's polynomials) it is the shaders' own, in 64 bits.",
    "Numbers: structs are their fields in order of declaration, vectors x y z, matrices column by column, bools 0 or 1. Textures are left \
     out: they are the shipped tables.",
    "lights_factors is the whole: frame, lookups and one walk around a light of n corners (counter-clockwise as seen from the lit side), for \
     the cosine, the table's numbers and three form factors.",
    "An output is right where it is within its tolerance of the number here; one without a tolerance (- or null) is left open by the \
     definition, and not compared.",
    "Print what your port gives with 9 digits, as lines of id,number,number,... and run: velour golden FILE. It says what is off, and which \
     mistake fits.",
    "Mistakes: what comes out where one is made, of those that show in that row. They are:",
    "table_transposed, m_inv_transposed (b is looked for in a row), frame_transposed, frame_about_light (x towards the middle of the light's \
     corners),",
    "b_sign, alpha_squared (of the specular base: roughness squared), no_half_texel (a sampler's bilinear filter at u = alpha, v = mu, clamped \
     to the edge;",
    "of the specular base at u = roughness, v = t/2 and (1 + t)/2 in the texture of two parts), turn_forgotten (the turn stays as it began),",
    "winding_reversed. Only b is off by m_inv_transposed where functions read its entries; ltc_density multiplies by the transposed matrix.",
    "Made by: velour export golden -o tables",
];

/// Digits that outputs are given with: more than `f32` has, fewer than machines differ by.
const DIGITS: usize = 12;

#[derive(Serialize)]
struct FunctionText<'a> {
    name: &'a str,
    inputs: &'a [String],
    outputs: &'a [String],
    tolerance: &'a str,
}

#[derive(Serialize)]
struct RowText<'a> {
    id: u32,
    function: &'a str,
    case: &'a str,
    inputs: Vec<f32>,
    outputs: Vec<f64>,
    tolerances: Vec<Option<f64>>,
    mistakes: BTreeMap<&'a str, Vec<f64>>,
}

impl Golden {
    /// The .csv: `#` comments, column names, and for each row a line, followed by one for each of its mistakes.
    pub fn to_csv(&self) -> String {
        let mut lines: Vec<String> = ABOUT.iter().map(|line| format!("# {line}")).collect();
        lines.push("# Functions (in order; inputs -> outputs; why the tolerance is what it is):".to_owned());
        for (index, Function { name, inputs, outputs, tolerance }) in self.functions.iter().enumerate() {
            lines.push(format!("# {index} {name}: {} -> {}", inputs.join(" "), outputs.join(" ")));
            lines.push(format!("#   tolerance: {tolerance}"));
        }
        lines.push("id,function,case,mistake,inputs,outputs,tolerances".to_owned());
        for row in &self.rows {
            let (name, text) = (self.functions[row.function].name, self.text(row));
            let inputs = cell(text.inputs.iter().map(|input| format!("{input:?}")));
            let outputs = numbers(&text.outputs);
            let tolerances = cell(text.tolerances.iter().map(|tolerance| tolerance.map_or("-".to_owned(), figure)));
            lines.push(format!("{},{name},{},,{inputs},{outputs},{tolerances}", row.id, row.case));
            // In the order of the key, not of the alphabet.
            for (mistake, outputs) in &row.mistakes {
                let outputs = numbers(&rounded(outputs));
                lines.push(format!("{},{name},{},{},,{outputs},", row.id, row.case, mistake.name()));
            }
        }
        lines.join("\n") + "\n"
    }

    /// The .json: an object of `about`, `functions` and `rows`, one of these a line.
    pub fn to_json(&self) -> String {
        let functions: Vec<FunctionText> = self
            .functions
            .iter()
            .map(|Function { name, inputs, outputs, tolerance }| FunctionText { name, inputs, outputs, tolerance })
            .collect();
        let functions = functions.iter().map(line).collect::<Vec<_>>().join(",\n");
        let rows = self.rows.iter().map(|row| line(&self.text(row))).collect::<Vec<_>>().join(",\n");
        let about = ABOUT.iter().map(line).collect::<Vec<_>>().join(",\n");
        format!("{{\"about\": [\n{about}\n],\n\"functions\": [\n{functions}\n],\n\"rows\": [\n{rows}\n]}}\n")
    }

    fn text<'a>(&'a self, row: &'a Row) -> RowText<'a> {
        let named = |(mistake, outputs): &(Mistake, Vec<f64>)| (mistake.name(), rounded(outputs));
        RowText {
            id: row.id,
            function: self.functions[row.function].name,
            case: &row.case,
            inputs: row.inputs.iter().map(|input| *input as f32).collect(),
            outputs: rounded(&row.outputs),
            tolerances: row
                .tolerances
                .iter()
                .map(|tolerance| tolerance.map(|tolerance| to_digits(tolerance, 2)))
                .collect(),
            mistakes: row.mistakes.iter().map(named).collect(),
        }
    }
}

fn line(value: &impl Serialize) -> String {
    serde_json::to_string(value).expect("numbers and text are always written")
}

fn rounded(numbers: &[f64]) -> Vec<f64> {
    numbers.iter().map(|number| to_decimals(to_digits(*number, DIGITS))).collect()
}

/// Without what is too small: not all readers of JSON get digits past the 22nd right.
fn to_decimals(number: f64) -> f64 {
    format!("{number:.22}").parse::<f64>().expect("a number that was written is one") + 0.0
}

/// Rounded to so many digits; without a negative zero.
fn to_digits(number: f64, digits: usize) -> f64 {
    let text = format!("{number:.*e}", digits - 1);
    text.parse::<f64>().expect("a number that was written is one") + 0.0
}

fn numbers(numbers: &[f64]) -> String {
    cell(numbers.iter().copied().map(figure))
}

fn figure(number: f64) -> String {
    format!("{number:?}")
}

fn cell(words: impl Iterator<Item = String>) -> String {
    words.collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::Value;

    const CSV: &str = include_str!("../../../tables/golden.csv");
    const JSON: &str = include_str!("../../../tables/golden.json");

    /// Whether two lines are the same but for numbers, which may differ by 1e-9 of them (mathematical libraries differ), and for
    /// tolerances, which have two digits: the last may be rounded either way.
    fn same_line(one: &str, other: &str) -> bool {
        let near = |one: f64, other: f64| (one - other).abs() <= 1e-9 * one.abs().max(1e-3);
        let [one, other] = [one, other].map(around_tolerances);
        same_words(one[0], other[0], near)
            && same_words(one[1], other[1], |one, other| near(one, other) || is_last_digit(one, other))
            && same_words(one[2], other[2], near)
    }

    /// What stands before a row's tolerances, they, and what stands behind them.
    fn around_tolerances(line: &str) -> [&str; 3] {
        let json = line.split_once("\"tolerances\":[").and_then(|(before, rest)| Some((before, rest.split_once(']')?)));
        let is_row = line.starts_with(|letter: char| letter.is_ascii_digit()) && line.matches(',').count() == 6;
        match (json, line.rsplit_once(',')) {
            (Some((before, (tolerances, behind))), _) => [before, tolerances, behind],
            (None, Some((before, tolerances))) if is_row => [before, tolerances, ""],
            _ => [line, "", ""],
        }
    }

    fn same_words(one: &str, other: &str, near: impl Fn(f64, f64) -> bool) -> bool {
        let ends = |letter: char| letter.is_whitespace() || ",:[]{}".contains(letter);
        let [one, other] = [one, other].map(|text| text.split_inclusive(ends).collect::<Vec<_>>());
        one.len() == other.len() && one.iter().zip(&other).all(|(one, other)| same_word(one, other, &near))
    }

    fn same_word(one: &str, other: &str, near: impl Fn(f64, f64) -> bool) -> bool {
        let number = |word: &str| {
            let at = word.trim_end_matches(|letter: char| !letter.is_ascii_digit()).len();
            (word[..at].parse::<f64>().ok(), word[at..].to_owned())
        };
        let ((first, first_end), (second, second_end)) = (number(one), number(other));
        let is_near = first_end == second_end && first.zip(second).is_some_and(|(first, second)| near(first, second));
        one == other || is_near
    }

    fn is_last_digit(one: f64, other: f64) -> bool {
        [one, other].iter().all(|number| to_digits(*number, 2) == *number) && (one - other).abs() < 0.11 * one.abs()
    }

    #[test]
    fn the_files_are_what_export_makes() {
        let golden = Golden::new();
        for (name, file, made) in [("csv", CSV, golden.to_csv()), ("json", JSON, golden.to_json())] {
            let first = file.lines().zip(made.lines()).position(|(file, made)| !same_line(file, made));
            assert_eq!(first, None, "a line of tables/golden.{name} is old: velour export golden -o tables");
            assert_eq!(file.lines().count(), made.lines().count(), "golden.{name}");
        }
    }

    #[test]
    fn lines_are_the_same_but_for_rounding() {
        assert!(same_line("1,0.5 2.25,x", "1,0.5000000001 2.25,x"));
        for other in ["1,0.50000001 2.25,x", "1,0.5 2.25,y", "1,0.5 2.25", "1,-0.5 2.25,x", "1,0.5 2.25 3,x"] {
            assert!(!same_line("1,0.5 2.25,x", other), "{other}");
        }
        // The last digit of a tolerance, and of nothing else.
        let csv = |id: u32, output: f64, tolerance: f64| format!("{id},f,case,,1.0,{output} 0.5,{tolerance:?} -");
        let json = |id: u32, output: f64, tolerance: f64| {
            format!(r#"{{"id":{id},"outputs":[{output},0.5],"tolerances":[{tolerance:?},null],"mistakes":{{}}}}"#)
        };
        let kinds: [&dyn Fn(u32, f64, f64) -> String; 2] = [&csv, &json];
        for line in kinds {
            let made = line(100, 0.5, 5e-7);
            assert!(same_line(&made, &line(100, 0.5, 5.1e-7)), "{made}");
            for other in [line(110, 0.5, 5e-7), line(100, 0.55, 5e-7), line(100, 0.5, 6e-7)] {
                assert!(!same_line(&made, &other), "{other}");
            }
        }
    }

    #[test]
    fn both_files_hold_the_same_rows_and_read_back_exactly() {
        let golden = Golden::new();
        let json: Value = serde_json::from_str(JSON).unwrap();
        let mut lines =
            CSV.lines().filter(|line| !line.starts_with('#')).map(|line| line.split(',').collect::<Vec<_>>());
        assert_eq!(lines.next().unwrap().join(","), "id,function,case,mistake,inputs,outputs,tolerances");
        let rows = json["rows"].as_array().unwrap();
        assert_eq!(rows.len(), golden.rows.len());
        for (row, text) in golden.rows.iter().zip(rows) {
            let cells = lines.next().unwrap();
            let numbers = |cell: &str| -> Vec<Option<f64>> { cell.split(' ').map(|word| word.parse().ok()).collect() };
            let listed =
                |value: &Value| -> Vec<Option<f64>> { value.as_array().unwrap().iter().map(Value::as_f64).collect() };
            assert_eq!(
                [cells[0], cells[1], cells[2], cells[3]],
                [&*text["id"].to_string(), text["function"].as_str().unwrap(), text["case"].as_str().unwrap(), ""]
            );
            for (column, name) in [(4, "inputs"), (5, "outputs"), (6, "tolerances")] {
                assert_eq!(numbers(cells[column]), listed(&text[name]), "{} of {}", name, cells[0]);
            }
            // As f32 straight from the text, and by way of f64.
            let straight: Vec<f32> = cells[4].split(' ').map(|word| word.parse().unwrap()).collect();
            let inputs: Vec<f32> = listed(&text["inputs"]).into_iter().map(|input| input.unwrap() as f32).collect();
            assert_eq!(straight, inputs);
            assert_eq!(inputs.iter().map(|input| f64::from(*input)).collect::<Vec<_>>(), row.inputs, "{}", row.id);
            for (mistake, _) in &row.mistakes {
                let wrong = lines.next().unwrap();
                assert_eq!((wrong[0], wrong[3], wrong[4]), (cells[0], mistake.name(), ""));
                assert_eq!(numbers(wrong[5]), listed(&text["mistakes"][mistake.name()]));
            }
            assert_eq!(text["mistakes"].as_object().unwrap().len(), row.mistakes.len());
        }
        assert_eq!(lines.next(), None);
    }

    #[test]
    fn cases_have_no_character_that_a_csv_would_have_to_quote() {
        let golden = Golden::new();
        assert!(golden.rows.iter().all(|row| !row.case.contains([',', '"', '\n', '#']) && !row.case.is_empty()));
        let mut ids: Vec<u32> = golden.rows.iter().map(|row| row.id).collect();
        assert!(ids.is_sorted());
        ids.dedup();
        assert_eq!(ids.len(), golden.rows.len());
        for row in &golden.rows {
            let function = &golden.functions[row.function];
            assert_eq!((row.inputs.len(), row.outputs.len()), (function.inputs.len(), function.outputs.len()));
        }
        // Open by definition is rare.
        let open = golden.rows.iter().flat_map(|row| &row.tolerances).filter(|tolerance| tolerance.is_none()).count();
        assert!(open <= 40, "{open} numbers are not compared");
    }
}
