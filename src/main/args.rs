//! The commands and their flags.

use std::ops::RangeInclusive;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use velour::fit::RESOLUTIONS;

use crate::render_args::Reference;
#[cfg(feature = "gpu")]
use crate::render_args::Render;

/// Real-time sheen for fuzzy and dusty surfaces under polygonal area lights.
///
/// Without a command: the viewer on the default scene; without a display, that scene in velour.png.
#[derive(Parser)]
#[command(
    version,
    after_help = "Exit codes: 0 done; 1 a comparison or check fell short; 2 bad usage or bad input; 3 no device."
)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Option<Command>,
}

#[derive(Subcommand)]
pub enum Command {
    /// Opens a scene in a window: drag to orbit, right drag or shift drag to pan, wheel to zoom
    #[cfg(feature = "viewer")]
    View(View),
    /// Renders a scene to a picture
    #[cfg(feature = "gpu")]
    Render(Render),
    /// Renders a scene by path tracing on the processor: what the real-time picture is held against
    Reference(Reference),
    /// Makes the tables from nothing and prints their errors
    Fit(Fit),
    /// Draws the table, its lobes and its errors, as .svg
    Figures(Figures),
    /// Prints adapters, limits, versions and table checksums
    #[cfg(feature = "gpu")]
    Info,
}

#[cfg(feature = "viewer")]
#[derive(Args)]
pub struct View {
    /// glTF 2.0 scene, .glb or .gltf [default: a velvet drape]
    pub scene: Option<PathBuf>,
}

#[derive(Args)]
pub struct Fit {
    /// Folder of the tables; made if it is not there
    #[arg(short, long, default_value = "tables", value_name = "DIR")]
    pub output: PathBuf,
    /// Which table: sheen is sheen_ltc.csv and .dds, slab is sheen_slab.dds, ggx is ggx_ltc.csv and .dds [default: all]
    #[arg(long, value_enum, value_name = "sheen|slab|ggx")]
    pub only: Option<Table>,
    /// Nodes along alpha and along mu of the sheen's table, 2 to 128 [default: 32]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(resolutions()))]
    pub resolution: Option<u16>,
    /// Writes nothing: compares the folder's tables with what would be written, to one half-float step
    #[arg(long)]
    pub check: bool,
}

/// Of the sheen's table.
fn resolutions() -> RangeInclusive<i64> {
    let side = |side: &usize| *side as i64;
    side(RESOLUTIONS.start())..=side(RESOLUTIONS.end())
}

#[derive(Clone, Copy, ValueEnum, PartialEq)]
pub enum Table {
    Sheen,
    Slab,
    Ggx,
}

#[derive(Args)]
pub struct Figures {
    /// Folder for the pictures; made if it is not there
    #[arg(short, long, default_value = "figures", value_name = "DIR")]
    pub output: PathBuf,
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Arguments::command().debug_assert();
    }
}
