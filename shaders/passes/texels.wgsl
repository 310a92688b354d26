// Textures, looked up so that no driver is kept busy by coordinates that make no sense.

// The side of what one of a pixel's samples stands for, in pixels: textures and shading are filtered over that.
var<private> texels_footprint: f32 = 1.0;

// So many copies of a texture across a pixel are its mean.
const TEXELS_COPIES = 16.0;

// Pixels beside a triangle that is seen edge-on may have coordinates anywhere, and software drivers average texel by
// texel over all that lies between those of a pixel and of its neighbours, which may take hours. Past TEXELS_COPIES
// the coordinates are brought within two copies, by which mirroring goes, and lie that many copies apart from one
// pixel to the next: the mean is still asked for, and found in the smallest mipmap.
fn texels_at(map: texture_2d<f32>, map_sampler: sampler, uv: vec2f, pixel: vec2f) -> vec4f {
    let copies = max(abs(dpdx(uv)), abs(dpdy(uv)));
    let odd = floor(pixel) - 2.0 * floor(0.5 * floor(pixel));
    let apart = uv - 2.0 * floor(0.5 * uv) + TEXELS_COPIES * odd;
    let at = select(uv, apart, max(copies.x, copies.y) > TEXELS_COPIES);
    if VARIANT_SHADOWED {
        return textureSampleGrad(map, map_sampler, at, texels_footprint * dpdx(at), texels_footprint * dpdy(at));
    }
    return textureSample(map, map_sampler, at);
}
