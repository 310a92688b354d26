// Cut-out surfaces (alphaMode MASK): which of a pixel's samples they cover.

// Where the four samples of a pixel lie, from its centre: WebGPU's pattern, which is that of Vulkan and Direct3D.
const COVERAGE_SAMPLE_X = vec4f(-0.125, 0.375, -0.375, 0.125);
const COVERAGE_SAMPLE_Y = vec4f(-0.375, -0.125, 0.125, 0.375);
const COVERAGE_ALL = 15u;
// Interpolating a constant errs by less than this.
const COVERAGE_ROUNDING = 1e-5;

// What a pixel sees of a texture.
struct CoverageTexel {
    color: vec4f,
    // The image's alpha at each sample.
    alphas: vec4f,
    // How much of what the pixel sees is there, by the mipmaps.
    share: f32,
    // From 0, where texels are larger than pixels and the samples tell, to 1, where the share does.
    far: f32,
}

// Before a texture is looked up.
fn coverage_untextured() -> CoverageTexel {
    return CoverageTexel(vec4f(1.0), vec4f(1.0), 1.0, 0.0);
}

// `map` is the file's image, and all there is where nothing is cut out; `shares` has mipmaps of what is there (scene::Cutout).
// Where nothing is dithered the alpha is the image's at the pixel's centre.
fn coverage_texel(
    map: texture_2d<f32>, map_sampler: sampler, shares: texture_2d<f32>, shares_sampler: sampler, uv: vec2f, pixel: vec2f,
) -> CoverageTexel {
    var found = coverage_untextured();
    if !VARIANT_MASK {
        found.color = texels_at(map, map_sampler, uv, pixel);
        return found;
    }
    let right = dpdx(uv);
    let down = dpdy(uv);
    let size = vec2f(textureDimensions(map));
    let mean = texels_at(shares, shares_sampler, uv, pixel);
    let image = textureSampleLevel(map, map_sampler, uv, 0.0);
    found.share = mean.a;
    // From half a texel a pixel to one: where texels are smaller, four samples miss some.
    found.far = saturate(2.0 * texels_footprint * max(length(size * right), length(size * down)) - 1.0);
    found.color = vec4f(mix(image.rgb, mean.rgb, found.far), image.a);
    found.alphas = vec4f(image.a);
    if VARIANT_DITHERED && found.far < 1.0 {
        for (var index = 0; index < 4; index++) {
            let at = uv + COVERAGE_SAMPLE_X[index] * right + COVERAGE_SAMPLE_Y[index] * down;
            found.alphas[index] = textureSampleLevel(map, map_sampler, at, 0.0).a;
        }
    }
    return found;
}

// The samples that are covered, a bit each; where nothing is dithered, all or none. A sample near a surface is covered where the alpha,
// with the material's and the vertices', is no less than the cutoff; far away each of the samples has a threshold of its own, a
// quarter from the next one, for the share. Over pixels thresholds are uniform in [0, 1): the mean is the share itself.
fn coverage_samples(
    texel: CoverageTexel, factor: f32, vertex_alpha: f32, cutoff: f32, pixel: vec2f, seed: u32,
) -> u32 {
    let least = vec4f(cutoff - COVERAGE_ROUNDING);
    let slope = vec2f(dpdx(vertex_alpha), dpdy(vertex_alpha));
    if !VARIANT_DITHERED {
        return select(0u, COVERAGE_ALL, factor * vertex_alpha * texel.color.a >= least.x);
    }
    let opacity = factor * (vertex_alpha + COVERAGE_SAMPLE_X * slope.x + COVERAGE_SAMPLE_Y * slope.y);
    let near = select(vec4f(0.0), vec4f(1.0), opacity * texel.alphas >= least);
    let far = select(vec4f(0.0), vec4f(texel.share), opacity >= least);
    let bits = select(vec4u(0u), vec4u(1u, 2u, 4u, 8u), mix(near, far, texel.far) > coverage_thresholds(pixel, seed));
    return bits.x | bits.y | bits.z | bits.w;
}

// A threshold in [0, 1) for each sample, a quarter from the next one. They are the same as long as a pixel sees the same triangle. In
// each block of 8 x 8 pixels they are 256 even steps; where these begin, and which sample of a pixel takes which, is independent of
// what other triangles have there, so that layers hide of each other what chance does.
fn coverage_thresholds(pixel: vec2f, seed: u32) -> vec4f {
    let at = vec2u(pixel);
    let block = coverage_hash(seed ^ coverage_hash(at.x / 8u ^ coverage_hash(at.y / 8u)));
    let turn = coverage_hash(block ^ (at.x % 8u + 8u * (at.y % 8u))) % 4u;
    // An ordered dither: neighbours are far apart.
    let mixed = at.x ^ at.y;
    let rank = (mixed & 1u) << 5u | (at.y & 1u) << 4u | (mixed & 2u) << 2u | (at.y & 2u) << 1u
        | (mixed & 4u) >> 1u | (at.y & 4u) >> 2u;
    let step = fract((f32(rank) + f32(block >> 8u) / 262144.0) / 64.0);
    return fract(0.25 * (vec4f(0.0, 1.0, 2.0, 3.0) + f32(turn) + step));
}

// Scatters the bits of a number: the last steps of Murmur 3.
fn coverage_hash(number: u32) -> u32 {
    var hash = (number ^ (number >> 16u)) * 0x85ebca6bu;
    hash = (hash ^ (hash >> 13u)) * 0xc2b2ae35u;
    return hash ^ (hash >> 16u);
}
