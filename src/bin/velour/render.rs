//! `velour render`: pictures by the real-time renderer.

use clap::Args;
use serde_json::json;
use velour::file::write_atomically;
use velour::picture::{DisplayImage, Format};
use velour::renderer::device::{self, Gpu};
use velour::renderer::{Effort, Offscreen, RadianceFormat, RenderError, SAMPLES};
use velour::scene::{Camera, Edits, Layering, Scene, Settings};

use crate::comment;
#[cfg(feature = "window")]
use crate::comment::quoted;
use crate::console::{complain, say};
use crate::exposed::{Exposed, Exposes};
use crate::failure::Failure;
use crate::inputs::Inputs;
use crate::picture_args::PictureArgs;
use crate::timing::Timing;
use crate::without_device;

/// The flags of `velour render`.
#[derive(Args)]
pub struct Render {
    #[command(flatten)]
    pub picture: PictureArgs,
    /// With 1 each pixel is the value at its centre. With 4 it is a mean over the pixel: without shadows of 4 samples, and an adapter
    /// that has no 4 draws 1, and says so; with shadows of all its samples
    #[arg(long, default_value = "4", value_name = "1|4", value_parser = samples)]
    pub msaa: u32,
    /// Samples a pixel where there are shadows: each has a ray to a point of every light, but of no more than 4 lights
    #[arg(long, default_value_t = SAMPLES, value_name = "N", value_parser = clap::value_parser!(u32).range(1..), allow_negative_numbers = true)]
    pub spp: u32,
    /// What `velour info` prints of an adapter, or a part of it; case does not count
    #[arg(long, value_name = "NAME-PART")]
    pub adapter: Option<String>,
}

fn samples(text: &str) -> Result<u32, String> {
    match text {
        "1" => Ok(1),
        "4" => Ok(4),
        _ => Err("give 1 or 4".to_owned()),
    }
}

/// What can fail comes before anything is written or said.
pub fn run(arguments: &Render) -> Result<(), Failure> {
    let mut timing = Timing::default();
    let inputs = Inputs::load(&arguments.picture, &mut timing)?;
    check_real_time(&inputs.edits)?;
    let wanted = arguments.adapter.as_deref();
    let gpu = match timing.measure("device", || pollster::block_on(device::open_offscreen(wanted))) {
        Err(why) if wanted.is_none() => {
            let samples = (arguments.msaa, arguments.spp);
            return without_device::render(&why, &arguments.picture, samples, &inputs, timing);
        }
        gpu => gpu.map_err(Failure::device)?,
    };
    let drawing = draw(&gpu, arguments, &inputs, &mut timing)?;
    timing.measure("write", || write_atomically(&arguments.picture.output, &drawing.bytes)).map_err(Failure::input)?;
    inputs.warn();
    drawing.notice.iter().for_each(complain);
    // With shadows all samples are drawn one by one.
    let wanted = if drawing.has_shadows { 1 } else { arguments.msaa };
    shortfall(drawing.radiance, wanted, inputs.format).into_iter().for_each(complain);
    drawing.exposed.iter().for_each(Exposed::warn);
    report(arguments, &inputs.scene, (&gpu, &drawing), &timing);
    Ok(())
}

/// What is to be said where the adapter draws less than was asked for.
pub fn shortfall(radiance: RadianceFormat, samples: u32, format: Format) -> Option<String> {
    let samples = (radiance.samples < samples)
        .then(|| format!("{} of {samples} samples a pixel, so that edges are not smoothed", radiance.samples));
    let bits = (format == Format::Exr && radiance.bits() < 32)
        .then(|| "16 of 32 bits a number: 11 binary digits, up to 65504".to_owned());
    let short: Vec<String> = samples.into_iter().chain(bits).collect();
    (!short.is_empty()).then(|| format!("the adapter draws {}", short.join("; and ")))
}

/// A command for a shell that renders a picture of the viewer's, of the scene in a file or the default one: read with these flags, and
/// changed by the state that follows it.
#[cfg(feature = "window")]
pub fn command(scene: Option<&str>, flags: &[String], pictured: &velour::viewer::Pictured) -> String {
    let velour::viewer::Pictured { scene: loaded, edits, size: [width, height], samples, format } = pictured;
    let output = match format {
        Format::Png => "velour.png",
        Format::Exr => "velour.exr",
    };
    let (size, samples) = (format!("--size={width}x{height}"), format!("--spp={samples}"));
    let words = ["velour", "render"].into_iter().chain(scene).chain(["-o", output, &size, &samples]);
    let words = words.chain(flags.iter().map(String::as_str)).chain(["--state", "-"]);
    let words: Vec<String> = words.map(quoted).collect();
    // No line of a state is this one: what is no key and no bracket is no TOML.
    format!("{} <<'END'\n{}END\n", words.join(" "), edits.to_text(loaded))
}

