// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
//! A path tracer on a device, which samples the lobes by the shipped shaders' `ltc_sample` and `ltc_density`.

mod bvh;
mod scene;
mod tracer;

use std::io::{IsTerminal, stderr};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;
use velour::file::{check_writable, write_atomically};
use velour::picture::{Format, LinearImage, ToneCurve, metered};
use velour::renderer::device::{Gpu, open_offscreen};
use velour::scene::{Drawn, Edits, gltf};

use scene::TracedScene;
use tracer::{SOURCE, Settings, Tracer};

/// Traces paths through a scene on a graphics device.
#[derive(Parser)]
struct Arguments {
    /// A .glb or .gltf file
    scene: PathBuf,
    /// Linear radiance as .exr; a .png of the same name goes beside it
    #[arg(short, long, value_name = "OUT.exr")]
    output: PathBuf,
    /// Width and height in pixels
    #[arg(long, default_value = "640x360", value_name = "WxH", value_parser = size)]
    size: [u32; 2],
    /// Samples a pixel
    #[arg(long, default_value_t = 64, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    spp: u32,
    /// Surfaces that light may bounce off before the one that is seen; 0 is direct light alone; at most 1000
    #[arg(long, default_value_t = 4, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=1000))]
    max_bounces: u32,
    /// Another seed gives other noise
    #[arg(long, default_value_t = 0, value_name = "N")]
    seed: u32,
    /// Part of the description of the adapter to use, as `velour info` gives it
    #[arg(long, value_name = "NAME-PART")]
    adapter: Option<String>,
}

/// Why there is no picture: the exit code, 2 for bad input and 3 for no device, and the line that says it.
type Failure = (u8, String);

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err((code, message)) => {
            eprintln!("path_tracer: {message}");
            ExitCode::from(code)
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), Failure> {
    let Arguments { output, size, spp, max_bounces, seed, .. } = arguments;
    if !matches!(Format::of(output), Ok(Format::Exr)) {
        return Err(bad(format!("{}: give a name that ends in .exr", output.display())));
    }
    let preview = output.with_extension("png");
    for path in [output, &preview] {
        check_writable(path).map_err(bad)?;
    }
    let scene = gltf::load(&arguments.scene, &gltf::Options::default()).map_err(bad)?;
    let traced = TracedScene::new(&Drawn::new(&scene, &Edits::default()));
    let traced = traced.map_err(|error| bad(format!("{}: {error}", arguments.scene.display())))?;
    scene.notices.iter().for_each(|notice| eprintln!("path_tracer: {notice}"));
    let gpu = open(arguments.adapter.as_deref())?;
    let settings = Settings { size: *size, max_bounces: *max_bounces, seed: *seed };
    let mut tracer = Tracer::new(&gpu, &traced, SOURCE, settings).map_err(bad)?;
    let start = Instant::now();
    let is_watched = stderr().is_terminal();
    tracer.add(*spp, |done| {
        if is_watched {
            eprint!("\r{done} of {spp} samples a pixel");
        }
    });
    if is_watched {
        eprintln!();
    }
    let picture = tracer.picture();
    write(&picture, output, &preview)?;
    let [width, height] = size;
    println!(
        "{}: {width}x{height}, {spp} samples a pixel in {:.2} s on {}; {} triangles, {} of them shine",
        output.display(),
        start.elapsed().as_secs_f64(),
        gpu.adapter.get_info().name,
        traced.triangles.len(),
        traced.lights.len(),
    );
    Ok(())
}

fn open(wanted: Option<&str>) -> Result<Gpu, Failure> {
    pollster::block_on(open_offscreen(wanted)).map_err(|error| (3, error.to_string()))
}

/// The picture as it is, and as metering exposes it.
fn write(picture: &LinearImage, output: &Path, preview: &Path) -> Result<(), Failure> {
    let shown = picture.display(metered(picture).unwrap_or(0.0), ToneCurve::default());
    write_atomically(output, &picture.to_exr().map_err(bad)?).map_err(bad)?;
    write_atomically(preview, &shown.to_png().map_err(bad)?).map_err(bad)
}

fn bad(message: impl ToString) -> Failure {
    (2, message.to_string())
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let parse = |side: &str| side.parse::<u32>().ok().filter(|side| *side > 0);
    let sides = text.split_once(['x', 'X']).and_then(|(width, height)| Some([parse(width)?, parse(height)?]));
    sides.ok_or_else(|| "give two whole numbers of at least 1, say 1280x720".to_owned())
}
