// Numbers that look random: each pixel, light and dimension has its own, and from sample to sample they cover the range evenly.

// The start of a pixel.
fn randoms_seed(pixel: vec2f, seed: u32) -> u32 {
    let at = vec2u(pixel);
    return coverage_hash(at.x ^ coverage_hash(at.y ^ coverage_hash(seed ^ 0x9e3779b9u)));
}

// The start of a thing, counted by `index`, in a pixel.
fn randoms_of(seed: u32, index: u32) -> u32 {
    return coverage_hash(seed ^ coverage_hash(index + 0x7f4a7c15u));
}

// Three numbers in [0, 1) for a sample: two of a Sobol sequence, scrambled, and one of another, all in shuffled order (Burley 2020, "Practical
// hash-based Owen scrambling").
fn randoms_three(start: u32, sample: u32) -> vec3f {
    let shuffled = randoms_scrambled(sample, start);
    let others = randoms_scrambled(sample, coverage_hash(start ^ 0x58f3a2b1u));
    let first = randoms_scrambled(reverseBits(others), coverage_hash(start ^ 0x85157af5u));
    let second = randoms_scrambled(reverseBits(shuffled), coverage_hash(start ^ 0xd1b54a32u));
    let third = randoms_scrambled(randoms_sobol(shuffled), coverage_hash(start ^ 0xabc98388u));
    return vec3f(vec3u(first, second, third) >> vec3u(8u)) / 16777216.0;
}

// One number in [0, 1) for a sample, independent of all others.
fn randoms_one(start: u32, sample: u32) -> f32 {
    return f32(coverage_hash(start ^ coverage_hash(sample)) >> 8u) / 16777216.0;
}

// The second dimension of Sobol's sequence: its matrix is Pascal's triangle modulo 2, which is the same in each quarter.
fn randoms_sobol(index: u32) -> u32 {
    var bits = index;
    bits ^= (bits & 0xaaaaaaaau) >> 1u;
    bits ^= (bits & 0xccccccccu) >> 2u;
    bits ^= (bits & 0xf0f0f0f0u) >> 4u;
    bits ^= (bits & 0xff00ff00u) >> 8u;
    bits ^= (bits & 0xffff0000u) >> 16u;
    return reverseBits(bits);
}

// Nested uniform scrambling: each bit is flipped by a hash of the higher ones.
fn randoms_scrambled(bits: u32, seed: u32) -> u32 {
    var mixed = reverseBits(bits) + seed;
    mixed ^= mixed * 0x6c50b47cu;
    mixed ^= mixed * 0xb82f1e52u;
    mixed ^= mixed * 0xc7afe638u;
    mixed ^= mixed * 0x8d22f6e6u;
    return reverseBits(mixed);
}
