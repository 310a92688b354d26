//! What is off in a port's numbers, and which mistakes fit.

use super::answers::Answers;
use super::function::{DISTINCT, Row};
use super::mistake::Mistake;
use super::numbers::Golden;

/// A mistake fits a number that is within so many tolerances of what it gives,
const FITTING: f64 = 2.0;
/// or within this share of what it changes: samplers' weights have few digits.
const SHARE: f64 = 0.05;

/// A number that is off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Off {
    /// Of the row.
    pub id: u32,
    /// Index of the output.
    pub output: usize,
    /// What it should be,
    pub expected: f64,
    /// what the port gave,
    pub given: f64,
    /// and how far it may be off.
    pub tolerance: f64,
}

/// A mistake that fits.
#[derive(Clone, Debug, PartialEq)]
pub struct Cause {
    /// Which.
    pub mistake: Mistake,
    /// Ids of rows all of whose numbers are either right or what the mistake gives.
    pub rows: Vec<u32>,
}

/// A port's numbers against the golden ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement {
    /// Ids of the rows that it did not give.
    pub missing: Vec<u32>,
    /// Every number that is off or none at all, in order of the rows.
    pub off: Vec<Off>,
    /// Mistakes that fit, the one that fits the most rows first; each row counts for one.
    pub causes: Vec<Cause>,
    /// Ids of rows that are off and that no mistake fits.
    pub unexplained: Vec<u32>,
}

impl Judgement {
    /// Compares them number by number.
    pub fn of(answers: &Answers, golden: &Golden) -> Self {
        let missing = golden.rows.iter().map(|row| row.id).filter(|id| !answers.rows.contains_key(id)).collect();
        let given = golden.rows.iter().filter_map(|row| answers.rows.get(&row.id).map(|numbers| (row, numbers)));
        let judged: Vec<(&Row, Vec<Off>)> =
            given.map(|(row, numbers)| (row, off(row, numbers))).filter(|(_, off)| !off.is_empty()).collect();
        let (causes, unexplained) = causes(&judged);
        let off = judged.into_iter().flat_map(|(_, off)| off).collect();
        Self { missing, off, causes, unexplained }
    }

    /// Ids of the rows that are off.
    pub fn rows_off(&self) -> Vec<u32> {
        let mut ids: Vec<u32> = self.off.iter().map(|off| off.id).collect();
        ids.dedup();
        ids
    }
}

/// The numbers of a row that are off; NaN is.
fn off(row: &Row, numbers: &[f64]) -> Vec<Off> {
    let compared =
        row.tolerances.iter().enumerate().filter_map(|(k, tolerance)| tolerance.map(|tolerance| (k, tolerance)));
    compared
        .map(|(output, tolerance)| Off {
            id: row.id,
            output,
            expected: row.outputs[output],
            given: numbers[output],
            tolerance,
        })
        .filter(|off| !is_near(off.given, off.expected, off.tolerance))
        .collect()
}

/// False for NaN.
fn is_near(one: f64, other: f64, tolerance: f64) -> bool {
    (one - other).abs() <= tolerance
}

/// How well a mistake fits what is off in a row: the mean share of its changes that is left over; `None` where it does not,
/// or where nothing that is off is changed by it so much that it shows.
fn misfit(row: &Row, off: &[Off], mistake: Mistake) -> Option<f64> {
    let (_, numbers) = row.mistakes.iter().find(|(other, _)| *other == mistake)?;
    let (mut left, mut shows) = (0.0, false);
    for off in off {
        let change = (numbers[off.output] - off.expected).abs();
        if !is_near(off.given, numbers[off.output], f64::max(FITTING * off.tolerance, SHARE * change)) {
            return None;
        }
        left += (off.given - numbers[off.output]).abs() / change.max(off.tolerance);
        shows |= change > DISTINCT * off.tolerance;
    }
    shows.then_some(left / off.len() as f64)
}

