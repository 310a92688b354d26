//! WGSL as tokens that remember how they were laid out.

use super::refusal::Refusal;

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A name or keyword.
    Word,
    /// A literal, with its suffix.
    Number,
    /// Punctuation or an operator.
    Symbol,
    /// From `//` to the end of the line.
    Comment,
    /// After the last one; its text is empty.
    End,
}

/// A piece of the text.
#[derive(Clone, Copy, Debug)]
pub(super) struct Token<'a> {
    pub kind: Kind,
    pub text: &'a str,
    /// Counted from 1.
    pub line: usize,
    /// Columns before it, where it is the first of its line.
    pub indent: Option<usize>,
    /// Whether the line before its own is empty.
    pub after_blank: bool,
}

/// Longest first, so that none is taken for two.
const SYMBOLS: [&str; 35] = [
    "->", "++", "--", "+=", "-=", "*=", "/=", "==", "!=", "<=", ">=", "&&", "||", "(", ")", "{", "}", "[", "]", "<",
    ">", ",", ";", ":", ".", "=", "+", "-", "*", "/", "%", "!", "&", "|", "^",
];

/// All tokens, comments among them, and an end.
pub(super) fn tokens(text: &str) -> Result<Vec<Token<'_>>, Refusal> {
    let mut found = Vec::new();
    let mut is_blank = false;
    for (index, whole) in text.lines().enumerate() {
        let (line, mut rest, first) = (index + 1, whole.trim(), found.len());
        while !rest.is_empty() {
            let (kind, length) = token(rest).map_err(|problem| Refusal::new(line, problem))?;
            let indent = (found.len() == first).then(|| whole.len() - whole.trim_start().len());
            found.push(Token { kind, text: &rest[..length], line, indent, after_blank: is_blank && indent.is_some() });
            rest = rest[length..].trim_start();
        }
        is_blank = whole.trim().is_empty();
    }
    let line = text.lines().count() + 1;
    found.push(Token { kind: Kind::End, text: "", line, indent: Some(0), after_blank: false });
    Ok(found)
}

/// What the text begins with, and its length.
fn token(text: &str) -> Result<(Kind, usize), String> {
    let is_part = |letter: char| letter.is_ascii_alphanumeric() || letter == '_';
    let first = text.chars().next().unwrap_or_default();
    if text.starts_with("//") {
        // Where there is a preprocessor, the next line would belong to it.
        if text.ends_with('\\') {
            return Err("a comment that ends in a backslash".to_owned());
        }
        return Ok((Kind::Comment, text.len()));
    }
    if first.is_ascii_alphabetic() || first == '_' {
        return Ok((Kind::Word, text.find(|letter| !is_part(letter)).unwrap_or(text.len())));
    }
    if first.is_ascii_digit() {
        return Ok((Kind::Number, number_length(text)));
    }
    match SYMBOLS.iter().find(|symbol| text.starts_with(**symbol)) {
        Some(symbol) => Ok((Kind::Symbol, symbol.len())),
        None => Err(format!("'{first}' is not understood")),
    }
}

/// Digits, a point, an exponent with its sign, and a suffix.
fn number_length(text: &str) -> usize {
    let is_hex = text.starts_with("0x");
    let mut before = ' ';
    text.find(|letter: char| {
        let is_sign = matches!(letter, '+' | '-') && before == 'e' && !is_hex;
        before = letter;
        !(letter.is_ascii_alphanumeric() || letter == '.' || is_sign)
    })
    .unwrap_or(text.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_cut_into_what_it_is_made_of() {
        let text = "let x = 1e-20 - 0xffu; // all\n\n    if a.x <= 2.0 {";
        let found = tokens(text).unwrap();
        let texts: Vec<&str> = found.iter().map(|token| token.text).collect();
        assert_eq!(
            texts,
            ["let", "x", "=", "1e-20", "-", "0xffu", ";", "// all", "if", "a", ".", "x", "<=", "2.0", "{", ""]
        );
        let indents: Vec<usize> = found.iter().filter_map(|token| token.indent).collect();
        assert_eq!(indents, [0, 4, 0]);
        assert!(found[8].after_blank && !found[9].after_blank);
        assert_eq!(tokens("let a = 1;\nlet b = '2';").unwrap_err().line, 2);
    }
}
