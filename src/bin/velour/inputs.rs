//! What every way of rendering starts from: the scene, the table, the settings.

use std::path::Path;

use velour::file::check_writable;
use velour::picture::Format;
use velour::scene::{Camera, Overrides, Scene, Settings, gltf};
use velour::table::SheenTable;

use crate::console::complain;
use crate::failure::Failure;
use crate::output::check_apart;
use crate::overrides;
use crate::picture_args::{PictureArgs, Switch};
use crate::timing::Timing;

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
    /// Reads and checks everything that the flags name, the output first.
    pub fn load(arguments: &PictureArgs, timing: &mut Timing) -> Result<Self, Failure> {
        let format = Format::of(&arguments.output).map_err(Failure::input)?;
        check_writable(&arguments.output).map_err(Failure::input)?;
        let (scene, table) = timing.measure("load", || -> Result<_, Failure> {
            let scene = gltf::load(&arguments.scene).map_err(Failure::input)?;
            Ok((scene, sheen_table(arguments.sheen_table.as_deref())?))
        })?;
        check_apart(&arguments.output, &scene, arguments.sheen_table.as_deref())?;
        let camera = camera(&scene, arguments.camera.as_deref())?;
        let settings = settings(arguments, &scene)?;
        Ok(Self { format, scene, table, settings, camera })
    }

    pub fn camera(&self) -> &Camera {
        &self.scene.cameras[self.camera]
    }

    /// Prints the scene's notices, which have waited until nothing can go wrong any more.
    pub fn warn(&self) {
        self.scene.notices.iter().for_each(complain);
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
