//! A linear picture, and what becomes of it in a file: .exr as it is, .png through exposure, tone curve and sRGB. And
//! how two pictures differ: in their numbers, and to the eye (FLIP, with feature `cli`).

#[cfg(test)]
#[path = "tests/claims.rs"]
mod claims_tests;
mod difference;
mod exposure;
#[cfg(test)]
#[path = "tests/exposure.rs"]
mod exposure_tests;
mod extent;
#[cfg(feature = "cli")]
mod flip;
mod format;
mod layers;
#[cfg(test)]
#[path = "tests/layers.rs"]
mod layers_tests;
#[cfg(test)]
#[path = "tests/meaning.rs"]
mod meaning_tests;
mod read;
mod samples;
mod tone;
mod write;

pub use difference::{Differences, LargestDifference};
pub use exposure::{Blank, Exposure, metered, metered_size};
#[cfg(feature = "cli")]
pub use flip::{Exposures, FlipMap};
pub use format::{Format, FormatError};
pub use read::{MAX_PIXELS, MAX_SIDE, Picture, ReadError};
pub use tone::{ToneCurve, srgb_from_linear};

/// A picture in linear Rec. 709 radiance: rows from the top, pixels from the left.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearImage {
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// `width * height` triples.
    pub pixels: Vec<[f32; 3]>,
}

/// A picture as it is shown: sRGB, 8 bits a channel, rows from the top, pixels from the left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DisplayImage {
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// `width * height` triples.
    pub pixels: Vec<[u8; 3]>,
}

impl LinearImage {
    /// The picture as it is shown: radiance times `2^exposure`, through the tone curve, in sRGB.
    pub fn display(&self, exposure: f32, tone: ToneCurve) -> DisplayImage {
        let gain = exposure.exp2();
        let show = |pixel: &[f32; 3]| encoded(tone.apply(pixel.map(|channel| channel * gain)));
        DisplayImage { width: self.width, height: self.height, pixels: self.pixels.iter().map(show).collect() }
    }

    /// The same where unlit surfaces, which are shown as they are, cover a share of each pixel: `unlit` has what of its
    /// radiance they show, and that share, in [0, 1]. The sum of it and the exposed rest goes through the tone curve by
    /// the share of the rest.
    pub fn display_with_unlit(&self, unlit: &[[f32; 4]], exposure: f32, tone: ToneCurve) -> DisplayImage {
        assert_eq!(unlit.len(), self.pixels.len(), "number of pixels");
        let gain = exposure.exp2();
        let show = |(pixel, [red, green, blue, share]): (&[f32; 3], &[f32; 4])| {
            let as_it_is = [red, green, blue];
            let exposed = std::array::from_fn(|index| gain * (pixel[index] - as_it_is[index]) + as_it_is[index]);
            let shown = [ToneCurve::None, tone].map(|curve| curve.apply(exposed));
            encoded(std::array::from_fn(|index| share * shown[0][index] + (1.0 - share) * shown[1][index]))
        };
        let pixels = self.pixels.iter().zip(unlit).map(show).collect();
        DisplayImage { width: self.width, height: self.height, pixels }
    }
}

fn encoded(shown: [f32; 3]) -> [u8; 3] {
    shown.map(|channel| (srgb_from_linear(channel) * 255.0).round() as u8)
}

impl DisplayImage {
    /// Reads the bytes of a PNG file, reduced to 8 bits a channel; its alpha is ignored.
    pub fn from_png(bytes: &[u8]) -> Result<Self, image::ImageError> {
        let image = image::load_from_memory_with_format(bytes, image::ImageFormat::Png)?.into_rgb8();
        let (width, height) = image.dimensions();
        Ok(Self { width, height, pixels: image.pixels().map(|pixel| pixel.0).collect() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gradient() -> LinearImage {
        let pixels = (0..12).map(|i| [i as f32 * 0.1, 1e-6, 1e5 / (1 + i) as f32]).collect();
        LinearImage { width: 4, height: 3, pixels }
    }

    #[test]
    fn exr_keeps_every_bit() {
        let picture = gradient();
        let bytes = picture.to_exr().unwrap();
        let back = image::load_from_memory_with_format(&bytes, image::ImageFormat::OpenExr).unwrap().into_rgb32f();
        assert_eq!(back.dimensions(), (4, 3));
        assert!(back.pixels().zip(&picture.pixels).all(|(read, written)| read.0 == *written));
    }

    #[test]
    fn png_round_trip() {
        let shown = gradient().display(0.5, ToneCurve::Neutral);
        assert_eq!(DisplayImage::from_png(&shown.to_png().unwrap()).unwrap(), shown);
        assert!(DisplayImage::from_png(b"not a png").is_err());
    }

    #[test]
    fn exposure_doubles_with_each_stop() {
        let picture = LinearImage { width: 1, height: 1, pixels: vec![[0.1, 0.05, 0.2]] };
        let twice = LinearImage { width: 1, height: 1, pixels: vec![[0.2, 0.1, 0.4]] };
        assert_eq!(picture.display(1.0, ToneCurve::None), twice.display(0.0, ToneCurve::None));
        assert_ne!(picture.display(0.0, ToneCurve::None), twice.display(0.0, ToneCurve::None));
    }
}
