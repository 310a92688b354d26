//! The shipped files in other languages: those in `shaders/` are what the program makes, and what it cannot translate
//! faithfully it refuses.

use velour::export::shaders::{Language, SOURCES, translate};

use super::files::source;

#[test]
fn the_shipped_translations_are_those_that_are_made() {
    for (language, folder) in Language::ALL.into_iter().filter_map(|language| Some((language, language.folder()?))) {
        for file in SOURCES {
            let name = format!("{folder}/{}.{}", file.stem, language.extension());
            let made = file.in_language(language).unwrap_or_else(|refusal| panic!("{}.wgsl, {refusal}", file.stem));
            assert!(source(&name) == made, "shaders/{name} is not what `velour export shaders` makes");
        }
    }
}

#[test]
fn every_file_that_is_copied_is_translated() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/shaders");
    let mut names: Vec<String> = std::fs::read_dir(root)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter_map(|name| name.strip_suffix(".wgsl").map(str::to_owned))
        .collect();
    // The loop to copy stands in `examples/`.
    names.push("lights".to_owned());
    names.sort();
    let mut stems = SOURCES.map(|file| file.stem.to_owned());
    stems.sort();
    assert_eq!(names, stems);
}

/// The body of `fn f(v: vec3<f32>, m: mat3x3<f32>, n: u32, table: texture_2d<f32>) -> f32`, in a language, or why not.
fn body(statements: &str, language: Language) -> Result<String, String> {
    let text = format!(
        "// A file.\n\nstruct Two {{ x: f32, y: f32 }}\n\nfn mat_of(v: vec3<f32>) -> mat3x3<f32> {{\n    return mat3x3(v, v, v);\n}}\n\nfn f(v: vec3<f32>, m: mat3x3<f32>, n: u32, table: texture_2d<f32>) -> f32 {{\n{statements}\n}}\n"
    );
    let written = translate(&text, "", &[], language).map_err(|refusal| refusal.to_string())?;
    let (_, body) = written.rsplit_once("table) {\n").expect("the function has a head");
    Ok(body.trim_end().trim_end_matches('}').trim_end().to_owned())
}

