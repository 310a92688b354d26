//! `velour export`: what other engines take of Velour.

mod shaders;

use clap::Subcommand;

use crate::failure::Failure;

/// What is exported.
#[derive(Subcommand)]
pub enum Export {
    /// The shader files that are made to be copied, in another language
    Shaders(shaders::Shaders),
}

pub fn run(export: &Export) -> Result<(), Failure> {
    match export {
        Export::Shaders(arguments) => shaders::run(arguments),
    }
}
