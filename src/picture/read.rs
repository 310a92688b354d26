use std::fs::File;
use std::io::{BufReader, Seek};
use std::path::{Path, PathBuf};

use exr::meta::MetaData;
use image::codecs::png::PngDecoder;
use image::error::{DecodingError, ImageFormatHint};
use image::{DynamicImage, ImageDecoder, ImageError, ImageResult, Limits};

use super::extent::Extent;
use super::layers::{NoLayer, choose, layers};
use super::{DisplayImage, Format, LinearImage, samples};

/// The most pixels along a side of a picture that is read.
pub const MAX_SIDE: u32 = 16384;
/// The most pixels of a picture that is read: 7680 x 4320 is within it, and takes 400 MB.
pub const MAX_PIXELS: u64 = 1 << 25;

/// The most bytes of a piece of a .exr (some lines, or a tile) that is decoded at once: those of the largest picture with red, green,
/// blue and alpha in one tile.
const PIECE_BYTES_MAX: u64 = 16 * MAX_PIXELS;

/// A picture whose numbers mean what its kind of file says: linear radiance of a .exr, shown values in [0, 1] (sRGB) of
/// a .png. Rows from the top, pixels from the left.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The kind of its file, which says what its numbers mean.
    pub format: Format,
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// `width * height` triples.
    pub pixels: Vec<[f32; 3]>,
}

/// Why a picture could not be read, or two could not be compared.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file's name ends neither in .png nor in .exr.
    #[error("{}: the extension says what is read: use .png or .exr", path.display())]
    Extension {
        /// The file.
        path: PathBuf,
    },
    /// The file cannot be opened.
    #[error("{}: cannot be opened ({source}): name a picture that is there", path.display())]
    Open {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// What the path names is no file.
    #[error("{}: is no file: name a picture", path.display())]
    NoFile {
        /// What stands there instead, a folder perhaps.
        path: PathBuf,
    },
    /// The file is broken, or is not of the kind that its name says.
    #[error("{}: cannot be read as {format} ({source}): make it anew", path.display())]
    Decode {
        /// The file.
        path: PathBuf,
        /// What its extension says that it is.
        format: Format,
        /// What the decoder says.
        source: ImageError,
    },
    /// The picture has more pixels than [`MAX_SIDE`] and [`MAX_PIXELS`] allow.
    #[error(
        "{}: {width}x{height} is too large: {MAX_SIDE} pixels a side and {MAX_PIXELS} in all are read; crop or scale it",
        path.display()
    )]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// In pixels; of a .exr perhaps of its data, which may reach beyond what it shows.
        width: u64,
        /// In pixels.
        height: u64,
    },
    /// A .exr is cut into pieces that each hold more than can be decoded at once.
    #[error(
        "{}: a tile or block of lines takes {bytes} bytes, of {PIECE_BYTES_MAX} that are read: save it in lines, with fewer channels",
        path.display()
    )]
    Pieces {
        /// The file.
        path: PathBuf,
        /// Bytes of the largest piece.
        bytes: u64,
    },
    /// A .exr has nothing that could be compared as a picture.
    #[error("{}: has no layer of red, green and blue, or of luminance alone: render it with colours", path.display())]
    NoColors {
        /// The file.
        path: PathBuf,
    },
    /// A .exr has several layers, and none is the picture by its name.
    #[error("{}: which of its layers is meant? it has {names}: pick one with --layer NAME", path.display())]
    Undecided {
        /// The file.
        path: PathBuf,
        /// Those that are there, cut where there are many.
        names: String,
    },
    /// The layer that was asked for is not there.
    #[error("{}: has no layer {wanted}: it has {names}", path.display())]
    UnknownLayer {
        /// The file.
        path: PathBuf,
        /// What was asked for.
        wanted: String,
        /// Those that are there, cut where there are many.
        names: String,
    },
    /// Pictures of shown values have no layers.
    #[error("{}: a .png has no layers: leave out --layer", path.display())]
    Layerless {
        /// The file.
        path: PathBuf,
    },
    /// Some of the picture's numbers are infinite or not a number.
    #[error(
        "{}: {count} pixels are infinite or not a number, the first at {x},{y} from the top left: mend them, or render it anew",
        path.display()
    )]
    NotFinite {
        /// The file.
        path: PathBuf,
        /// How many pixels are not finite.
        count: usize,
        /// Where the first one is, in pixels from the left.
        x: u32,
        /// Where the first one is, in rows from the top.
        y: u32,
    },
    /// One picture is linear radiance and the other is not.
    #[error(
        "{} is linear radiance and {} is as shown: compare two .exr or two .png",
        exr.display(), png.display()
    )]
    Kinds {
        /// The one of linear radiance.
        exr: PathBuf,
        /// The one of shown values.
        png: PathBuf,
    },
    /// The pictures differ in size.
    #[error(
        "{} is {}x{} and {} is {}x{}: give both the same size",
        first.display(), sizes[0][0], sizes[0][1], second.display(), sizes[1][0], sizes[1][1]
    )]
    Sizes {
        /// The first file.
        first: PathBuf,
        /// The second file.
        second: PathBuf,
        /// Width and height of each, in pixels.
        sizes: [[u32; 2]; 2],
    },
}

