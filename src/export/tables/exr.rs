//! Pictures in OpenEXR, for programs that bring textures in from there.

use std::io::Cursor;

use exr::image::write::WritableImage;
use exr::image::{Encoding, Image, Layer, SpecificChannels};
use exr::math::Vec2;
use exr::meta::attribute::Text;
use exr::meta::header::LayerAttributes;
use half::f16;

use super::form::Form;
use super::texture::Texture;

/// A picture of halves in the channels R, G, B, A, whose comment is the layout.
pub fn write(texture: &Texture) -> Vec<u8> {
    let [width, height] = texture.size;
    let texels: Vec<[f16; 4]> = texture.halves().collect();
    let rgba = |at: Vec2<usize>| {
        let [r, g, b, a] = texels[at.1 * width + at.0];
        (r, g, b, a)
    };
    let comment = format!("{} SPDX-License-Identifier: {}", texture.layout(Form::Exr), super::source::LICENCE);
    let attributes =
        LayerAttributes { comments: Some(Text::from_slice_unchecked(comment.as_bytes())), ..Default::default() };
    // Readers that know no compression are the ones that want so small a picture.
    let layer = Layer::new((width, height), attributes, Encoding::UNCOMPRESSED, SpecificChannels::rgba(rgba));
    let mut file = Cursor::new(Vec::new());
    Image::from_layer(layer).write().to_buffered(&mut file).expect("writing to memory does not fail");
    file.into_inner()
}
