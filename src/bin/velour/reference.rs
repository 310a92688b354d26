//! `velour reference`: pictures by path tracing; and those of `velour render` where there is no device.

use std::path::Path;
use std::sync::atomic::Ordering;

use serde_json::json;
use velour::file::{check_writable, write_atomically};
use velour::picture::Format;
use velour::reference::{Effort, Options, Picture, Reference as Renderer, ReferenceError};

use crate::inputs::{Inputs, Timing, check_apart, encoded};
use crate::interrupt::{ENDING, listen};
use crate::output::with_progress;
use crate::render_args::{PictureArgs, Reference};
use crate::{Failure, complain, say};

#[cfg(feature = "gpu")]
use {
    crate::render_args::Render,
    velour::picture::LinearImage,
    velour::reference::{Filter, SpecularModel},
    velour::scene::{Scene, Settings},
    velour::table::SheenTable,
};

/// How much is done where nobody said: of the fit light is found exactly, and only edges are to be smoothed; earlier models and the reciprocal rule
/// keep some percent of noise.
#[cfg(feature = "gpu")]
const PLAIN: Effort = Effort { samples: 16, seed: 0 };

pub fn reference(arguments: &Reference) -> Result<(), Failure> {
    let mut timing = Timing::default();
    if let Some(errors) = &arguments.errors {
        check_errors(errors, &arguments.picture)?;
    }
    Renderer::check_size(arguments.picture.size).map_err(failure)?;
    let inputs = Inputs::load(&arguments.picture, &mut timing)?;
    let effort = Effort { samples: arguments.spp.into(), seed: arguments.seed };
    let (picture, counts) = render(&inputs, &arguments.picture, arguments.options(), effort, &mut timing)?;
    if let Some(errors) = &arguments.errors {
        let bytes = picture.errors.to_exr().map_err(Failure::input)?;
        write_atomically(errors, &bytes).map_err(Failure::input)?;
    }
    finish(&arguments.picture, &inputs, &picture, counts, &mut timing)
}

/// Whether errors can be written there: numbers, and in no other file's place.
fn check_errors(errors: &Path, arguments: &PictureArgs) -> Result<(), Failure> {
    let refused = |what: &str| Err(Failure::input(format!("--errors {}: {what}", errors.display())));
    if !matches!(Format::of(errors), Ok(Format::Exr)) {
        return refused("standard errors are floating-point numbers: give a name that ends in .exr");
    }
    check_writable(errors).map_err(Failure::input)?;
    check_apart(errors, &arguments.scene)?;
    let place = |path: &Path| {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Some((folder.canonicalize().ok()?, path.file_name()?.to_owned()))
    };
    if place(errors) == place(&arguments.output) {
        return refused("the picture itself goes there: choose another place");
    }
    Ok(())
}

/// What was followed.
struct Counts {
    rays: u64,
    triangles: usize,
    wanted: u64,
}

fn failure(error: ReferenceError) -> Failure {
    match error {
        ReferenceError::Size { .. } => Failure::input(format!("--size: {error}")),
        ReferenceError::Triangles { .. } => Failure::input(error),
    }
}

fn render(
    inputs: &Inputs,
    arguments: &PictureArgs,
    options: Options,
    effort: Effort,
    timing: &mut Timing,
) -> Result<(Picture, Counts), Failure> {
    listen();
    let Inputs { scene, settings, table, .. } = inputs;
    let renderer = timing.measure("build", || Renderer::new(scene, settings, table, options)).map_err(failure)?;
    let camera = inputs.camera();
    let picture = timing.measure("render", || {
        with_progress("reference", |step| {
            renderer.render(camera, arguments.size, effort, |done, all| {
                step(done as usize, all as usize);
                !ENDING.load(Ordering::Relaxed)
            })
        })
    });
    let counts = Counts { rays: renderer.rays(), triangles: renderer.triangles(), wanted: effort.samples };
    Ok((picture.map_err(failure)?, counts))
}

