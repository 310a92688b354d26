//! Looking through what a file is made of.

use super::syntax::{Block, Expression, Form, Otherwise, Statement};

/// Calls `see` with an expression and all in it.
pub(super) fn each<'a>(expression: &'a Expression, see: &mut dyn FnMut(&'a Expression)) {
    see(expression);
    match &expression.what {
        Form::Parentheses(of) | Form::Unary { value: of, .. } | Form::Member { of, .. } => each(of, see),
        Form::Binary { left: one, right: other, .. } | Form::Index { of: one, index: other } => {
            each(one, see);
            each(other, see);
        }
        Form::Call { arguments, .. } => arguments.iter().for_each(|argument| each(argument, see)),
        Form::Number(_) | Form::Bool(_) | Form::Name(_) => {}
    }
}

/// The expressions of a statement itself, not of the blocks in it.
fn own(statement: &Statement) -> Vec<&Expression> {
    match statement {
        Statement::Local { value, .. } | Statement::Return(value) => value.iter().collect(),
        Statement::Assign { place, value, .. } => vec![place, value],
        Statement::Step { place, .. } | Statement::Call(place) => vec![place],
        Statement::If { condition, .. } => vec![condition],
        Statement::For { first, condition, next, .. } => {
            let heads = first.iter().chain(next).flat_map(|statement| own(statement));
            heads.chain(condition).collect()
        }
        Statement::Break | Statement::Continue => Vec::new(),
    }
}

/// The same, and the conditions of each `else if`.
pub(super) fn heads(statement: &Statement) -> Vec<&Expression> {
    let mut found = own(statement);
    if let Statement::If { otherwise: Some(otherwise), .. } = statement
        && let Otherwise::If(next) = &**otherwise
    {
        found.extend(heads(next));
    }
    found
}

/// Whether a value is made by functions.
pub(super) fn calls_function(value: &Expression) -> bool {
    let mut found = false;
    each(value, &mut |inner| found |= matches!(&inner.what, Form::Call { name, .. } if !name.is_constructor()));
    found
}

/// Whether a value is made by operators of two values.
pub(super) fn calculates(value: &Expression) -> bool {
    let mut found = false;
    each(value, &mut |inner| found |= matches!(inner.what, Form::Binary { .. }));
    found
}

/// The names of all functions called in a block.
pub(super) fn calls(block: &Block) -> Vec<&str> {
    let mut found = Vec::new();
    for statement in &block.statements {
        add_calls(&statement.what, &mut found);
    }
    found
}

fn add_calls<'a>(statement: &'a Statement, found: &mut Vec<&'a str>) {
    for expression in own(statement) {
        each(expression, &mut |inner| {
            if let Form::Call { name, .. } = &inner.what {
                found.push(&name.word);
            }
        });
    }
    match statement {
        Statement::If { then, otherwise, .. } => {
            found.extend(calls(then));
            match otherwise.as_deref() {
                Some(Otherwise::If(statement)) => add_calls(statement, found),
                Some(Otherwise::Block(block)) => found.extend(calls(block)),
                None => {}
            }
        }
        Statement::For { body, .. } => found.extend(calls(body)),
        _ => {}
    }
}
