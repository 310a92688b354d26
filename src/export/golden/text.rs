//! Golden numbers as files: .csv and .json, with the same numbers.

use super::Golden;
use super::function::{Function, Row};
use super::mistake::Mistake;
use serde::Serialize;
use std::collections::BTreeMap;

/// What stands at the head of both files.
const ABOUT: [&str; 14] = [
    "SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD",
    "SPDX-FileCopyrightText: 2026 The Velour authors",
    "Golden numbers: what every function of shaders/{ltc,ltc_sample,sheen,ggx}.wgsl gives for some inputs, to check a port by.",
    "Inputs are exact 32-bit floats. Outputs are computed in 64 bits from the halves in tables/*.dds, by definitions that share no step with \
     the shaders.",
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
    numbers.iter().map(|number| to_digits(*number, DIGITS)).collect()
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