#[test]
fn each_language_is_written_as_it_is_spoken() {
    for (wgsl, glsl, hlsl, msl) in [
        ("let x = m * v;", "vec3 x = m * v;", "float3 x = mul(m, v);", "float3 x = m * v;"),
        ("let x = m * (v + v);", "vec3 x = m * (v + v);", "float3 x = mul(m, v + v);", "float3 x = m * (v + v);"),
        ("let x = v * m;", "vec3 x = v * m;", "float3 x = mul(v, m);", "float3 x = v * m;"),
        ("let x = 2.0 * m;", "mat3 x = 2.0 * m;", "float3x3 x = 2.0 * m;", "float3x3 x = 2.0f * m;"),
        ("let x = m[2].x;", "float x = m[2].x;", "float x = m[0][2];", "float x = m[2].x;"),
        ("let x = m[1].yz;", "vec2 x = m[1].yz;", "float2 x = float2(m[1][1], m[2][1]);", "float2 x = m[1].yz;"),
        ("let x = m[1];", "vec3 x = m[1];", "float3 x = transpose(m)[1];", "float3 x = m[1];"),
        (
            "let x = mat3x3(v, v, v);",
            "mat3 x = mat3(v, v, v);",
            "float3x3 x = transpose(float3x3(v, v, v));",
            "float3x3 x = float3x3(v, v, v);",
        ),
        (
            "let x = transpose(mat3x3(v, v, v));",
            "mat3 x = transpose(mat3(v, v, v));",
            "float3x3 x = float3x3(v, v, v);",
            "float3x3 x = transpose(float3x3(v, v, v));",
        ),
        (
            "let x = mat2x2(1.0, 2.0, 3.0, 4.0);",
            "mat2 x = mat2(1.0, 2.0, 3.0, 4.0);",
            "float2x2 x = float2x2(1.0, 3.0, 2.0, 4.0);",
            "float2x2 x = float2x2(1.0f, 2.0f, 3.0f, 4.0f);",
        ),
        (
            "let x = mat3x3<f32>();",
            "mat3 x = mat3(0.0);",
            "float3x3 x = (float3x3)0.0;",
            "float3x3 x = float3x3(0.0f);",
        ),
        ("let x = vec3(v.x).y;", "float x = vec3(v.x).y;", "float x = ((float3)v.x).y;", "float x = float3(v.x).y;"),
        (
            "let x = vec2(v.x + 1.0);",
            "vec2 x = vec2(v.x + 1.0);",
            "float2 x = (float2)(v.x + 1.0);",
            "float2 x = float2(v.x + 1.0f);",
        ),
        (
            "let x = vec2<f32>(vec2(n));",
            "vec2 x = vec2(uvec2(n));",
            "float2 x = float2((uint2)n);",
            "float2 x = float2(uint2(n));",
        ),
        (
            "let x = select(1.0, v.x, v.y < 0.0) * 2.0;",
            "float x = (v.y < 0.0 ? v.x : 1.0) * 2.0;",
            "float x = (v.y < 0.0 ? v.x : 1.0) * 2.0;",
            "float x = (v.y < 0.0f ? v.x : 1.0f) * 2.0f;",
        ),
        ("let x = all(v < v);", "bool x = all(lessThan(v, v));", "bool x = all(v < v);", "bool x = all(v < v);"),
        (
            "let x = bitcast<vec3<u32>>(v);",
            "uvec3 x = floatBitsToUint(v);",
            "uint3 x = asuint(v);",
            "uint3 x = as_type<uint3>(v);",
        ),
        ("let x = - -v.x;", "float x = - -v.x;", "float x = - -v.x;", "float x = - -v.x;"),
        ("let x = sign(v);", "vec3 x = sign(v);", "float3 x = float3(sign(v));", "float3 x = sign(v);"),
        (
            "let x = transpose(mat_of(v));",
            "mat3 x = transpose(mat_of(v));",
            "float3x3 x = transpose(mat_of(v));",
            "float3x3 x = transpose(mat_of(v));",
        ),
        (
            "if v.x > 0.0 {\n    } else if textureDimensions(table, 0).x > n {\n    }",
            "if (v.x > 0.0) {\n    } else if (uvec2(textureSize(table, 0)).x > n) {\n    }",
            "uint2 table_size;\n    table.GetDimensions(table_size.x, table_size.y);\n    if (v.x > 0.0) {\n    } else if (table_size.x > n) {\n    }",
            "if (v.x > 0.0f) {\n    } else if (uint2(table.get_width(), table.get_height()).x > n) {\n    }",
        ),
        ("let x = inverseSqrt(v);", "vec3 x = inversesqrt(v);", "float3 x = rsqrt(v);", "float3 x = rsqrt(v);"),
        (
            "let x = mix(v, v, 1e-3);",
            "vec3 x = mix(v, v, 1e-3);",
            "float3 x = lerp(v, v, 1e-3);",
            "float3 x = mix(v, v, 1e-3f);",
        ),
        (
            "let x = atan2(v.x, v.y);",
            "float x = atan(v.x, v.y);",
            "float x = atan2(v.x, v.y);",
            "float x = atan2(v.x, v.y);",
        ),
        (
            "let x = textureLoad(table, vec2(n, 0u), 0);",
            "vec4 x = texelFetch(table, ivec2(n, 0u), 0);",
            "float4 x = table.Load(int3(n, 0u, 0));",
            "float4 x = table.read(uint2(n, 0u));",
        ),
        (
            "let x = textureDimensions(table, 0);",
            "uvec2 x = uvec2(textureSize(table, 0));",
            "uint2 table_size;\n    table.GetDimensions(table_size.x, table_size.y);\n    uint2 x = table_size;",
            "uint2 x = uint2(table.get_width(), table.get_height());",
        ),
        ("let x = Two(1.0, v.x);", "Two x = Two(1.0, v.x);", "Two x = { 1.0, v.x };", "Two x = Two{1.0f, v.x};"),
        (
            "for (var k = 0u; k < n; k++) {\n        if v.x > 0.0 {\n            break;\n        } else if k == 2u {\n            continue;  // two\n        }\n    }",
            "for (uint k = 0u; k < n; k++) {\n        if (v.x > 0.0) {\n            break;\n        } else if (k == 2u) {\n            continue;  // two\n        }\n    }",
            "for (uint k = 0u; k < n; k++) {\n        if (v.x > 0.0) {\n            break;\n        } else if (k == 2u) {\n            continue;  // two\n        }\n    }",
            "for (uint k = 0u; k < n; k++) {\n        if (v.x > 0.0f) {\n            break;\n        } else if (k == 2u) {\n            continue;  // two\n        }\n    }",
        ),
        (
            "let x = v.x\n        + v.y;",
            "float x = v.x\n        + v.y;",
            "float x = v.x\n        + v.y;",
            "float x = v.x\n        + v.y;",
        ),
    ] {
        for (language, expected) in Language::ALL.into_iter().zip([glsl, glsl, hlsl, msl]) {
            let zero = if language == Language::Msl { "0.0f" } else { "0.0" };
            let found = body(&format!("    {wgsl}\n    return 0.0;"), language);
            assert_eq!(found, Ok(format!("    {expected}\n    return {zero};")), "{wgsl}");
        }
    }
}

