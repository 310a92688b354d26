//! A port's numbers, as it prints them.

use super::numbers::Golden;
use serde::Deserialize;
use serde::de::{MapAccess, SeqAccess, Visitor};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::fmt;

/// Longest word of a file that a message shows.
const EXCERPT: usize = 24;

/// Why a port's numbers were not read: what is wrong, where, and what to do, in one line.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}{problem}", .line.map_or(String::new(), |line| format!("line {line}: ")))]
pub struct AnswersError {
    /// Counted from 1, where a line is to blame.
    pub line: Option<usize>,
    /// What is wrong, and what belongs there.
    pub problem: String,
}

/// What a port gave, by the ids of rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Answers {
    /// As many numbers as the row has outputs.
    pub rows: BTreeMap<u32, Vec<f64>>,
}

impl Answers {
    /// Reads lines of `id,number,number,...` (also apart by spaces, with `#` comments and a line of names at the top), or JSON: an object
    /// `{"id": [...]}` or an array of `{"id": ..., "outputs": [...]}`.
    ///
    /// Whatever languages print for a number that is none, `null` in JSON too, is read as NaN. Fails on an id that is not golden's or is
    /// given twice, on a count of numbers that is not the row's, on what is no number, and where there is no row.
    pub fn read(text: &str, golden: &Golden) -> Result<Self, AnswersError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        if is_golden(text) {
            let problem =
                "is the file of inputs; give what your port prints for them: id,number,number,... for each row"
                    .to_owned();
            return Err(AnswersError { line: None, problem });
        }
        let mut answers = Self::default();
        if text.trim_start().starts_with(['{', '[']) {
            for (id, numbers) in json(text)? {
                answers.add(golden, &id, numbers).map_err(|problem| AnswersError { line: None, problem })?;
            }
        } else {
            answers.read_lines(text, golden)?;
        }
        if answers.rows.is_empty() {
            let problem = "no row of numbers; give lines of id,number,number,... for the rows of golden.csv".to_owned();
            return Err(AnswersError { line: None, problem });
        }
        Ok(answers)
    }

    fn read_lines(&mut self, text: &str, golden: &Golden) -> Result<(), AnswersError> {
        let mut is_first = true;
        for (index, line) in text.lines().enumerate() {
            let is_between = |letter: char| letter == ',' || letter == ';' || letter.is_whitespace();
            // Within a line '#' may belong to a number: 1.#IND.
            let content = if line.trim_start().starts_with('#') { "" } else { line };
            let mut words = content.split(is_between).filter(|word| !word.is_empty());
            let Some(id) = words.next() else { continue };
            let is_header = std::mem::take(&mut is_first) && id.trim_matches('"').eq_ignore_ascii_case("id");
            if !is_header {
                let numbers = words.map(number).collect::<Result<_, _>>();
                let added = check_fields(content).and(numbers).and_then(|numbers| self.add(golden, id, numbers));
                added.map_err(|problem| AnswersError { line: Some(index + 1), problem })?;
            }
        }
        Ok(())
    }

    fn add(&mut self, golden: &Golden, id: &str, numbers: Vec<f64>) -> Result<(), String> {
        let Some(row) = whole(id).and_then(|id| golden.row(id)) else {
            return Err(format!(
                "{:?} is no row's id; ids are those of golden.csv, say {}",
                excerpt(id),
                golden.rows[0].id
            ));
        };
        let (expected, function) = (row.outputs.len(), &golden.functions[row.function]);
        if numbers.len() != expected {
            let found = numbers.len();
            let names = function.outputs.join(" ");
            return Err(format!("row {id} has {found} numbers where {} gives {expected}: {names}", function.name));
        }
        match self.rows.entry(row.id) {
            Entry::Vacant(entry) => entry.insert(numbers),
            Entry::Occupied(_) => return Err(format!("row {id} is given a second time; give each once")),
        };
        Ok(())
    }
}

