//! `velour export shaders`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use velour::export::shaders::{self, SOURCES, Source};
use velour::file::write_atomically;

use crate::console::say;
use crate::failure::Failure;
use crate::output::prepare;

/// The flags of `velour export shaders`.
#[derive(Args)]
pub struct Shaders {
    /// Folder of the files; made if it is not there
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// The language
    #[arg(long, value_enum)]
    lang: Language,
}

/// A language, with the version where one is meant.
#[derive(Clone, Copy, ValueEnum, PartialEq)]
enum Language {
    /// OpenGL ES 3.0 and WebGL 2, and any GLSL in which textures come with their samplers
    GlslEs300,
    /// Vulkan, with textures apart from samplers
    #[value(name = "glsl-450")]
    Glsl450,
    /// Direct3D, shader model 5.0 and later
    Hlsl,
    /// Metal
    Msl,
    /// WebGPU: the files that the others are made from, as they are
    Wgsl,
    /// Vulkan: libraries whose functions are exported by name, for spirv-link; but for the loop over lights
    Spirv,
}

impl Language {
    fn extension(self) -> &'static str {
        match self {
            Self::GlslEs300 | Self::Glsl450 => shaders::Language::Glsl450.extension(),
            Self::Hlsl => shaders::Language::Hlsl.extension(),
            Self::Msl => shaders::Language::Msl.extension(),
            Self::Wgsl => "wgsl",
            Self::Spirv => "spv",
        }
    }

    fn bytes(self, source: &Source) -> Result<Vec<u8>, Failure> {
        let translated = |language| {
            let text = source.in_language(language).map_err(|refusal| refusal.to_string());
            text.map(String::into_bytes)
        };
        let bytes = match self {
            Self::GlslEs300 => translated(shaders::Language::GlslEs300),
            Self::Glsl450 => translated(shaders::Language::Glsl450),
            Self::Hlsl => translated(shaders::Language::Hlsl),
            Self::Msl => translated(shaders::Language::Msl),
            Self::Wgsl => Ok(source.text.as_bytes().to_vec()),
            Self::Spirv => shaders::spirv(source.text),
        };
        bytes.map_err(|problem| Failure::input(format!("{}.wgsl, {problem}", source.stem)))
    }
}

pub fn run(arguments: &Shaders) -> Result<(), Failure> {
    let extension = arguments.lang.extension();
    let mut files = Vec::new();
    // A library in SPIR-V has all that it calls.
    let is_whole = |source: &&Source| arguments.lang != Language::Spirv || source.needs.is_empty();
    for source in SOURCES.iter().filter(is_whole) {
        let path = arguments.output.join(format!("{}.{extension}", source.stem));
        files.push((path, arguments.lang.bytes(source)?));
    }
    let paths: Vec<PathBuf> = files.iter().map(|(path, _)| path.clone()).collect();
    prepare(&arguments.output, &paths)?;
    for (path, bytes) in &files {
        write_atomically(path, bytes).map_err(Failure::input)?;
        say(format!("wrote {}", path.display()));
    }
    Ok(())
}
