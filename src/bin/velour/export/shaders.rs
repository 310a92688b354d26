//! `velour export shaders`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use velour::export::shaders::SOURCES;
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
    #[arg(long, value_enum, default_value_t = Language::Wgsl)]
    lang: Language,
}

#[derive(Clone, Copy, ValueEnum)]
enum Language {
    Wgsl,
}

pub fn run(arguments: &Shaders) -> Result<(), Failure> {
    let files: Vec<(PathBuf, &str)> =
        SOURCES.iter().map(|source| (arguments.output.join(format!("{}.wgsl", source.stem)), source.text)).collect();
    let paths: Vec<PathBuf> = files.iter().map(|(path, _)| path.clone()).collect();
    prepare(&arguments.output, &paths)?;
    for (path, text) in &files {
        write_atomically(path, text.as_bytes()).map_err(Failure::input)?;
        say(format!("wrote {}", path.display()));
    }
    Ok(())
}