impl Picture {
    /// Reads a .png of 8 or 16 bits a channel, or a .exr of halves or floats. Alpha is left out. Of the layers of a .exr
    /// the plain channels R, G and B are taken; without these, the only layer with colours; of several the one whose
    /// name ends in `Combined`, else in `rgba`, `rgb`, `beauty`, `C` or `Ci`, whatever the case. Luminance alone (Y) is
    /// grey. No memory is taken for a picture that is larger than [`MAX_SIDE`] and [`MAX_PIXELS`] allow, and all numbers
    /// of a picture that is returned are finite.
    pub fn load(path: &Path) -> Result<Self, ReadError> {
        Self::load_layer(path, None)
    }

    /// Reads a picture as [`Self::load`] does; where a layer is named, that one of a .exr, by its whole name or by what
    /// stands behind a dot in it. A .exr whose only channels are plain ones is taken under any name.
    pub fn load_layer(path: &Path, layer: Option<&str>) -> Result<Self, ReadError> {
        let format = format_of(path)?;
        let open_error = |source| ReadError::Open { path: path.to_owned(), source };
        if !std::fs::metadata(path).map_err(open_error)?.is_file() {
            return Err(ReadError::NoFile { path: path.to_owned() });
        }
        let file = BufReader::new(File::open(path).map_err(open_error)?);
        let picture = match (format, layer) {
            (Format::Png, Some(_)) => return Err(ReadError::Layerless { path: path.to_owned() }),
            (Format::Png, None) => {
                let image = decode(path, format, PngDecoder::with_limits(file, Limits::default()))?.into_rgb16();
                // Values of 8 bits come as 257 times themselves, so the quotients are the same.
                let shown = |channel| f32::from(channel) / f32::from(u16::MAX);
                let (width, height) = image.dimensions();
                Self { format, width, height, pixels: image.pixels().map(|pixel| pixel.0.map(shown)).collect() }
            }
            (Format::Exr, layer) => load_exr(path, file, layer)?.into(),
        };
        picture.check_finite(path)?;
        Ok(picture)
    }

    /// Reads two pictures, which must be of the same kind and size to be compared; of each the layer that is named, as
    /// [`Self::load_layer`] does.
    pub fn load_pair(first: &Path, second: &Path, layer: Option<&str>) -> Result<[Self; 2], ReadError> {
        match [format_of(first)?, format_of(second)?] {
            [Format::Exr, Format::Png] => Err(ReadError::Kinds { exr: first.to_owned(), png: second.to_owned() }),
            [Format::Png, Format::Exr] => Err(ReadError::Kinds { exr: second.to_owned(), png: first.to_owned() }),
            _ => Ok(()),
        }?;
        let pair = [Self::load_layer(first, layer)?, Self::load_layer(second, layer)?];
        let sizes = pair.each_ref().map(|picture| [picture.width, picture.height]);
        if sizes[0] != sizes[1] {
            return Err(ReadError::Sizes { first: first.to_owned(), second: second.to_owned(), sizes });
        }
        Ok(pair)
    }

