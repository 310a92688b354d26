//! `velour render`: pictures by the real-time renderer.

use clap::Args;
use serde_json::json;
use velour::file::write_atomically;
use velour::picture::Format;
use velour::renderer::device::{self, DeviceError, Gpu};
use velour::renderer::{Offscreen, RenderError};
use velour::scene::{Edits, Layering, Scene};

use crate::console::say;
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
    /// Samples a pixel; with 1 each pixel is the value at its centre
    #[arg(long, default_value = "4", value_name = "1|4", value_parser = samples)]
    pub msaa: u32,
    /// Part of an adapter's name, as `velour info` lists them
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
    let gpu =
        match timing.measure("device", || pollster::block_on(device::open_offscreen(arguments.adapter.as_deref()))) {
            Err(DeviceError::NoAdapter) if arguments.adapter.is_none() => {
                return without_device::render(&arguments.picture, arguments.msaa, &inputs, timing);
            }
            gpu => gpu.map_err(Failure::device)?,
        };
    let bytes = draw(&gpu, arguments, &inputs, &mut timing)?;
    timing.measure("write", || write_atomically(&arguments.picture.output, &bytes)).map_err(Failure::input)?;
    inputs.warn();
    report(arguments, &inputs.scene, &gpu, &timing);
    Ok(())
}

/// Refuses what takes a path tracer.
pub fn check_real_time(edits: &Edits) -> Result<(), Failure> {
    for edits in edits.materials.values().chain([&edits.every_material]) {
        if let Some(model) = edits.sheen_model.filter(|model| !model.is_real_time()) {
            let name = model.name();
            return Err(Failure::input(format!("--sheen-model {name} takes a path tracer: use `velour reference`")));
        }
        if edits.layering == Some(Layering::Walk) {
            return Err(Failure::input("--layering walk takes a path tracer: use `velour reference`"));
        }
    }
    Ok(())
}

/// The picture's file, in memory.
fn draw(gpu: &Gpu, arguments: &Render, inputs: &Inputs, timing: &mut Timing) -> Result<Vec<u8>, Failure> {
    let Inputs { format, table, .. } = inputs;
    let (drawn, camera) = (inputs.drawn(), inputs.camera());
    let (samples, size, settings) = (arguments.msaa, arguments.picture.size, &drawn.settings);
    let encoded = match format {
        Format::Png => {
            let renderer = timing.measure("pipelines", || Offscreen::for_display(gpu, samples, table, &drawn));
            let mut renderer = renderer.map_err(failure)?;
            let picture = timing.measure("frame", || gpu.block_on(renderer.display(gpu, &camera, size, settings)));
            timing.measure("encode", || Ok(picture?.to_png()))
        }
        Format::Exr => {
            let renderer = timing.measure("pipelines", || Offscreen::for_linear(gpu, samples, table, &drawn));
            let mut renderer = renderer.map_err(failure)?;
            let picture = timing.measure("frame", || gpu.block_on(renderer.linear(gpu, &camera, size, settings)));
            timing.measure("encode", || Ok(picture?.to_exr()))
        }
    };
    encoded.map_err(failure)?.map_err(Failure::input)
}

/// A lost device is not bad input.
pub fn failure(error: RenderError) -> Failure {
    match error {
        RenderError::Readback(_) => Failure::device(error),
        _ => Failure::input(error),
    }
}

fn report(arguments: &Render, scene: &Scene, gpu: &Gpu, timing: &Timing) {
    let adapter = gpu.adapter.get_info();
    let [width, height] = arguments.picture.size;
    let output = arguments.picture.output.display();
    if !arguments.picture.json {
        say(format!("{output}: {width}x{height} on {} in {:.2} s", adapter.name, timing.total()));
        return;
    }
    let triangles = |mesh: usize| scene.meshes[mesh].indices.len() / 3;
    let figures = json!({
        "output": output.to_string(),
        "size": arguments.picture.size,
        "msaa": arguments.msaa,
        "adapter": adapter.name,
        "backend": format!("{:?}", adapter.backend).to_lowercase(),
        "triangles": scene.instances.iter().map(|instance| triangles(instance.mesh)).sum::<usize>(),
        "lights": scene.lights.len(),
        "polygons": scene.lights.iter().map(|light| light.polygons.len()).sum::<usize>(),
        "seconds": timing.seconds(),
        "total_seconds": timing.total(),
    });
    say(figures);
}
