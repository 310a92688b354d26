//! Uniform numbers: Owen-scrambled Sobol sequences (Burley 2020), four dimensions at a time.

use rand::SeedableRng;
use rand_pcg::Pcg64;
use sobol_burley::{NUM_DIMENSION_SETS_4D, sample_4d};

/// The numbers of one sample of one pixel, in the order in which they are asked for.
pub(super) struct Uniforms {
    /// Of the pixel and the batch.
    seed: u64,
    /// In the batch.
    index: u32,
    set: u32,
}

impl Uniforms {
    /// Of the sample `index`, below 2^16, of a batch; each batch is scrambled on its own.
    pub fn new(seed: u64, pixel: u64, batch: u64, index: u32) -> Self {
        Self { seed: mixed(mixed(mixed(seed) ^ pixel) ^ batch), index, set: 0 }
    }

    /// Four numbers in \[0, 1).
    pub fn next(&mut self) -> [f64; 4] {
        // Past its last dimension the sequence starts over, scrambled anew.
        let (round, set) = (self.set / NUM_DIMENSION_SETS_4D, self.set % NUM_DIMENSION_SETS_4D);
        self.set += 1;
        sample_4d(self.index, set, mixed(self.seed ^ u64::from(round)) as u32).map(f64::from)
    }

    /// A stream of independent numbers, for what has no fixed number of dimensions.
    pub fn stream(&mut self) -> Pcg64 {
        self.set += 1;
        Pcg64::seed_from_u64(mixed(self.seed ^ (u64::from(self.index) << 32 | u64::from(self.set))))
    }
}

/// One sample of a pixel: its numbers, and what it has cost.
pub(super) struct Sample {
    pub uniforms: Uniforms,
    /// Rays that have been followed for it.
    pub rays: u64,
}

/// A bijection of 64 bits in which each bit depends on all (Steele, Lea and Flood 2014: SplitMix's finaliser).
fn mixed(bits: u64) -> u64 {
    let bits = bits.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}
