//! What the translator does not take.

/// Why a file is not translated: it is no mistake of the WGSL, but outside of what is translated faithfully.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "line {line}: {problem}; what is translated is const, struct, fn, let, var, if, for and return, with numbers of \
     one type on both sides of an operator"
)]
pub struct Refusal {
    /// Counted from 1.
    pub line: usize,
    /// What stands there.
    pub problem: String,
}

impl Refusal {
    pub(super) fn new(line: usize, problem: impl Into<String>) -> Self {
        Self { line, problem: problem.into() }
    }

    /// The same at another line: that of the text out of which it was read.
    pub(super) fn at(self, line: usize) -> Self {
        Self { line, ..self }
    }

    /// The same of a text that the file stands on.
    pub(super) fn of_another(self) -> Self {
        Self { problem: format!("of a text before it: {}", self.problem), ..self }
    }
}