    /// Where the pixel of an index is: pixels from the left, rows from the top.
    pub(super) fn place(&self, index: usize) -> [u32; 2] {
        [index as u32 % self.width, index as u32 / self.width]
    }

    pub(super) fn assert_comparable(&self, other: &Self) {
        let about = |picture: &Self| (picture.format, picture.width, picture.height);
        assert_eq!(about(self), about(other), "pictures of one kind and one size are compared");
        for picture in [self, other] {
            assert!(picture.width > 0 && picture.height > 0, "{}x{}", picture.width, picture.height);
            assert_eq!(picture.pixels.len(), picture.width as usize * picture.height as usize, "number of pixels");
            if let Some((count, at)) = picture.not_finite() {
                panic!("{count} pixels are infinite or not a number, the first at {at:?}");
            }
        }
    }

    fn check_finite(&self, path: &Path) -> Result<(), ReadError> {
        match self.not_finite() {
            None => Ok(()),
            Some((count, [x, y])) => Err(ReadError::NotFinite { path: path.to_owned(), count, x, y }),
        }
    }

    /// How many pixels are infinite or not a number, and where the first one is.
    fn not_finite(&self) -> Option<(usize, [u32; 2])> {
        let wrong = |pixel: &[f32; 3]| !pixel.iter().all(|channel| channel.is_finite());
        let first = self.pixels.iter().position(wrong)?;
        Some((self.pixels[first..].iter().filter(|pixel| wrong(pixel)).count(), self.place(first)))
    }
}

impl From<LinearImage> for Picture {
    fn from(image: LinearImage) -> Self {
        Self { format: Format::Exr, width: image.width, height: image.height, pixels: image.pixels }
    }
}

impl From<&DisplayImage> for Picture {
    fn from(image: &DisplayImage) -> Self {
        let pixels = image.pixels.iter().map(|pixel| pixel.map(|channel| f32::from(channel) / 255.0)).collect();
        Self { format: Format::Png, width: image.width, height: image.height, pixels }
    }
}

fn format_of(path: &Path) -> Result<Format, ReadError> {
    Format::of(path).map_err(|_| ReadError::Extension { path: path.to_owned() })
}

/// Checks the size before memory is taken for the pixels.
fn decode(path: &Path, format: Format, decoder: ImageResult<impl ImageDecoder>) -> Result<DynamicImage, ReadError> {
    let error = |source| ReadError::Decode { path: path.to_owned(), format, source };
    let decoder = decoder.map_err(error)?;
    let (width, height) = decoder.dimensions();
    check_size(path, [width, height].map(u64::from))?;
    DynamicImage::from_decoder(decoder).map_err(error)
}

/// What a layer of a .exr shows, checked in its head before memory is taken for it.
fn load_exr(path: &Path, mut file: BufReader<File>, layer: Option<&str>) -> Result<LinearImage, ReadError> {
    let error = |error: exr::error::Error| {
        let hint = ImageFormatHint::Exact(image::ImageFormat::OpenExr);
        let source = ImageError::Decoding(DecodingError::new(hint, error));
        ReadError::Decode { path: path.to_owned(), format: Format::Exr, source }
    };
    // The head alone at first: a reader already checks it against the tables behind it.
    let head = MetaData::read_from_buffered(&mut file, false).map_err(error)?;
    check_extent(path, Extent::of(&head.headers))?;
    file.rewind().map_err(|source| ReadError::Open { path: path.to_owned(), source })?;
    let reader = exr::block::read(file, false).map_err(error)?;
    let path = path.to_owned();
    let chosen = match choose(&layers(reader.headers()), layer) {
        Ok(chosen) => chosen,
        Err(NoLayer::Colors) => return Err(ReadError::NoColors { path }),
        Err(NoLayer::Undecided(names)) => return Err(ReadError::Undecided { path, names }),
        Err(NoLayer::Unknown(names)) => {
            return Err(ReadError::UnknownLayer { path, wanted: layer.unwrap_or_default().to_owned(), names });
        }
    };
    samples::read(reader, &chosen).map_err(error)
}

