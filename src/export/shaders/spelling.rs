//! Expressions in other languages.

use super::functions::built_in;
use super::language::Language;
use super::refusal::Refusal;
use super::scope::Scope;
use super::syntax::{Expression, Form, TypeName};
use super::types::{F32, Scalar, Type};

/// An expression that has been written.
struct Written {
    text: String,
    binds: Binds,
}

/// What may stand beside an expression without taking a part of it for its own; each may what those before it may.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd)]
enum Binds {
    /// Commas: it is a choice by `?`.
    Choice,
    /// Operators: it is a cast.
    Cast,
    /// A member's name.
    Tight,
}

/// Writes an expression; its first token's line break is left to whoever puts it somewhere.
pub(super) fn spell(expression: &Expression, language: Language, scope: &Scope<'_>) -> Result<String, Refusal> {
    Ok(Speller { language, scope }.write(expression)?.text)
}

/// The same after a separator: on a line of its own where it begins one in the source, else after `space`.
pub(super) fn spell_after(
    space: &str,
    expression: &Expression,
    language: Language,
    scope: &Scope<'_>,
) -> Result<String, Refusal> {
    Ok(format!("{}{}", separator(space, expression.indent), spell(expression, language, scope)?))
}

/// A line break and its indent, or `space`.
pub(super) fn separator(space: &str, indent: Option<usize>) -> String {
    indent.map_or_else(|| space.to_owned(), |indent| format!("\n{:indent$}", ""))
}

struct Speller<'a> {
    language: Language,
    scope: &'a Scope<'a>,
}