/// Whether it is golden.csv or golden.json itself: their columns and lists have these names.
fn is_golden(text: &str) -> bool {
    let is_header = |line: &str| line.starts_with("id,function,case,mistake,inputs");
    text.lines().take(400).any(is_header) || (text.trim_start().starts_with('{') && text.contains("\"functions\""))
}

/// Nothing between two commas is a number that is missing.
fn check_fields(line: &str) -> Result<(), String> {
    let fields: Vec<&str> = line.trim_end().trim_end_matches([',', ';']).split([',', ';']).collect();
    match fields.iter().position(|field| field.trim().is_empty()) {
        Some(empty) => Err(format!("field {} is empty; give a number, or nan", empty + 1)),
        None => Ok(()),
    }
}

/// An id, as languages print whole numbers: 2400, 2400.0, 2.4e+03.
fn whole(word: &str) -> Option<u32> {
    let number: f64 = word.trim_matches('"').parse().ok()?;
    (number.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&number)).then_some(number as u32)
}

/// A number in whatever way C, C# or JavaScript print those that are none.
fn number(word: &str) -> Result<f64, String> {
    let lower = word.to_ascii_lowercase();
    let bare = lower.strip_prefix(['+', '-']).unwrap_or(&lower);
    // Microsoft's older libraries fill up with digits: 1.#IND00, 1.#QNAN0e+000.
    match bare.trim_end_matches(['0', 'e', '+']) {
        "1.#qnan" | "1.#snan" | "1.#ind" => return Ok(f64::NAN),
        "1.#inf" => return Ok(f64::INFINITY),
        _ if bare == "nan" || (bare.starts_with("nan(") && bare.ends_with(')')) => return Ok(f64::NAN),
        _ => {}
    }
    word.parse().map_err(|_| format!("{:?} is no number; give the row's id and then its outputs", excerpt(word)))
}

/// The beginning of a word, short enough for a message.
fn excerpt(word: &str) -> String {
    word.chars().take(EXCERPT).collect()
}

/// The ids and numbers of both kinds of JSON.
fn json(text: &str) -> Result<Vec<(String, Vec<f64>)>, AnswersError> {
    // Python writes these, though JSON has no such words.
    let text = text.replace("-Infinity", "null").replace("Infinity", "null").replace("NaN", "null");
    let entries: Entries = serde_json::from_str(&text).map_err(|error| {
        let message = error.to_string();
        let problem = message.split(" at line ").next().unwrap_or_default();
        AnswersError {
            line: Some(error.line()),
            problem: format!("{problem}; give {{\"id\": [numbers]}} or [{{\"id\": ..., \"outputs\": [numbers]}}]"),
        }
    })?;
    let nan = |numbers: Vec<Option<f64>>| numbers.into_iter().map(|number| number.unwrap_or(f64::NAN)).collect();
    Ok(entries.0.into_iter().map(|(id, numbers)| (id, nan(numbers))).collect())
}

/// In the order of the file, with ids that are given twice.
struct Entries(Vec<(String, Vec<Option<f64>>)>);

#[derive(Deserialize)]
#[serde(expecting = "an object with id and outputs")]
struct Listed {
    /// A number, or a text that holds one.
    id: serde_json::Value,
    outputs: Vec<Option<f64>>,
}

impl<'de> Deserialize<'de> for Entries {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(EntriesVisitor)
    }
}

struct EntriesVisitor;

impl<'de> Visitor<'de> for EntriesVisitor {
    type Value = Entries;

