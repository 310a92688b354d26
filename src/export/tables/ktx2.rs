//! Khronos' texture container, version 2.0 (KTX 2.0 and Data Format 1.3 specifications).

use super::form::Form;
use super::source::LICENCE;
use super::texture::Texture;

const IDENTIFIER: [u8; 12] = *b"\xabKTX 20\xbb\r\n\x1a\n";
/// VK_FORMAT_R16G16B16A16_SFLOAT.
const FORMAT: u32 = 97;
/// Bytes of a half, and of a texel of four.
const HALF: u32 = 2;
const TEXEL: u32 = 8;
/// Bytes of the header, the index of what follows, and the list of one level.
const HEAD: u32 = 12 + 9 * 4 + 4 * 4 + 2 * 8 + 3 * 8;
/// What levels begin at a multiple of: the least that 4 and a texel divide.
const ALIGNMENT: usize = 8;

/// One 2D level without supercompression. Notes tell orientation, writer, licence and layout.
pub fn write(texture: &Texture) -> Vec<u8> {
    let [width, height] = texture.size.map(|side| side as u32);
    let (format, notes, data) = (format_descriptor(), notes(texture), texture.half_bytes());
    let [format_bytes, note_bytes] = [&format, &notes].map(|part| part.len() as u32);
    let level = ((HEAD + format_bytes + note_bytes) as usize).next_multiple_of(ALIGNMENT);
    let mut file = IDENTIFIER.to_vec();
    // Depth and layers are 0 where there are none; one face, one level; no supercompression.
    let header = [FORMAT, HALF, width, height, 0, 0, 1, 1, 0];
    let index = [HEAD, format_bytes, HEAD + format_bytes, note_bytes];
    file.extend(header.into_iter().chain(index).flat_map(u32::to_le_bytes));
    // No data of a supercompression, in two numbers; then the level's place, its bytes, and these when inflated.
    let long = [0, 0, level, data.len(), data.len()];
    file.extend(long.into_iter().flat_map(|number| (number as u64).to_le_bytes()));
    file.extend(format);
    file.extend(notes);
    file.resize(level, 0);
    file.extend(data);
    file
}

/// The basic data format descriptor: linear numbers without primaries, for they are no colours, in four samples.
fn format_descriptor() -> Vec<u8> {
    const SAMPLES: [u8; 4] = [0, 1, 2, 15]; // red, green, blue, alpha
    const FLOAT_AND_SIGNED: u8 = 0xc0;
    let block = 24 + 16 * SAMPLES.len() as u32;
    let mut bytes: Vec<u8> = [4 + block, 0, 2 | block << 16].into_iter().flat_map(u32::to_le_bytes).collect();
    let (rgb_model, no_primaries, linear, no_flags) = (1, 0, 1, 0);
    bytes.extend([rgb_model, no_primaries, linear, no_flags]);
    bytes.extend([0; 4]); // a block of texels is one texel
    bytes.extend([TEXEL as u8, 0, 0, 0, 0, 0, 0, 0]); // bytes of the planes
    for (k, channel) in SAMPLES.into_iter().enumerate() {
        bytes.extend((16 * k as u16).to_le_bytes());
        bytes.extend([15, channel | FLOAT_AND_SIGNED]); // bits less one
        bytes.extend([0; 4]); // where in the block
        bytes.extend([-1.0_f32, 1.0].into_iter().flat_map(f32::to_le_bytes)); // what counts as the ends of the range
    }
    bytes
}

/// Keys and values, by the keys in order.
fn notes(texture: &Texture) -> Vec<u8> {
    let writer = concat!("Velour ", env!("CARGO_PKG_VERSION"));
    let layout = texture.layout(Form::Ktx2);
    let notes = [
        ("KTXorientation", "rd"), // x to the right, y down
        ("KTXwriter", writer),
        ("SPDX-License-Identifier", LICENCE),
        ("layout", &layout),
    ];
    let mut bytes = Vec::new();
    for (key, value) in notes {
        let note = format!("{key}\0{value}\0");
        bytes.extend((note.len() as u32).to_le_bytes());
        bytes.extend(note.into_bytes());
        bytes.resize(bytes.len().next_multiple_of(4), 0);
    }
    bytes
}
