//! What every way of rendering starts from: the scene, what is changed in it, the table.

use std::path::Path;

use velour::file::check_writable;
use velour::picture::Format;
use velour::scene::assets::DRAPE;
use velour::scene::{Camera, CameraEdit, Drawn, Edits, Kind, Scene, gltf, select};
use velour::table::SheenTable;

use crate::assignment;
use crate::console::complain;
use crate::failure::Failure;
use crate::output::check_apart;
use crate::picture_args::PictureArgs;
use crate::state;
use crate::timing::Timing;

/// What a picture is made of.
pub struct Inputs {
    pub format: Format,
    pub scene: Scene,
    pub table: SheenTable,
    /// Of the state and, over it, the flags.
    pub edits: Edits,
}

impl Inputs {
    /// Reads and checks everything that the flags name, the output first.
    pub fn load(arguments: &PictureArgs, timing: &mut Timing) -> Result<Self, Failure> {
        let format = Format::of(&arguments.output).map_err(Failure::input)?;
        check_writable(&arguments.output).map_err(Failure::input)?;
        let (scene, table) = timing.measure("load", || -> Result<_, Failure> {
            let scene = scene(arguments.scene.as_deref(), &arguments.loading.options(), &|_| ());
            Ok((scene.map_err(Failure::input)?, sheen_table(arguments.sheen_table.as_deref())?))
        })?;
        check_apart(&arguments.output, &scene, &arguments.files())?;
        let state =
            arguments.state.as_deref().map_or_else(|| Ok(Edits::default()), |path| state::load(path, &scene))?;
        let edits = state.then(&edits(arguments, &scene)?);
        Ok(Self { format, scene, table, edits })
    }

    /// The view that is wanted. A loaded scene has a camera.
    pub fn camera(&self) -> Camera {
        self.edits.camera(&self.scene)
    }

    /// The scene as it is drawn.
    pub fn drawn(&self) -> Drawn<'_> {
        Drawn::new(&self.scene, &self.edits)
    }

    /// Prints the scene's notices, which have waited until nothing can go wrong any more.
    pub fn warn(&self) {
        self.scene.notices.iter().for_each(complain);
    }
}

/// The scene in a file, or the default one; `stage` hears what is being done.
pub fn scene(path: Option<&Path>, options: &gltf::Options, stage: &dyn Fn(&'static str)) -> Result<Scene, String> {
    let loaded = path.map_or_else(|| DRAPE.load(), |path| gltf::load_in_stages(path, options, stage));
    loaded.map_err(|error| error.to_string())
}

/// What the flags change.
fn edits(arguments: &PictureArgs, scene: &Scene) -> Result<Edits, Failure> {
    let assigned = assignment::resolve(&arguments.set, scene).map_err(Failure::input)?;
    let camera = arguments.camera.as_deref().map(|wanted| camera(scene, wanted)).transpose()?;
    // One of `--set` goes before those for all materials, wherever it stands.
    Ok(Edits { camera, ..arguments.edits().then(&assigned) })
}

fn sheen_table(path: Option<&Path>) -> Result<SheenTable, Failure> {
    path.map_or_else(|| Ok(SheenTable::embedded()), |path| SheenTable::load(path).map_err(Failure::input))
}

fn camera(scene: &Scene, wanted: &str) -> Result<CameraEdit, Failure> {
    let found = select(scene, Kind::Camera, wanted);
    let found = found.map_err(|unknown| Failure::input(format!("--camera {wanted}: {unknown}")))?;
    Ok(CameraEdit::Loaded(found[0]))
}
