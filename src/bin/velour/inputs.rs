//! What every way of rendering starts from: the scene, the table, the settings; and how its time is told.

use std::path::Path;
use std::time::Instant;

use velour::file::check_writable;
use velour::picture::{Format, FormatError, LinearImage};
use velour::scene::{Camera, Overrides, Scene, Settings, gltf};
use velour::table::SheenTable;

use crate::output::is_same_file;
use crate::render_args::{PictureArgs, Switch};
use crate::{Failure, complain, overrides};

/// Seconds spent in the parts of a run, in order.
#[derive(Default)]
pub struct Timing(pub Vec<(&'static str, f64)>);

impl Timing {
    pub fn measure<T>(&mut self, part: &'static str, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let done = work();
        self.0.push((part, start.elapsed().as_secs_f64()));
        done
    }

    pub fn total(&self) -> f64 {
        self.0.iter().map(|(_, seconds)| seconds).sum()
    }
}

/// What a picture is made of.
pub struct Inputs {
    pub format: Format,
    pub scene: Scene,
    pub table: SheenTable,
    pub settings: Settings,
    /// Index into the scene's cameras.
    camera: usize,
}

impl Inputs {
    /// Reads and checks everything that the flags name. What can be wrong with the output is said first.
    pub fn load(arguments: &PictureArgs, timing: &mut Timing) -> Result<Self, Failure> {
        let format = Format::of(&arguments.output).map_err(Failure::input)?;
        check_writable(&arguments.output).map_err(Failure::input)?;
        check_apart(&arguments.output, &arguments.scene)?;
        let (scene, table) = timing.measure("load", || -> Result<_, Failure> {
            let scene = gltf::load(&arguments.scene).map_err(Failure::input)?;
            Ok((scene, sheen_table(arguments.sheen_table.as_deref())?))
        })?;
        let camera = camera(&scene, arguments.camera.as_deref())?;
        let settings = settings(arguments, &scene)?;
        Ok(Self { format, scene, table, settings, camera })
    }

    pub fn camera(&self) -> &Camera {
        &self.scene.cameras[self.camera]
    }

    /// Warnings have waited until nothing can go wrong any more.
    pub fn warn(&self) {
        self.scene.notices.iter().for_each(complain);
    }

    /// Refuses what takes a path tracer.
    #[cfg(feature = "gpu")]
    pub fn check_real_time(&self) -> Result<(), Failure> {
        let own = self.settings.material_overrides.values();
        for overrides in own.chain([&self.settings.overrides]) {
            if let Some(model) = overrides.sheen_model.filter(|model| !model.is_real_time()) {
                let name = model.name();
                return Err(Failure::input(format!(
                    "--sheen-model {name} takes a path tracer: use `velour reference`"
                )));
            }
            if overrides.layering == Some(velour::scene::Layering::Walk) {
                return Err(Failure::input("--layering walk takes a path tracer: use `velour reference`"));
            }
        }
        Ok(())
    }
}

/// Refuses to write over the scene.
pub fn check_apart(output: &Path, scene: &Path) -> Result<(), Failure> {
    let message = || format!("{}: is the scene itself: choose another place", output.display());
    if is_same_file(output, scene) { Err(Failure::input(message())) } else { Ok(()) }
}

/// A linear picture's file, in memory.
pub fn encoded(picture: &LinearImage, format: Format, arguments: &PictureArgs) -> Result<Vec<u8>, FormatError> {
    match format {
        Format::Png => picture.display(arguments.exposure, arguments.tonemap.into()).to_png(),
        Format::Exr => picture.to_exr(),
    }
}

fn settings(arguments: &PictureArgs, scene: &Scene) -> Result<Settings, Failure> {
    Ok(Settings {
        lobes: arguments.lobes,
        lights_visible: arguments.lights_visible == Switch::On,
        exposure: arguments.exposure,
        ambient: arguments.ambient,
        overrides: Overrides {
            alpha: arguments.alpha,
            sheen_color: arguments.sheen_color,
            roughness_map: arguments.roughness_map,
            sheen_model: arguments.sheen_model,
            layering: arguments.layering,
        },
        material_overrides: overrides::resolve(&arguments.set, &scene.materials).map_err(Failure::input)?,
    })
}

fn sheen_table(path: Option<&Path>) -> Result<SheenTable, Failure> {
    path.map_or_else(|| Ok(SheenTable::embedded()), |path| SheenTable::load(path).map_err(Failure::input))
}

/// Index of the camera that is wanted, else of the first.
fn camera(scene: &Scene, wanted: Option<&str>) -> Result<usize, Failure> {
    let Some(wanted) = wanted else {
        return if scene.cameras.is_empty() { Err(Failure::input("the scene has no camera")) } else { Ok(0) };
    };
    let found = scene.camera(wanted).and_then(|camera| scene.cameras.iter().position(|own| std::ptr::eq(own, camera)));
    found.ok_or_else(|| {
        let names: Vec<String> =
            scene.cameras.iter().enumerate().map(|(index, camera)| format!("{index} ({})", camera.name)).collect();
        Failure::input(format!("--camera {wanted}: the scene has no such camera; it has {}", names.join(", ")))
    })
}
