//! A file out of its text.

use super::cursor::{Cursor, unexpected};
use super::expressions::expression;
use super::refusal::Refusal;
use super::syntax::{Block, Expression, Function, Item, Lead, Noted, Otherwise, Statement, TypeName, Typed};
use super::tokens::Kind;

/// A whole file.
#[derive(Clone, Debug)]
pub(super) struct File {
    pub items: Vec<Noted<Item>>,
    /// Comments after the last one.
    pub tail: Vec<Lead>,
}

/// Reads a file, or says what in it is not translated.
pub(super) fn parse(text: &str) -> Result<File, Refusal> {
    let mut cursor = Cursor::new(text)?;
    let mut items = Vec::new();
    loop {
        let lead = cursor.lead();
        let token = cursor.peek();
        if token.kind == Kind::End {
            return Ok(File { items, tail: lead });
        }
        let what = match cursor.take().text {
            "const" => constant(&mut cursor)?,
            "struct" => structure(&mut cursor)?,
            "fn" => Item::Function(function(&mut cursor)?),
            _ => return Err(unexpected(token, "const, struct or fn")),
        };
        items.push(Noted { lead, line: token.line, what, comment: cursor.comment() });
    }
}

/// Reads the head of a function, from its name on.
pub(super) fn parse_head(text: &str) -> Result<Function, Refusal> {
    let whole = format!("{text} {{}}");
    function(&mut Cursor::new(&whole)?)
}

fn constant(cursor: &mut Cursor<'_>) -> Result<Item, Refusal> {
    let name = cursor.word()?;
    let kind = given_type(cursor)?;
    cursor.expect("=")?;
    let value = expression(cursor)?;
    cursor.expect(";")?;
    Ok(Item::Const { name, kind, value })
}

/// `: type`, if it is there.
fn given_type(cursor: &mut Cursor<'_>) -> Result<Option<TypeName>, Refusal> {
    if cursor.take_if(":") { cursor.type_name().map(Some) } else { Ok(None) }
}

fn typed(cursor: &mut Cursor<'_>) -> Result<Typed, Refusal> {
    let indent = cursor.peek().indent;
    let name = cursor.word()?;
    cursor.expect(":")?;
    Ok(Typed { name, kind: cursor.type_name()?, indent })
}

fn structure(cursor: &mut Cursor<'_>) -> Result<Item, Refusal> {
    let name = cursor.word()?;
    cursor.expect("{")?;
    let mut fields = Vec::new();
    loop {
        let lead = cursor.lead();
        if cursor.take_if("}") {
            break;
        }
        let line = cursor.peek().line;
        let what = typed(cursor)?;
        let is_last = !cursor.take_if(",");
        fields.push(Noted { lead, line, what, comment: cursor.comment() });
        if is_last {
            cursor.expect("}")?;
            break;
        }
    }
    Ok(Item::Struct { name, fields })
}

fn function(cursor: &mut Cursor<'_>) -> Result<Function, Refusal> {
    let name = cursor.word()?;
    cursor.expect("(")?;
    let parameters = cursor.list(")", typed)?;
    let result = if cursor.take_if("->") { Some(cursor.type_name()?) } else { None };
    Ok(Function { name, parameters, result, body: block(cursor)? })
}

fn block(cursor: &mut Cursor<'_>) -> Result<Block, Refusal> {
    cursor.expect("{")?;
    let mut statements = Vec::new();
    loop {
        let lead = cursor.lead();
        if cursor.take_if("}") {
            return Ok(Block { statements, tail: lead });
        }
        let line = cursor.peek().line;
        let what = statement(cursor)?;
        statements.push(Noted { lead, line, what, comment: cursor.comment() });
    }
}

fn statement(cursor: &mut Cursor<'_>) -> Result<Statement, Refusal> {
    let token = cursor.peek();
    let found = match token.text {
        "if" => return branch(cursor),
        "for" => return repetition(cursor),
        "return" => {
            cursor.take();
            let is_bare = cursor.peek().text == ";";
            Statement::Return(if is_bare { None } else { Some(expression(cursor)?) })
        }
        "break" => {
            cursor.take();
            Statement::Break
        }
        "continue" => {
            cursor.take();
            Statement::Continue
        }
        _ => simple(cursor)?,
    };
    cursor.expect(";")?;
    Ok(found)
}

/// What may stand in the head of a `for` too.
fn simple(cursor: &mut Cursor<'_>) -> Result<Statement, Refusal> {
    let token = cursor.peek();
    if ["let", "var"].contains(&token.text) {
        cursor.take();
        let name = cursor.word()?;
        let kind = given_type(cursor)?;
        let value = if cursor.take_if("=") { Some(expression(cursor)?) } else { None };
        return Ok(Statement::Local { name, kind, value });
    }
    if token.kind != Kind::Word {
        return Err(unexpected(token, "a statement"));
    }
    let place = expression(cursor)?;
    let operator = cursor.peek();
    match operator.text {
        "=" | "+=" | "-=" | "*=" | "/=" => {
            cursor.take();
            Ok(Statement::Assign { place, operator: operator.text.to_owned(), value: expression(cursor)? })
        }
        "++" | "--" => {
            cursor.take();
            Ok(Statement::Step { place, operator: operator.text.to_owned() })
        }
        _ => Ok(Statement::Call(place)),
    }
}

fn branch(cursor: &mut Cursor<'_>) -> Result<Statement, Refusal> {
    cursor.expect("if")?;
    let condition = expression(cursor)?;
    let then = block(cursor)?;
    let otherwise = if !cursor.take_if("else") {
        None
    } else if cursor.peek().text == "if" {
        Some(Box::new(Otherwise::If(branch(cursor)?)))
    } else {
        Some(Box::new(Otherwise::Block(block(cursor)?)))
    };
    Ok(Statement::If { condition, then, otherwise })
}

fn repetition(cursor: &mut Cursor<'_>) -> Result<Statement, Refusal> {
    cursor.expect("for")?;
    cursor.expect("(")?;
    let first = if cursor.peek().text == ";" { None } else { Some(Box::new(simple(cursor)?)) };
    cursor.expect(";")?;
    let condition: Option<Expression> = if cursor.peek().text == ";" { None } else { Some(expression(cursor)?) };
    cursor.expect(";")?;
    let next = if cursor.peek().text == ")" { None } else { Some(Box::new(simple(cursor)?)) };
    cursor.expect(")")?;
    Ok(Statement::For { first, condition, next, body: block(cursor)? })
}
