//! Tables as text.

use super::TableError;
use super::grid::{Grid, MAX_SIDE, node};
use std::fmt::Write;

/// How far the places of a file's rows on both axes may be from the nodes.
const NODE_TOLERANCE: f64 = 1e-4;

/// What each line of a table holds: the node's place on both axes, and its numbers.
pub(super) struct Columns<const N: usize> {
    pub axes: [&'static str; 2],
    pub values: [&'static str; N],
    /// What is wrong with a node's numbers, if anything.
    pub defect: fn([f64; N]) -> Option<String>,
}

/// A line of numbers and where it stood (from 1).
struct Row<const N: usize> {
    line: usize,
    place: [f64; 2],
    values: [f64; N],
}

impl<const N: usize> Columns<N> {
    /// Reads lines in order of the axes, the second varying fastest.
    ///
    /// A line of column names at the top, empty lines and lines that begin with `#` are optional; spaces around numbers
    /// and CRLF line ends do not matter.
    pub fn read(&self, text: &str) -> Result<Grid<N>, TableError> {
        let rows = self.rows(text)?;
        let size = size(&rows, self.axes).map_err(|problem| self.broken(problem))?;
        for (index, row) in rows.iter().enumerate() {
            let nodes = [node(index / size[1], size[0]), node(index % size[1], size[1])];
            for ((is, should), name) in row.place.into_iter().zip(nodes).zip(self.axes) {
                if (is - should).abs() > NODE_TOLERANCE {
                    let [n, m] = size;
                    let problem =
                        format!("{name} is {is}, but row {index} of a table of {n} x {m} nodes has {should:.6}");
                    return Err(TableError::Line { line: row.line, problem });
                }
            }
        }
        Ok(Grid { size, cells: rows.into_iter().map(|row| row.values).collect() })
    }

    /// `header` as `#` comments, the column names, a line for each node.
    ///
    /// Numbers are the shortest that read back as the same `f64`; the node positions have 7 digits.
    pub fn write(&self, grid: &Grid<N>, header: &[String]) -> String {
        let mut text: String = header.iter().map(|line| format!("# {line}").trim_end().to_owned() + "\n").collect();
        text += &self.names();
        text.push('\n');
        let [n, m] = grid.size;
        for (index, cell) in grid.cells.iter().enumerate() {
            let position = |k, n| (node(k, n) * 1e7).round() / 1e7;
            let (x, y) = (position(index / m, n), position(index % m, m));
            let cell: String = cell.iter().map(|value| format!(",{value}")).collect();
            writeln!(text, "{x},{y}{cell}").expect("writing to a string does not fail");
        }
        text
    }

    fn names(&self) -> String {
        self.axes.into_iter().chain(self.values).collect::<Vec<_>>().join(",")
    }

    fn broken(&self, problem: String) -> TableError {
        TableError::Lines { columns: self.names(), problem }
    }

    fn rows(&self, text: &str) -> Result<Vec<Row<N>>, TableError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut rows = Vec::new();
        for (index, line) in text.lines().enumerate() {
            let content = line.trim();
            let names = || content.split(',').map(str::trim).eq(self.axes.into_iter().chain(self.values));
            if content.is_empty() || content.starts_with('#') || (rows.is_empty() && names()) {
                continue;
            }
            if rows.len() == MAX_SIDE * MAX_SIDE {
                return Err(self.broken(format!("more than {MAX_SIDE} nodes a side")));
            }
            let line = index + 1;
            let row = self.row(line, content).map_err(|problem| TableError::Line { line, problem })?;
            rows.push(row);
        }
        Ok(rows)
    }

    fn row(&self, line: usize, content: &str) -> Result<Row<N>, String> {
        let columns = content.split(',').count();
        if columns != N + 2 {
            return Err(format!("{columns} columns instead of the {} of {}", N + 2, self.names()));
        }
        let mut row = Row { line, place: [0.0; 2], values: [0.0; N] };
        let numbers = row.place.iter_mut().chain(&mut row.values);
        for ((number, field), name) in numbers.zip(content.split(',')).zip(self.axes.into_iter().chain(self.values)) {
            let field = field.trim();
            *number = match field.parse() {
                Ok(number) if f64::is_finite(number) => number,
                _ => return Err(format!("{name} must be a finite number: {:?}", excerpt(field))),
            };
        }
        (self.defect)(row.values).map_or(Ok(row), Err)
    }
}

/// How many nodes the rows have along both axes: the rows at the first node of the first axis count those of the
/// second.
fn size<const N: usize>(rows: &[Row<N>], [first_name, second_name]: [&str; 2]) -> Result<[usize; 2], String> {
    let Some(first) = rows.first() else {
        return Err("no line of numbers".to_owned());
    };
    let m = rows.iter().take_while(|row| (row.place[0] - first.place[0]).abs() <= NODE_TOLERANCE).count();
    let n = rows.len().div_ceil(m);
    if m < 2 || n < 2 {
        return Err(format!("{n} x {m} nodes of {first_name} and {second_name}, where each needs 2 or more"));
    }
    if n > MAX_SIDE || m > MAX_SIDE {
        return Err(format!("{n} x {m} nodes of {first_name} and {second_name}, where {MAX_SIDE} a side is the most"));
    }
    if n * m != rows.len() {
        return Err(format!("{} rows do not fill {n} nodes of {first_name} by {m} of {second_name}", rows.len()));
    }
    Ok([n, m])
}

/// The beginning of a field, short enough for a message.
fn excerpt(field: &str) -> String {
    field.chars().take(24).collect()
}
