//! `velour export golden`.

use std::path::PathBuf;

use clap::Args;
use velour::export::golden::Golden;
use velour::file::write_atomically;

use crate::console::say;
use crate::failure::Failure;
use crate::output::prepare;

/// The flags of `velour export golden`.
#[derive(Args)]
pub struct GoldenNumbers {
    /// Folder of the files; made if it is not there
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
}

pub fn run(arguments: &GoldenNumbers) -> Result<(), Failure> {
    let golden = Golden::new();
    let files = [("golden.csv", golden.to_csv()), ("golden.json", golden.to_json())]
        .map(|(name, text)| (arguments.output.join(name), text));
    prepare(&arguments.output, &files.each_ref().map(|(path, _)| path.clone()))?;
    for (path, text) in &files {
        write_atomically(path, text.as_bytes()).map_err(Failure::input)?;
        say(format!("wrote {}", path.display()));
    }
    Ok(())
}
