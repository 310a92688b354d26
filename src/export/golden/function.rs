//! A function of the shaders with its definition in `f64`, and rows of numbers made from it.

use super::flat::Flat;
use super::mistake::Mistake;

/// By how many tolerances a mistake's numbers have to be off to be listed.
pub(super) const DISTINCT: f64 = 4.0;
/// Rows that a function may have: ids go by the hundred.
const ROWS: usize = 100;

/// A function as files describe it.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    /// Its name in WGSL.
    pub name: &'static str,
    /// Names of the numbers that it takes.
    pub inputs: Vec<String>,
    /// Names of those that it gives.
    pub outputs: Vec<String>,
    /// Why its tolerances are what they are.
    pub tolerance: &'static str,
}

/// One call of a function.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// 100 (f + 1) + k for row k of function f.
    pub id: u32,
    /// The index of its function.
    pub function: usize,
    /// What is special about it.
    pub case: String,
    /// Exact in `f32`.
    pub inputs: Vec<f64>,
    /// By the definition, from these inputs.
    pub outputs: Vec<f64>,
    /// How far each output may be off; `None` where the definition leaves it open.
    pub tolerances: Vec<Option<f64>>,
    /// What comes out where a mistake is made, of those that show here.
    pub mistakes: Vec<(Mistake, Vec<f64>)>,
}

/// A function by its definition.
pub(super) struct Definition<I, O> {
    pub name: &'static str,
    /// The name of what it gives; empty for a struct.
    pub output: &'static str,
    pub answer: fn(&I) -> O,
    /// How far each number of the answer may be off; infinity where it is not defined.
    pub tolerance: fn(&I, &O) -> O,
    pub reason: &'static str,
    /// The answer with a mistake, where that can be made here.
    pub mistaken: fn(&I, Mistake) -> Option<O>,
}

/// No mistake of the key can be made in this function.
pub(super) fn none<I, O>(_: &I, _: Mistake) -> Option<O> {
    None
}

impl<I: Flat, O: Flat> Definition<I, O> {
    /// The function, of index `index`, and a row for each of the inputs, rounded to `f32`.
    pub fn rows<'a>(&self, index: usize, cases: impl IntoIterator<Item = (&'a str, I)>) -> (Function, Vec<Row>) {
        let cases: Vec<(&str, I)> = cases.into_iter().map(|(case, input)| (case, input.rounded())).collect();
        assert!((1..=ROWS).contains(&cases.len()), "{} rows of {}", cases.len(), self.name);
        let (_, first) = &cases[0];
        let inputs = first.names("");
        let outputs = (self.answer)(first).names(self.output);
        let function = Function { name: self.name, inputs, outputs, tolerance: self.reason };
        let first_id = 100 * (index as u32 + 1);
        let row = |(k, (case, input)): (u32, (&str, I))| self.row(index, first_id + k, case, &input);
        (function, (0..).zip(cases).map(row).collect())
    }

    fn row(&self, function: usize, id: u32, case: &str, input: &I) -> Row {
        let answer = (self.answer)(input);
        let outputs = answer.flat();
        assert!(outputs.iter().all(|output| output.is_finite()), "{}, {case}: {outputs:?}", self.name);
        let tolerances = (self.tolerance)(input, &answer).flat();
        let shows = |numbers: &[f64]| {
            let mut off = numbers.iter().zip(&outputs).zip(&tolerances);
            off.any(|((number, output), tolerance)| (number - output).abs() > DISTINCT * tolerance)
        };
        let mistaken = |mistake| (self.mistaken)(input, mistake).map(|answer| (mistake, answer.flat()));
        let mistakes = Mistake::ALL.into_iter().filter_map(mistaken).filter(|(_, numbers)| shows(numbers)).collect();
        let tolerances = tolerances.iter().map(|tolerance| tolerance.is_finite().then_some(*tolerance)).collect();
        Row { id, function, case: case.to_owned(), inputs: input.flat(), outputs, tolerances, mistakes }
    }
}
