//! Numbers as people type them: `0.25`, `1/3 + 0.2`, `(1+2)/4`, `0,125`.
//!
//! Crates that do this do far more (functions, variables, regular expressions), or are no longer kept, or are AGPL.

/// How deep parentheses and signs may be nested.
const DEEPEST: usize = 50;

/// The value of a sum: numbers, `+ - * /` and parentheses. `None` where it is none, or not finite.
///
/// A comma is a decimal point where it can be nothing else: `1,234` may be a thousand, and is refused.
pub fn evaluate(text: &str) -> Option<f64> {
    let plain = |sign: char| match sign {
        '\u{2212}' => '-',
        '\u{d7}' => '*',
        '\u{f7}' => '/',
        other => other,
    };
    let signs: Vec<char> = text.chars().map(plain).collect();
    let mut sum = Sum { signs: &signs, at: 0 };
    let value = sum.terms(0)?;
    (sum.peek().is_none() && value.is_finite()).then_some(value)
}

struct Sum<'a> {
    signs: &'a [char],
    at: usize,
}

impl Sum<'_> {
    /// The next sign that is no space.
    fn peek(&mut self) -> Option<char> {
        while self.signs.get(self.at).is_some_and(|sign| sign.is_whitespace()) {
            self.at += 1;
        }
        self.signs.get(self.at).copied()
    }

    /// Whether one of these signs comes next; it is taken.
    fn next_of(&mut self, wanted: &[char]) -> Option<char> {
        let found = self.peek().filter(|sign| wanted.contains(sign));
        self.at += usize::from(found.is_some());
        found
    }

    fn terms(&mut self, depth: usize) -> Option<f64> {
        let mut value = self.factors(depth)?;
        while let Some(sign) = self.next_of(&['+', '-']) {
            let other = self.factors(depth)?;
            value += if sign == '+' { other } else { -other };
        }
        Some(value)
    }

    fn factors(&mut self, depth: usize) -> Option<f64> {
        let mut value = self.factor(depth)?;
        while let Some(sign) = self.next_of(&['*', '/']) {
            let other = self.factor(depth)?;
            value = if sign == '*' { value * other } else { value / other };
        }
        Some(value)
    }

    fn factor(&mut self, depth: usize) -> Option<f64> {
        if depth > DEEPEST {
            return None;
        }
        match self.next_of(&['-', '+', '(']) {
            Some('-') => self.factor(depth + 1).map(|value| -value),
            Some('+') => self.factor(depth + 1),
            Some(_) => {
                let value = self.terms(depth + 1)?;
                self.next_of(&[')'])?;
                Some(value)
            }
            None => self.number(),
        }
    }

    fn number(&mut self) -> Option<f64> {
        self.peek()?;
        let start = self.at;
        while let Some(&sign) = self.signs.get(self.at) {
            let is_exponents_sign =
                matches!(sign, '+' | '-') && matches!(self.signs[start..self.at].last(), Some('e' | 'E'));
            if !sign.is_ascii_digit() && !matches!(sign, '.' | ',' | 'e' | 'E') && !is_exponents_sign {
                break;
            }
            self.at += 1;
        }
        let number: String = self.signs[start..self.at].iter().collect();
        // Of "inf" and "nan" no sign has been taken.
        with_point(&number)?.parse().ok()
    }
}

/// A number with a point for its comma.
fn with_point(number: &str) -> Option<String> {
    let Some((whole, fraction)) = number.split_once(',') else { return Some(number.to_owned()) };
    let is_thousand = fraction.len() == 3 && (1..=3).contains(&whole.len()) && !whole.starts_with('0');
    let is_plain = !fraction.contains([',', '.']) && !whole.contains('.');
    (is_plain && !is_thousand).then(|| format!("{whole}.{fraction}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_worked_out() {
        for (text, value) in [
            ("0.25", 0.25),
            ("1/3 + 0.2", 1.0 / 3.0 + 0.2),
            ("2*0.4", 0.8),
            ("(1+2)/4", 0.75),
            ("1 - 2 - 3", -4.0),
            ("8/4/2", 1.0),
            ("1+2*3", 7.0),
            (" \u{2212}2,5 ", -2.5),
            ("-(1 + 1)*.5", -1.0),
            ("2*-3", -6.0),
            ("1e-3+1E+2", 100.001),
            ("0,125", 0.125),
            ("1,5 \u{d7} 2", 3.0),
            ("1234,567", 1234.567),
            ("5.", 5.0),
        ] {
            assert_eq!(evaluate(text), Some(value), "{text}");
        }
    }

    #[test]
    fn what_is_no_number_is_refused() {
        for text in [
            "", " ", "x", "2..", "1/0", "0/0", "1+", "*2", "(1", "1)", "()", "1 2", "nan", "inf", "1e999", "1e", "e3",
            "1,234", "1,2,3", "1,234.5", "1.2,3", "#fff", "--", "2 + two",
        ] {
            assert_eq!(evaluate(text), None, "{text}");
        }
        assert_eq!(evaluate(&"(".repeat(1_000_000)), None);
        assert_eq!(evaluate(&"-".repeat(1_000_000)), None);
    }
}
