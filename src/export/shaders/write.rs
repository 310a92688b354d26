//! A file in another language.

use super::declarations::Declarations;
use super::language::Language;
use super::parse::{File, parse_head};
use super::refusal::Refusal;
use super::reserved::check;
use super::scope::Scope;
use super::spelling::{separator, spell};
use super::statements::{self, Statements};
use super::syntax::{Expression, Function, Item, Lead, Noted, TypeName, Typed};
use super::types::Type;
use super::walk::{calculates, calls, calls_function};

/// Writes a file whose names, and those of the files that it is copied with, are declared.
pub(super) fn write(file: &File, language: Language, declarations: &Declarations) -> Result<String, Refusal> {
    let writer = Writer { language, declarations };
    let mut text = String::new();
    let first_function = file.items.iter().position(|item| matches!(item.what, Item::Function(_)));
    for (index, item) in file.items.iter().enumerate() {
        let is_function = matches!(item.what, Item::Function(_));
        if !is_function && first_function.is_some_and(|first| first < index) {
            return Err(Refusal::new(item.line, "a constant or struct behind a function, which may need it"));
        }
        if Some(index) == first_function {
            text += &writer.prototypes(file, item.line)?;
        }
        text += &writer.top_lead(&item.lead)?;
        text += &match &item.what {
            Item::Const { name, kind, value } => writer.constant(name, kind.as_ref(), value, item)?,
            Item::Struct { name, fields } => writer.structure(name, fields, item)?,
            Item::Function(function) => writer.function(function, item.line)?,
        };
    }
    Ok(text + &writer.lead(&file.tail, 0))
}

/// How a comment begins that tells a function's head.
const HEAD_IN_COMMENT: &str = "//     fn ";

struct Writer<'a> {
    language: Language,
    declarations: &'a Declarations,
}

impl Writer<'_> {
    fn lead(&self, lead: &[Lead], indent: usize) -> String {
        statements::lead(lead, indent, self.language)
    }

    /// Comments that tell heads of functions tell them in this language.
    fn top_lead(&self, lead: &[Lead]) -> Result<String, Refusal> {
        let mut text = String::new();
        for line in lead {
            text += &match line {
                Lead::Comment { text: comment, line: at } if comment.starts_with(HEAD_IN_COMMENT) => {
                    let head = parse_head(&comment[HEAD_IN_COMMENT.len()..]).map_err(|refusal| refusal.at(*at))?;
                    format!("//     {};\n", self.head(&head, *at)?)
                }
                _ => self.lead(std::slice::from_ref(line), 0),
            };
        }
        Ok(text)
    }

    fn note(&self, comment: Option<&String>) -> String {
        statements::note(comment, self.language)
    }

    fn constant(
        &self,
        name: &str,
        kind: Option<&TypeName>,
        value: &Expression,
        item: &Noted<Item>,
    ) -> Result<String, Refusal> {
        check(name, item.line)?;
        let scope = Scope::new(self.declarations);
        let found = scope.type_of(value)?;
        if calls_function(value) {
            return Err(Refusal::new(item.line, "a constant that a function makes, which Metal does not know"));
        }
        if calculates(value) && !matches!(found, Type::Scalar(_)) {
            return Err(Refusal::new(item.line, "a constant that is calculated from vectors or matrices"));
        }
        if kind.is_some_and(|kind| self.declarations.type_of(kind, item.line).is_ok_and(|kind| kind != found)) {
            return Err(Refusal::new(item.line, format!("{name} has a value of another type")));
        }
        let (before, kind) = (self.language.constant(), self.language.type_name(&found));
        let value = spell(value, self.language, &scope)?;
        Ok(format!("{before}{kind} {name} = {value};{}\n", self.note(item.comment.as_ref())))
    }

    /// Comments behind fields stand in one column.
    fn structure(&self, name: &str, fields: &[Noted<Typed>], item: &Noted<Item>) -> Result<String, Refusal> {
        let mut lines = Vec::new();
        for field in fields {
            let kind = self.type_name(&field.what.kind, field.line)?;
            lines.push(format!("    {kind} {};", field.what.name));
        }
        let noted = || fields.iter().zip(&lines).filter(|(field, _)| field.comment.is_some());
        let column = noted().map(|(_, line)| line.len()).max().unwrap_or(0);
        let mut text = format!("struct {name} {{{}\n", self.note(item.comment.as_ref()));
        for (field, line) in fields.iter().zip(&lines) {
            text += &self.lead(&field.lead, 4);
            let padded = if field.comment.is_some() { format!("{line:column$}") } else { line.clone() };
            text += &format!("{padded}{}\n", self.note(field.comment.as_ref()));
        }
        Ok(text + "};\n")
    }

    fn function(&self, function: &Function, line: usize) -> Result<String, Refusal> {
        let mut scope = Scope::new(self.declarations);
        for parameter in &function.parameters {
            scope.add(&parameter.name, self.declarations.type_of(&parameter.kind, line)?);
        }
        let body = Statements::new(self.language, scope, self.result(function, line)?).block(&function.body, 0)?;
        Ok(format!("{} {body}\n", self.head(function, line)?))
    }

    fn result(&self, function: &Function, line: usize) -> Result<Type, Refusal> {
        function.result.as_ref().map_or(Ok(Type::Nothing), |name| self.declarations.type_of(name, line))
    }

    /// Result, name and parameters.
    fn head(&self, function: &Function, line: usize) -> Result<String, Refusal> {
        let result = self.language.type_name(&self.result(function, line)?);
        let mut parameters = String::new();
        for (index, parameter) in function.parameters.iter().enumerate() {
            let (comma, space) = if index == 0 { ("", "") } else { (",", " ") };
            let kind = self.type_name(&parameter.kind, line)?;
            parameters += &format!("{comma}{}{kind} {}", separator(space, parameter.indent), parameter.name);
        }
        Ok(format!("{}{result} {}({parameters})", self.language.function(), function.name))
    }

    fn type_name(&self, name: &TypeName, line: usize) -> Result<String, Refusal> {
        Ok(self.language.type_name(&self.declarations.type_of(name, line)?))
    }

    /// WGSL knows its functions in any order. Those that are called before they are defined are declared first.
    fn prototypes(&self, file: &File, line: usize) -> Result<String, Refusal> {
        let functions: Vec<&Function> = file
            .items
            .iter()
            .filter_map(|item| if let Item::Function(function) = &item.what { Some(function) } else { None })
            .collect();
        let mut text = String::new();
        for (index, function) in functions.iter().enumerate() {
            let is_early = functions[..index].iter().any(|earlier| calls(&earlier.body).contains(&&*function.name));
            if is_early {
                text += &format!("{};\n", self.head(function, line)?);
            }
        }
        Ok(if text.is_empty() { text } else { format!("\n// Used above their definitions.\n{text}") })
    }
}