/// What is refused in every language, and where.
#[test]
fn what_is_not_translated_is_refused_with_its_line() {
    for (statements, problem) in [
        ("    var x: array<f32, 4>;", "line 10: '<'"),
        ("    loop {\n    }", "line 10: '{'"),
        ("    let x = v.x * 2;", "line 10: * between"),
        ("    let x = vec3(1, 2.0, 3.0);", "line 10: vec3 of these arguments"),
        ("    var x: f32;", "line 10: x without a value"),
        ("    let x = nobody(v);", "line 10: nobody"),
        ("    let x = v.q;", "line 10: Vector(3, F32) has no member q"),
        ("    let x = select(v, v, v < v);", "line 10: select"),
        ("    let x = 1.0; // one\n    let y = 1.0 + // two\n    x;", "line 11: a comment"),
        ("    let x = 1.0;\n    if x > 0.0 {\n        let x = 2.0;\n    }", "line 12: the name x hides"),
        ("    let x = textureSampleLevel(table, v.xy, 0.0);", "line 10: textureSampleLevel"),
        ("    let x = textureLoad(table, vec2(n), 1);", "line 10: a level"),
        ("    let x = textureDimensions(table, 1);", "line 10: a level"),
        ("    return 1u;", "line 10: a result of another type"),
        ("    var x = m;\n    x[0] = v;", "line 11: a value for a part of a matrix"),
        ("    var x = m;\n    x[0][1] = 2.0;", "line 11: a value for a part of a matrix"),
        ("    var x = m;\n    x *= m;", "line 11: a product of matrices"),
        ("    let x = 'a';", "line 10: ''' is not understood"),
        ("    let x = 5 % 2;", "line 10: % between"),
        ("    let x = 1E5;", "line 10: the literal 1E5"),
        ("    let x = 0x1p3;", "line 10: the literal 0x1p3"),
        ("    let x = 5000000000;", "line 10: the literal 5000000000"),
        ("    let x = any(v.x < v.y);", "line 10: any"),
        ("    let x = abs(n);", "line 10: abs"),
        ("    let x = sign(1);", "line 10: sign"),
        ("    let texture = 1.0;", "line 10: the name texture"),
        ("    let float3 = 1.0;", "line 10: the name float3"),
        ("    let mat4x3 = 1.0;", "line 10: the name mat4x3"),
        ("    let lessThan = 1.0;", "line 10: the name lessThan"),
        ("    let x = 1.0;  // one \\", "line 10: a comment that ends in a backslash"),
        ("    let x = Two(1.0, 2.0);\n    let y = select(x, x, true);", "line 11: a choice between structs"),
        (
            "    let result = v;\n    return 0.0;\n}\nconst AFTER = 1.0;\nfn g() {",
            "line 13: a constant or struct behind",
        ),
        ("    return 0.0;\n}\nstruct Later { x: f32 }\nfn g() {", "line 12: a constant or struct behind"),
        ("    return 0.0;\n}\n//     fn h(x: q32) -> f32\nfn g() {", "line 12: the type q32"),
        ("    if 1.0 {\n    }", "line 10: a condition"),
    ] {
        for language in Language::ALL {
            let refusal = body(statements, language).expect_err(statements);
            assert!(refusal.starts_with(problem), "{statements} in {language:?}: {refusal}");
            assert!(!refusal.contains('\n'), "{refusal}");
        }
    }
    let hlsl = body("    let x = Two(1.0, 2.0).x;", Language::Hlsl).unwrap_err();
    assert!(hlsl.starts_with("line 10: Two is made within an expression"), "{hlsl}");
}

#[test]
fn what_is_not_translated_at_the_top_is_refused_with_its_line() {
    for (text, line) in [
        ("// A file.\n\nconst ROOT = sqrt(2.0);\n", 3),
        ("// A file.\n\nconst TWICE = 2.0 * vec2(1.0, 2.0);\n", 3),
        ("// A file.\n\n@group(0) @binding(0) var<uniform> x: f32;\n", 3),
        ("// A file.\n\nfn sampler2D() {\n}\n", 3),
        ("// A file.\n\nstruct S {\n    half: f32,\n}\n", 4),
        ("// A file.\n// Example: let x = nobody;\n\nconst ONE = 1.0;\n", 2),
    ] {
        let refusal = translate(text, "fn example() {", &[], Language::Msl).expect_err(text);
        assert_eq!(refusal.line, line, "{text}: {refusal}");
    }
    let before = translate("const ONE = 1.0;\n", "", &["const TWO = 2.0 * 1;\n"], Language::Hlsl).unwrap_err();
    assert!(before.problem.starts_with("of a text before it"), "{before}");
    let comments = "// SPDX-License-Identifier: 0BSD\n";
    assert!(translate(comments, "", &[], Language::Hlsl).unwrap().contains(comments));
}
