//! A file and those that it is copied with, to another language.

use super::declarations::Declarations;
use super::language::Language;
use super::parse::{File, parse};
use super::refusal::Refusal;
use super::scope::Scope;
use super::statements::lead;
use super::syntax::{Item, Lead, Noted};
use super::write::write;

/// The line of the header that shows a call.
const EXAMPLE: &str = "// Example: ";

/// A file's text in another language: names, comments and layout are kept, types are inferred, no helper is added.
///
/// `known` are WGSL sources whose declarations the file stands on, in an order in which each stands on those before it.
/// `given` declares what the example in the header takes for granted: the head of a function, to its opening brace, and
/// statements. Fails where the file is not within what is translated faithfully; what is, is assumed to turn no floats into integers
/// that these cannot hold: WGSL clamps them, and the others need not.
pub fn translate(text: &str, given: &str, known: &[&str], language: Language) -> Result<String, Refusal> {
    let mut declarations = Declarations::default();
    for source in known {
        let declared = parse(source).and_then(|file| declare(&file, &mut declarations));
        declared.map_err(Refusal::of_another)?;
    }
    let mut file = parse(text)?;
    declare(&file, &mut declarations)?;
    let header = file.items.first_mut().map(split_header).unwrap_or_default();
    let mut written = String::new();
    for comment in header {
        written += &match &comment {
            Lead::Comment { text, line } if text.starts_with(EXAMPLE) => {
                let example = &text[EXAMPLE.len()..];
                let example = translate_example(example, given, declarations.clone(), language);
                format!("{EXAMPLE}{}\n", example.map_err(|refusal| refusal.at(*line))?)
            }
            _ => lead(&[comment], 0, language),
        };
    }
    Ok(written + language.notes() + language.preamble() + &write(&file, language, &declarations)?)
}

/// The comments at the top of the file, up to the first empty line, which stays with the item.
fn split_header(first: &mut Noted<Item>) -> Vec<Lead> {
    let length = first.lead.iter().take_while(|line| matches!(line, Lead::Comment { .. })).count();
    first.lead.drain(..length).collect()
}

/// Enters what a file declares.
fn declare(file: &File, declarations: &mut Declarations) -> Result<(), Refusal> {
    declarations.add(file)?;
    for item in &file.items {
        if let Item::Const { name, value, .. } = &item.what {
            let kind = Scope::new(declarations).type_of(value)?;
            declarations.add_constant(name, kind);
        }
    }
    Ok(())
}

/// Statements on one line.
fn translate_example(
    example: &str,
    given: &str,
    mut declarations: Declarations,
    language: Language,
) -> Result<String, Refusal> {
    let marked = parse(&format!("{given}\n// The example.\n{example}\n}}\n"))?;
    declare(&marked, &mut declarations)?;
    let written = write(&marked, language, &declarations)?;
    let lines = written.lines().skip_while(|line| line.trim() != "// The example.").skip(1);
    let statements: Vec<&str> = lines.map(str::trim).take_while(|line| *line != "}").collect();
    Ok(statements.join(" "))
}
