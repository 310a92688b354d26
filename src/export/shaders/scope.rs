//! The names within a function, and the types of the expressions made of them.

use super::declarations::Declarations;
use super::functions::built_in;
use super::refusal::Refusal;
use super::syntax::{Expression, Form, TypeName};
use super::types::{BOOL, F32, Generic, I32, Scalar, Type, U32, generic};

pub(super) struct Scope<'a> {
    pub declarations: &'a Declarations,
    /// The innermost last.
    locals: Vec<(String, Type)>,
}

impl<'a> Scope<'a> {
    pub fn new(declarations: &'a Declarations) -> Self {
        Self { declarations, locals: Vec::new() }
    }

    pub fn add(&mut self, name: &str, kind: Type) {
        self.locals.push((name.to_owned(), kind));
    }

    /// How many names there are, for [`Self::leave`].
    pub fn depth(&self) -> usize {
        self.locals.len()
    }

    /// Forgets the names that have come since.
    pub fn leave(&mut self, depth: usize) {
        self.locals.truncate(depth);
    }

    pub fn has(&self, name: &str) -> bool {
        self.local(name).is_some() || self.declarations.constant(name).is_some()
    }

    fn local(&self, name: &str) -> Option<&Type> {
        self.locals.iter().rev().find(|(local, _)| local == name).map(|(_, kind)| kind)
    }

    /// The type of an expression; refuses what is not translated or does not fit.
    pub fn type_of(&self, expression: &Expression) -> Result<Type, Refusal> {
        let refuse = |problem: String| Err(Refusal::new(expression.line, problem));
        match &expression.what {
            Form::Number(text) => number(text).map_err(|problem| Refusal::new(expression.line, problem)),
            Form::Bool(_) => Ok(BOOL),
            Form::Name(name) => match self.local(name).or_else(|| self.declarations.constant(name)) {
                Some(kind) => Ok(kind.clone()),
                None => refuse(format!("{name} is not known here")),
            },
            Form::Parentheses(inner) => self.type_of(inner),
            Form::Unary { operator, value } => match (operator.as_str(), self.type_of(value)?) {
                ("!", kind) if kind == BOOL => Ok(kind),
                (
                    "-",
                    kind @ (Type::Scalar(Scalar::F32 | Scalar::I32) | Type::Vector(_, Scalar::F32 | Scalar::I32)),
                ) => Ok(kind),
                (operator, kind) => refuse(format!("{operator} of {kind:?}")),
            },
            Form::Binary { operator, left, right, .. } => {
                let (left, right) = (self.type_of(left)?, self.type_of(right)?);
                binary(operator, &left, &right).map_err(|problem| Refusal::new(expression.line, problem))
            }
            Form::Call { name, arguments } => self.call(name, arguments, expression.line),
            Form::Member { of, name } => self.member(&self.type_of(of)?, name, expression.line),
            Form::Index { of, index } => match (self.type_of(of)?, self.type_of(index)?) {
                (Type::Matrix(size), Type::Scalar(Scalar::I32 | Scalar::U32)) => Ok(Type::Vector(size, Scalar::F32)),
                (Type::Vector(_, of), Type::Scalar(Scalar::I32 | Scalar::U32)) => Ok(Type::Scalar(of)),
                (kind, _) => refuse(format!("an index into {kind:?}")),
            },
        }
    }

    fn member(&self, of: &Type, name: &str, line: usize) -> Result<Type, Refusal> {
        let found = match of {
            Type::Struct(of) => self
                .declarations
                .fields(of)
                .and_then(|fields| fields.iter().find(|(field, _)| field == name))
                .map(|(_, kind)| kind.clone()),
            Type::Vector(size, component) => swizzle(name, *size).map(|length| match length {
                1 => Type::Scalar(*component),
                length => Type::Vector(length, *component),
            }),
            _ => None,
        };
        found.ok_or_else(|| Refusal::new(line, format!("{of:?} has no member {name}")))
    }

    fn call(&self, name: &TypeName, arguments: &[Expression], line: usize) -> Result<Type, Refusal> {
        let types = arguments.iter().map(|argument| self.type_of(argument)).collect::<Result<Vec<_>, _>>()?;
        self.called(name, &types).map_err(|problem| Refusal::new(line, problem))
    }

    /// The type of what a function, or a constructor, gives for arguments of these types.
    fn called(&self, name: &TypeName, types: &[Type]) -> Result<Type, String> {
        let word = name.word.as_str();
        if let Some(made) = constructed(name, types)? {
            return Ok(made);
        }
        if let Some(signature) = self.declarations.function(word) {
            let fits = signature.parameters == types;
            return if fits { Ok(signature.result.clone()) } else { Err(format!("{word} takes other types")) };
        }
        if let Some(fields) = self.declarations.fields(word) {
            let fits = fields.iter().map(|(_, kind)| kind).eq(types);
            return if fits { Ok(Type::Struct(word.to_owned())) } else { Err(format!("{word} has other fields")) };
        }
        match (word, types) {
            ("bitcast", [from]) => {
                let to = name.of.as_deref().and_then(type_named).ok_or("bitcast needs a type")?;
                let (Some(to_component), Some(_)) = (to.component(), from.component()) else {
                    return Err("bitcast of other than numbers".to_owned());
                };
                if from.with(to_component) == to { Ok(to) } else { Err("bitcast to another length".to_owned()) }
            }
            ("select", [no, yes, when]) if no == yes && when == &BOOL => Ok(no.clone()),
            ("textureDimensions", [Type::Texture, Type::Scalar(_)]) => Ok(Type::Vector(2, Scalar::U32)),
            ("textureLoad", [Type::Texture, Type::Vector(2, Scalar::U32), Type::Scalar(_)]) => {
                Ok(Type::Vector(4, Scalar::F32))
            }
            _ => match built_in(word) {
                Some(function) => function.result(types),
                None => Err(format!("{word} of these arguments is not translated")),
            },
        }
    }
}

