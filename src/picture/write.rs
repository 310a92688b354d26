//! Pictures as files that say what their numbers mean.

use std::io::Cursor;

use exr::image::write::WritableImage;
use exr::image::{Image, SpecificChannels};
use exr::math::Vec2;
use exr::meta::attribute::{Chromaticities, Text};
use image::ImageError;
use image::error::{EncodingError, ImageFormatHint};
use png::{BitDepth, ColorType, ScaledFloat, SourceChromaticities, SrgbRenderingIntent};

use super::{DisplayImage, Format, FormatError, LinearImage};

/// What wrote the file.
const SOFTWARE: &str = concat!("Velour ", env!("CARGO_PKG_VERSION"));

/// Rec. 709's white (D65), red, green and blue, CIE 1931 x and y in 1/100000 (ITU-R BT.709-6, item 1.3).
const REC709: [[u32; 2]; 4] = [[31270, 32900], [64000, 33000], [30000, 60000], [15000, 6000]];

impl LinearImage {
    /// The bytes of an OpenEXR file of 32-bit floats, with channels R, G and B, that names its primaries, those of Rec.
    /// 709.
    pub fn to_exr(&self) -> Result<Vec<u8>, FormatError> {
        self.to_exr_with_comment("")
    }

    /// The same, with a comment where there is one: what made the picture, say.
    pub fn to_exr_with_comment(&self, comment: &str) -> Result<Vec<u8>, FormatError> {
        let Self { width, height, pixels } = self;
        let size = [*width, *height].map(|side| side as usize);
        let rgb = |at: Vec2<usize>| {
            let [red, green, blue] = pixels[at.1 * size[0] + at.0];
            (red, green, blue)
        };
        let mut image = Image::from_channels((size[0], size[1]), SpecificChannels::rgb(rgb));
        let [white, red, green, blue] = REC709.map(|[x, y]| Vec2(x as f32 / 1e5, y as f32 / 1e5));
        image.attributes.chromaticities = Some(Chromaticities { red, green, blue, white });
        let attributes = &mut image.layer_data.attributes;
        // The format says nothing of an encoding; its library takes texts as UTF-8.
        let text = |text: &str| (!text.is_empty()).then(|| Text::from_slice_unchecked(text.as_bytes()));
        (attributes.software_name, attributes.comments) = (text(SOFTWARE), text(comment));
        let mut out = Cursor::new(Vec::new());
        image.write().to_buffered(&mut out).map_err(|source| encode_error(Format::Exr, source))?;
        Ok(out.into_inner())
    }
}

impl DisplayImage {
    /// The bytes of a PNG file that says that its values are sRGB.
    pub fn to_png(&self) -> Result<Vec<u8>, FormatError> {
        self.to_png_with_comment("")
    }

    /// The same, with a comment where there is one: what made the picture, say.
    pub fn to_png_with_comment(&self, comment: &str) -> Result<Vec<u8>, FormatError> {
        let mut out = Vec::new();
        self.encode_png(&mut out, comment).map_err(|source| encode_error(Format::Png, source))?;
        Ok(out)
    }

    fn encode_png(&self, out: &mut Vec<u8>, comment: &str) -> Result<(), png::EncodingError> {
        let mut encoder = png::Encoder::new(out, self.width, self.height);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_compression(png::Compression::Fast);
        encoder.set_filter(png::Filter::Adaptive);
        // An sRGB chunk goes before gAMA and cHRM (PNG 3, 4.3 and 11.3.2.5), which are for readers that do not know it.
        // The pictures are measured and compared, so their colours are wanted as they are, relative to white.
        encoder.set_source_srgb(SrgbRenderingIntent::RelativeColorimetric);
        encoder.set_source_gamma(ScaledFloat::from_scaled(45455));
        let [white, red, green, blue] = REC709.map(|[x, y]| (ScaledFloat::from_scaled(x), ScaledFloat::from_scaled(y)));
        encoder.set_source_chromaticities(SourceChromaticities { white, red, green, blue });
        encoder.add_text_chunk("Software".to_owned(), SOFTWARE.to_owned())?;
        if !comment.is_empty() {
            // In UTF-8, as paths may be.
            encoder.add_itxt_chunk("Comment".to_owned(), comment.to_owned())?;
        }
        let mut writer = encoder.write_header()?;
        writer.write_image_data(bytemuck::cast_slice(&self.pixels))?;
        writer.finish()
    }
}

fn encode_error(format: Format, source: impl Into<Box<dyn std::error::Error + Send + Sync>>) -> FormatError {
    let hint = match format {
        Format::Png => image::ImageFormat::Png,
        Format::Exr => image::ImageFormat::OpenExr,
    };
    FormatError::Encode {
        format,
        source: ImageError::Encoding(EncodingError::new(ImageFormatHint::Exact(hint), source)),
    }
}
