//! Types, which WGSL leaves out where they follow from the values and other languages want.

use super::syntax::TypeName;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    Bool,
    I32,
    U32,
    F32,
}

/// The type of a value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Type {
    Scalar(Scalar),
    /// 2 to 4 of them.
    Vector(usize, Scalar),
    /// Square, of f32.
    Matrix(usize),
    Struct(String),
    /// Of two dimensions and f32.
    Texture,
    /// What a function without a result gives.
    Nothing,
}

pub(super) const BOOL: Type = Type::Scalar(Scalar::Bool);
pub(super) const F32: Type = Type::Scalar(Scalar::F32);
pub(super) const I32: Type = Type::Scalar(Scalar::I32);
pub(super) const U32: Type = Type::Scalar(Scalar::U32);

impl TypeName {
    /// Whether a call of this name makes a number, vector or matrix.
    pub fn is_constructor(&self) -> bool {
        Type::built_in(self).is_some() || generic(&self.word).is_some()
    }
}

impl Type {
    /// The type that a name stands for where it is one of the language's own.
    pub fn built_in(name: &TypeName) -> Option<Self> {
        let component = name.of.as_deref().map(scalar);
        match (generic(&name.word), component) {
            (Some(Generic::Vector(size)), Some(Some(of))) => return Some(Self::Vector(size, of)),
            (Some(Generic::Matrix(size)), Some(Some(Scalar::F32))) => return Some(Self::Matrix(size)),
            _ => {}
        }
        match (name.word.as_str(), &name.of) {
            ("texture_2d", Some(of)) if of == "f32" => Some(Self::Texture),
            (word, None) => scalar(word).map(Self::Scalar).or_else(|| short(word)),
            _ => None,
        }
    }

    /// Of a scalar or of a vector's components.
    pub fn component(&self) -> Option<Scalar> {
        match self {
            Self::Scalar(scalar) | Self::Vector(_, scalar) => Some(*scalar),
            _ => None,
        }
    }

    /// The same shape of other components.
    pub fn with(&self, component: Scalar) -> Self {
        match self {
            Self::Vector(size, _) => Self::Vector(*size, component),
            _ => Self::Scalar(component),
        }
    }

    /// How many numbers a constructor takes it for.
    pub fn length(&self) -> usize {
        match self {
            Self::Vector(size, _) => *size,
            Self::Matrix(size) => size * size,
            _ => 1,
        }
    }
}

/// A type whose components are told by its brackets, or by what it is made from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Generic {
    Vector(usize),
    Matrix(usize),
}

pub(super) fn generic(word: &str) -> Option<Generic> {
    Some(match word {
        "vec2" => Generic::Vector(2),
        "vec3" => Generic::Vector(3),
        "vec4" => Generic::Vector(4),
        "mat2x2" => Generic::Matrix(2),
        "mat3x3" => Generic::Matrix(3),
        "mat4x4" => Generic::Matrix(4),
        _ => return None,
    })
}

pub(super) fn scalar(word: &str) -> Option<Scalar> {
    Some(match word {
        "bool" => Scalar::Bool,
        "i32" => Scalar::I32,
        "u32" => Scalar::U32,
        "f32" => Scalar::F32,
        _ => return None,
    })
}

/// `vec3f`, `mat3x3f` and their like.
fn short(word: &str) -> Option<Type> {
    let (generic_word, suffix) = word.split_at_checked(word.len().checked_sub(1)?)?;
    let component = match suffix {
        "i" => Scalar::I32,
        "u" => Scalar::U32,
        "f" => Scalar::F32,
        _ => return None,
    };
    match generic(generic_word)? {
        Generic::Vector(size) => Some(Type::Vector(size, component)),
        Generic::Matrix(size) => (component == Scalar::F32).then_some(Type::Matrix(size)),
    }
}
