//! The functions that WGSL brings along, by the types that they give and their names elsewhere.

use super::types::{BOOL, F32, Scalar, Type};

/// How the type of a result follows from the arguments'.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Gives {
    /// That of the first one; the others are of its type too.
    First,
    /// That of the first one; the last may be an f32 too.
    Mixed,
    Float,
    Bool,
}

/// A built-in function.
#[derive(Debug)]
pub(super) struct BuiltIn {
    pub name: &'static str,
    pub arguments: usize,
    pub gives: Gives,
    pub glsl: &'static str,
    pub hlsl: &'static str,
    pub msl: &'static str,
}

const fn same(name: &'static str, arguments: usize, gives: Gives) -> BuiltIn {
    BuiltIn { name, arguments, gives, glsl: name, hlsl: name, msl: name }
}

const fn named(
    name: &'static str,
    arguments: usize,
    glsl: &'static str,
    hlsl: &'static str,
    msl: &'static str,
) -> BuiltIn {
    BuiltIn { name, arguments, gives: Gives::First, glsl, hlsl, msl }
}

/// Those that mean the same everywhere. What is missing here is refused.
const BUILT_IN: [BuiltIn; 32] = [
    same("abs", 1, Gives::First),
    same("acos", 1, Gives::First),
    same("all", 1, Gives::Bool),
    same("any", 1, Gives::Bool),
    same("asin", 1, Gives::First),
    named("atan2", 2, "atan", "atan2", "atan2"),
    same("ceil", 1, Gives::First),
    same("clamp", 3, Gives::First),
    same("cos", 1, Gives::First),
    same("cross", 2, Gives::First),
    same("distance", 2, Gives::Float),
    same("dot", 2, Gives::Float),
    same("exp", 1, Gives::First),
    same("exp2", 1, Gives::First),
    same("floor", 1, Gives::First),
    named("fract", 1, "fract", "frac", "fract"),
    named("inverseSqrt", 1, "inversesqrt", "rsqrt", "rsqrt"),
    same("length", 1, Gives::Float),
    same("log", 1, Gives::First),
    same("log2", 1, Gives::First),
    same("max", 2, Gives::First),
    same("min", 2, Gives::First),
    BuiltIn { name: "mix", arguments: 3, gives: Gives::Mixed, glsl: "mix", hlsl: "lerp", msl: "mix" },
    same("normalize", 1, Gives::First),
    same("pow", 2, Gives::First),
    same("sign", 1, Gives::First),
    same("sin", 1, Gives::First),
    same("smoothstep", 3, Gives::First),
    same("sqrt", 1, Gives::First),
    same("step", 2, Gives::First),
    same("tan", 1, Gives::First),
    same("transpose", 1, Gives::First),
];

/// The built-in function of a name.
pub(super) fn built_in(name: &str) -> Option<&'static BuiltIn> {
    BUILT_IN.iter().find(|function| function.name == name)
}

impl BuiltIn {
    /// The type of the result; what is wrong with the arguments, if anything.
    pub fn result(&self, arguments: &[Type]) -> Result<Type, String> {
        let wrong = || Err(format!("{} does not take arguments of these types", self.name));
        let [first, others @ ..] = arguments else { return wrong() };
        if arguments.len() != self.arguments {
            return Err(format!("{} takes {} arguments", self.name, self.arguments));
        }
        let (last, between) = others.split_last().unwrap_or((first, &[]));
        let is_mixed = self.gives == Gives::Mixed && last == &F32 && first.component() == Some(Scalar::F32);
        if between.iter().any(|other| other != first) || !(last == first || is_mixed) {
            return wrong();
        }
        let is_matrix = matches!(first, Type::Matrix(_));
        let of = first.component();
        let fits = match (self.name, self.gives) {
            ("transpose", _) => is_matrix,
            (_, Gives::Bool) => matches!(first, Type::Vector(_, Scalar::Bool)),
            ("abs", _) => of == Some(Scalar::F32) || of == Some(Scalar::I32),
            ("clamp" | "max" | "min", _) => of.is_some_and(|of| of != Scalar::Bool),
            ("cross", _) => first == &Type::Vector(3, Scalar::F32),
            _ => of == Some(Scalar::F32),
        };
        match self.gives {
            _ if !fits => wrong(),
            Gives::First | Gives::Mixed => Ok(first.clone()),
            Gives::Float => Ok(F32),
            Gives::Bool => Ok(BOOL),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_follow_from_arguments() {
        let vector = Type::Vector(3, Scalar::F32);
        let result = |name, arguments: &[Type]| built_in(name).unwrap().result(arguments);
        assert_eq!(result("max", &[vector.clone(), vector.clone()]), Ok(vector.clone()));
        assert_eq!(result("mix", &[vector.clone(), vector.clone(), F32]), Ok(vector.clone()));
        assert_eq!(result("dot", &[vector.clone(), vector.clone()]), Ok(F32));
        assert!(result("max", &[vector.clone(), F32]).is_err());
        assert!(result("all", &[BOOL]).is_err() && result("all", &[Type::Vector(2, Scalar::Bool)]).is_ok());
        assert!(result("sign", &[Type::Scalar(Scalar::I32)]).is_err());
        assert!(result("abs", &[Type::Scalar(Scalar::U32)]).is_err());
        assert!(result("sqrt", &[Type::Scalar(Scalar::U32)]).is_err());
        assert!(result("sqrt", &[F32, F32]).is_err());
        assert!(built_in("textureSample").is_none());
    }
}
