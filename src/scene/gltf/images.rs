//! Images: fetched, and decoded in parallel within bounds.

use std::borrow::Cow;
use std::io::Cursor;
use std::path::Path;

use gltf::json::Root;
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};
use rayon::prelude::*;

use super::Fault;
use super::buffers::{self, Bytes};
use super::ktx2;
use crate::scene::error::label;
use crate::scene::mipmap::half_of;
use crate::scene::notices::Notices;
use crate::scene::{Encoding, Image, Level};

/// The longest side of an image in texels: longer ones are refused before memory is asked for.
const SIDE_MAX: u32 = 1 << 14;
/// The longest side that is kept, which every device has room for: images with longer ones are halved.
const KEPT_SIDE_MAX: u32 = 1 << 13;
/// The most texels that all images are kept with together: 1 GiB.
const TEXELS_MAX: u64 = 1 << 28;
/// The most bytes that a decoder may ask for: those of the largest image with 16 bits a channel.
const DECODER_BYTES_MAX: u64 = 8 * (SIDE_MAX as u64) * (SIDE_MAX as u64);

/// Where the bytes of images come from.
pub struct Sources<'a> {
    pub root: &'a Root,
    pub buffers: &'a [Bytes<'a>],
    /// The folder of the files that images name; without it, none are read.
    pub folder: Option<&'a Path>,
}

/// An image of the file that is to be read.
pub struct Wanted {
    /// Index into the file's images.
    pub index: usize,
    /// Whether any material reads it as sRGB colours: it is then halved in linear light. Everything else is averaged as
    /// plain numbers: alpha always, and normals, which shading normalises.
    pub is_color: bool,
}

/// What an image is decoded by.
#[derive(Clone, Copy, PartialEq)]
enum Format {
    Ktx2,
    Other(ImageFormat),
}

/// An image that is not decoded yet.
struct Encoded<'a> {
    /// As errors name it.
    place: String,
    name: String,
    bytes: &'a [u8],
    format: Format,
    is_color: bool,
    size: [u32; 2],
}

impl Encoded<'_> {
    /// Whether it will be reduced.
    fn is_large(&self) -> bool {
        kept_size(self.size) != self.size
    }
}

/// Decodes these of the file's images, and gives them in this order.
pub fn read(sources: &Sources, wanted: &[Wanted], notices: &mut Notices) -> Result<Vec<Image>, Fault> {
    let mut files = buffers::Files::new();
    let mut fetch = |wanted: &Wanted| {
        sources.fetch(wanted.index, &mut files).map_err(|fault| Fault::at(sources.label(wanted.index), fault))
    };
    let fetched = wanted.iter().map(&mut fetch).collect::<Result<Vec<_>, _>>()?;
    let heads = wanted.iter().zip(&fetched).map(|(wanted, bytes)| head(sources, wanted, bytes));
    let heads = heads.collect::<Result<Vec<_>, _>>()?;
    check_texels(&heads)?;
    for image in heads.iter().filter(|image| image.is_large()) {
        notices.add("images of more than 8192 texels a side are reduced", || image.place.clone());
    }
    // Large ones one after the other: while one is decoded, it takes several times the memory that it keeps.
    let decode_some =
        |large: bool| move |image: &Encoded| if image.is_large() == large { decode(image).map(Some) } else { Ok(None) };
    let large = heads.iter().map(decode_some(true)).collect::<Result<Vec<_>, _>>()?;
    let small = heads.par_iter().map(decode_some(false)).collect::<Result<Vec<_>, _>>()?;
    Ok(large.into_iter().zip(small).filter_map(|(large, small)| large.or(small)).collect())
}

fn check_texels(images: &[Encoded]) -> Result<(), Fault> {
    let mut texels = 0;
    for image in images {
        let [width, height] = kept_size(image.size).map(u64::from);
        texels += width * height;
        if texels > TEXELS_MAX {
            let what = format_args!("the images up to here hold {texels} texels, of {TEXELS_MAX} served; reduce them");
            return Err(Fault::at(&image.place, what));
        }
    }
    Ok(())
}

impl<'a> Sources<'a> {
    fn label(&self, index: usize) -> String {
        label("image", index, self.root.images[index].name.as_deref())
    }

