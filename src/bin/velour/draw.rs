//! What each command does, step by step. What can fail comes before anything is written or said.

#[cfg(feature = "window")]
use std::path::Path;

use serde_json::json;
use velour::file::write_atomically;
use velour::picture::Format;
use velour::renderer::device::{self, DeviceError, Gpu};
use velour::renderer::{Offscreen, RenderError};
use velour::scene::Scene;
use velour::table::{GgxTable, SLAB_SIDE, SheenTable, SlabTable};

use crate::inputs::{Inputs, Timing};
use crate::render_args::Render;
use crate::{Failure, reference, say};
#[cfg(feature = "window")]
use {
    crate::complain,
    velour::file::check_writable,
    velour::scene::{Settings, gltf},
};

/// The scene that is shown when none is named, embedded so that the program runs from any folder.
#[cfg(feature = "window")]
const DEFAULT_SCENE: (&str, &[u8]) = ("drape.glb", include_bytes!("../../../assets/drape.glb"));

pub fn render(arguments: &Render) -> Result<(), Failure> {
    let mut timing = Timing::default();
    let inputs = Inputs::load(&arguments.picture, &mut timing)?;
    inputs.check_real_time()?;
    let gpu =
        match timing.measure("device", || pollster::block_on(device::open_offscreen(arguments.adapter.as_deref()))) {
            Err(DeviceError::NoAdapter) if arguments.adapter.is_none() => {
                return reference::in_place_of_a_device(arguments, &inputs, timing);
            }
            gpu => gpu.map_err(Failure::device)?,
        };
    let bytes = draw(&gpu, arguments, &inputs, &mut timing)?;
    timing.measure("write", || write_atomically(&arguments.picture.output, &bytes)).map_err(Failure::input)?;
    inputs.warn();
    report(arguments, &inputs.scene, &gpu, &timing);
    Ok(())
}

/// The picture's file, in memory.
fn draw(gpu: &Gpu, arguments: &Render, inputs: &Inputs, timing: &mut Timing) -> Result<Vec<u8>, Failure> {
    let Inputs { format, scene, table, settings, .. } = inputs;
    let (camera, samples, size) = (inputs.camera(), arguments.msaa, arguments.picture.size);
    let encoded = match format {
        Format::Png => {
            let renderer = timing.measure("pipelines", || Offscreen::for_display(gpu, samples, table, scene, settings));
            let mut renderer = renderer.map_err(render_failure)?;
            let tone = arguments.picture.tonemap.into();
            let picture = timing.measure("frame", || gpu.block_on(renderer.display(gpu, camera, size, settings, tone)));
            timing.measure("encode", || Ok(picture?.to_png()))
        }
        Format::Exr => {
            let renderer = timing.measure("pipelines", || Offscreen::for_linear(gpu, samples, table, scene, settings));
            let mut renderer = renderer.map_err(render_failure)?;
            let picture = timing.measure("frame", || gpu.block_on(renderer.linear(gpu, camera, size, settings)));
            timing.measure("encode", || Ok(picture?.to_exr()))
        }
    };
    encoded.map_err(render_failure)?.map_err(Failure::input)
}

/// A lost device is no bad input.
fn render_failure(error: RenderError) -> Failure {
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
    let seconds: serde_json::Map<_, _> =
        timing.0.iter().map(|(part, seconds)| (part.to_string(), json!(seconds))).collect();
    let figures = json!({
        "output": output.to_string(),
        "size": arguments.picture.size,
        "msaa": arguments.msaa,
        "adapter": adapter.name,
        "backend": format!("{:?}", adapter.backend).to_lowercase(),
        "triangles": scene.instances.iter().map(|instance| triangles(instance.mesh)).sum::<usize>(),
        "lights": scene.lights.len(),
        "polygons": scene.lights.iter().map(|light| light.polygons.len()).sum::<usize>(),
        "seconds": seconds,
        "total_seconds": timing.total(),
    });
    say(figures);
}

