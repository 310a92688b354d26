//! What is drawn where there is no graphics device: the reference's picture of what real time would show.

use velour::reference::{Effort, Filter, Options, SpecularModel};
use velour::renderer::DeviceError;
#[cfg(feature = "window")]
use velour::renderer::SAMPLES;
#[cfg(feature = "window")]
use {
    crate::exposed::Exposed,
    crate::progress::with_progress,
    velour::reference::Reference,
    velour::scene::{Drawn, Edits, Scene},
    velour::table::SheenTable,
};

use crate::console::complain;
use crate::failure::Failure;
use crate::inputs::Inputs;
use crate::picture_args::PictureArgs;
use crate::reference;
use crate::timing::Timing;

/// Where nobody has said how much work to do. The light that the fitted lobes scatter has no noise but that of shadows; earlier
/// models and the reciprocal rule keep a few percent more.
#[cfg(feature = "window")]
const EFFORT: Effort = Effort { samples: SAMPLES as u64, seed: 0 };

/// What `velour render` draws, with so many samples; at the pixels' centres with `msaa` 1.
pub fn render(
    why: &DeviceError,
    arguments: &PictureArgs,
    (msaa, samples): (u32, u32),
    inputs: &Inputs,
    mut timing: Timing,
) -> Result<(), Failure> {
    let filter = if msaa == 1 { Filter::Centre } else { Filter::Box };
    let shadows = inputs.edits.settings().shadows;
    let options = Options { filter, shadows, max_bounces: 0, specular: SpecularModel::Ltc };
    let effort = Effort { samples: samples.into(), seed: arguments.seed.into() };
    complain(format!("{why}; the reference draws the picture, on the processor"));
    let rendered = reference::render(inputs, arguments, options, effort, &mut timing)?;
    reference::finish(arguments, inputs, &rendered, &mut timing)
}

/// What the viewer shows of a scene.
#[cfg(feature = "window")]
pub fn plain(why: &DeviceError, scene: &Scene, edits: &Edits, size: [u32; 2]) -> Result<Exposed, Failure> {
    let options = Options { shadows: edits.settings().shadows, ..Options::default() };
    let (drawn, camera) = (Drawn::new(scene, edits), edits.camera(scene));
    let mut renderer = Reference::new(&drawn, &SheenTable::embedded(), options).map_err(reference::failure)?;
    complain(format!("{why}; the reference draws the picture, on the processor"));
    let picture = with_progress("reference", |step| {
        renderer.render(&camera, size, EFFORT, |done, all| {
            step(done as usize, all as usize);
            true
        })
    });
    let (picture, tone) = (&picture.map_err(reference::failure)?, drawn.settings.tone);
    let mut shows = reference::Shows { renderer: &mut renderer, camera: &camera, size, picture, tone };
    Exposed::new(edits, &mut shows)
}
