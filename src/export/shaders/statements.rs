//! The statements of a function in another language.

use super::language::Language;
use super::refusal::Refusal;
use super::reserved::check;
use super::scope::Scope;
use super::spelling::{dimensions_name, spell, spell_after};
use super::syntax::{Block, Expression, Form, Lead, Noted, Otherwise, Statement, TypeName};
use super::types::{BOOL, Scalar, Type};
use super::walk::{each, heads};

/// How much deeper a block stands.
const INDENT: usize = 4;

/// Comments and blank lines before something.
pub(super) fn lead(lead: &[Lead], indent: usize, language: Language) -> String {
    lead.iter()
        .map(|line| match line {
            Lead::Blank => "\n".to_owned(),
            Lead::Comment { text, .. } => format!("{:indent$}{}\n", "", comment(text, language)),
        })
        .collect()
}

/// A comment behind something.
pub(super) fn note(text: Option<&String>, language: Language) -> String {
    text.map(|text| format!("  {}", comment(text, language))).unwrap_or_default()
}

/// Other files have another ending.
fn comment(text: &str, language: Language) -> String {
    text.replace(".wgsl", &format!(".{}", language.extension()))
}

/// Writes the statements of one function.
pub(super) struct Statements<'a> {
    language: Language,
    scope: Scope<'a>,
    /// What the function gives.
    result: Type,
}

impl<'a> Statements<'a> {
    pub fn new(language: Language, scope: Scope<'a>, result: Type) -> Self {
        Self { language, scope, result }
    }

    /// In braces, of which the closing one has the indent.
    pub fn block(&mut self, block: &Block, indent: usize) -> Result<String, Refusal> {
        let depth = self.scope.depth();
        let mut text = "{\n".to_owned();
        let inner = indent + INDENT;
        for statement in &block.statements {
            text += &lead(&statement.lead, inner, self.language);
            for before in self.dimensions(statement)? {
                text += &format!("{:inner$}{before}\n", "");
            }
            let written = self.statement(statement, inner)?;
            text += &format!("{:inner$}{written}{}\n", "", note(statement.comment.as_ref(), self.language));
        }
        text += &lead(&block.tail, inner, self.language);
        self.scope.leave(depth);
        Ok(text + &format!("{:indent$}}}", ""))
    }

    /// Statements that ask for the sizes of textures, where that is no expression.
    fn dimensions(&mut self, statement: &Noted<Statement>) -> Result<Vec<String>, Refusal> {
        let mut textures: Vec<&Expression> = Vec::new();
        for expression in heads(&statement.what) {
            each(expression, &mut |inner| match &inner.what {
                Form::Call { name, arguments } if name.word == "textureDimensions" => {
                    textures.extend(arguments.first())
                }
                _ => {}
            });
        }
        if self.language != Language::Hlsl {
            return Ok(Vec::new());
        }
        let mut found = Vec::new();
        for texture in textures {
            let texture = spell(texture, self.language, &self.scope)?;
            let size = dimensions_name(&texture);
            self.add(&size, Type::Vector(2, Scalar::U32), statement.line)?;
            found.push(format!("uint2 {size};"));
            found.push(format!("{texture}.GetDimensions({size}.x, {size}.y);"));
        }
        Ok(found)
    }

    /// Enters a name. One that hides another is refused: languages differ in what they allow.
    fn add(&mut self, name: &str, kind: Type, line: usize) -> Result<(), Refusal> {
        check(name, line)?;
        if self.scope.has(name) || self.scope.declarations.function(name).is_some() {
            return Err(Refusal::new(line, format!("the name {name} hides another one")));
        }
        self.scope.add(name, kind);
        Ok(())
    }

    /// Without the indent of its first line.
    fn statement(&mut self, statement: &Noted<Statement>, indent: usize) -> Result<String, Refusal> {
        let line = statement.line;
        match &statement.what {
            Statement::Return(None) => Ok("return;".to_owned()),
            Statement::Return(Some(value)) => self.give_back(value, indent),
            Statement::If { condition, then, otherwise } => self.branch(condition, then, otherwise.as_deref(), indent),
            Statement::For { first, condition, next, body } => {
                let depth = self.scope.depth();
                let first = first.as_ref().map_or(Ok(String::new()), |first| self.simple(first, line))?;
                let condition = condition.as_ref().map_or(Ok(String::new()), |condition| self.condition(condition))?;
                let next = next.as_ref().map_or(Ok(String::new()), |next| self.simple(next, line))?;
                let [condition, next] =
                    [condition, next].map(|part| if part.is_empty() { part } else { format!(" {part}") });
                let text = format!("for ({first};{condition};{next}) {}", self.block(body, indent)?);
                self.scope.leave(depth);
                Ok(text)
            }
            Statement::Break => Ok("break;".to_owned()),
            Statement::Continue => Ok("continue;".to_owned()),
            simple => Ok(self.simple(simple, line)? + ";"),
        }
    }

    fn condition(&self, condition: &Expression) -> Result<String, Refusal> {
        if self.scope.type_of(condition)? != BOOL {
            return Err(Refusal::new(condition.line, "a condition that is no bool"));
        }
        self.value(condition)
    }

