//! Pictures of surfaces: the figures of Zeltner, Burley and Chiang 2022 made anew, and comparisons of our own, by the reference renderer.
//!
//! | plates | what they show |
//! |---|---|
//! | `cloth_*` | their figure 1: a cloth asset without sheen, with one of low and with one of high roughness |
//! | `sphere_*` | their figure 2: a sphere lit from the front, from 90 and from 130 degrees, by our sheen, by explicit fibres, by models of prior work |
//! | `dust` | their figure 3: dust of roughness .85 on a sculpted form |
//! | `sweep_*` | their supplement's: all models over roughness |
//! | `layers_*` | the fit, the slab and the walk of one sphere; the layering rules and the walk through both layers |
//!
//! The scenes are the program's own; the shapes in the paper's figures are others.

mod ball;
mod page;
mod scenes;
mod spheres;

pub use page::page;

use crate::picture::{DisplayImage, ToneCurve};
use crate::reference::{Effort, Options, Reference, ReferenceError};
use crate::scene::{Scene, SceneError, Settings};
use crate::table::SheenTable;

/// A picture to be made.
pub struct Plate {
    /// The name of its file, without extension.
    pub name: String,
    /// What it is made with, one line each: enough to tell whether a file that exists already is this plate.
    pub settings: Vec<(&'static str, String)>,
    make: Box<Make>,
}

type Make = dyn Fn(&Progress) -> Result<DisplayImage, PlateError> + Send;

/// Called with the numbers of steps (done, all) of a plate, from any thread; returns whether to go on.
pub type Progress<'a> = dyn Fn(u64, u64) -> bool + Sync + 'a;

/// Why a plate was not made.
#[derive(Debug, thiserror::Error)]
pub enum PlateError {
    /// The asset was not read.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The reference renderer could not render the scene.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
    /// [`Progress`] said to stop.
    #[error("interrupted: run the command again, and it goes on with this picture")]
    Interrupted,
}

impl Plate {
    /// Renders the plate, which takes seconds to a minute.
    pub fn make(&self, progress: &Progress) -> Result<DisplayImage, PlateError> {
        (self.make)(progress)
    }
}

/// All plates, in order.
pub fn plates() -> Vec<Plate> {
    [scenes::plates(), spheres::prior_work(), spheres::sweep(), spheres::layers()].into_iter().flatten().collect()
}

/// How the reference renders a scene.
struct Shot {
    size: [u32; 2],
    samples: u64,
    exposure: f32,
    options: Options,
}

impl Shot {
    /// The lines of a plate's settings.
    fn settings(&self) -> [(&'static str, String); 4] {
        let Self { size: [width, height], samples, exposure, options } = self;
        let Options { max_bounces, shadows, filter, specular } = options;
        let options = format!("max bounces {max_bounces}, shadows {shadows}, {filter:?} filter, {specular:?} specular");
        [
            ("size", format!("{width}x{height}")),
            ("samples", samples.to_string()),
            ("exposure", format!("{exposure} EV, neutral tone curve")),
            ("reference", options.to_lowercase()),
        ]
    }

    fn take(&self, scene: &Scene, settings: &Settings, progress: &Progress) -> Result<DisplayImage, PlateError> {
        let reference = Reference::new(scene, settings, &SheenTable::embedded(), self.options)?;
        let effort = Effort { samples: self.samples, seed: 0 };
        let picture = reference.render(&scene.cameras[0], self.size, effort, progress)?;
        if picture.samples < self.samples {
            return Err(PlateError::Interrupted);
        }
        Ok(picture.radiance.display(self.exposure, ToneCurve::Neutral))
    }
}