    fn fetch(&self, index: usize, files: &mut buffers::Files) -> Result<Bytes<'a>, Fault> {
        let image = &self.root.images[index];
        let view = image.buffer_view.and_then(|view| buffers::view(self.root, self.buffers, view.value()));
        match (view, &image.uri) {
            (Some(bytes), _) => Ok(Bytes::Within(bytes)),
            (None, Some(uri)) => buffers::fetch(uri, self.folder, files).map(Bytes::Read),
            (None, None) => Err(Fault::new("has neither a uri nor a bufferView; export the file again")),
        }
    }
}

/// An image's format and size, by its bytes alone: what a file says of its images is often wrong.
fn head<'a>(sources: &Sources, &Wanted { index, is_color }: &Wanted, bytes: &'a [u8]) -> Result<Encoded<'a>, Fault> {
    let place = sources.label(index);
    let (format, size) = format_and_size(bytes).map_err(|what| Fault::at(&place, what))?;
    let name = super::cut(sources.root.images[index].name.as_deref().unwrap_or_default());
    Ok(Encoded { place, name, bytes, format, is_color, size })
}

fn format_and_size(bytes: &[u8]) -> Result<(Format, [u32; 2]), String> {
    let (format, [width, height]) = match image::guess_format(bytes) {
        Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg | ImageFormat::WebP)) => {
            (Format::Other(format), decoder(bytes, format)?.dimensions().into())
        }
        _ if ktx2::is_ktx2(bytes) => (Format::Ktx2, ktx2::size(bytes)?),
        _ => return Err("is no PNG, JPEG, WebP or KTX 2.0 image; export it as one of these".to_owned()),
    };
    if width == 0 || height == 0 || width.max(height) > SIDE_MAX {
        return Err(format!("is {width} x {height}; give an image of 1 to {SIDE_MAX} texels a side"));
    }
    Ok((format, [width, height]))
}

fn decoder(bytes: &[u8], format: ImageFormat) -> Result<impl ImageDecoder + '_, String> {
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(DECODER_BYTES_MAX);
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    reader.limits(limits);
    reader.into_decoder().map_err(|error| broken(&error))
}

fn broken(error: &image::ImageError) -> String {
    format!("is broken ({}); copy or export it again", super::cut(&error.to_string()))
}

fn decode(encoded: &Encoded) -> Result<Image, Fault> {
    let texels = match encoded.format {
        Format::Ktx2 => ktx2::decode(encoded.bytes),
        Format::Other(format) => texels(encoded.bytes, format),
    };
    let bytes = texels.map_err(|what| Fault::at(&encoded.place, what))?;
    let encoding = if encoded.is_color { Encoding::Colors } else { Encoding::Numbers };
    let mut level = Level { size: encoded.size, texels: Cow::Borrowed(bytes.as_chunks().0) };
    while kept_size(level.size) != level.size {
        level = level.halved(encoding);
    }
    let [width, height] = level.size;
    Ok(Image { name: encoded.name.clone(), width, height, texels: level.texels.into_owned() })
}

/// The texels of an image file that is neither of KTX's.
fn texels(bytes: &[u8], format: ImageFormat) -> Result<Vec<u8>, String> {
    let decoded = DynamicImage::from_decoder(decoder(bytes, format)?).map_err(|error| broken(&error))?;
    if format == ImageFormat::Jpeg && !jpeg_ends(bytes) {
        return Err("is cut short; copy or export it again".to_owned());
    }
    Ok(decoded.into_rgba8().into_raw())
}

/// An image's size after it has been halved until no side is too long to be kept.
fn kept_size([width, height]: [u32; 2]) -> [u32; 2] {
    match width.max(height) > KEPT_SIDE_MAX {
        true => kept_size(half_of([width, height])),
        false => [width, height],
    }
}

/// Whether a JPEG file's end is there: the decoder fills what is missing with grey.
fn jpeg_ends(bytes: &[u8]) -> bool {
    // Zeros, restart markers and fill bytes after 0xff stand within the data.
    let is_marker = |pair: &[u8]| pair[0] == 0xff && !matches!(pair[1], 0 | 1 | 0xd0..=0xd8 | 0xff);
    let mut rest = bytes;
    while let Some(at) = rest.windows(2).position(is_marker) {
        if rest[at + 1] == 0xd9 {
            return true;
        }
        // A segment is skipped by its length: thumbnails in it have ends of their own.
        let length =
            rest.get(at + 2..at + 4).map_or(usize::MAX, |length| usize::from(length[0]) << 8 | usize::from(length[1]));
        rest = rest.get(at.saturating_add(2).saturating_add(length)..).unwrap_or_default();
    }
    false
}
