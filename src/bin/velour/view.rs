//! `velour view`: the window; and what stands in for it where there is no display.

use std::path::{Path, PathBuf};

use clap::Args;
use velour::file::{check_writable, write_atomically};
use velour::picture::Format;
use velour::renderer::{Offscreen, RadianceFormat, device};
use velour::scene::assets::DRAPE;
use velour::scene::{Scene, Settings, gltf};
use velour::table::SheenTable;

use crate::console::{complain, say};
use crate::failure::Failure;
use crate::{render, without_device};

/// The flags of `velour view`.
#[derive(Args)]
pub struct View {
    /// glTF 2.0 scene, .glb or .gltf [default: a velvet drape]
    pub scene: Option<PathBuf>,
}

pub fn run(arguments: &View) -> Result<(), Failure> {
    let scene = match &arguments.scene {
        Some(path) => gltf::load(path).map_err(Failure::input)?,
        None => DRAPE.load().map_err(Failure::input)?,
    };
    let name = arguments.scene.as_ref().map_or(DRAPE.name.into(), |path| path.display().to_string());
    let no_display = |error| Failure::device(format!("{error}: open a desktop, or use `velour render`"));
    let event_loop = velour::viewer::event_loop().map_err(no_display)?;
    scene.notices.iter().for_each(complain);
    velour::viewer::run(event_loop, &name, scene, SheenTable::embedded()).map_err(Failure::device)
}

/// The viewer on the default scene; without a display, the picture that it would show.
pub fn run_or_render_default() -> Result<(), Failure> {
    let scene = DRAPE.load().map_err(Failure::input)?;
    match velour::viewer::event_loop() {
        Ok(event_loop) => {
            velour::viewer::run(event_loop, DRAPE.name, scene, SheenTable::embedded()).map_err(Failure::device)
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
fn render_default(scene: &Scene, output: &Path) -> Result<(), Failure> {
    const SIZE: [u32; 2] = [1280, 720];
    check_writable(output).map_err(Failure::input)?;
    let settings = Settings::default();
    let picture = match pollster::block_on(device::open_offscreen(None)) {
        Err(why) => without_device::plain(&why, scene, &settings, SIZE)?.display(settings.exposure, Default::default()),
        Ok(gpu) => {
            let picture = gpu.block_on(Offscreen::screenshot(&gpu, scene, &settings, SIZE)).map_err(render::failure)?;
            let radiance = RadianceFormat::nearest_display(&gpu.adapter, 4);
            radiance.and_then(|radiance| render::shortfall(radiance, 4, Format::Png)).into_iter().for_each(complain);
            picture
        }
    };
    write_atomically(output, &picture.to_png().map_err(Failure::input)?).map_err(Failure::input)
}
