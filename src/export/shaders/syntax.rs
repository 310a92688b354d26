//! What a file is made of, as far as it is translated, with its comments and line breaks.

/// A type as it is written: `f32`, `vec3<f32>`, `LtcOutline`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct TypeName {
    pub word: String,
    /// What stands in the brackets.
    pub of: Option<String>,
}

/// What stands before a declaration or statement, line by line.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Lead {
    Blank,
    /// With its slashes, on a line counted from 1.
    Comment {
        text: String,
        line: usize,
    },
}

/// A declaration or statement with its comments: those before it and the one at the end of its (first) line.
#[derive(Clone, Debug)]
pub(super) struct Noted<T> {
    pub lead: Vec<Lead>,
    pub line: usize,
    pub what: T,
    pub comment: Option<String>,
}

/// A name with its type.
#[derive(Clone, Debug)]
pub(super) struct Typed {
    pub name: String,
    pub kind: TypeName,
    /// Columns before it, where it begins a line.
    pub indent: Option<usize>,
}

/// A declaration at the top of a file.
#[derive(Clone, Debug)]
pub(super) enum Item {
    Const { name: String, kind: Option<TypeName>, value: Expression },
    Struct { name: String, fields: Vec<Noted<Typed>> },
    Function(Function),
}

#[derive(Clone, Debug)]
pub(super) struct Function {
    pub name: String,
    pub parameters: Vec<Typed>,
    pub result: Option<TypeName>,
    pub body: Block,
}

/// Statements in braces, and the comments before the closing one.
#[derive(Clone, Debug)]
pub(super) struct Block {
    pub statements: Vec<Noted<Statement>>,
    pub tail: Vec<Lead>,
}

#[derive(Clone, Debug)]
pub(super) enum Statement {
    /// `let` and `var`: the other languages have only the latter.
    Local {
        name: String,
        kind: Option<TypeName>,
        value: Option<Expression>,
    },
    /// Of `=`, `+=` and their like.
    Assign {
        place: Expression,
        operator: String,
        value: Expression,
    },
    /// `k++` and `k--`.
    Step {
        place: Expression,
        operator: String,
    },
    Call(Expression),
    If {
        condition: Expression,
        then: Block,
        otherwise: Option<Box<Otherwise>>,
    },
    For {
        first: Option<Box<Statement>>,
        condition: Option<Expression>,
        next: Option<Box<Statement>>,
        body: Block,
    },
    Return(Option<Expression>),
    Break,
    Continue,
}

#[derive(Clone, Debug)]
pub(super) enum Otherwise {
    If(Statement),
    Block(Block),
}

#[derive(Clone, Debug)]
pub(super) struct Expression {
    pub line: usize,
    /// Columns before it, where it begins a line.
    pub indent: Option<usize>,
    pub what: Form,
}

#[derive(Clone, Debug)]
pub(super) enum Form {
    Number(String),
    Bool(bool),
    Name(String),
    Parentheses(Box<Expression>),
    Unary {
        operator: String,
        value: Box<Expression>,
    },
    Binary {
        operator: String,
        operator_indent: Option<usize>,
        left: Box<Expression>,
        right: Box<Expression>,
    },
    /// Of a function, or of a type as its constructor or conversion.
    Call {
        name: TypeName,
        arguments: Vec<Expression>,
    },
    Member {
        of: Box<Expression>,
        name: String,
    },
    Index {
        of: Box<Expression>,
        index: Box<Expression>,
    },
}
