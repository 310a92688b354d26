//! A place in a text's tokens.

use super::refusal::Refusal;
use super::syntax::{Lead, TypeName};
use super::tokens::{Kind, Token, tokens};

/// Types whose name takes another one in brackets.
const GENERIC: [&str; 8] = ["vec2", "vec3", "vec4", "mat2x2", "mat3x3", "mat4x4", "texture_2d", "bitcast"];

pub(super) struct Cursor<'a> {
    tokens: Vec<Token<'a>>,
    at: usize,
}

impl<'a> Cursor<'a> {
    pub fn new(text: &'a str) -> Result<Self, Refusal> {
        Ok(Self { tokens: tokens(text)?, at: 0 })
    }

    pub fn peek(&self) -> Token<'a> {
        self.tokens[self.at]
    }

    pub fn take(&mut self) -> Token<'a> {
        let token = self.peek();
        self.at = (self.at + 1).min(self.tokens.len() - 1);
        token
    }

    /// Takes the next token if that is what it says.
    pub fn take_if(&mut self, text: &str) -> bool {
        let is = self.peek().text == text;
        if is {
            self.take();
        }
        is
    }

    pub fn expect(&mut self, text: &str) -> Result<Token<'a>, Refusal> {
        let token = self.take();
        if token.text == text { Ok(token) } else { Err(unexpected(token, &format!("'{text}'"))) }
    }

    pub fn word(&mut self) -> Result<String, Refusal> {
        let token = self.take();
        if token.kind == Kind::Word { Ok(token.text.to_owned()) } else { Err(unexpected(token, "a name")) }
    }

    /// Comments and blank lines before what comes next.
    pub fn lead(&mut self) -> Vec<Lead> {
        let mut lead = Vec::new();
        loop {
            let token = self.peek();
            if token.after_blank {
                lead.push(Lead::Blank);
            }
            if token.kind != Kind::Comment {
                return lead;
            }
            lead.push(Lead::Comment { text: self.take().text.to_owned(), line: token.line });
        }
    }

    /// The comment on the line where the last token was taken.
    pub fn comment(&mut self) -> Option<String> {
        let token = self.peek();
        let follows = token.kind == Kind::Comment && token.indent.is_none();
        follows.then(|| self.take().text.to_owned())
    }

    pub fn type_name(&mut self) -> Result<TypeName, Refusal> {
        let word = self.word()?;
        let mut of = None;
        if GENERIC.contains(&word.as_str()) && self.take_if("<") {
            let inner = self.type_name()?;
            of = Some(match inner.of {
                Some(component) => format!("{}<{component}>", inner.word),
                None => inner.word,
            });
            self.expect(">")?;
        }
        Ok(TypeName { word, of })
    }

    /// What stands between `open`, which has been taken, and `close`, with commas between and perhaps after.
    pub fn list<T>(
        &mut self,
        close: &str,
        mut element: impl FnMut(&mut Self) -> Result<T, Refusal>,
    ) -> Result<Vec<T>, Refusal> {
        let mut found = Vec::new();
        while !self.take_if(close) {
            found.push(element(self)?);
            if !self.take_if(",") {
                self.expect(close)?;
                break;
            }
        }
        Ok(found)
    }
}

/// There is something else.
pub(super) fn unexpected(token: Token<'_>, wanted: &str) -> Refusal {
    let found = match token.kind {
        Kind::End => "the end of the file".to_owned(),
        Kind::Comment => "a comment".to_owned(),
        _ => format!("'{}'", token.text),
    };
    Refusal::new(token.line, format!("{found} stands where {wanted} is expected"))
}