/// The mistakes that fit, the best first, and the ids of rows that none fits.
fn causes(judged: &[(&Row, Vec<Off>)]) -> (Vec<Cause>, Vec<u32>) {
    let mut left: Vec<&(&Row, Vec<Off>)> = judged.iter().collect();
    let mut causes = Vec::new();
    loop {
        let fits = Mistake::ALL.map(|mistake| {
            let misfits: Vec<f64> = left.iter().filter_map(|(row, off)| misfit(row, off, mistake)).collect();
            (mistake, misfits.len(), misfits.iter().sum::<f64>())
        });
        // The most rows; of as many, what is left over least.
        let best = fits.into_iter().max_by(|one, other| one.1.cmp(&other.1).then(other.2.total_cmp(&one.2)));
        let Some((mistake, 1.., _)) = best else { break };
        let (fitting, rest): (Vec<_>, Vec<_>) =
            left.into_iter().partition(|(row, off)| misfit(row, off, mistake).is_some());
        causes.push(Cause { mistake, rows: fitting.iter().map(|(row, _)| row.id).collect() });
        left = rest;
    }
    (causes, left.iter().map(|(row, _)| row.id).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// What a port gives that makes `mistake` in the functions for which `is_made`, where it shows; rounded to `f32`.
    fn port(golden: &Golden, mistake: Option<Mistake>, is_made: impl Fn(usize) -> bool) -> Answers {
        let numbers = |row: &Row| {
            let wrong = row.mistakes.iter().find(|(other, _)| Some(*other) == mistake && is_made(row.function));
            wrong.map_or(&row.outputs, |(_, outputs)| outputs).iter().map(|output| f64::from(*output as f32)).collect()
        };
        Answers { rows: golden.rows.iter().map(|row| (row.id, numbers(row))).collect() }
    }

    /// The index of the whole.
    fn whole(golden: &Golden) -> usize {
        golden.functions.iter().position(|function| function.name == "lights_factors").unwrap()
    }

    #[test]
    fn a_right_port_passes() {
        let golden = Golden::new();
        let judgement = Judgement::of(&port(&golden, None, |_| true), &golden);
        assert_eq!(judgement, Judgement { missing: vec![], off: vec![], causes: vec![], unexplained: vec![] });
    }

    #[test]
    fn each_mistake_is_named_in_each_function_where_it_shows() {
        let golden = Golden::new();
        let mut pairs = 0;
        for mistake in Mistake::ALL {
            let shows = golden.rows.iter().filter(|row| row.mistakes.iter().any(|(other, _)| *other == mistake));
            let functions: BTreeSet<usize> = shows.map(|row| row.function).collect();
            assert!(!functions.is_empty(), "{mistake:?}");
            for function in functions {
                let judgement = Judgement::of(&port(&golden, Some(mistake), |other| other == function), &golden);
                let named: Vec<Mistake> = judgement.causes.iter().map(|cause| cause.mistake).collect();
                let name = golden.functions[function].name;
                assert_eq!((named, &judgement.unexplained), (vec![mistake], &vec![]), "in {name}");
                assert!(judgement.off.iter().all(|off| golden.row(off.id).unwrap().function == function));
                pairs += 1;
            }
        }
        assert!(pairs >= 20, "{pairs}");
    }

    #[test]
    fn in_the_whole_each_mistake_shows_in_a_dozen_rows_and_no_other_fits_them_all() {
        let golden = Golden::new();
        let whole = whole(&golden);
        for mistake in Mistake::ALL {
            let judged = Judgement::of(&port(&golden, Some(mistake), |function| function == whole), &golden);
            let ids = judged.rows_off();
            assert!(ids.len() >= 12, "{mistake:?} in {} rows", ids.len());
            for other in Mistake::ALL.into_iter().filter(|other| *other != mistake) {
                let fitting = ids.iter().filter(|id| {
                    let off: Vec<Off> = judged.off.iter().copied().filter(|off| off.id == **id).collect();
                    misfit(golden.row(**id).unwrap(), &off, other).is_some()
                });
                let count = fitting.count();
                // Where one-sided lights are dark by both, one cannot be told from the other.
                assert!(2 * count <= ids.len(), "{other:?} fits {count} of {} rows of {mistake:?}", ids.len());
            }
        }
    }

    #[test]
    fn two_mistakes_at_once_are_both_named() {
        let golden = Golden::new();
        let index = |name: &str| golden.functions.iter().position(|function| function.name == name).unwrap();
        let (frame, sheen) = (index("ltc_frame"), index("sheen_lobe"));
        let mut answers = port(&golden, Some(Mistake::FrameTransposed), |function| function == frame);
        let others = port(&golden, Some(Mistake::AlphaSquared), |function| function == sheen);
        answers.rows.extend(others.rows.into_iter().filter(|(id, _)| golden.row(*id).unwrap().function == sheen));
        let judgement = Judgement::of(&answers, &golden);
        let named: BTreeSet<Mistake> = judgement.causes.iter().map(|cause| cause.mistake).collect();
        assert_eq!(named, BTreeSet::from([Mistake::FrameTransposed, Mistake::AlphaSquared]));
        assert!(judgement.unexplained.is_empty(), "{:?}", judgement.unexplained);
    }

    #[test]
    fn a_half_of_the_whole_may_be_wrong() {
        // The specular base's table alone is transposed: the sheen's numbers are right.
        let golden = Golden::new();
        let whole = whole(&golden);
        let specular = golden.functions[whole].outputs.iter().position(|name| name == "specular").unwrap();
        let mut answers = port(&golden, None, |_| true);
        let wrong = port(&golden, Some(Mistake::TableTransposed), |function| function == whole);
        for (id, numbers) in &mut answers.rows {
            if golden.row(*id).unwrap().function == whole {
                numbers[specular] = wrong.rows[id][specular];
            }
        }
        let judgement = Judgement::of(&answers, &golden);
        assert_eq!(judgement.causes.first().map(|cause| cause.mistake), Some(Mistake::TableTransposed));
        assert_eq!((judgement.causes.len(), judgement.unexplained.len()), (1, 0));
    }

    #[test]
    fn what_is_slightly_off_is_off_and_no_mistake_fits() {
        let golden = Golden::new();
        for row in &golden.rows {
            for (output, tolerance) in row.tolerances.iter().enumerate() {
                let Some(tolerance) = tolerance else { continue };
                for (by, is_off) in [(0.5, false), (-0.5, false), (1.5, true), (-1.5, true), (f64::NAN, true)] {
                    let mut numbers = row.outputs.clone();
                    numbers[output] += by * tolerance;
                    let judgement = Judgement::of(&Answers { rows: [(row.id, numbers)].into() }, &golden);
                    let is_off = is_off && (*tolerance > 0.0 || by.is_nan());
                    assert_eq!(judgement.off.len(), usize::from(is_off), "{} by {by}", row.id);
                    assert_eq!(judgement.causes, [], "{} by {by}", row.id);
                    assert_eq!(judgement.missing.len(), golden.rows.len() - 1);
                }
            }
        }
    }

    #[test]
    fn what_is_wrong_in_another_way_is_not_explained() {
        let golden = Golden::new();
        let mut answers = port(&golden, None, |_| true);
        for numbers in answers.rows.values_mut() {
            numbers.iter_mut().for_each(|number| *number = 1.3 * *number + 0.1);
        }
        let judgement = Judgement::of(&answers, &golden);
        let explained = judgement.causes.iter().map(|cause| cause.rows.len()).sum::<usize>();
        assert!(explained * 20 < judgement.rows_off().len(), "{explained} of {}", judgement.rows_off().len());
        let nothing = Answers {
            rows: answers.rows.into_iter().map(|(id, numbers)| (id, vec![f64::NAN; numbers.len()])).collect(),
        };
        assert_eq!(Judgement::of(&nothing, &golden).causes, []);
    }
}
