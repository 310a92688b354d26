//! `velour view`: the window; and what stands in for it where there is no display.

use std::path::{Path, PathBuf};

use clap::Args;
use velour::file::{check_writable, write_atomically};
use velour::picture::Format;
use velour::renderer::{Offscreen, RadianceFormat, device};
use velour::scene::assets::DRAPE;
use velour::scene::{Edits, Scene, gltf};
use velour::table::SheenTable;
use velour::viewer::ViewerError;

use crate::console::{complain, say};
use crate::failure::Failure;
use crate::output::check_apart;
use crate::{render, state, without_device};

/// The flags of `velour view`.
#[derive(Args)]
pub struct View {
    /// glTF 2.0 scene, .glb or .gltf [default: a velvet drape]
    pub scene: Option<PathBuf>,
    /// What the viewer has saved: view, picture, materials, lights
    #[arg(long, value_name = "FILE")]
    pub state: Option<PathBuf>,
}

pub fn run(arguments: &View) -> Result<(), Failure> {
    let (name, scene) = load(arguments.scene.as_deref())?;
    let edits = arguments.state.as_ref().map_or_else(|| Ok(Edits::default()), |path| state::load(path, &scene))?;
    render::check_real_time(&edits)?;
    let no_display = |error| Failure::device(format!("{error}: open a desktop, or use `velour render`"));
    let event_loop = velour::viewer::event_loop().map_err(no_display)?;
    scene.notices.iter().for_each(complain);
    velour::viewer::run(event_loop, &name, (scene, edits), SheenTable::embedded()).map_err(Failure::device)
}

/// The viewer; without a display, or a device that draws on it, the picture that it would show.
pub fn run_or_render(path: Option<&Path>) -> Result<(), Failure> {
    let (name, scene) = load(path)?;
    let notices = scene.notices.clone();
    let shown = velour::viewer::event_loop().and_then(|event_loop| {
        notices.iter().for_each(complain);
        velour::viewer::run(event_loop, &name, (scene, Edits::default()), SheenTable::embedded())
    });
    match shown {
        Err(why @ (ViewerError::NoDisplay(_) | ViewerError::Device(_))) => {
            let output = Path::new("velour.png");
            // The viewer has kept its own.
            let (_, scene) = load(path)?;
            check_apart(output, &scene, &[])?;
            render_default(&scene, output)?;
            if matches!(why, ViewerError::NoDisplay(_)) {
                notices.iter().for_each(complain);
            }
            let what = if path.is_some() { &name } else { "the default scene" };
            say(format!("{why}: {what} is rendered to {}", output.display()));
            Ok(())
        }
        shown => shown.map_err(Failure::device),
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
    const SAMPLES: u32 = 4;
    check_writable(output).map_err(Failure::input)?;
    let edits = Edits::default();
    let picture = match pollster::block_on(device::open_offscreen(None)) {
        Err(why) => without_device::plain(&why, scene, &edits, SIZE)?,
        Ok(gpu) => {
            let picture = gpu.block_on(Offscreen::screenshot(&gpu, scene, &edits, SIZE)).map_err(render::failure)?;
            let radiance = RadianceFormat::nearest_display(&gpu.adapter, SAMPLES);
            radiance
                .and_then(|radiance| render::shortfall(radiance, SAMPLES, Format::Png))
                .into_iter()
                .for_each(complain);
            picture
        }
    };
    write_atomically(output, &picture.to_png().map_err(Failure::input)?).map_err(Failure::input)
}