#[cfg(feature = "window")]
pub fn view(arguments: &crate::args::View) -> Result<(), Failure> {
    let scene = match &arguments.scene {
        Some(path) => gltf::load(path).map_err(Failure::input)?,
        None => default_scene()?,
    };
    let name = arguments.scene.as_ref().map_or(DEFAULT_SCENE.0.into(), |path| path.display().to_string());
    let no_display = |error| Failure::device(format!("{error}: open a desktop, or use `velour render`"));
    let event_loop = velour::viewer::event_loop().map_err(no_display)?;
    scene.notices.iter().for_each(complain);
    velour::viewer::run(event_loop, &name, scene, SheenTable::embedded()).map_err(Failure::device)
}

/// The viewer on the default scene; without a display, the picture that it would show.
#[cfg(feature = "window")]
pub fn view_or_render_default() -> Result<(), Failure> {
    let scene = default_scene()?;
    match velour::viewer::event_loop() {
        Ok(event_loop) => {
            velour::viewer::run(event_loop, DEFAULT_SCENE.0, scene, SheenTable::embedded()).map_err(Failure::device)
        }
        Err(no_display) => {
            let output = Path::new("velour.png");
            render_default(&scene, output)?;
            say(format!("{no_display}: the default scene is rendered to {}", output.display()));
            Ok(())
        }
    }
}

/// What `velour render` makes of the scene when no flag is given.
#[cfg(feature = "window")]
fn render_default(scene: &Scene, output: &Path) -> Result<(), Failure> {
    const SIZE: [u32; 2] = [1280, 720];
    check_writable(output).map_err(Failure::input)?;
    let (camera, settings) = (&scene.cameras[0], Settings::default());
    let picture = match pollster::block_on(device::open_offscreen(None)) {
        Err(DeviceError::NoAdapter) => {
            reference::plain(scene, &settings, SIZE)?.display(settings.exposure, Default::default())
        }
        gpu => {
            let gpu = gpu.map_err(Failure::device)?;
            let renderer = Offscreen::for_display(&gpu, 4, &SheenTable::embedded(), scene, &settings);
            let mut renderer = renderer.map_err(render_failure)?;
            let picture = gpu.block_on(renderer.display(&gpu, camera, SIZE, &settings, Default::default()));
            picture.map_err(render_failure)?
        }
    };
    write_atomically(output, &picture.to_png().map_err(Failure::input)?).map_err(Failure::input)
}

#[cfg(feature = "window")]
fn default_scene() -> Result<Scene, Failure> {
    gltf::from_slice(DEFAULT_SCENE.1, DEFAULT_SCENE.0).map_err(Failure::input)
}

pub fn info() -> Result<(), Failure> {
    say(format!("velour {}", env!("CARGO_PKG_VERSION")));
    let adapters =
        pollster::block_on(device::instance(wgpu::Backends::all()).enumerate_adapters(wgpu::Backends::all()));
    if adapters.is_empty() {
        say("adapters: none");
    }
    for adapter in adapters {
        let about = adapter.get_info();
        let limits = adapter.limits();
        say(format!("adapter: {} ({:?}, {:?}, {})", about.name, about.backend, about.device_type, about.driver_info));
        say(format!("  largest picture: {0}x{0}", limits.max_texture_dimension_2d));
        say(format!("  largest buffer: {} MiB", limits.max_buffer_size >> 20));
        say(format!("  largest storage binding: {} MiB", limits.max_storage_buffer_binding_size >> 20));
    }
    let table = SheenTable::embedded();
    let [alphas, mus] = table.size();
    say(format!("table: sheen_ltc {alphas}x{mus}, checksum {:08x}", table.checksum()));
    say(format!(
        "table: sheen_slab {SLAB_SIDE}x{SLAB_SIDE}x{SLAB_SIDE}, checksum {:08x}",
        SlabTable::embedded().checksum()
    ));
    let table = GgxTable::embedded();
    let [roughnesses, places] = table.size();
    say(format!("table: ggx_ltc {roughnesses}x{places}, checksum {:08x}", table.checksum()));
    Ok(())
}
