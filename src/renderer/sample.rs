use super::pipelines::Stage;

/// Which of each pixel's samples a frame with shadows draws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// From 0: the first one begins a picture anew.
    pub index: u32,
    /// Another seed gives other noise.
    pub seed: u32,
    /// Whether samples lie all over the pixel, so that edges and textures converge to their mean over it; otherwise at its
    /// centre.
    pub spread: bool,
}

impl Sample {
    /// The only sample of a picture that has but one.
    pub const FIRST: Self = Self { index: 0, seed: 0, spread: false };

    /// Where it lies, from the pixel's centre, in pixels to the right and down: an even sequence (Roberts 2018) that starts at
    /// the centre.
    pub(super) fn offset(&self) -> [f32; 2] {
        const STEPS: [u32; 2] = [0xc13f_a9a9, 0x91e1_0da5];
        let place =
            |step: u32| f64::from(step.wrapping_mul(self.index).wrapping_add(1 << 31)) / f64::from(1u32 << 31) / 2.0;
        if self.spread { STEPS.map(|step| (place(step) - 0.5) as f32) } else { [0.0; 2] }
    }

    /// The side of what it stands for, in pixels: that of all samples so far, of which there is one more.
    pub(super) fn footprint(&self) -> f32 {
        if self.spread { (self.index as f32 + 1.0).sqrt().recip() } else { 1.0 }
    }

    pub(super) fn stage(&self, opacities: bool) -> Stage {
        Stage::Shadowed { filtered: self.spread, opacities }
    }
}
