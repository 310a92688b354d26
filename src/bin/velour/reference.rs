//! `velour reference`: pictures by path tracing.

use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

use clap::{Args, ValueEnum};
use serde_json::json;
use velour::file::{check_writable, write_atomically};
use velour::picture::{DisplayImage, Format, ToneCurve};
use velour::reference::{self, Effort, Options, Picture, ReferenceError};
use velour::scene::{Camera, Settings};

use crate::comment::command;
use crate::console::{complain, say};
use crate::exposed::{Exposed, Exposes};
use crate::failure::Failure;
use crate::inputs::Inputs;
use crate::interrupt::{ENDING, listen};
use crate::output::check_apart;
use crate::picture_args::PictureArgs;
use crate::progress::with_progress;
use crate::timing::Timing;

/// The flags of `velour reference`.
#[derive(Args)]
pub struct Reference {
    #[command(flatten)]
    pub picture: PictureArgs,
    /// Samples a pixel
    #[arg(long, default_value_t = 64, value_name = "N", value_parser = clap::value_parser!(u32).range(1..), allow_negative_numbers = true)]
    pub spp: u32,
    /// Surfaces that light may bounce off before the one that is seen; 0 is direct light alone; at most 1000
    #[arg(long, default_value_t = 0, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=1000), allow_negative_numbers = true)]
    pub max_bounces: u32,
    /// Samples lie all over the pixel, or at its centre as with `velour render --msaa 1`
    #[arg(long, default_value = "box", value_enum, value_name = "box|centre")]
    pub filter: Filter,
    /// The lobe of the specular base: the transformed cosine of real time, or GGX microfacets themselves
    #[arg(long, default_value = "ltc", value_enum, value_name = "ltc|ggx")]
    pub specular_model: SpecularModel,
    /// Each pixel's standard error of radiance, as a picture
    #[arg(long, value_name = "OUT.exr")]
    pub errors: Option<PathBuf>,
}

#[derive(Clone, Copy, ValueEnum)]
pub enum Filter {
    Box,
    #[value(alias = "center")]
    Centre,
}

#[derive(Clone, Copy, ValueEnum)]
pub enum SpecularModel {
    Ltc,
    Ggx,
}

impl Reference {
    pub fn options(&self, settings: &Settings) -> Options {
        Options {
            max_bounces: self.max_bounces,
            shadows: settings.shadows,
            filter: match self.filter {
                Filter::Box => reference::Filter::Box,
                Filter::Centre => reference::Filter::Centre,
            },
            specular: match self.specular_model {
                SpecularModel::Ltc => reference::SpecularModel::Ltc,
                SpecularModel::Ggx => reference::SpecularModel::Ggx,
            },
        }
    }
}

pub fn run(arguments: &Reference) -> Result<(), Failure> {
    let mut timing = Timing::default();
    if let Some(errors) = &arguments.errors {
        check_errors(errors, &arguments.picture)?;
    }
    reference::Reference::check_size(arguments.picture.size).map_err(failure)?;
    let inputs = Inputs::load(&arguments.picture, &mut timing)?;
    if let Some(errors) = &arguments.errors {
        check_apart(errors, &inputs.scene, &arguments.picture.files())?;
    }
    let effort = Effort { samples: arguments.spp.into(), seed: arguments.picture.seed.into() };
    let rendered =
        render(&inputs, &arguments.picture, arguments.options(&inputs.edits.settings()), effort, &mut timing)?;
    if let Some(errors) = &arguments.errors {
        let bytes = rendered.picture.errors.to_exr_with_comment(&command()).map_err(Failure::input)?;
        write_atomically(errors, &bytes).map_err(Failure::input)?;
    }
    finish(&arguments.picture, &inputs, &rendered, &mut timing)
}

/// Errors are written as numbers, and over no other file.
fn check_errors(errors: &Path, arguments: &PictureArgs) -> Result<(), Failure> {
    let refused = |what: &str| Err(Failure::input(format!("--errors {}: {what}", errors.display())));
    if !matches!(Format::of(errors), Ok(Format::Exr)) {
        return refused("standard errors are floating-point numbers: give a name that ends in .exr");
    }
    check_writable(errors).map_err(Failure::input)?;
    let place = |path: &Path| {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Some((folder.canonicalize().ok()?, path.file_name()?.to_owned()))
    };
    if place(errors) == place(&arguments.output) {
        return refused("the picture itself goes there: choose another place");
    }
    Ok(())
}

