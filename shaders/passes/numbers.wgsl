// What every pixel reads of the scene, as numbers in a texture: the materials' factors, then the lights, then their outlines.
//
// Software drivers read buffers number by number for each pixel, and textures four numbers for several pixels at once. As a storage texture,
// without levels, they read it faster still.

// Texels in a row are two to this power.
const NUMBERS_ROW = 11u;

@group(0) @binding(4) var numbers_all: texture_storage_2d<rgba32uint, read>;

// Where this texel is, in rows one after the other, each of two to this power of texels.
fn numbers_place(index: u32, row: u32) -> vec2u {
    return vec2u(index & ((1u << row) - 1u), index >> row);
}

fn numbers_at(index: u32) -> vec4u {
    return textureLoad(numbers_all, numbers_place(index, NUMBERS_ROW));
}
