//! `velour export`: what other engines take of Velour.

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
}

pub fn run(export: &Export) -> Result<(), Failure> {
    match export {
        Export::Shaders(arguments) => shaders::run(arguments),
        Export::Tables(arguments) => tables::run(arguments),
    }
}
