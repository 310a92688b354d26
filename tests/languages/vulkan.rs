//! GLSL and HLSL: compiled, and run by Vulkan.

use std::process::Command;

use velour::export::shaders::{Language, SOURCES, spirv as library};

use super::compilers::{compiles, folder, metal, run, spirv, validate};
use super::device::run as run_on_device;
use super::golden::{Rows, assert_right};
use super::shells;
use super::theirs::{by_buffers, theirs};

fn glsl() -> String {
    let (before, after) = (include_str!("shells/before.glsl"), include_str!("shells/after.glsl"));
    format!("{before}{}{after}", shells::rows(Language::Glsl450))
}

fn hlsl() -> String {
    let (before, after) = (include_str!("shells/before.hlsl"), include_str!("shells/after.hlsl"));
    format!("{before}{}{after}", shells::rows(Language::Hlsl))
}

#[test]
fn glsl_gives_the_golden_numbers() {
    let (_folder, path) = folder();
    let rows = Rows::shipped();
    let module = spirv(&path, &glsl(), false);
    assert_right("GLSL 4.50", &rows, &run_on_device(&module, &rows));
}

#[test]
fn hlsl_gives_the_golden_numbers() {
    let (_folder, path) = folder();
    let rows = Rows::shipped();
    let module = spirv(&path, &hlsl(), true);
    assert_right("HLSL", &rows, &run_on_device(&module, &rows));
}

#[test]
fn a_mistake_in_a_language_is_found() {
    let (_folder, path) = folder();
    let rows = Rows::shipped();
    let source = hlsl();
    // What someone writes who takes m_inv for its transpose.
    let wrong = source.replace("mul(lobes.frame", "mul(transpose(lobes.frame)").replace(
        "float3x3(abr.x, 0.0, abr.y, 0.0, abr.x, 0.0, 0.0, 0.0, 1.0)",
        "float3x3(abr.x, 0.0, 0.0, 0.0, abr.x, 0.0, abr.y, 0.0, 1.0)",
    );
    assert_ne!(source, wrong);
    let module = spirv(&path, &wrong, true);
    assert!(!rows.off(&run_on_device(&module, &rows)).is_empty());
}

/// Each file alone, or behind those that it needs, and all of them together.
#[test]
fn every_file_compiles_in_glsl_es() {
    let (_folder, path) = folder();
    let head = "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n";
    let compile = |source: &str| compiles(&path, "shader.frag", source, glslang);
    each_and_all(Language::GlslEs300, |files| compile(&format!("{head}{files}\nvoid main() {{}}\n")));
    assert!(compile(&format!("{head}float f() {{ return 1u; }}\nvoid main() {{}}\n")).is_err(), "it tells errors");
}

/// The loop over lights behind the examples' own reading of lights.
#[test]
fn the_examples_buffers_are_what_the_loop_asks_for() {
    let (_folder, path) = folder();
    let files = |language| {
        let shipped = |stem: &str| SOURCES.iter().find(|source| source.stem == stem)?.in_language(language).ok();
        let [ltc, sheen, ggx, lights] =
            ["ltc", "sheen", "ggx", "lights"].map(|stem| shipped(stem).expect("it is shipped"));
        format!("{ltc}{sheen}{ggx}{}{lights}", by_buffers(language))
    };
    let head = "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n";
    let es = format!("{head}{}\nvoid main() {{}}\n", files(Language::GlslEs300));
    compiles(&path, "shader.frag", &es, glslang).unwrap_or_else(|said| panic!("{said}"));
    let hlsl = format!("{}\nfloat4 main() : SV_Target {{ return (float4)0.0; }}\n", files(Language::Hlsl));
    let compiled = compiles(&path, "shader.frag", &hlsl, |path| {
        let mut compiler = glslang(path);
        compiler.args(["-D", "-V", "-e", "main", "--auto-map-bindings", "-o"]).arg(path.with_extension("spv"));
        compiler
    });
    compiled.unwrap_or_else(|said| panic!("{said}"));
    compiles(&path, "shader.metal", &files(Language::Msl), |path| metal(path, &["-fsyntax-only"]))
        .unwrap_or_else(|said| panic!("{said}"));
}

/// The GLSL with samplers serves desktops too.
#[test]
fn every_file_with_samplers_compiles_in_later_glsl() {
    let (_folder, path) = folder();
    for version in ["330 core", "450 core"] {
        each_and_all(Language::GlslEs300, |files| {
            compiles(&path, "shader.frag", &format!("#version {version}\n{files}\nvoid main() {{}}\n"), glslang)
        });
    }
}

#[test]
fn every_file_compiles_in_vulkans_glsl() {
    let (_folder, path) = folder();
    let head = "#version 450\n#extension GL_EXT_samplerless_texture_functions : require\n";
    each_and_all(Language::Glsl450, |files| {
        let source = format!("{head}{files}\nvoid main() {{}}\n");
        compiles(&path, "shader.frag", &source, |path| {
            let mut compiler = glslang(path);
            compiler.arg("-V").arg("-o").arg(path.with_extension("spv"));
            compiler
        })
    });
}

#[test]
fn every_file_compiles_in_hlsl() {
    let (_folder, path) = folder();
    each_and_all(Language::Hlsl, |files| {
        let source = format!("{files}\nfloat4 main() : SV_Target {{ return (float4)0.0; }}\n");
        compiles(&path, "shader.frag", &source, |path| {
            let mut compiler = glslang(path);
            compiler.args(["-D", "-V", "-e", "main", "-o"]).arg(path.with_extension("spv"));
            compiler
        })
    });
}

/// Modules with the functions' names, which a linker joins.
#[test]
fn spirv_is_valid_and_links() {
    let (_folder, path) = folder();
    let mut modules = Vec::new();
    for source in SOURCES.iter().filter(|source| source.needs.is_empty()) {
        let module = path.join(format!("{}.spv", source.stem));
        let words = library(source.text).expect("shipped files compile");
        std::fs::write(&module, words).expect("the folder takes a file");
        validate(&module, "spv1.1");
        modules.push(module);
    }
    let linked = path.join("all.spv");
    run(Command::new("spirv-link").arg("--create-library").args(&modules).arg("-o").arg(&linked), &[]);
    validate(&linked, "spv1.1");
    let listing = run(Command::new("spirv-dis").arg(&linked), &[]);
    let listing = String::from_utf8(listing).expect("a listing is text");
    for name in ["ltc_edge", "sheen_lobe", "ggx_lobe", "ltc_sample_point"] {
        assert!(listing.contains(&format!("LinkageAttributes \"{name}\" Export")), "{name}");
    }
}

fn glslang(path: &std::path::Path) -> Command {
    let mut compiler = Command::new("glslangValidator");
    compiler.arg(path);
    compiler
}

/// Compiles each file by itself behind those that it needs, and all together: no two clash.
fn each_and_all(language: Language, compile: impl Fn(&str) -> Result<(), String>) {
    let shipped = |stem: &str| {
        let source = SOURCES.iter().find(|source| source.stem == stem).expect("it is one of them");
        source.in_language(language).expect("shipped files are translated")
    };
    for source in SOURCES {
        let needed: String = source.needed().map(|needed| shipped(needed.stem)).collect();
        let files = format!("{needed}{}{}", theirs(&source, language), shipped(source.stem));
        compile(&files).unwrap_or_else(|said| panic!("{} in {language:?}: {said}", source.stem));
    }
    let all: String =
        SOURCES.iter().map(|source| format!("{}{}", theirs(source, language), shipped(source.stem))).collect();
    compile(&all).unwrap_or_else(|said| panic!("all in {language:?}: {said}"));
}
