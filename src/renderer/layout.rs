//! For tests: whether a struct has the same layout in memory in Rust and in WGSL.

use wgpu::naga::{self, TypeInner};

/// The named fields of a Rust struct and their offsets in bytes.
macro_rules! members {
    ($type:ty { $($field:ident),+ }) => {
        &[$((stringify!($field), std::mem::offset_of!($type, $field))),+]
    };
}
pub(super) use members;

/// How the WGSL struct `name` differs from a Rust one of `size` bytes with these `members`. They are the members that
/// WGSL has, in its order, without Rust's padding. In arrays, WGSL's stride is a struct's size.
pub(super) fn differences(wgsl: &str, name: &str, size: usize, members: &[(&str, usize)]) -> Vec<String> {
    let module = naga::front::wgsl::parse_str(wgsl).unwrap_or_else(|error| panic!("{}", error.emit_to_string(wgsl)));
    let found = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name));
    let Some(TypeInner::Struct { members: expected, span }) = found.map(|(_, ty)| &ty.inner) else {
        return vec![format!("WGSL has no struct {name}")];
    };
    let mut differences = Vec::new();
    if *span as usize != size {
        differences.push(format!("{name} takes {size} bytes in Rust, {span} in WGSL"));
    }
    let expected: Vec<(&str, usize)> =
        expected.iter().map(|member| (member.name.as_deref().unwrap_or_default(), member.offset as usize)).collect();
    if expected != members {
        differences.push(format!("{name} has {members:?} in Rust, {expected:?} in WGSL"));
    }
    differences
}

/// The value of a WGSL constant, a literal.
pub(super) fn constant(wgsl: &str, name: &str) -> u32 {
    let module = naga::front::wgsl::parse_str(wgsl).unwrap_or_else(|error| panic!("{}", error.emit_to_string(wgsl)));
    let found = module.constants.iter().find(|(_, constant)| constant.name.as_deref() == Some(name));
    let value = found.map(|(_, constant)| &module.global_expressions[constant.init]);
    match value {
        Some(naga::Expression::Literal(naga::Literal::U32(value))) => *value,
        other => panic!("{name} is {other:?}"),
    }
}

#[test]
fn differences_are_found() {
    let wgsl = "struct Light { color: vec3f, power: f32, place: vec4f } @group(0) @binding(0) var<uniform> l: Light;";
    let right = [("color", 0), ("power", 12), ("place", 16)];
    assert_eq!(differences(wgsl, "Light", 32, &right), [""; 0]);
    assert_eq!(differences(wgsl, "Lamp", 32, &right).len(), 1);
    assert_eq!(differences(wgsl, "Light", 28, &right).len(), 1);
    assert_eq!(differences(wgsl, "Light", 32, &right[..2]).len(), 1);
    assert_eq!(differences(wgsl, "Light", 32, &[("color", 0), ("power", 16), ("place", 20)]).len(), 1);
    assert_eq!(differences(wgsl, "Light", 36, &[("color", 0), ("place", 16), ("power", 12)]).len(), 2);
}
