//! A picture's means, and their standard errors.

use glam::{DVec3, DVec4};

use super::luminance::luminance;
use crate::picture::{DisplayImage, LinearImage, ToneCurve};

/// A pixel's mean and the scatter of its batches about it (Welford 1962, weighted).
#[derive(Clone, Copy, Default)]
pub(super) struct Pixel {
    mean: DVec3,
    scatter: DVec3,
}

/// All pixels: rows from the top. Each is made of batches of samples that are independent of each other.
pub(super) struct Film {
    size: [u32; 2],
    pixels: Vec<Pixel>,
    /// Means of what of each pixel is unlit (`Seen::unlit`); empty where nothing can be.
    unlit: Vec<DVec4>,
    samples: u64,
    batches: u64,
}

/// Means of a batch over some pixels, or all.
#[derive(Default)]
pub(super) struct Means {
    pub radiance: Vec<DVec3>,
    /// `Seen::unlit`; empty where nothing can be.
    pub unlit: Vec<DVec4>,
}

impl Film {
    /// `has_unlit`: whether there are unlit surfaces.
    pub fn new(size: [u32; 2], has_unlit: bool) -> Self {
        let count = size[0] as usize * size[1] as usize;
        let unlit = vec![DVec4::ZERO; if has_unlit { count } else { 0 }];
        Self { size, pixels: vec![Pixel::default(); count], unlit, samples: 0, batches: 0 }
    }

    /// Adds a batch of `samples` a pixel, by the means of all pixels, in parts that follow each other.
    pub fn add(&mut self, means: &[Means], samples: u64) {
        self.samples += samples;
        self.batches += 1;
        let (weight, share) = (samples as f64, samples as f64 / self.samples as f64);
        for (pixel, mean) in self.unlit.iter_mut().zip(means.iter().flat_map(|means| &means.unlit)) {
            *pixel += share * (*mean - *pixel);
        }
        for (pixel, &mean) in self.pixels.iter_mut().zip(means.iter().flat_map(|means| &means.radiance)) {
            let before = mean - pixel.mean;
            pixel.mean += share * before;
            pixel.scatter += weight * before * (mean - pixel.mean);
        }
    }

    pub fn finish(self) -> Picture {
        let Self { size: [width, height], samples, batches, pixels, unlit } = self;
        let image = |value: &dyn Fn(&Pixel) -> DVec3| {
            let pixels = pixels.iter().map(|pixel| value(pixel).as_vec3().to_array()).collect();
            LinearImage { width, height, pixels }
        };
        // Values beyond a file's range are stored as its greatest number.
        let greatest = f64::from(f32::MAX);
        let deviation = |pixel: &Pixel| {
            let scale = if batches > 1 { 1.0 / ((batches - 1) as f64 * samples as f64) } else { f64::NAN };
            (pixel.scatter * scale).map(f64::sqrt)
        };
        Picture {
            radiance: image(&|pixel| pixel.mean.map(|value| if value > greatest { greatest } else { value })),
            errors: image(&deviation),
            unlit: unlit.into_iter().map(|pixel| pixel.as_vec4().to_array()).collect(),
            samples,
            batches,
        }
    }
}

/// A rendered picture.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Linear radiance: the mean of each pixel's samples.
    pub radiance: LinearImage,
    /// The standard error of each pixel and channel, estimated from its batches; not a number where there is one batch
    /// only.
    pub errors: LinearImage,
    /// What of each pixel's radiance unlit surfaces show, and the share of it that they cover; empty where there are none.
    unlit: Vec<[f32; 4]>,
    /// Samples a pixel.
    pub samples: u64,
    /// Independent batches that the samples come in.
    pub batches: u64,
}

impl Picture {
    /// The picture as it is shown; unlit surfaces as they are, whatever exposure and tone curve.
    pub fn display(&self, exposure: f32, tone: ToneCurve) -> DisplayImage {
        match self.unlit.as_slice() {
            [] => self.radiance.display(exposure, tone),
            unlit => self.radiance.display_with_unlit(unlit, exposure, tone),
        }
    }

    /// The same picture without what is unlit: black where that covers more than half of a pixel.
    pub(super) fn lit(&self) -> LinearImage {
        let mut lit = self.radiance.clone();
        for (pixel, [.., share]) in lit.pixels.iter_mut().zip(&self.unlit) {
            *pixel = if *share > 0.5 { [0.0; 3] } else { *pixel };
        }
        lit
    }

    /// The mean standard error of the pixels' luminance over their mean luminance: 0.01 is one percent of noise. None
    /// where it is not known, or where everything is black.
    pub fn relative_error(&self) -> Option<f64> {
        let sum =
            |image: &LinearImage| image.pixels.iter().map(|pixel| luminance(pixel.map(f64::from).into())).sum::<f64>();
        let (errors, radiance) = (sum(&self.errors), sum(&self.radiance));
        (errors.is_finite() && radiance > 0.0).then(|| errors / radiance)
    }

    /// The relative standard error of a pixel's luminance below which `share` in \[0, 1\] of the pixels that are not
    /// black lie.
    pub fn error_quantile(&self, share: f64) -> Option<f64> {
        let pair = |(error, pixel): (&[f32; 3], &[f32; 3])| {
            let [error, radiance] = [error, pixel].map(|pixel| luminance(pixel.map(f64::from).into()));
            (radiance > 0.0).then(|| error / radiance)
        };
        let mut relative: Vec<f64> = self.errors.pixels.iter().zip(&self.radiance.pixels).filter_map(pair).collect();
        relative.sort_by(f64::total_cmp);
        let at = (share * relative.len() as f64) as usize;
        relative.get(at.min(relative.len().saturating_sub(1))).copied().filter(|error| error.is_finite())
    }
}
