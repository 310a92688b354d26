//! The golden numbers as a shell takes them, and what it gives held against them.

use std::path::Path;

use serde_json::Value;
use velour::table::{GgxTable, SheenTable};

/// Inputs of all rows, one after the other, and where each row's begin.
pub struct Rows {
    pub inputs: Vec<f32>,
    /// Function, first input, first output, and nothing.
    pub heads: Vec<[u32; 4]>,
    /// How many there are of all rows together.
    pub outputs: usize,
    /// The sheen's and the specular base's.
    pub tables: [Table; 2],
    rows: Vec<Row>,
}

/// A table as a texture.
pub struct Table {
    pub size: [u32; 2],
    pub texels: Vec<f32>,
}

struct Row {
    what: String,
    expected: Vec<f64>,
    /// None for what is not compared.
    tolerances: Vec<Option<f64>>,
}

impl Rows {
    /// Those that are shipped.
    pub fn shipped() -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tables");
        let text = std::fs::read_to_string(root.join("golden.json")).expect("the golden numbers are shipped");
        let golden: Value = serde_json::from_str(&text).expect("they are JSON");
        let list = |value: &Value| value.as_array().expect("a list").clone();
        let names: Vec<Value> =
            list(&golden["functions"]).into_iter().map(|function| function["name"].clone()).collect();
        let mut rows =
            Self { inputs: Vec::new(), heads: Vec::new(), outputs: 0, tables: tables(&root), rows: Vec::new() };
        for row in list(&golden["rows"]) {
            let function = names.iter().position(|name| *name == row["function"]).expect("it is in the list");
            rows.heads.push([function as u32, rows.inputs.len() as u32, rows.outputs as u32, 0]);
            rows.inputs.extend(list(&row["inputs"]).iter().map(|number| number.as_f64().expect("a number") as f32));
            let expected: Vec<f64> =
                list(&row["outputs"]).iter().map(|number| number.as_f64().expect("a number")).collect();
            rows.outputs += expected.len();
            let tolerances = list(&row["tolerances"]).iter().map(Value::as_f64).collect();
            let what = format!("{} {}, {}", row["id"], row["function"], row["case"]);
            rows.rows.push(Row { what, expected, tolerances });
        }
        rows
    }

    /// How many numbers a row takes and gives.
    pub fn counts(&self, row: usize) -> [usize; 2] {
        let end = self.heads.get(row + 1).map_or(self.inputs.len(), |head| head[1] as usize);
        [end - self.heads[row][1] as usize, self.rows[row].expected.len()]
    }

    /// What is off, a line for each number. (No number is, if it isn't one.)
    pub fn off(&self, results: &[f32]) -> Vec<String> {
        assert_eq!(results.len(), self.outputs, "as many results as outputs");
        let mut off = Vec::new();
        for (row, head) in self.rows.iter().zip(&self.heads) {
            let results = &results[head[2] as usize..];
            for (index, (expected, tolerance)) in row.expected.iter().zip(&row.tolerances).enumerate() {
                let found = f64::from(results[index]);
                let is_right = tolerance.is_none_or(|tolerance| (found - expected).abs() <= tolerance);
                if !is_right {
                    off.push(format!("{}: output {index} is {found}, not {expected} ({tolerance:?})", row.what));
                }
            }
        }
        off
    }

    /// Differences as shares of the tolerances, the greatest and the mean; and those of the whole's form factors themselves.
    fn figures(&self, results: &[f32]) -> [f64; 4] {
        let (mut shares, mut factors) = (Vec::new(), Vec::new());
        for (row, head) in self.rows.iter().zip(&self.heads) {
            for (index, (expected, tolerance)) in row.expected.iter().zip(&row.tolerances).enumerate() {
                let Some(tolerance) = tolerance.filter(|tolerance| *tolerance > 0.0) else { continue };
                let apart = (f64::from(results[head[2] as usize + index]) - expected).abs();
                shares.push(apart / tolerance);
                // mu, a, b and r come before them.
                if row.what.contains("lights_factors") && index >= 4 {
                    factors.push(apart);
                }
            }
        }
        let greatest = |numbers: &[f64]| numbers.iter().copied().fold(0.0, f64::max);
        let mean = |numbers: &[f64]| numbers.iter().sum::<f64>() / numbers.len() as f64;
        [greatest(&shares), mean(&shares), greatest(&factors), mean(&factors)]
    }
}

/// As they are in the .dds: rounded to halves.
fn tables(root: &Path) -> [Table; 2] {
    let flat = |texels: Vec<[f32; 4]>, [width, height]: [usize; 2], parts: usize| Table {
        size: [width as u32, (height * parts) as u32],
        texels: texels.into_iter().flatten().collect(),
    };
    let sheen = SheenTable::load(root.join("sheen_ltc.dds")).expect("it is shipped");
    let ggx = GgxTable::load(root.join("ggx_ltc.dds")).expect("it is shipped");
    [flat(sheen.texels(), sheen.size(), 1), flat(ggx.texels(), ggx.size(), 2)]
}

/// Fails with the first of the numbers that are off.
pub fn assert_right(language: &str, rows: &Rows, results: &[f32]) {
    let off = rows.off(results);
    let shown = off.iter().take(20).cloned().collect::<Vec<_>>().join("\n");
    assert!(off.is_empty(), "{language}: {} numbers are off\n{shown}", off.len());
    let [greatest, mean, factor, mean_factor] = rows.figures(results);
    println!(
        "{language}: {} numbers, off by {greatest:.2} of a tolerance at most, {mean:.3} on average; form factors by {factor:.1e} and {mean_factor:.1e}",
        results.len()
    );
}
