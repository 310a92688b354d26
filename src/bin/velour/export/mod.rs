//! `velour export`: what other engines take of Velour.

mod golden;
mod shaders;
mod tables;

use clap::Subcommand;

use crate::failure::Failure;

/// What is exported.
#[derive(Subcommand)]
pub enum Export {
    /// The shader files that are made to be copied, in another language
    Shaders(shaders::Shaders),
    /// The tables in the forms that engines take; each line that it prints says how a file is laid out
    Tables(tables::Tables),
    /// Numbers to check a port of the shaders by, golden.csv and golden.json: inputs, outputs and tolerances of every function, and
    /// what common mistakes give; `velour golden` judges a port's numbers by them
    Golden(golden::GoldenNumbers),
}

pub fn run(export: &Export) -> Result<(), Failure> {
    match export {
        Export::Shaders(arguments) => shaders::run(arguments),
        Export::Tables(arguments) => tables::run(arguments),
        Export::Golden(arguments) => golden::run(arguments),
    }
}