    fn branch(
        &mut self,
        condition: &Expression,
        then: &Block,
        otherwise: Option<&Otherwise>,
        indent: usize,
    ) -> Result<String, Refusal> {
        let text = format!("if ({}) {}", self.condition(condition)?, self.block(then, indent)?);
        Ok(match otherwise {
            None => text,
            Some(Otherwise::Block(block)) => format!("{text} else {}", self.block(block, indent)?),
            Some(Otherwise::If(statement)) => {
                let Statement::If { condition, then, otherwise } = statement else { unreachable!("it is an if") };
                format!("{text} else {}", self.branch(condition, then, otherwise.as_deref(), indent)?)
            }
        })
    }

    /// What may stand in the head of a `for`; without a semicolon.
    fn simple(&mut self, statement: &Statement, line: usize) -> Result<String, Refusal> {
        match statement {
            Statement::Local { name, kind, value } => self.local(name, kind.as_ref(), value.as_ref(), line),
            Statement::Assign { place, operator, value } => {
                let (place_type, value_type) = (self.scope.type_of(place)?, self.scope.type_of(value)?);
                let is_product = ["*=", "/="].contains(&operator.as_str());
                let is_scaled = is_product && place_type.component().is_some_and(|of| value_type == Type::Scalar(of));
                if is_product && matches!(value_type, Type::Matrix(_)) {
                    return Err(Refusal::new(line, "a product of matrices in place: HLSL's goes by component"));
                }
                if place_type != value_type && !is_scaled {
                    return Err(Refusal::new(line, "a value of another type than its place"));
                }
                self.check_place(place)?;
                Ok(format!("{} {operator}{}", self.value(place)?, self.after(" ", value)?))
            }
            Statement::Step { place, operator } => {
                self.check_place(place)?;
                Ok(format!("{}{operator}", self.value(place)?))
            }
            Statement::Call(call) => {
                self.scope.type_of(call)?;
                self.value(call)
            }
            _ => Err(Refusal::new(line, "a statement in the head of a for")),
        }
    }

    /// A column of a matrix is no place in HLSL.
    fn check_place(&self, place: &Expression) -> Result<(), Refusal> {
        let mut indexed = Vec::new();
        each(place, &mut |inner| {
            if let Form::Index { of, .. } = &inner.what {
                indexed.push(of);
            }
        });
        for of in indexed {
            if matches!(self.scope.type_of(of)?, Type::Matrix(_)) {
                return Err(Refusal::new(place.line, "a value for a part of a matrix"));
            }
        }
        Ok(())
    }

    fn local(
        &mut self,
        name: &str,
        kind: Option<&TypeName>,
        value: Option<&Expression>,
        line: usize,
    ) -> Result<String, Refusal> {
        let given = kind.map(|kind| self.scope.declarations.type_of(kind, line)).transpose()?;
        let found = value.map(|value| self.scope.type_of(value)).transpose()?;
        let kind = match (given, found) {
            (Some(given), Some(found)) if given != found => {
                return Err(Refusal::new(line, format!("{name} has a value of another type")));
            }
            (Some(kind), Some(_)) | (None, Some(kind)) => kind,
            // WGSL starts it at 0; the others do not.
            _ => return Err(Refusal::new(line, format!("{name} without a value"))),
        };
        let spelt = self.language.type_name(&kind);
        let text = match value {
            Some(value) if self.is_made_anew(value) => format!("{spelt} {name} = {}", self.members(value)?),
            Some(value) => format!("{spelt} {name} ={}", self.after(" ", value)?),
            None => unreachable!("its type has been found"),
        };
        self.add(name, kind, line)?;
        Ok(text)
    }

    fn give_back(&mut self, value: &Expression, indent: usize) -> Result<String, Refusal> {
        if self.scope.type_of(value)? != self.result {
            return Err(Refusal::new(value.line, "a result of another type"));
        }
        if !self.is_made_anew(value) {
            return Ok(format!("return{};", self.after(" ", value)?));
        }
        let kind = self.language.type_name(&self.result);
        if self.scope.has("result") || self.scope.declarations.function("result").is_some() {
            return Err(Refusal::new(value.line, "the name result, which HLSL's result takes"));
        }
        Ok(format!("{kind} result = {};\n{:indent$}return result;", self.members(value)?, ""))
    }

    /// Whether it is a struct that HLSL makes by a list of its members only.
    fn is_made_anew(&self, value: &Expression) -> bool {
        let Form::Call { name, .. } = &value.what else { return false };
        self.language == Language::Hlsl && self.scope.declarations.fields(&name.word).is_some()
    }

    fn members(&self, value: &Expression) -> Result<String, Refusal> {
        let Form::Call { arguments, .. } = &value.what else { unreachable!("a struct is made by a call") };
        self.scope.type_of(value)?;
        let mut text = "{".to_owned();
        for (index, argument) in arguments.iter().enumerate() {
            text += if index == 0 { "" } else { "," };
            text += &self.after(" ", argument)?;
        }
        Ok(text + " }")
    }

    fn value(&self, value: &Expression) -> Result<String, Refusal> {
        spell(value, self.language, &self.scope)
    }

    fn after(&self, space: &str, value: &Expression) -> Result<String, Refusal> {
        spell_after(space, value, self.language, &self.scope)
    }
}
