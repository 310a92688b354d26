//! Numbers over a grid of nodes in the unit square.

use half::f16;

/// Most nodes that a side of a table may have. A shipped table has 32; the million cells of the largest are more than
/// any lobe needs.
pub const MAX_SIDE: usize = 1024;

/// N numbers at each node.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Grid<const N: usize> {
    /// Nodes along the first and second axis; both in \[2, [`MAX_SIDE`]\].
    pub size: [usize; 2],
    /// First-axis-major: the second varies fastest.
    pub cells: Vec<[f64; N]>,
}

impl<const N: usize> Grid<N> {
    /// Panics unless both sides are in `[2, MAX_SIDE]`, the count fits and no cell has a defect.
    pub fn new(size: [usize; 2], cells: Vec<[f64; N]>, defect: fn([f64; N]) -> Option<String>) -> Self {
        assert!(
            size.iter().all(|side| (2..=MAX_SIDE).contains(side)),
            "a table's sides are in [2, {MAX_SIDE}]: {size:?}"
        );
        assert_eq!(cells.len(), size[0] * size[1], "cells of a table of {size:?} nodes");
        for (index, cell) in cells.iter().enumerate() {
            let defect = defect(*cell);
            assert!(defect.is_none(), "cell {index}: {}", defect.unwrap_or_default());
        }
        Self { size, cells }
    }

    pub fn cell(&self, i: usize, j: usize) -> [f64; N] {
        assert!(i < self.size[0] && j < self.size[1], "node ({i}, {j}) of a table of {:?}", self.size);
        self.cells[i * self.size[1] + j]
    }

    /// Bilinear between the nodes, clamped to \[0, 1\].
    pub fn lookup(&self, x: f64, y: f64) -> [f64; N] {
        let (i, s) = cell(x.clamp(0.0, 1.0), self.size[0]);
        let (j, t) = cell(y.clamp(0.0, 1.0), self.size[1]);
        let corners = [self.cell(i, j), self.cell(i, j + 1), self.cell(i + 1, j), self.cell(i + 1, j + 1)];
        std::array::from_fn(|k| {
            let [c00, c01, c10, c11] = corners.map(|corner| corner[k]);
            (1.0 - s) * ((1.0 - t) * c00 + t * c01) + s * ((1.0 - t) * c10 + t * c11)
        })
    }

    /// The largest difference from `other` over all numbers, in steps from one half-float to the next; `None` where the
    /// sizes differ. Differences up to `negligible` do not count.
    pub fn half_steps(&self, other: &Self, negligible: f64) -> Option<u32> {
        let pairs = self.cells.as_flattened().iter().zip(other.cells.as_flattened());
        let apart = pairs.filter(|(one, other)| (*one - *other).abs() > negligible);
        let steps = apart.map(|(one, other)| half_steps(f16::from_f64(*one), f16::from_f64(*other)));
        (self.size == other.size).then(|| steps.max().unwrap_or_default())
    }

    /// All nodes in the order of a texture: row by row, the first axis along x.
    pub fn by_rows(&self) -> impl Iterator<Item = [f64; N]> {
        let [width, height] = self.size;
        (0..height).flat_map(move |y| (0..width).map(move |x| self.cells[x * height + y]))
    }
}

/// CRC-32 of texels as little-endian floats.
pub(super) fn checksum(texels: &[[f32; 4]]) -> u32 {
    let mut hasher = crc32fast::Hasher::new();
    for value in texels.as_flattened() {
        hasher.update(&value.to_le_bytes());
    }
    hasher.finalize()
}

/// Where node `k` of `n` >= 2 sits, in \[0, 1\].
pub fn node(k: usize, n: usize) -> f64 {
    k as f64 / (n - 1) as f64
}

/// The cell between two of `n` nodes in which `x` in \[0, 1\] lies, and how far it is from the lower one, in cells.
#[inline]
pub fn cell(x: f64, n: usize) -> (usize, f64) {
    let x = x * (n - 1) as f64;
    let below = (x as usize).min(n - 2);
    (below, x - below as f64)
}

/// The centres of `n` equal cells of \[0, 1\].
pub fn centres(n: usize) -> Vec<f64> {
    (0..n).map(|k| (k as f64 + 0.5) / n as f64).collect()
}

/// How many half-floats lie from `one` to `other`.
pub(super) fn half_steps(one: f16, other: f16) -> u32 {
    // Without the sign, a half's bits ascend with its magnitude.
    let place = |value: f16| {
        let bits = i32::from(value.to_bits());
        if bits & 0x8000 == 0 { bits } else { 0x8000 - bits }
    };
    place(one).abs_diff(place(other))
}