/// Refuses what takes a path tracer.
pub fn check_real_time(edits: &Edits) -> Result<(), Failure> {
    for edits in edits.materials.values().chain([&edits.every_material]) {
        if let Some(model) = edits.sheen_model.filter(|model| !model.is_real_time()) {
            let name = model.name();
            return Err(Failure::input(format!("the sheen-model {name} takes a path tracer: use `velour reference`")));
        }
        if edits.layering == Some(Layering::Walk) {
            return Err(Failure::input("the layering walk takes a path tracer: use `velour reference`"));
        }
    }
    Ok(())
}

/// A picture that has been drawn.
struct Drawing {
    /// Its file, in memory.
    bytes: Vec<u8>,
    /// How its radiance was kept on the way.
    radiance: RadianceFormat,
    has_shadows: bool,
    /// What the renderer has to say of it.
    notice: Option<String>,
    /// What it shows, of a .png.
    exposed: Option<Exposed>,
}

fn draw(gpu: &Gpu, arguments: &Render, inputs: &Inputs, timing: &mut Timing) -> Result<Drawing, Failure> {
    let Inputs { format, table, .. } = inputs;
    let (drawn, camera) = (inputs.drawn(), inputs.camera());
    let (samples, size, settings) = (arguments.msaa, arguments.picture.size, &drawn.settings);
    let prepare = match format {
        Format::Png => Offscreen::nearest_for_display,
        Format::Exr => Offscreen::nearest_for_linear,
    };
    let renderer = timing.measure("pipelines", || prepare(gpu, samples, table, &drawn));
    let mut renderer = renderer.map_err(failure)?;
    renderer.effort = Effort { samples: arguments.spp, seed: arguments.picture.seed, spread: arguments.msaa > 1 };
    let radiance = renderer.radiance();
    let (bytes, exposed) = match format {
        Format::Png => {
            let mut shows = Shows { gpu, renderer: &mut renderer, camera: &camera, size, settings, timing };
            let exposed = Exposed::new(&inputs.edits, &mut shows)?;
            (timing.measure("encode", || exposed.picture.to_png_with_comment(&comment::command())), Some(exposed))
        }
        Format::Exr => {
            let picture = timing.measure("frame", || gpu.block_on(renderer.linear(gpu, &camera, size, settings)));
            let picture = picture.map_err(failure)?;
            (timing.measure("encode", || picture.to_exr_with_comment(&comment::command())), None)
        }
    };
    let notice = renderer.notice().map(str::to_owned);
    let has_shadows = renderer.has_shadows(settings);
    Ok(Drawing { bytes: bytes.map_err(Failure::input)?, radiance, has_shadows, notice, exposed })
}

/// What draws a picture that is shown.
pub struct Shows<'a> {
    pub gpu: &'a Gpu,
    pub renderer: &'a mut Offscreen,
    pub camera: &'a Camera,
    pub size: [u32; 2],
    pub settings: &'a Settings,
    pub timing: &'a mut Timing,
}

impl Exposes for Shows<'_> {
    fn meter(&mut self) -> Result<Option<f32>, Failure> {
        let Self { gpu, renderer, camera, size, settings, timing } = self;
        timing.measure("meter", || gpu.block_on(renderer.meter(gpu, camera, *size, settings))).map_err(failure)
    }

    fn display(&mut self, exposure: f32) -> Result<DisplayImage, Failure> {
        let Self { gpu, renderer, camera, size, settings, timing } = self;
        let settings = Settings { exposure, ..**settings };
        timing.measure("frame", || gpu.block_on(renderer.display(gpu, camera, *size, &settings))).map_err(failure)
    }
}

/// A lost device is not bad input.
pub fn failure(error: RenderError) -> Failure {
    match error {
        RenderError::Readback(_) => Failure::device(error),
        _ => Failure::input(error),
    }
}

fn report(arguments: &Render, scene: &Scene, (gpu, drawing): (&Gpu, &Drawing), timing: &Timing) {
    let adapter = gpu.adapter.get_info();
    let [width, height] = arguments.picture.size;
    let output = arguments.picture.output.display();
    if !arguments.picture.json {
        say(format!("{output}: {width}x{height} on {} in {:.2} s", adapter.name, timing.total()));
        drawing.exposed.iter().for_each(Exposed::report);
        return;
    }
    let triangles = |mesh: usize| scene.meshes[mesh].indices.len() / 3;
    let figures = json!({
        "output": output.to_string(),
        "size": arguments.picture.size,
        "msaa": drawing.radiance.samples,
        // Without shadows there is nothing to be sampled.
        "spp": drawing.has_shadows.then_some(arguments.spp),
        "adapter": adapter.name,
        "backend": format!("{:?}", adapter.backend).to_lowercase(),
        // Linear radiance has none.
        "exposure": drawing.exposed.as_ref().map(|exposed| exposed.exposure),
        "triangles": scene.instances.iter().map(|instance| triangles(instance.mesh)).sum::<usize>(),
        "lights": scene.lights.len(),
        "polygons": scene.lights.iter().map(|light| light.polygons.len()).sum::<usize>(),
        "seconds": timing.seconds(),
        "total_seconds": timing.total(),
    });
    say(figures);
}