/// A .exr may have data for more than it shows, and a decoder takes memory for both.
fn check_extent(path: &Path, Extent { windows, piece_bytes }: Extent) -> Result<(), ReadError> {
    windows.into_iter().try_for_each(|size| check_size(path, size))?;
    match piece_bytes {
        bytes if bytes > PIECE_BYTES_MAX => Err(ReadError::Pieces { path: path.to_owned(), bytes }),
        _ => Ok(()),
    }
}

fn check_size(path: &Path, [width, height]: [u64; 2]) -> Result<(), ReadError> {
    if width.max(height) > MAX_SIDE.into() || width * height > MAX_PIXELS {
        return Err(ReadError::TooLarge { path: path.to_owned(), width, height });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn put(folder: &tempfile::TempDir, name: &str, image: &DynamicImage) -> PathBuf {
        let path = folder.path().join(name);
        image.save(&path).unwrap();
        path
    }

    /// 8 and 16 bits, grey and with alpha: what is shown, to the last bit.
    #[test]
    fn png_of_any_depth_is_read_as_shown() {
        let folder = tempfile::tempdir().unwrap();
        let bytes = image::RgbImage::from_fn(2, 1, |x, _| image::Rgb([[255, 51, 0], [1, 128, 254]][x as usize]));
        let alpha =
            image::RgbaImage::from_fn(2, 1, |x, _| image::Rgba([[255, 51, 0, 9], [1, 128, 254, 0]][x as usize]));
        let words =
            image::ImageBuffer::from_fn(2, 1, |x, _| image::Rgb([[65535, 13107, 0], [1, 0, 65534]][x as usize]));
        let grey = image::GrayImage::from_fn(2, 1, |x, _| image::Luma([[0], [51]][x as usize]));
        let quotient = |of: u16, all: u16| f32::from(of) / f32::from(all);
        let eight = vec![[1.0, 0.2, 0.0], [quotient(1, 255), quotient(128, 255), quotient(254, 255)]];
        for (image, pixels) in [
            (DynamicImage::ImageRgb8(bytes), eight.clone()),
            (DynamicImage::ImageRgba8(alpha), eight),
            (DynamicImage::ImageRgb16(words), vec![[1.0, 0.2, 0.0], [quotient(1, 65535), 0.0, quotient(65534, 65535)]]),
            (DynamicImage::ImageLuma8(grey), vec![[0.0; 3], [0.2; 3]]),
        ] {
            let read = Picture::load(&put(&folder, "picture.png", &image)).unwrap();
            assert_eq!(read, Picture { format: Format::Png, width: 2, height: 1, pixels });
        }
    }

    #[test]
    fn exr_is_read_as_it_is() {
        let folder = tempfile::tempdir().unwrap();
        let pixels = vec![[1e-30, -2.5, 7e30], [0.1, 0.2, 0.3]];
        let alpha = image::Rgba32FImage::from_fn(1, 2, |_, y| {
            let [red, green, blue] = pixels[y as usize];
            image::Rgba([red, green, blue, 0.5])
        });
        let expected = Picture { format: Format::Exr, width: 1, height: 2, pixels: pixels.clone() };
        assert_eq!(Picture::load(&put(&folder, "a.exr", &DynamicImage::ImageRgba32F(alpha))).unwrap(), expected);
        let own = LinearImage { width: 1, height: 2, pixels };
        std::fs::write(folder.path().join("b.exr"), own.to_exr().unwrap()).unwrap();
        assert_eq!(Picture::load(&folder.path().join("b.exr")).unwrap(), expected);
        assert_eq!(Picture::from(own), expected);
    }

    #[test]
    fn what_is_not_finite_is_counted_and_found() {
        let folder = tempfile::tempdir().unwrap();
        let mut picture = LinearImage { width: 5, height: 4, pixels: vec![[1.0; 3]; 20] };
        picture.pixels[13] = [f32::NAN; 3];
        picture.pixels[17][2] = f32::NEG_INFINITY;
        let path = folder.path().join("a.exr");
        std::fs::write(&path, picture.to_exr().unwrap()).unwrap();
        let said = Picture::load(&path).unwrap_err().to_string();
        assert!(said.contains("a.exr: 2 pixels") && said.contains("at 3,2 "), "{said}");
    }
}
