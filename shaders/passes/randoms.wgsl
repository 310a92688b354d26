// Numbers that look random: each pixel, light and dimension has a start of its own, and from sample to sample they go on evenly.

// Fractions of the powers of the root of x^4 = x + 1: a sequence of low discrepancy in three dimensions (Roberts 2018).
const RANDOMS_STEPS = vec3u(0xd1b54a32u, 0xabc98388u, 0x8cb92ba7u);

// The start of a pixel.
fn randoms_seed(pixel: vec2f, seed: u32) -> u32 {
    let at = vec2u(pixel);
    return coverage_hash(at.x ^ coverage_hash(at.y ^ coverage_hash(seed ^ 0x9e3779b9u)));
}

// The start of a thing, counted by `index`, in a pixel.
fn randoms_of(seed: u32, index: u32) -> u32 {
    return coverage_hash(seed ^ coverage_hash(index + 0x7f4a7c15u));
}

// Three numbers in [0, 1) for a sample.
fn randoms_three(start: u32, sample: u32) -> vec3f {
    let starts = vec3u(start, coverage_hash(start ^ 0x85157af5u), coverage_hash(start ^ 0x58f3a2b1u));
    return randoms_floats(starts + RANDOMS_STEPS * sample);
}

// One number in [0, 1) for a sample, independent of all others.
fn randoms_one(start: u32, sample: u32) -> f32 {
    return randoms_floats(vec3u(coverage_hash(start ^ coverage_hash(sample)))).x;
}

fn randoms_floats(bits: vec3u) -> vec3f {
    return vec3f(bits >> vec3u(8u)) / 16777216.0;
}
