//! A picture to be made, by the reference or otherwise.

use crate::picture::{DisplayImage, ToneCurve};
use crate::reference::{Effort, Options, Reference, ReferenceError};
use crate::scene::{Drawn, Edits, Scene, SceneError};
use crate::table::SheenTable;

/// A picture to be made.
pub struct Plate {
    /// The name of its file, without extension.
    pub name: String,
    /// What it is made with, one line each: enough to tell whether a file that exists already is this plate.
    pub settings: Vec<(&'static str, String)>,
    pub(super) make: Box<Make>,
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
    /// The caller asked for an end before the picture was whole.
    #[error("interrupted: run the command again, and it goes on with this picture")]
    Interrupted,
}

impl Plate {
    /// Renders the plate, which takes seconds to a minute.
    pub fn make(&self, progress: &Progress) -> Result<DisplayImage, PlateError> {
        (self.make)(progress)
    }
}

/// How the reference renders a scene.
pub(super) struct Shot {
    pub size: [u32; 2],
    pub samples: u64,
    pub exposure: f32,
    pub options: Options,
}

impl Shot {
    /// The lines of a plate's settings.
    pub fn settings(&self) -> [(&'static str, String); 4] {
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

    pub fn take(&self, scene: &Scene, edits: &Edits, progress: &Progress) -> Result<DisplayImage, PlateError> {
        let drawn = Drawn::new(scene, edits);
        let reference = Reference::new(&drawn, &SheenTable::embedded(), self.options)?;
        let effort = Effort { samples: self.samples, seed: 0 };
        let picture = reference.render(&scene.cameras[0], self.size, effort, progress)?;
        if picture.samples < self.samples {
            return Err(PlateError::Interrupted);
        }
        Ok(picture.radiance.display(self.exposure, ToneCurve::Neutral))
    }
}
