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
    #[cfg(feature = "window")]
    View(View),
    /// Renders a scene to a picture
    #[cfg(feature = "gpu")]
    Render(Render),
    /// Renders a scene by path tracing on the processor: what the real-time picture is held against; Ctrl-C ends it with what it has
    Reference(Reference),
    /// Makes the tables from nothing and prints their errors
    Fit(Fit),
    /// Compares picture A with the reference B: FLIP, relative mean absolute error, bias, largest error
    ///
    /// Two .exr are compared in linear radiance, two .png in shown values from 0 to 1, alpha left out; up to 16384 pixels a side
    /// and 33554432 in all. The relative mean absolute error is mean |A - B| / mean |B|, over pixels and channels; the mean error
    /// is mean (A - B).
    ///
    /// FLIP is the mean over the picture, in [0,1], at 67 pixels a degree, of values rounded to 8 bits. For .exr it is HDR-FLIP: each
    /// pixel's greatest over exposures a stop apart or less (2 to 32 of them; past 32 stops farther apart), from that which shows B's
    /// greatest luminance at 0.85 to that which does so with the median of its luminances above 0, through the ACES tone curve
    /// published with it.
    ///
    /// Pixels that are infinite or not a number are bad input.
    Compare(Compare),
    /// Makes all figures and the page that shows them: the table, its lobes and errors (.svg), the paper's and our comparisons (.png); what is
    /// there already, made with the same settings, is left
    Figures(Figures),
    /// Prints adapters, limits, versions and table checksums
    #[cfg(feature = "gpu")]
    Info,
}

#[cfg(feature = "window")]
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
pub struct Compare {
    /// The picture: .exr (linear radiance) or .png (as shown, 8 or 16 bits a channel)
    pub a: PathBuf,
    /// The reference, of the same kind and size
    pub b: PathBuf,
    /// Writes FLIP of each pixel as colours: black is 0, pale yellow 1 [default: none is written]
    #[arg(long, value_name = "OUT.png")]
    pub heatmap: Option<PathBuf>,
    /// Ends with exit code 1 where FLIP is above this, a finite number from 0 up [default: no limit]
    #[arg(long, value_name = "FLIP", value_parser = limit, allow_negative_numbers = true)]
    pub fail_above: Option<f64>,
    /// Prints figures for machines on stdout
    #[arg(long)]
    pub json: bool,
}

fn limit(text: &str) -> Result<f64, String> {
    let limit = text.parse().ok().filter(|limit: &f64| limit.is_finite() && *limit >= 0.0);
    limit.ok_or_else(|| "give a finite number from 0 up, say 0.05".to_owned())
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

    #[test]
    fn limits_are_finite_and_not_negative() {
        assert_eq!(["0", "0.05", "2", "1e-9"].map(limit), [0.0, 0.05, 2.0, 1e-9].map(Ok));
        for text in ["", "-0.1", "nan", "inf", "1e999", "5%", "0,05"] {
            assert!(limit(text).is_err(), "{text}");
        }
    }
}
