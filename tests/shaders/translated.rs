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
        "// A file.\n\nstruct Two {{ x: f32, y: f32 }}\n\nfn f(v: vec3<f32>, m: mat3x3<f32>, n: u32, table: texture_2d<f32>) -> f32 {{\n{statements}\n}}\n"
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

#[test]
fn what_is_not_translated_is_refused_with_its_line() {
    for (statements, problem) in [
        ("    var x: array<f32, 4>;", "line 6: '<'"),
        ("    loop {\n    }", "line 6: '{'"),
        ("    let x = v.x * 2;", "line 6: * between"),
        ("    let x = vec3(1, 2.0, 3.0);", "line 6: vec3 of these arguments"),
        ("    var x: f32;", "line 6: x without a value"),
        ("    let x = nobody(v);", "line 6: nobody"),
        ("    let x = v.q;", "line 6: Vector(3, F32) has no member q"),
        ("    let x = select(v, v, v < v);", "line 6: select"),
        ("    let x = 1.0; // one\n    let y = 1.0 + // two\n    x;", "line 7: a comment"),
        ("    let x = 1.0;\n    if x > 0.0 {\n        let x = 2.0;\n    }", "line 8: the name x hides"),
        ("    let x = textureSampleLevel(table, v.xy, 0.0);", "line 6: textureSampleLevel"),
        ("    let x = textureLoad(table, vec2(n), 1);", "line 6: a level"),
        ("    return 1u;", "line 6: a result of another type"),
        ("    var x = m;\n    x[0] = v;", "line 7: a value for a part of a matrix"),
        ("    let x = Two(1.0, 2.0).x;", "line 6: Two is made within an expression"),
        ("    let x = 'a';", "line 6: ''' is not understood"),
        ("    let x = 5 % 2;", "line 6: % between"),
        ("    let texture = 1.0;", "line 6: the name texture"),
        ("    let x = 1.0;  // one \\", "line 6: a comment that ends in a backslash"),
        ("    let x = Two(1.0, 2.0);\n    let y = select(x, x, true);", "line 7: a choice between structs"),
        (
            "    let result = v;\n    return 0.0;\n}\nconst AFTER = 1.0;\nfn g() {",
            "line 9: a constant or struct behind",
        ),
        ("    return 0.0;\n}\nstruct Later { x: f32 }\nfn g() {", "line 8: a constant or struct behind"),
        ("    if 1.0 {\n    }", "line 6: a condition"),
    ] {
        let refusals: Vec<String> =
            Language::ALL.into_iter().filter_map(|language| body(statements, language).err()).collect();
        assert!(refusals.iter().any(|refusal| refusal.starts_with(problem)), "{statements}: {refusals:?}");
        assert!(refusals.iter().all(|refusal| !refusal.contains('\n')), "{refusals:?}");
    }
    let made = translate("// A file.\n\nconst ROOT = sqrt(2.0);\n", "", &[], Language::Msl).unwrap_err();
    assert_eq!(made.line, 3);
    let global = translate("// A file.\n\n@group(0) @binding(0) var<uniform> x: f32;\n", "", &[], Language::Glsl450);
    assert!(global.is_err());
}
