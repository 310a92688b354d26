//! The commands; the flags of each stand in its own file.

use std::ffi::OsStr;
use std::path::Path;

use clap::{CommandFactory, Parser, Subcommand};

use crate::compare::Compare;
use crate::export::Export;
use crate::figures::Figures;
use crate::fit::Fit;
use crate::golden::GoldenCheck;
#[cfg(feature = "window")]
use crate::loading::Loading;
use crate::reference::Reference;
#[cfg(feature = "gpu")]
use crate::render::Render;
#[cfg(feature = "window")]
use crate::view::View;

/// Real-time sheen for fuzzy and dusty surfaces under polygonal area lights.
///
/// Without a command: the viewer on a scene; without a display, that scene in velour.png.
#[derive(Parser)]
#[command(
    version,
    args_conflicts_with_subcommands = true,
    after_help = "Exit codes: 0 done; 1 a comparison or check fell short; 2 bad usage or bad input; 3 no device."
)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Option<Command>,
    /// What the viewer opens: a glTF 2.0 scene, .glb or .gltf (./render where its name is a command's) [default: a
    /// velvet drape]
    #[cfg(feature = "window")]
    pub scene: Option<std::path::PathBuf>,
    #[cfg(feature = "window")]
    #[command(flatten)]
    pub loading: Loading,
}

/// Whether the first word of a command line names nothing: no flag, no command, no file that is there.
pub fn is_stray(word: &OsStr) -> bool {
    let is_flag = word.as_encoded_bytes().starts_with(b"-");
    let mut arguments = Arguments::command();
    // This adds clap's own command, `help`.
    arguments.build();
    // What cannot be asked for may be there: whoever reads it says why not.
    !is_flag && arguments.find_subcommand(word).is_none() && !Path::new(word).try_exists().unwrap_or(true)
}

#[derive(Subcommand)]
pub enum Command {
    /// Opens a scene in a window: drag to orbit, right drag or shift drag to pan, wheel to zoom; ? lists all keys
    #[cfg(feature = "window")]
    View(View),
    /// Renders a scene to a picture
    #[cfg(feature = "gpu")]
    Render(Render),
    /// Renders a scene by path tracing on the processor: what the real-time picture is held against; Ctrl-C ends it
    /// with what it has
    Reference(Reference),
    /// Makes the tables from nothing and prints their errors
    Fit(Fit),
    /// Compares picture A with the reference B: FLIP, relative mean absolute error, bias, largest error
    ///
    /// Two .exr are compared in linear radiance (of several layers the one that is the picture, see --layer), two .png in shown values from 0 to 1, alpha left out; up to 16384
    /// pixels a side and 33554432 in all. The relative mean absolute error is mean |A - B| / mean |B|, over pixels and
    /// channels; the mean error is mean (A - B).
    ///
    /// FLIP is the mean over the picture, in [0,1], at 67 pixels a degree, of values rounded to 8 bits. For .exr it is
    /// HDR-FLIP: each pixel's greatest value over 2 to 32 exposures, a stop or less apart (farther apart past 32
    /// stops), from the one that shows B's greatest luminance at 0.85 to the one that shows the median of its
    /// luminances above 0 there, through the ACES tone curve published with it.
    ///
    /// Pixels that are infinite or not a number are bad input.
    Compare(Compare),
    /// Makes all figures and the page that shows them: the table, its lobes and errors (.svg), the paper's and our
    /// comparisons (.png); what is there already, made with the same settings, is left
    Figures(Figures),
    /// Writes what other engines take: shaders in their languages, tables in their forms, golden numbers to check a port by
    #[command(subcommand, arg_required_else_help = false)]
    Export(Export),
    /// Judges a port of the shaders by the golden numbers: which of its numbers are off, and which mistake fits them
    ///
    /// The inputs are in tables/golden.csv and .json, which `velour export golden` makes; docs/golden.md says how a port is run on
    /// them. Numbers may be off by the tolerances there; NaN is off. Rows that are not given are named, and are no fault. Exit code 1
    /// where a number is off.
    Golden(GoldenCheck),
    /// Prints adapters, limits, versions and table checksums
    #[cfg(feature = "gpu")]
    Info,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn words_that_name_nothing_are_stray() {
        for word in ["rendre", "gone.glb", "./render", "", "Render"] {
            assert!(is_stray(word.as_ref()), "{word}");
        }
        for word in ["render", "help", "info", "-o", "--alpha", "Cargo.toml", "./Cargo.toml", "src"] {
            assert!(!is_stray(word.as_ref()), "{word}");
        }
    }
}
