//! Expressions out of tokens.

use super::cursor::{Cursor, unexpected};
use super::refusal::Refusal;
use super::syntax::{Expression, Form};
use super::tokens::Kind;

/// Binary operators, those that bind least first.
const LEVELS: [&[&str]; 6] =
    [&["||"], &["&&"], &["|", "^", "&"], &["==", "!=", "<", "<=", ">", ">="], &["+", "-"], &["*", "/", "%"]];

pub(super) fn expression(cursor: &mut Cursor<'_>) -> Result<Expression, Refusal> {
    binary(cursor, 0)
}

fn binary(cursor: &mut Cursor<'_>, level: usize) -> Result<Expression, Refusal> {
    let Some(operators) = LEVELS.get(level) else { return unary(cursor) };
    let mut left = binary(cursor, level + 1)?;
    while operators.contains(&cursor.peek().text) {
        let operator = cursor.take();
        let right = Box::new(binary(cursor, level + 1)?);
        left = Expression {
            line: left.line,
            indent: left.indent,
            what: Form::Binary {
                operator: operator.text.to_owned(),
                operator_indent: operator.indent,
                left: Box::new(Expression { indent: None, ..left }),
                right,
            },
        };
    }
    Ok(left)
}

fn unary(cursor: &mut Cursor<'_>) -> Result<Expression, Refusal> {
    let token = cursor.peek();
    if !["-", "!"].contains(&token.text) {
        return postfix(cursor);
    }
    cursor.take();
    let value = Box::new(unary(cursor)?);
    let what = Form::Unary { operator: token.text.to_owned(), value };
    Ok(Expression { line: token.line, indent: token.indent, what })
}

fn postfix(cursor: &mut Cursor<'_>) -> Result<Expression, Refusal> {
    let mut found = primary(cursor)?;
    loop {
        let (line, indent) = (found.line, found.indent);
        let of = Box::new(Expression { indent: None, ..found });
        let what = if cursor.take_if(".") {
            Form::Member { of, name: cursor.word()? }
        } else if cursor.take_if("[") {
            let index = Box::new(expression(cursor)?);
            cursor.expect("]")?;
            Form::Index { of, index }
        } else {
            return Ok(Expression { line, indent, what: of.what });
        };
        found = Expression { line, indent, what };
    }
}

fn primary(cursor: &mut Cursor<'_>) -> Result<Expression, Refusal> {
    let token = cursor.peek();
    let what = match (token.kind, token.text) {
        (Kind::Number, text) => {
            cursor.take();
            Form::Number(text.to_owned())
        }
        (Kind::Symbol, "(") => {
            cursor.take();
            let inner = expression(cursor)?;
            cursor.expect(")")?;
            Form::Parentheses(Box::new(inner))
        }
        (Kind::Word, "true" | "false") => Form::Bool(cursor.take().text == "true"),
        (Kind::Word, _) => {
            let name = cursor.type_name()?;
            if cursor.take_if("(") {
                Form::Call { name, arguments: cursor.list(")", expression)? }
            } else if name.of.is_none() {
                Form::Name(name.word)
            } else {
                return Err(unexpected(cursor.peek(), "'('"));
            }
        }
        _ => return Err(unexpected(token, "a value")),
    };
    Ok(Expression { line: token.line, indent: token.indent, what })
}