    fn expecting(&self, out: &mut fmt::Formatter) -> fmt::Result {
        out.write_str("rows of numbers")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Entries, A::Error> {
        let mut entries = Vec::new();
        while let Some(entry) = map.next_entry()? {
            entries.push(entry);
        }
        Ok(Entries(entries))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<Entries, A::Error> {
        let mut entries = Vec::new();
        while let Some(Listed { id, outputs }) = sequence.next_element()? {
            entries.push((id.to_string(), outputs));
        }
        Ok(Entries(entries))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<(u32, Vec<f64>)>, String> {
        let answers = Answers::read(text, &Golden::new());
        answers.map(|answers| answers.rows.into_iter().collect()).map_err(|error| error.to_string())
    }

    #[test]
    fn lines_and_both_kinds_of_json_are_read() {
        let expected = Ok(vec![(200, vec![1.0]), (1200, vec![0.5, -2.0, 1e-7])]);
        for text in [
            "200,1\n1200,0.5,-2,1e-7\n",
            "\u{feff}id,outputs\r\n# a comment, 7\r\n1200,0.5 -2 1e-7\r\n\r\n  200 , 1.0\r\n",
            "\"id\";\"outputs\"\n200;1\n1200;0.5;-2.0;1E-07",
            " {\"200\": [1], \"1200\": [0.5, -2, 1e-7]}",
            "2.000000000000000000e+02,1,\n1200.0,0.5,-2,1e-7,",
            "[{\"id\": \"1200\", \"outputs\": [0.5, -2, 1e-7]}, {\"id\": 200.0, \"outputs\": [1]}]",
            "[{\"id\": 1200, \"outputs\": [0.5, -2, 1e-7], \"case\": \"x\"},\n {\"outputs\": [1], \"id\": 200}]",
        ] {
            assert_eq!(read(text), expected, "{text}");
        }
    }

    #[test]
    fn what_is_no_number_is_nan_however_it_is_printed() {
        for word in ["nan", "NaN", "+nan", "-nan", "-nan(ind)", "-1.#IND", "1.#QNAN", "-1.#IND00", "1.#QNAN0e+000"] {
            assert!(read(&format!("200,{word}")).unwrap()[0].1[0].is_nan(), "{word}");
        }
        for word in ["banana", "nano", "nan0", "1.#indigo", "#ind", "--nan", "nan(", "infant"] {
            assert!(read(&format!("200,{word}")).unwrap_err().contains("is no number"), "{word}");
        }
        for text in ["{\"200\": [null]}", "[{\"id\": 200, \"outputs\": [NaN]}]", "{\"200\": [-Infinity]}"] {
            assert!(read(text).unwrap()[0].1[0].is_nan(), "{text}");
        }
        assert_eq!(read("200,inf").unwrap()[0].1, read("200,1.#INF").unwrap()[0].1);
    }

    #[test]
    fn bad_input_is_told_in_one_line() {
        let golden = "is the file of inputs; give what your port prints for them: id,number,number,... for each row";
        let none = "no row of numbers; give lines of id,number,number,... for the rows of golden.csv";
        for (text, message) in [
            ("", none),
            ("# nothing\nid,outputs\n", none),
            ("{}", none),
            ("200,1\n\n77,1", "line 3: \"77\" is no row's id; ids are those of golden.csv, say 100"),
            ("200,1\nid,outputs", "line 2: \"outputs\" is no number; give the row's id and then its outputs"),
            ("200,1\n200,1", "line 2: row 200 is given a second time; give each once"),
            ("{\"200\": [1], \"200\": [1]}", "row 200 is given a second time; give each once"),
            ("200,1.5f", "line 1: \"1.5f\" is no number; give the row's id and then its outputs"),
            ("1200,1,2", "line 1: row 1200 has 2 numbers where ltc_cross gives 3: product.x product.y product.z"),
            ("200", "line 1: row 200 has 0 numbers where ltc_side gives 1: side"),
            ("200,,1", "line 1: field 2 is empty; give a number, or nan"),
            ("id,function,case,mistake,inputs,outputs,tolerances\n", golden),
            ("{\"about\": [], \"functions\": []}", golden),
            ("-200,1", "line 1: \"-200\" is no row's id; ids are those of golden.csv, say 100"),
        ] {
            assert_eq!(read(text), Err(message.to_owned()), "{text}");
        }
        for text in ["{\"200\": [1}", "[1, 2]", "{\"200\": \"1\"}", "{\"200\": [1e999]}", "[{\"id\": 200}]"] {
            let message = read(text).unwrap_err();
            assert!(message.starts_with("line 1: ") && message.lines().count() == 1, "{text}: {message}");
        }
    }
}
