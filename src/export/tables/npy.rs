//! NumPy's .npy, version 1.0 of its format (NEP 1).

use super::texture::Texture;

/// The data begin at a multiple of it, in bytes.
const ALIGNMENT: usize = 64;

/// An array of `f4`, shape (height, width, 4).
pub fn write(texture: &Texture) -> Vec<u8> {
    let [width, height] = texture.size;
    let mut dictionary = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({height}, {width}, 4), }}");
    let mut file = b"\x93NUMPY\x01\x00".to_vec();
    // Two bytes tell the dictionary's length, and a line feed ends it.
    let end = (file.len() + 2 + dictionary.len() + 1).next_multiple_of(ALIGNMENT);
    dictionary += &" ".repeat(end - file.len() - 2 - dictionary.len() - 1);
    dictionary.push('\n');
    file.extend((dictionary.len() as u16).to_le_bytes());
    file.extend(dictionary.into_bytes());
    file.extend(texture.texels.iter().flatten().flat_map(|value| (*value as f32).to_le_bytes()));
    file
}