/// Of a literal: digits with a point or an exponent are f32, digits alone i32, with a u behind them u32; these may be hexadecimal.
fn number(text: &str) -> Result<Type, String> {
    let whole = |digits: &str| match digits.strip_prefix("0x") {
        Some(digits) => u32::from_str_radix(digits, 16).ok(),
        None => digits.parse().ok().filter(|_| digits.bytes().all(|digit| digit.is_ascii_digit())),
    };
    let is_float = || {
        let (digits, exponent) = text.split_once('e').unwrap_or((text, "0"));
        let (before, after) = digits.split_once('.').unwrap_or((digits, "0"));
        let exponent = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
        let are_digits = |text: &str| !text.is_empty() && text.bytes().all(|digit| digit.is_ascii_digit());
        text.contains(['.', 'e']) && [before, after, exponent].into_iter().all(are_digits)
    };
    if text.strip_suffix('u').is_some_and(|digits| whole(digits).is_some()) {
        Ok(U32)
    } else if whole(text).is_some_and(|number| i32::try_from(number).is_ok()) {
        Ok(I32)
    } else if is_float() {
        Ok(F32)
    } else {
        Err(format!("the literal {text}"))
    }
}

fn binary(operator: &str, left: &Type, right: &Type) -> Result<Type, String> {
    let wrong = || Err(format!("{operator} between {left:?} and {right:?}"));
    let is_number = |kind: &Type| kind.component().is_some_and(|of| of != Scalar::Bool);
    match operator {
        "&&" | "||" if left == &BOOL && right == &BOOL => Ok(BOOL),
        "==" | "!=" | "<" | "<=" | ">" | ">=" if left == right && left.component().is_some() => {
            if left.component() == Some(Scalar::Bool) && !["==", "!="].contains(&operator) {
                return wrong();
            }
            Ok(left.with(Scalar::Bool))
        }
        "&" | "|" | "^" if left == right && matches!(left.component(), Some(Scalar::U32 | Scalar::I32)) => {
            Ok(left.clone())
        }
        "%" if left == right && left == &U32 => Ok(U32),
        "+" | "-" | "*" | "/" if is_number(left) && is_number(right) && left.component() == right.component() => {
            match (left, right) {
                (Type::Vector(..), Type::Scalar(_)) => Ok(left.clone()),
                (Type::Scalar(_), Type::Vector(..)) => Ok(right.clone()),
                _ if left == right => Ok(left.clone()),
                _ => wrong(),
            }
        }
        "*" => match (left, right) {
            (Type::Matrix(size), Type::Vector(length, Scalar::F32)) if size == length => Ok(right.clone()),
            (Type::Vector(length, Scalar::F32), Type::Matrix(size)) if size == length => Ok(left.clone()),
            (Type::Matrix(_), _) if left == right || right == &F32 => Ok(left.clone()),
            (_, Type::Matrix(_)) if left == &F32 => Ok(right.clone()),
            _ => wrong(),
        },
        _ => wrong(),
    }
}

/// The type that a constructor or conversion makes, if the name is one.
fn constructed(name: &TypeName, types: &[Type]) -> Result<Option<Type>, String> {
    let length: usize = types.iter().map(Type::length).sum();
    let inferred = || match (generic(&name.word), &name.of) {
        (Some(Generic::Vector(size)), None) => types.first()?.component().map(|of| Type::Vector(size, of)),
        (Some(Generic::Matrix(size)), None) => Some(Type::Matrix(size)),
        _ => None,
    };
    let Some(made) = Type::built_in(name).or_else(inferred) else { return Ok(None) };
    let is_conversion = types.len() == 1 && types[0].length() == made.length();
    let is_alike = types.iter().all(|kind| match made {
        Type::Matrix(_) => kind.component() == Some(Scalar::F32),
        _ => kind.component() == made.component(),
    });
    let fits = match &made {
        Type::Scalar(to) => is_conversion && *to != Scalar::Bool && types[0].component() != Some(Scalar::Bool),
        Type::Vector(size, to) => {
            let is_number = |kind: &Type| kind.component().is_some_and(|of| of != Scalar::Bool);
            (is_alike && (length == *size || types.len() == 1 && length == 1))
                || (is_conversion && *to != Scalar::Bool && is_number(&types[0]))
        }
        Type::Matrix(size) => {
            let are_columns = types.iter().all(|kind| kind == &Type::Vector(*size, Scalar::F32));
            types.is_empty() || (is_alike && length == size * size && (are_columns || types.len() == size * size))
        }
        _ => false,
    };
    if fits { Ok(Some(made)) } else { Err(format!("{} of these arguments", name.word)) }
}

/// The type of brackets' text.
fn type_named(text: &str) -> Option<Type> {
    let (word, of) = match text.split_once('<') {
        Some((word, rest)) => (word, Some(rest.trim_end_matches('>').to_owned())),
        None => (text, None),
    };
    Type::built_in(&TypeName { word: word.to_owned(), of })
}

/// How many components a swizzle takes of a vector, if it is one.
fn swizzle(name: &str, size: usize) -> Option<usize> {
    let sets = ["xyzw", "rgba"];
    let fits = |set: &&str| name.chars().all(|letter| set[..size].contains(letter));
    (!name.is_empty() && name.len() <= 4 && sets.iter().any(fits)).then_some(name.len())
}
