//! KTX 2.0 images of Basis Universal texels (KHR_texture_basisu): ETC1S, and UASTC with or without Zstandard.

use basisu::{DecodeFlags, TargetFormat, Transcoder};
use ruzstd::decoding::FrameDecoder;

use super::elements::integer;

/// What files of the format begin with.
const IDENTIFIER: &[u8] = b"\xabKTX 20\xbb\r\n\x1a\n";
/// Bytes of a file's head up to where its levels are listed, and of each level in that list.
const HEADER: usize = 80;
const LISTED: usize = 24;
/// Colour models in the data format descriptor.
const ETC1S: u8 = 163;
const UASTC: u8 = 166;
/// How levels may be compressed on top.
const PLAIN: u32 = 0;
const BASIS_LZ: u32 = 1;
const ZSTANDARD: u32 = 2;
/// Bytes of a UASTC block, which holds 4 x 4 texels.
const BLOCK: usize = 16;
/// The window that decoders of Zstandard should have at least (RFC 8878, section 3.1.1.1.2).
const WINDOW: u64 = 8 << 20;

/// Whether a file begins as one of this format does.
pub fn is_ktx2(file: &[u8]) -> bool {
    file.starts_with(IDENTIFIER)
}

/// Width and height of an image that can be decoded as far as its head tells, in texels; or what is wrong with it.
pub fn size(file: &[u8]) -> Result<[u32; 2], String> {
    Ok(Head::read(file)?.size)
}

/// The texels of an image's largest level: red, green, blue and alpha, in rows from the top. Its size is to be checked
/// before, since so much memory is taken.
pub fn decode(file: &[u8]) -> Result<Vec<u8>, String> {
    let head = Head::read(file)?;
    let plain = if head.scheme == ZSTANDARD { head.inflate()? } else { Vec::new() };
    let file = if head.scheme == ZSTANDARD { &plain } else { file };
    let texels = Transcoder::new(file).and_then(|found| found.transcode(0, TargetFormat::Rgba32, DecodeFlags::NONE));
    // Which error it is says nothing about what is wrong with a file whose head is right.
    texels.map_err(|_| broken("no Basis Universal texels that can be decoded"))
}

/// What a file says of its image. Everything that is listed there lies within the file.
struct Head<'a> {
    size: [u32; 2],
    scheme: u32,
    header: &'a [u8],
    /// The data format descriptor.
    format: &'a [u8],
    /// The largest level.
    level: &'a [u8],
}

impl<'a> Head<'a> {
    /// Reads a file's head (KTX 2.0, section 3).
    fn read(file: &'a [u8]) -> Result<Self, String> {
        let header = file.get(..HEADER).ok_or_else(short)?;
        let word = |at: usize| integer(&header[at..at + 4]);
        let part = |at: usize, width: usize, list: &[u8]| {
            let [start, length] = [at, at + width].map(|at| usize::try_from(integer(&list[at..at + width])));
            let (start, length) = (start.ok()?, length.ok()?);
            file.get(start..start.checked_add(length)?)
        };
        let part = |at, width, list| part(at, width, list).ok_or_else(short);
        let [height, depth, layers, faces, levels] = [24, 28, 32, 36, 40].map(word);
        if height == 0 || depth != 0 || layers > 1 || faces != 1 {
            return Err(unserved("of one, three or more dimensions, or of a cube"));
        }
        let scheme = word(44) as u32;
        let (format, pairs) = (part(48, 4, header)?, part(56, 4, header)?);
        let is_basis = match format.get(12) {
            Some(&ETC1S) => scheme == BASIS_LZ,
            Some(&UASTC) => matches!(scheme, PLAIN | ZSTANDARD),
            _ => false,
        };
        if word(12) != 0 || !is_basis {
            return Err(unserved("in none of Basis Universal's formats ETC1S and UASTC"));
        }
        for (key, usual) in [(&b"KTXorientation\0"[..], &b"rd"[..]), (b"KTXswizzle\0", b"rgba")] {
            if value(pairs, key).is_some_and(|value| value.strip_suffix(b"\0").unwrap_or(value) != usual) {
                return Err(unserved("with turned rows or swapped channels"));
            }
        }
        // Data that all levels share.
        part(64, 8, header)?;
        let list = usize::try_from(levels).ok().and_then(|levels| LISTED.checked_mul(levels));
        let list = list.and_then(|length| file.get(HEADER..HEADER.checked_add(length)?)).ok_or_else(short)?;
        let levels = list.chunks_exact(LISTED).map(|listed| part(0, 8, listed)).collect::<Result<Vec<_>, _>>()?;
        let level = levels.first().ok_or_else(|| broken("no levels"))?;
        Ok(Self { size: [word(20) as u32, height as u32], scheme, header, format, level })
    }

    /// The file without Zstandard's compression, of its largest level alone.
    fn inflate(&self) -> Result<Vec<u8>, String> {
        let [columns, rows] = self.size.map(|side| side.div_ceil(4) as usize);
        let mut blocks = vec![0; columns * rows * BLOCK];
        let mut decoder = FrameDecoder::new();
        decoder.set_max_window_size(WINDOW.max(blocks.len() as u64));
        let length = decoder.decode_all(self.level, &mut blocks).map_err(|error| broken(&error.to_string()))?;
        if length != blocks.len() {
            return Err(broken("too few blocks"));
        }
        let (descriptor, start) = (HEADER + LISTED, HEADER + LISTED + self.format.len());
        let mut file = self.header.to_vec();
        // One level, no pairs, and nothing on top.
        for (at, word) in [(40, 1), (44, PLAIN), (48, descriptor as u32), (56, 0), (60, 0)] {
            file[at..at + 4].copy_from_slice(&word.to_le_bytes());
        }
        for listed in [start, blocks.len(), blocks.len()] {
            file.extend((listed as u64).to_le_bytes());
        }
        file.extend(self.format);
        file.extend(blocks);
        Ok(file)
    }
}

/// The value of a key in a list of pairs, if it is there (KTX 2.0, section 3.11).
fn value<'a>(mut pairs: &'a [u8], key: &[u8]) -> Option<&'a [u8]> {
    while let Some((length, rest)) = pairs.split_first_chunk::<4>() {
        let length = u32::from_le_bytes(*length) as usize;
        if let Some(value) = rest.get(..length)?.strip_prefix(key) {
            return Some(value);
        }
        pairs = rest.get(length.next_multiple_of(4)..)?;
    }
    None
}

fn short() -> String {
    "is cut short; copy or export it again".to_owned()
}

fn broken(what: &str) -> String {
    format!("is broken ({}); copy or export it again", super::cut(what))
}

fn unserved(what: &str) -> String {
    let way = "export it as PNG, JPEG or WebP, or convert the file: gltf-transform ktxdecompress IN.glb OUT.glb";
    format!("is a KTX image {what}; {way}")
}
