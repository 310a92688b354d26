//! `velour view`: the window; and what stands in for it where there is no display.

use std::path::{Path, PathBuf};

use clap::Args;
use velour::file::{check_writable, write_atomically};
use velour::renderer::Offscreen;
use velour::renderer::device::{self, DeviceError};
use velour::scene::assets::DRAPE;
use velour::scene::{Scene, Settings, gltf};
use velour::table::SheenTable;

use crate::console::{complain, say};
use crate::failure::Failure;
use crate::output::check_apart;
use crate::{render, without_device};

/// The flags of `velour view`.
#[derive(Args)]
pub struct View {
    /// glTF 2.0 scene, .glb or .gltf [default: a velvet drape]
    pub scene: Option<PathBuf>,
}

pub fn run(arguments: &View) -> Result<(), Failure> {
    let (name, scene) = load(arguments.scene.as_deref())?;
    let no_display = |error| Failure::device(format!("{error}: open a desktop, or use `velour render`"));
    let event_loop = velour::viewer::event_loop().map_err(no_display)?;
    scene.notices.iter().for_each(complain);
    velour::viewer::run(event_loop, &name, scene, SheenTable::embedded()).map_err(Failure::device)
}

/// The viewer; without a display, the picture that it would show.
pub fn run_or_render(path: Option<&Path>) -> Result<(), Failure> {
    let (name, scene) = load(path)?;
    match velour::viewer::event_loop() {
        Ok(event_loop) => {
            scene.notices.iter().for_each(complain);
            velour::viewer::run(event_loop, &name, scene, SheenTable::embedded()).map_err(Failure::device)
        }
        Err(no_display) => {
            let output = Path::new("velour.png");
            if let Some(path) = path {
                check_apart(output, path)?;
            }
            render_default(&scene, output)?;
            scene.notices.iter().for_each(complain);
            let what = if path.is_some() { &name } else { "the default scene" };
            say(format!("{no_display}: {what} is rendered to {}", output.display()));
            Ok(())
        }
    }
}

/// The scene in a file, or the default one, and its name.
fn load(path: Option<&Path>) -> Result<(String, Scene), Failure> {
    let Some(path) = path else {
        return Ok((DRAPE.name.to_owned(), DRAPE.load().map_err(Failure::input)?));
    };
    Ok((path.display().to_string(), gltf::load(path).map_err(Failure::input)?))
}

/// What `velour render` makes of the scene when no flag is given.
fn render_default(scene: &Scene, output: &Path) -> Result<(), Failure> {
    const SIZE: [u32; 2] = [1280, 720];
    check_writable(output).map_err(Failure::input)?;
    let settings = Settings::default();
    let picture = match pollster::block_on(device::open_offscreen(None)) {
        Err(DeviceError::NoAdapter) => {
            without_device::plain(scene, &settings, SIZE)?.display(settings.exposure, Default::default())
        }
        gpu => {
            let gpu = gpu.map_err(Failure::device)?;
            gpu.block_on(Offscreen::screenshot(&gpu, scene, &settings, SIZE)).map_err(render::failure)?
        }
    };
    write_atomically(output, &picture.to_png().map_err(Failure::input)?).map_err(Failure::input)
}
