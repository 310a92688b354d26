//! How a picture that is shown came to its exposure, and what there is to say of it.

use velour::picture::{Blank, DisplayImage, Exposure};
use velour::scene::Edits;

use crate::console::{complain, say};
use crate::failure::Failure;

/// A picture that is shown.
pub struct Exposed {
    pub picture: DisplayImage,
    /// In stops.
    pub exposure: f32,
    is_metered: bool,
    /// Where it shows next to nothing, what to try.
    advice: Option<String>,
}

/// What shows a picture, and can meter it.
pub trait Exposes {
    /// The exposure value that metering takes; none where nothing is lit.
    fn meter(&mut self) -> Result<Option<f32>, Failure>;
    /// The picture at this exposure.
    fn display(&mut self, exposure: f32) -> Result<DisplayImage, Failure>;
}

impl Exposed {
    /// The picture at the exposure that the edits name, or have metered.
    pub fn new(edits: &Edits, shows: &mut impl Exposes) -> Result<Self, Failure> {
        let is_metered = edits.exposure == Some(Exposure::Auto);
        let exposure = if is_metered { shows.meter()?.unwrap_or(0.0) } else { edits.settings().exposure };
        let picture = shows.display(exposure)?;
        let advice = match Blank::of(&picture) {
            Some(blank) => blank.advice(exposure, shows.meter()?),
            None => None,
        };
        Ok(Self { picture, exposure, is_metered, advice })
    }

    /// Complains where the picture shows next to nothing.
    pub fn warn(&self) {
        self.advice.iter().for_each(complain);
    }

    /// Says what was metered.
    pub fn report(&self) {
        if self.is_metered {
            say(format!("exposure auto took {} EV", self.exposure));
        }
    }
}
