//! What names stand for: at the top of files, and within functions.

use std::collections::HashMap;

use super::parse::File;
use super::refusal::Refusal;
use super::reserved::check;
use super::syntax::{Function, Item, TypeName, Typed};
use super::types::Type;

/// What a function takes and gives.
#[derive(Clone, Debug)]
pub(super) struct Signature {
    pub parameters: Vec<Type>,
    pub result: Type,
}

/// Everything that is declared at the top of files.
#[derive(Clone, Debug, Default)]
pub(super) struct Declarations {
    structs: HashMap<String, Vec<(String, Type)>>,
    functions: HashMap<String, Signature>,
    /// Constants, by the expressions' types, which whoever reads the values enters.
    constants: HashMap<String, Type>,
}

impl Declarations {
    /// Adds the structs and functions of a file.
    pub fn add(&mut self, file: &File) -> Result<(), Refusal> {
        for item in &file.items {
            if let Item::Struct { name, fields } = &item.what {
                check(name, item.line)?;
                let fields = fields.iter().map(|field| self.typed(&field.what, field.line));
                let fields = fields.collect::<Result<_, _>>()?;
                self.structs.insert(name.clone(), fields);
            }
        }
        for item in &file.items {
            if let Item::Function(function) = &item.what {
                check(&function.name, item.line)?;
                let signature = self.signature(function, item.line)?;
                self.functions.insert(function.name.clone(), signature);
            }
        }
        Ok(())
    }

    pub fn add_constant(&mut self, name: &str, kind: Type) {
        self.constants.insert(name.to_owned(), kind);
    }

    fn signature(&self, function: &Function, line: usize) -> Result<Signature, Refusal> {
        let parameters = function.parameters.iter().map(|parameter| self.typed(parameter, line).map(|(_, kind)| kind));
        let result = function.result.as_ref().map_or(Ok(Type::Nothing), |name| self.type_of(name, line))?;
        Ok(Signature { parameters: parameters.collect::<Result<_, _>>()?, result })
    }

    fn typed(&self, typed: &Typed, line: usize) -> Result<(String, Type), Refusal> {
        check(&typed.name, line)?;
        Ok((typed.name.clone(), self.type_of(&typed.kind, line)?))
    }

    /// The type that a name stands for. Structs are known from their declaration on.
    pub fn type_of(&self, name: &TypeName, line: usize) -> Result<Type, Refusal> {
        Type::built_in(name)
            .or_else(|| self.structs.contains_key(&name.word).then(|| Type::Struct(name.word.clone())))
            .ok_or_else(|| Refusal::new(line, format!("the type {} is not known here", name.word)))
    }

    pub fn fields(&self, name: &str) -> Option<&[(String, Type)]> {
        self.structs.get(name).map(Vec::as_slice)
    }

    pub fn function(&self, name: &str) -> Option<&Signature> {
        self.functions.get(name)
    }

    pub fn constant(&self, name: &str) -> Option<&Type> {
        self.constants.get(name)
    }
}