/// How much work it was.
pub struct Counts {
    rays: u64,
    triangles: usize,
    wanted: u64,
}

pub fn failure(error: ReferenceError) -> Failure {
    match error {
        ReferenceError::Size { .. } => Failure::input(format!("--size: {error}")),
        ReferenceError::Triangles { .. } => Failure::input(error),
    }
}

/// A picture that has been rendered.
pub struct Rendered {
    picture: Picture,
    /// What it shows, of a .png.
    exposed: Option<Exposed>,
    counts: Counts,
}

pub fn render(
    inputs: &Inputs,
    arguments: &PictureArgs,
    options: Options,
    effort: Effort,
    timing: &mut Timing,
) -> Result<Rendered, Failure> {
    listen();
    let (drawn, camera) = (inputs.drawn(), inputs.camera());
    let renderer = timing.measure("build", || reference::Reference::new(&drawn, &inputs.table, options));
    let mut renderer = renderer.map_err(failure)?;
    let picture = timing.measure("render", || {
        with_progress("reference", |step| {
            renderer.render(&camera, arguments.size, effort, |done, all| {
                step(done as usize, all as usize);
                !ENDING.load(Ordering::Relaxed)
            })
        })
    });
    let picture = picture.map_err(failure)?;
    let counts = Counts { rays: renderer.rays(), triangles: renderer.triangles(), wanted: effort.samples };
    let exposed = match inputs.format {
        Format::Png => {
            let (picture, size, tone) = (&picture, arguments.size, drawn.settings.tone);
            let mut shows = Shows { renderer: &mut renderer, camera: &camera, size, picture, tone };
            Some(timing.measure("expose", || Exposed::new(&inputs.edits, &mut shows))?)
        }
        Format::Exr => None,
    };
    Ok(Rendered { picture, exposed, counts })
}

/// What shows a picture that has been rendered.
pub struct Shows<'a, 'scene> {
    pub renderer: &'a mut reference::Reference<'scene>,
    pub camera: &'a Camera,
    pub size: [u32; 2],
    pub picture: &'a Picture,
    pub tone: ToneCurve,
}

impl Exposes for Shows<'_, '_> {
    fn meter(&mut self) -> Result<Option<f32>, Failure> {
        self.renderer.meter(self.camera, self.size, |_, _| !ENDING.load(Ordering::Relaxed)).map_err(failure)
    }

    fn display(&mut self, exposure: f32) -> Result<DisplayImage, Failure> {
        Ok(self.picture.display(exposure, self.tone))
    }
}

/// Writes the picture and says what it is.
pub fn finish(
    arguments: &PictureArgs,
    inputs: &Inputs,
    rendered: &Rendered,
    timing: &mut Timing,
) -> Result<(), Failure> {
    let Rendered { picture, exposed, counts } = rendered;
    let bytes = timing.measure("encode", || match exposed {
        Some(exposed) => exposed.picture.to_png_with_comment(&command()),
        None => picture.radiance.to_exr_with_comment(&command()),
    });
    let bytes = bytes.map_err(Failure::input)?;
    timing.measure("write", || write_atomically(&arguments.output, &bytes)).map_err(Failure::input)?;
    inputs.warn();
    if picture.samples < counts.wanted {
        complain(format!("interrupted: the picture has {} of {} samples a pixel", picture.samples, counts.wanted));
    }
    exposed.iter().for_each(Exposed::warn);
    report(arguments, inputs, rendered, timing);
    Ok(())
}

fn report(arguments: &PictureArgs, inputs: &Inputs, rendered: &Rendered, timing: &Timing) {
    let Rendered { picture, exposed, counts } = rendered;
    let output = arguments.output.display();
    let [width, height] = arguments.size;
    let (error, worst) = (picture.relative_error(), picture.error_quantile(0.99));
    let speed = counts.rays as f64 / timing.of("render").max(1e-9);
    if arguments.json {
        say(json!({
            "output": output.to_string(),
            "size": arguments.size,
            // No device has drawn it.
            "adapter": null,
            // Linear radiance has none.
            "exposure": exposed.as_ref().map(|exposed| exposed.exposure),
            "samples": picture.samples,
            "samples_wanted": counts.wanted,
            "batches": picture.batches,
            "relative_error": error,
            "relative_error_99": worst,
            "triangles": counts.triangles,
            "lights": inputs.scene.lights.len(),
            "rays": counts.rays,
            "rays_per_second": speed,
            "seconds": timing.seconds(),
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
    exposed.iter().for_each(Exposed::report);
}