/// Writes the picture and says what it is.
fn finish(
    arguments: &PictureArgs,
    inputs: &Inputs,
    picture: &Picture,
    counts: Counts,
    timing: &mut Timing,
) -> Result<(), Failure> {
    let bytes = timing.measure("encode", || encoded(&picture.radiance, inputs.format, arguments));
    let bytes = bytes.map_err(Failure::input)?;
    timing.measure("write", || write_atomically(&arguments.output, &bytes)).map_err(Failure::input)?;
    inputs.warn();
    if picture.samples < counts.wanted {
        complain(format!("interrupted: the picture has {} of {} samples a pixel", picture.samples, counts.wanted));
    }
    report(arguments, inputs, picture, &counts, timing);
    Ok(())
}

fn report(arguments: &PictureArgs, inputs: &Inputs, picture: &Picture, counts: &Counts, timing: &Timing) {
    let output = arguments.output.display();
    let [width, height] = arguments.size;
    let (error, worst) = (picture.relative_error(), picture.error_quantile(0.99));
    let rendered = timing.0.iter().find(|(part, _)| *part == "render").map_or(0.0, |(_, seconds)| *seconds);
    let speed = counts.rays as f64 / rendered.max(1e-9);
    if arguments.json {
        let seconds: serde_json::Map<_, _> =
            timing.0.iter().map(|(part, seconds)| (part.to_string(), json!(seconds))).collect();
        say(json!({
            "output": output.to_string(),
            "size": arguments.size,
            // No device has drawn it.
            "adapter": null,
            "samples": picture.samples,
            "samples_wanted": counts.wanted,
            "batches": picture.batches,
            "relative_error": error,
            "relative_error_99": worst,
            "triangles": counts.triangles,
            "lights": inputs.scene.lights.len(),
            "rays": counts.rays,
            "rays_per_second": speed,
            "seconds": seconds,
            "total_seconds": timing.total(),
        }));
        return;
    }
    let percent = |share: Option<f64>| share.map_or("unknown".to_owned(), |share| format!("{:.3}%", 100.0 * share));
    say(format!(
        "{output}: {width}x{height}, {} samples a pixel in {:.2} s, {:.2} million rays a second; standard error of a pixel: on average \
         {} of the mean radiance; 99 of 100 lit pixels are known to {} of their own",
        picture.samples,
        timing.total(),
        speed / 1e6,
        percent(error),
        percent(worst),
    ));
}

/// What `velour render` draws, without a device: no shadows, and samples at the pixels' centres where it takes one.
#[cfg(feature = "gpu")]
pub fn in_place_of_a_device(arguments: &Render, inputs: &Inputs, mut timing: Timing) -> Result<(), Failure> {
    let filter = if arguments.msaa == 1 { Filter::Centre } else { Filter::Box };
    let options = Options { filter, shadows: false, max_bounces: 0, specular: SpecularModel::Ltc };
    complain(NO_DEVICE);
    let (picture, counts) = render(inputs, &arguments.picture, options, PLAIN, &mut timing)?;
    finish(&arguments.picture, inputs, &picture, counts, &mut timing)
}

#[cfg(feature = "gpu")]
const NO_DEVICE: &str = "no graphics adapter was found: the reference draws the picture on the processor (scripts/setup installs a Vulkan driver)";

/// The same of a scene as it is.
#[cfg(feature = "window")]
pub fn plain(scene: &Scene, settings: &Settings, size: [u32; 2]) -> Result<LinearImage, Failure> {
    let options = Options { shadows: false, ..Options::default() };
    let renderer = Renderer::new(scene, settings, &SheenTable::embedded(), options).map_err(failure)?;
    complain(NO_DEVICE);
    let picture = with_progress("reference", |step| {
        renderer.render(&scene.cameras[0], size, PLAIN, |done, all| {
            step(done as usize, all as usize);
            true
        })
    });
    Ok(picture.map_err(failure)?.radiance)
}
