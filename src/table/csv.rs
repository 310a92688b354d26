//! Tables as text.

use super::{LtcTable, MAX_SIDE, NODE_TOLERANCE, TableError, cell_defect, node};
use std::fmt::Write;

const COLUMNS: [&str; 5] = ["alpha", "mu", "a", "b", "r"];

impl LtcTable {
    /// Reads lines of `alpha,mu,a,b,r`, alpha-major.
    ///
    /// The column names, empty lines and lines that begin with `#` may stand or be left out; spaces around numbers and
    /// CRLF line ends do not count.
    pub fn from_csv(text: &str) -> Result<Self, TableError> {
        let rows = rows(text)?;
        let size = size(&rows)?;
        for (index, row) in rows.iter().enumerate() {
            let (i, j) = (index / size[1], index % size[1]);
            let nodes = [node(i, size[0]), node(j, size[1])];
            for (axis, name) in ["alpha", "mu"].into_iter().enumerate() {
                let (is, should) = (row.values[axis], nodes[axis]);
                if (is - should).abs() > NODE_TOLERANCE {
                    let [n, m] = size;
                    let problem =
                        format!("{name} is {is}, but row {index} of a table of {n} x {m} nodes has {should:.6}");
                    return Err(TableError::Line { line: row.line, problem });
                }
            }
        }
        let cells = rows.iter().map(|row| row.cell()).collect();
        Ok(Self { size, cells })
    }

    /// The table as text: `header` as `#` comments, the column names, a line for each node.
    ///
    /// Numbers are the shortest that read back as the same `f64`; the node positions have 7 digits.
    pub fn to_csv(&self, header: &[String]) -> String {
        let mut text: String = header.iter().map(|line| format!("# {line}").trim_end().to_owned() + "\n").collect();
        text += &COLUMNS.join(",");
        text.push('\n');
        let [n, m] = self.size;
        for (index, [a, b, r]) in self.cells.iter().enumerate() {
            let position = |k, n| (node(k, n) * 1e7).round() / 1e7;
            let (alpha, mu) = (position(index / m, n), position(index % m, m));
            writeln!(text, "{alpha},{mu},{a},{b},{r}").expect("writing to a string does not fail");
        }
        text
    }
}

/// A line of numbers and where it stood (from 1).
struct Row {
    line: usize,
    /// In the order of [`COLUMNS`].
    values: [f64; 5],
}

impl Row {
    fn cell(&self) -> [f64; 3] {
        [self.values[2], self.values[3], self.values[4]]
    }
}

fn rows(text: &str) -> Result<Vec<Row>, TableError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut rows = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let content = line.trim();
        let names = || content.split(',').map(str::trim).eq(COLUMNS);
        if content.is_empty() || content.starts_with('#') || (rows.is_empty() && names()) {
            continue;
        }
        if rows.len() == MAX_SIDE * MAX_SIDE {
            return Err(TableError::Lines { problem: format!("more than {MAX_SIDE} nodes a side") });
        }
        let line = index + 1;
        let row = row(line, content).map_err(|problem| TableError::Line { line, problem })?;
        rows.push(row);
    }
    Ok(rows)
}

fn row(line: usize, content: &str) -> Result<Row, String> {
    let columns = content.split(',').count();
    if columns != COLUMNS.len() {
        return Err(format!("{columns} columns instead of the 5 of {}", COLUMNS.join(",")));
    }
    let mut values = [0.0; 5];
    for ((value, field), name) in values.iter_mut().zip(content.split(',')).zip(COLUMNS) {
        let field = field.trim();
        *value = match field.parse() {
            Ok(number) if f64::is_finite(number) => number,
            _ => return Err(format!("{name} must be a finite number: {:?}", excerpt(field))),
        };
    }
    let row = Row { line, values };
    cell_defect(row.cell()).map_or(Ok(row), Err)
}

/// The nodes of alpha and mu that the rows are made of: the first alpha's rows count mu.
fn size(rows: &[Row]) -> Result<[usize; 2], TableError> {
    let broken = |problem| Err(TableError::Lines { problem });
    let Some(first) = rows.first() else {
        return broken("no line of numbers".to_owned());
    };
    let m = rows.iter().take_while(|row| (row.values[0] - first.values[0]).abs() <= NODE_TOLERANCE).count();
    let n = rows.len().div_ceil(m);
    if m < 2 || n < 2 {
        return broken(format!("{n} x {m} nodes of alpha and mu, where each needs 2 or more"));
    }
    if n > MAX_SIDE || m > MAX_SIDE {
        return broken(format!("{n} x {m} nodes of alpha and mu, where {MAX_SIDE} a side is the most"));
    }
    if n * m != rows.len() {
        return broken(format!("{} rows do not fill {n} nodes of alpha by {m} of mu", rows.len()));
    }
    Ok([n, m])
}

/// The beginning of a field, short enough for a message.
fn excerpt(field: &str) -> String {
    field.chars().take(24).collect()
}
