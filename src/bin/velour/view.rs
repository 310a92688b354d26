//! `velour view`: the window; and what stands in for it where there is no display.

use std::path::{Path, PathBuf};

use clap::Args;
use velour::file::{check_writable, write_atomically};
use velour::picture::Format;
use velour::renderer::{Offscreen, device};
use velour::scene::assets::DRAPE;
use velour::scene::gltf::Options;
use velour::scene::{Drawn, Edits, Scene};
use velour::table::SheenTable;
use velour::viewer::{self, ViewerError};

use crate::comment::command;
use crate::console::{complain, say};
use crate::exposed::Exposed;
use crate::failure::Failure;
use crate::loading::Loading;
use crate::output::check_apart;
use crate::render::Shows;
use crate::timing::Timing;
use crate::{inputs, render, state, without_device};

/// The flags of `velour view`.
#[derive(Args)]
pub struct View {
    /// glTF 2.0 scene, .glb or .gltf [default: a velvet drape]
    pub scene: Option<PathBuf>,
    /// What the viewer has saved: view, picture, materials, lights; - reads it from standard input
    #[arg(long, value_name = "FILE")]
    pub state: Option<PathBuf>,
    #[command(flatten)]
    pub loading: Loading,
}

pub fn run(arguments: &View) -> Result<(), Failure> {
    let loading = load_aside(arguments.scene.clone(), arguments.loading.options(), arguments.state.clone());
    let event_loop = match viewer::event_loop() {
        Ok(event_loop) => event_loop,
        Err(error) => {
            // What is wrong with the scene comes first.
            loading.wait().map_err(Failure::input)?;
            return Err(Failure::device(format!("{error}: open a desktop, or use `velour render`")));
        }
    };
    let files = Box::new(Files(arguments.loading.options()));
    viewer::run(event_loop, loading, files, SheenTable::embedded()).map_err(failure)
}

/// The viewer; without a display, or a device that draws on it, the picture that it would show.
pub fn run_or_render(path: Option<&Path>, options: &Options) -> Result<(), Failure> {
    let loading = load_aside(path.map(Path::to_owned), options.clone(), None);
    let event_loop = match viewer::event_loop() {
        Ok(event_loop) => event_loop,
        Err(no_display) => return render_instead(&no_display, path, &*loading.wait().map_err(Failure::input)?),
    };
    match viewer::run(event_loop, loading, Box::new(Files(options.clone())), SheenTable::embedded()) {
        // The viewer has kept the scene.
        Err(why @ ViewerError::Device(_)) => {
            render_instead(&why, path, &inputs::scene(path, options, &|_| ()).map_err(Failure::input)?)
        }
        shown => shown.map_err(failure),
    }
}

fn failure(error: ViewerError) -> Failure {
    match error {
        ViewerError::Scene(why) => Failure::input(why),
        other => Failure::device(other),
    }
}

/// Files that are opened in the window are read with the flags that it was opened with.
struct Files(Options);

impl viewer::Files for Files {
    fn scene(&self, path: &Path) -> viewer::Loading {
        load_aside(Some(path.to_owned()), self.0.clone(), None)
    }

    fn state(&self, path: &Path, scene: &Scene) -> Result<Edits, String> {
        read_state(path, scene).map_err(|failure| failure.message)
    }

    fn command(&self, pictured: &viewer::Pictured) -> Result<String, String> {
        let scene = pictured.scene.files.first().map(|path| {
            let path = std::path::absolute(path).map_err(|error| error.to_string())?;
            path.into_os_string().into_string().map_err(|path| format!("{} is no text", path.display()))
        });
        Ok(render::command(scene.transpose()?.as_deref(), &Loading::words(&self.0), pictured))
    }
}

/// The edits in a state's file.
fn read_state(path: &Path, scene: &Scene) -> Result<Edits, Failure> {
    let edits = state::load(path, scene)?;
    render::check_real_time(&edits).map(|()| edits)
}

/// Loads a scene, and the edits in a state's file, while the window opens.
fn load_aside(path: Option<PathBuf>, options: Options, state: Option<PathBuf>) -> viewer::Loading {
    viewer::Loading::start(&name(path.as_deref()), move |stage| {
        let scene = inputs::scene(path.as_deref(), &options, stage)?;
        let edits = state.map_or_else(|| Ok(Edits::default()), |path| read_state(&path, &scene));
        let edits = edits.map_err(|failure| failure.message)?;
        scene.notices.iter().for_each(complain);
        Ok((scene, edits))
    })
}

/// What the window calls a scene.
fn name(path: Option<&Path>) -> String {
    path.map_or_else(|| DRAPE.name.to_owned(), |path| path.display().to_string())
}

/// Renders the scene to velour.png, says what there is to say of it, and why it is not in a window.
fn render_instead(why: &ViewerError, path: Option<&Path>, scene: &Scene) -> Result<(), Failure> {
    let output = Path::new("velour.png");
    check_apart(output, scene, &[])?;
    render_default(scene, output)?;
    let what = path.map_or("the default scene".to_owned(), |path| path.display().to_string());
    say(format!("{why}: {what} is rendered to {}", output.display()));
    Ok(())
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