impl Speller<'_> {
    fn write(&self, expression: &Expression) -> Result<Written, Refusal> {
        let refuse = |problem: &str| Err(Refusal::new(expression.line, problem));
        let text = match &expression.what {
            Form::Number(text) => self.number(text),
            Form::Bool(is) => is.to_string(),
            Form::Name(name) => name.clone(),
            Form::Parentheses(inner) => format!("({})", self.inside(inner)?),
            Form::Unary { operator, value } => {
                let value = self.operand(value)?;
                // Two of them take one away.
                let space = if operator == "-" && value.starts_with('-') { " " } else { "" };
                format!("{operator}{space}{value}")
            }
            Form::Binary { .. } => self.binary(expression)?,
            Form::Call { name, arguments } if name.word == "select" => {
                self.scope.type_of(expression)?;
                let [no, yes, when] = arguments.as_slice() else { return refuse("select takes three values") };
                let is_struct = matches!(self.scope.type_of(yes)?, Type::Struct(_));
                if is_struct {
                    return refuse("a choice between structs, which HLSL does not know");
                }
                let text = format!("{} ? {} : {}", self.operand(when)?, self.operand(yes)?, self.operand(no)?);
                return Ok(Written { text, binds: Binds::Choice });
            }
            Form::Call { name, arguments } => return self.call(expression, name, arguments),
            Form::Member { of, name } => self.member(of, name)?,
            Form::Index { of, index } => self.index(of, index)?,
        };
        Ok(tight(text))
    }

    /// In parentheses or between commas: without parentheses of its own.
    fn inside(&self, expression: &Expression) -> Result<String, Refusal> {
        match &expression.what {
            Form::Parentheses(inner) => self.inside(inner),
            _ => Ok(separator("", expression.indent) + &self.write(expression)?.text),
        }
    }

    /// Next to an operator.
    fn operand(&self, expression: &Expression) -> Result<String, Refusal> {
        self.binding(Binds::Cast, expression)
    }

    /// In parentheses unless it binds as tightly.
    fn binding(&self, least: Binds, expression: &Expression) -> Result<String, Refusal> {
        let Written { text, binds } = self.write(expression)?;
        Ok(if binds < least { format!("({text})") } else { text })
    }

    fn number(&self, text: &str) -> String {
        // Without the suffix it is a double in C++.
        let is_float = text.contains(['.', 'e']) && !text.starts_with("0x");
        if self.language == Language::Msl && is_float { format!("{text}f") } else { text.to_owned() }
    }

    fn binary(&self, expression: &Expression) -> Result<String, Refusal> {
        let Form::Binary { operator, operator_indent, left, right } = &expression.what else { unreachable!() };
        let kind = self.scope.type_of(expression)?;
        let types = [self.scope.type_of(left)?, self.scope.type_of(right)?];
        let is_linear =
            operator == "*" && types.iter().any(|kind| matches!(kind, Type::Matrix(_))) && !types.contains(&F32);
        if is_linear && self.language == Language::Hlsl {
            return Ok(format!("mul({}, {})", self.inside(left)?, self.inside(right)?));
        }
        let is_by_component = matches!(kind, Type::Vector(_, Scalar::Bool));
        if is_by_component && self.language.is_glsl() {
            let function = match operator.as_str() {
                "==" => "equal",
                "!=" => "notEqual",
                "<" => "lessThan",
                "<=" => "lessThanEqual",
                ">" => "greaterThan",
                _ => "greaterThanEqual",
            };
            return Ok(format!("{function}({}, {})", self.inside(left)?, self.inside(right)?));
        }
        let before = separator(" ", *operator_indent);
        let after = separator(" ", right.indent);
        Ok(format!("{}{before}{operator}{after}{}", self.operand(left)?, self.operand(right)?))
    }

    fn call(&self, whole: &Expression, name: &TypeName, arguments: &[Expression]) -> Result<Written, Refusal> {
        let kind = self.scope.type_of(whole)?;
        let word = name.word.as_str();
        let is_ours = self.scope.declarations.function(word).is_some();
        if matches!(kind, Type::Struct(_)) && !is_ours {
            return match self.language {
                Language::GlslEs300 | Language::Glsl450 => self.with_arguments(word, arguments),
                Language::Msl => Ok(tight(format!("{word}{{{}}}", self.arguments(arguments)?))),
                Language::Hlsl => Err(Refusal::new(
                    whole.line,
                    format!("{word} is made within an expression: give it a name, or return it"),
                )),
            };
        }
        match word {
            _ if is_ours => self.with_arguments(word, arguments),
            "bitcast" => self.bitcast(&kind, arguments),
            "textureDimensions" => self.dimensions(arguments),
            "textureLoad" => self.load(arguments),
            "transpose" if self.language == Language::Hlsl => self.transpose(arguments),
            // An int in HLSL.
            "sign" if self.language == Language::Hlsl => {
                let value = self.with_arguments("sign", arguments)?.text;
                Ok(tight(format!("{}({value})", self.language.type_name(&kind))))
            }
            _ => match built_in(word) {
                Some(function) => {
                    let name = match self.language {
                        Language::GlslEs300 | Language::Glsl450 => function.glsl,
                        Language::Hlsl => function.hlsl,
                        Language::Msl => function.msl,
                    };
                    self.with_arguments(name, arguments)
                }
                None => self.constructor(&kind, arguments),
            },
        }
    }

    fn with_arguments(&self, name: &str, arguments: &[Expression]) -> Result<Written, Refusal> {
        Ok(tight(format!("{name}({})", self.arguments(arguments)?)))
    }

    fn arguments(&self, arguments: &[Expression]) -> Result<String, Refusal> {
        let mut text = String::new();
        for (index, argument) in arguments.iter().enumerate() {
            let Written { text: written, .. } = self.write(argument)?;
            let comma = if index == 0 { "" } else { "," };
            text += comma;
            text += &separator(if index == 0 { "" } else { " " }, argument.indent);
            text += &written;
        }
        Ok(text)
    }

    fn constructor(&self, kind: &Type, arguments: &[Expression]) -> Result<Written, Refusal> {
        let name = self.language.type_name(kind);
        let types = arguments.iter().map(|argument| self.scope.type_of(argument)).collect::<Result<Vec<_>, _>>()?;
        let are_scalars = types.iter().all(|kind| matches!(kind, Type::Scalar(_)));
        match (self.language, kind) {
            (Language::Hlsl, Type::Matrix(_)) if arguments.is_empty() => Ok(cast(&name, "0.0")),
            (_, Type::Matrix(_)) if arguments.is_empty() => Ok(tight(format!("{name}({})", self.number("0.0")))),
            // By rows.
            (Language::Hlsl, Type::Matrix(size)) if are_scalars => {
                let rows: Vec<Expression> =
                    (0..size * size).map(|k| arguments[k % size * size + k / size].clone()).collect();
                self.with_arguments(&name, &rows)
            }
            (Language::Hlsl, Type::Matrix(_)) => {
                Ok(tight(format!("transpose({})", self.with_arguments(&name, arguments)?.text)))
            }
            (Language::Hlsl, Type::Vector(..)) if types.len() == 1 && are_scalars => {
                let is_operation = matches!(arguments[0].what, Form::Binary { .. });
                let value = self.binding(Binds::Tight, &arguments[0])?;
                Ok(cast(&name, &if is_operation { format!("({value})") } else { value }))
            }
            _ => self.with_arguments(&name, arguments),
        }
    }

    /// In HLSL the transpose of columns are rows, which are what a constructor takes.
    fn transpose(&self, arguments: &[Expression]) -> Result<Written, Refusal> {
        let [matrix] = arguments else { unreachable!("its type has been found") };
        if let Form::Call { name, arguments: columns } = &matrix.what
            && name.is_constructor()
            && let Ok(kind @ Type::Matrix(size)) = self.scope.type_of(matrix)
            && columns.len() == size
        {
            return self.with_arguments(&self.language.type_name(&kind), columns);
        }
        self.with_arguments("transpose", arguments)
    }

    fn bitcast(&self, to: &Type, arguments: &[Expression]) -> Result<Written, Refusal> {
        let [value] = arguments else { unreachable!("its type has been found") };
        let from = self.scope.type_of(value)?.component();
        let to_word = to.component();
        let name = match (self.language, from, to_word) {
            (Language::Msl, ..) => format!("as_type<{}>", self.language.type_name(to)),
            (Language::GlslEs300 | Language::Glsl450, Some(Scalar::F32), Some(Scalar::U32)) => {
                "floatBitsToUint".to_owned()
            }
            (Language::GlslEs300 | Language::Glsl450, Some(Scalar::F32), Some(Scalar::I32)) => {
                "floatBitsToInt".to_owned()
            }
            (Language::GlslEs300 | Language::Glsl450, Some(Scalar::U32), Some(Scalar::F32)) => {
                "uintBitsToFloat".to_owned()
            }
            (Language::GlslEs300 | Language::Glsl450, Some(Scalar::I32), Some(Scalar::F32)) => {
                "intBitsToFloat".to_owned()
            }
            (Language::Hlsl, Some(Scalar::F32), Some(Scalar::U32)) => "asuint".to_owned(),
            (Language::Hlsl, Some(Scalar::F32), Some(Scalar::I32)) => "asint".to_owned(),
            (Language::Hlsl, Some(Scalar::U32 | Scalar::I32), Some(Scalar::F32)) => "asfloat".to_owned(),
            _ => return Err(Refusal::new(value.line, "a bitcast between these types")),
        };
        self.with_arguments(&name, arguments)
    }

    fn dimensions(&self, arguments: &[Expression]) -> Result<Written, Refusal> {
        let [texture, level] = arguments else { unreachable!("its type has been found") };
        check_level(level)?;
        let texture = self.write(texture)?.text;
        Ok(tight(match self.language {
            Language::GlslEs300 | Language::Glsl450 => format!("uvec2(textureSize({texture}, 0))"),
            Language::Hlsl => dimensions_name(&texture),
            Language::Msl => format!("uint2({texture}.get_width(), {texture}.get_height())"),
        }))
    }

    fn load(&self, arguments: &[Expression]) -> Result<Written, Refusal> {
        let [texture, at, level] = arguments else { unreachable!("its type has been found") };
        check_level(level)?;
        let texture = self.write(texture)?.text;
        // Components go into the vector that the language wants.
        let parts = match &at.what {
            Form::Call { name, arguments } if name.word == "vec2" && arguments.len() == 2 => {
                self.arguments(arguments)?
            }
            _ => self.inside(at)?,
        };
        let is_split = matches!(&at.what, Form::Call { name, .. } if name.word == "vec2");
        Ok(tight(match self.language {
            Language::GlslEs300 | Language::Glsl450 => format!("texelFetch({texture}, ivec2({parts}), 0)"),
            Language::Hlsl => format!("{texture}.Load(int3({parts}, 0))"),
            Language::Msl if is_split => format!("{texture}.read(uint2({parts}))"),
            Language::Msl => format!("{texture}.read({parts})"),
        }))
    }

    fn member(&self, of: &Expression, name: &str) -> Result<String, Refusal> {
        // HLSL's m[k] is a row.
        if self.language == Language::Hlsl
            && let Form::Index { of: matrix, index } = &of.what
            && matches!(self.scope.type_of(matrix)?, Type::Matrix(_))
        {
            let (matrix, column) = (self.binding(Binds::Tight, matrix)?, self.inside(index)?);
            let row = |letter: char| "xyzw".find(letter).or_else(|| "rgba".find(letter)).unwrap_or_default();
            let entries: Vec<String> =
                name.chars().map(|letter| format!("{matrix}[{}][{column}]", row(letter))).collect();
            return Ok(match entries.as_slice() {
                [entry] => entry.clone(),
                entries => format!("float{}({})", entries.len(), entries.join(", ")),
            });
        }
        Ok(format!("{}.{name}", self.binding(Binds::Tight, of)?))
    }

    fn index(&self, of: &Expression, index: &Expression) -> Result<String, Refusal> {
        let is_matrix = matches!(self.scope.type_of(of)?, Type::Matrix(_));
        let (of, index) = (self.binding(Binds::Tight, of)?, self.inside(index)?);
        // HLSL's m[k] is a row.
        let is_by_rows = is_matrix && self.language == Language::Hlsl;
        Ok(if is_by_rows { format!("transpose({of})[{index}]") } else { format!("{of}[{index}]") })
    }
}

/// Tables have one level.
fn check_level(level: &Expression) -> Result<(), Refusal> {
    match &level.what {
        Form::Number(text) if text.trim_end_matches('u') == "0" => Ok(()),
        _ => Err(Refusal::new(level.line, "a level other than 0")),
    }
}

/// The variable that holds a texture's size in HLSL, where asking for it is a statement.
pub(super) fn dimensions_name(texture: &str) -> String {
    format!("{texture}_size")
}

fn tight(text: String) -> Written {
    Written { text, binds: Binds::Tight }
}

fn cast(kind: &str, value: &str) -> Written {
    Written { text: format!("({kind}){value}"), binds: Binds::Cast }
}
