//! `velour compare`: how far a picture is from a reference.

use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::json;
use velour::file::{check_writable, write_atomically};
use velour::picture::{Differences, FlipMap, Format, Picture};

use crate::comment::command;
use crate::console::say;
use crate::failure::Failure;
use crate::output::is_same_file;
use crate::progress::with_progress;

/// The flags of `velour compare`.
#[derive(Args)]
pub struct Compare {
    /// The picture: .exr (linear radiance) or .png (as shown, 8 or 16 bits a channel)
    pub a: PathBuf,
    /// The reference, of the same kind and size
    pub b: PathBuf,
    /// The layer of a .exr of several: its name, or what stands behind a dot in it; of both pictures, but for a .exr that
    /// has plain R, G and B alone [default: plain R, G, B; else the only layer with colours; else the one whose name
    /// ends in Combined, or in rgba, rgb, beauty, C, Ci]
    #[arg(long, value_name = "NAME", value_parser = clap::builder::NonEmptyStringValueParser::new(), allow_hyphen_values = true)]
    pub layer: Option<String>,
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

const CHANNELS: [&str; 3] = ["red", "green", "blue"];

/// Both pictures are read and compared before anything is written; the figures of a picture that falls short are
/// printed too.
pub fn run(arguments: &Compare) -> Result<(), Failure> {
    let heatmap = arguments.heatmap.as_deref();
    heatmap.map_or(Ok(()), |path| check_heatmap(path, [&arguments.a, &arguments.b]))?;
    let [a, b] = Picture::load_pair(&arguments.a, &arguments.b, arguments.layer.as_deref()).map_err(Failure::input)?;
    let differences = Differences::between(&a, &b);
    let flip = with_progress("flip", |step| FlipMap::between(&a, &b, step));
    if let Some(path) = heatmap {
        let bytes = flip.heat_map().to_png_with_comment(&command()).map_err(Failure::input)?;
        write_atomically(path, &bytes).map_err(Failure::input)?;
    }
    if arguments.json {
        say(figures(arguments, &a, &differences, &flip));
    } else {
        report(arguments, &a, &differences, &flip);
    }
    match arguments.fail_above {
        Some(most) if flip.mean() > most => {
            let name = arguments.a.display();
            Err(Failure::check(format!("{name}: FLIP {} is above {most}: --heatmap shows where", flip.mean())))
        }
        _ => Ok(()),
    }
}

/// The heat map is a .png that can be written, and neither of the pictures.
fn check_heatmap(path: &Path, inputs: [&Path; 2]) -> Result<(), Failure> {
    let name = path.display();
    if Format::of(path).ok() != Some(Format::Png) {
        return Err(Failure::input(format!("--heatmap {name}: a heat map is a .png: give it that extension")));
    }
    check_writable(path).map_err(Failure::input)?;
    if inputs.into_iter().any(|input| is_same_file(path, input)) {
        return Err(Failure::input(format!("--heatmap {name}: is a picture to be compared: choose another place")));
    }
    Ok(())
}

fn report(arguments: &Compare, a: &Picture, differences: &Differences, flip: &FlipMap) {
    let (values, variant) = match &flip.exposures {
        None => ("shown values in [0,1]", "LDR".to_owned()),
        Some(e) => {
            ("linear radiance", format!("HDR, {} exposures from {:.2} to {:.2} stops", e.count, e.first, e.last))
        }
    };
    say(format!("{} against {}: {}x{}, {values}", arguments.a.display(), arguments.b.display(), a.width, a.height));
    say(format!("FLIP: {:.6}, greatest {:.6} ({variant})", flip.mean(), flip.greatest()));
    let relative = differences.relative_mean_absolute;
    let relative = relative.map_or("none, the reference is black".to_owned(), figure);
    say(format!("relative mean absolute error: {relative}"));
    say(format!("mean error: {}", figure(differences.mean)));
    let largest = &differences.largest;
    let [x, y] = largest.at;
    let channel = CHANNELS[largest.channel];
    say(format!(
        "largest error: {} in {channel} at {x},{y} ({} instead of {})",
        figure(largest.error()),
        figure(largest.test.into()),
        figure(largest.reference.into())
    ));
    if let Some(path) = &arguments.heatmap {
        say(format!("heat map: {}", path.display()));
    }
}

/// In the digits of an `f32`, with an exponent of ten where they would be many.
fn figure(value: f64) -> String {
    format!("{:?}", value as f32)
}

fn figures(arguments: &Compare, a: &Picture, differences: &Differences, flip: &FlipMap) -> serde_json::Value {
    let exposures = flip.exposures.as_ref();
    let largest = &differences.largest;
    json!({
        "a": arguments.a.display().to_string(),
        "b": arguments.b.display().to_string(),
        "size": [a.width, a.height],
        "values": if exposures.is_some() { "linear" } else { "shown" },
        "flip": flip.mean(),
        "flip_greatest": flip.greatest(),
        "flip_exposures": exposures.map(|exposures| exposures.stops().collect::<Vec<f64>>()),
        "relative_mean_absolute_error": differences.relative_mean_absolute,
        "mean_absolute_error": differences.mean_absolute,
        "mean_error": differences.mean,
        "largest_error": {
            "error": largest.error(),
            "at": largest.at,
            "channel": CHANNELS[largest.channel],
            "a": largest.test,
            "b": largest.reference,
        },
        "heatmap": arguments.heatmap.as_ref().map(|path| path.display().to_string()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_finite_and_not_negative() {
        assert_eq!(["0", "0.05", "2", "1e-9"].map(limit), [0.0, 0.05, 2.0, 1e-9].map(Ok));
        for text in ["", "-0.1", "nan", "inf", "1e999", "5%", "0,05"] {
            assert!(limit(text).is_err(), "{text}");
        }
    }
}
