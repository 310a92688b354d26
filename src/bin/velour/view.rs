//! `velour view`: the window; and what stands in for it where there is no display.

use std::path::{Path, PathBuf};

use clap::Args;
use velour::file::{check_writable, write_atomically};
use velour::picture::Format;
use velour::renderer::{Offscreen, device};
use velour::scene::assets::DRAPE;
use velour::scene::gltf::{self, Options};
use velour::scene::{Drawn, Edits, Scene};
use velour::table::SheenTable;
use velour::viewer::ViewerError;

use crate::comment::command;
use crate::console::{complain, say};
use crate::exposed::Exposed;
use crate::failure::Failure;
use crate::loading::Loading;
use crate::output::check_apart;
use crate::render::Shows;
use crate::timing::Timing;
use crate::{render, state, without_device};

/// The flags of `velour view`.
#[derive(Args)]
pub struct View {
    /// glTF 2.0 scene, .glb or .gltf [default: a velvet drape]
    pub scene: Option<PathBuf>,
    /// What the viewer has saved: view, picture, materials, lights
    #[arg(long, value_name = "FILE")]
    pub state: Option<PathBuf>,
    #[command(flatten)]
    pub loading: Loading,
}

pub fn run(arguments: &View) -> Result<(), Failure> {
    let (name, scene) = load(arguments.scene.as_deref(), &arguments.loading.options())?;
    let edits = arguments.state.as_ref().map_or_else(|| Ok(Edits::default()), |path| state::load(path, &scene))?;
    render::check_real_time(&edits)?;
    let no_display = |error| Failure::device(format!("{error}: open a desktop, or use `velour render`"));
    let event_loop = velour::viewer::event_loop().map_err(no_display)?;
    scene.notices.iter().for_each(complain);
    velour::viewer::run(event_loop, &name, (scene, edits), SheenTable::embedded()).map_err(Failure::device)
}

/// The viewer; without a display, or a device that draws on it, the picture that it would show.
pub fn run_or_render(path: Option<&Path>, options: &Options) -> Result<(), Failure> {
    let (name, scene) = load(path, options)?;
    let event_loop = match velour::viewer::event_loop() {
        Ok(event_loop) => event_loop,
        Err(no_display) => return render_instead(&no_display, path, &scene, &scene.notices),
    };
    scene.notices.iter().for_each(complain);
    match velour::viewer::run(event_loop, &name, (scene, Edits::default()), SheenTable::embedded()) {
        // The viewer has kept the scene; what there is to say of it has been said.
        Err(why @ ViewerError::Device(_)) => render_instead(&why, path, &load(path, options)?.1, &[]),
        shown => shown.map_err(Failure::device),
    }
}

/// Renders the scene to velour.png, says what there is to say of it, and why it is not in a window.
fn render_instead(why: &ViewerError, path: Option<&Path>, scene: &Scene, notices: &[String]) -> Result<(), Failure> {
    let output = Path::new("velour.png");
    check_apart(output, scene, &[])?;
    render_default(scene, output)?;
    notices.iter().for_each(complain);
    let what = path.map_or("the default scene".to_owned(), |path| path.display().to_string());
    say(format!("{why}: {what} is rendered to {}", output.display()));
    Ok(())
}

/// The scene in a file, or the default one, and its name.
fn load(path: Option<&Path>, options: &Options) -> Result<(String, Scene), Failure> {
    let Some(path) = path else {
        return Ok((DRAPE.name.to_owned(), DRAPE.load().map_err(Failure::input)?));
    };
    Ok((path.display().to_string(), gltf::load(path, options).map_err(Failure::input)?))
}

/// What `velour render` makes of the scene when no flag is given.
fn render_default(scene: &Scene, output: &Path) -> Result<(), Failure> {
    const SIZE: [u32; 2] = [1280, 720];
    const SAMPLES: u32 = 4;
    check_writable(output).map_err(Failure::input)?;
    let edits = Edits::default();
    let exposed = match pollster::block_on(device::open_offscreen(None)) {
        Err(why) => without_device::plain(&why, scene, &edits, SIZE)?,
        Ok(gpu) => {
            let (drawn, camera) = (Drawn::new(scene, &edits), edits.camera(scene));
            let renderer = Offscreen::nearest_for_display(&gpu, SAMPLES, &SheenTable::embedded(), &drawn);
            let mut renderer = renderer.map_err(render::failure)?;
            let (settings, timing) = (&drawn.settings, &mut Timing::default());
            let mut shows = Shows { gpu: &gpu, renderer: &mut renderer, camera: &camera, size: SIZE, settings, timing };
            let exposed = Exposed::new(&edits, &mut shows)?;
            renderer.notice().into_iter().for_each(complain);
            // With shadows all samples are drawn one by one.
            let wanted = if renderer.has_shadows(settings) { 1 } else { SAMPLES };
            render::shortfall(renderer.radiance(), wanted, Format::Png).into_iter().for_each(complain);
            exposed
        }
    };
    let bytes = exposed.picture.to_png_with_comment(&command()).map_err(Failure::input)?;
    write_atomically(output, &bytes).map_err(Failure::input)?;
    exposed.warn();
    Ok(())
}
