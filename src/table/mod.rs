//! The tables: grids, their lookup, and their files.
//!
//! [`LtcTable`], for real time, holds `(a, b, r)` over `(alpha, mu)`:
//!
//! | column | meaning | range |
//! |---|---|---|
//! | `alpha` | the paper's roughness | node k of n at k/(n-1) |
//! | `mu` | cosine between `wi` and the normal | node k of n at k/(n-1) |
//! | `a`, `b` | inverse matrix of the transformed cosine, rows (a,0,b), (0,a,0), (0,0,1) | a >= 0; b of either sign |
//! | `r` | albedo of the lobe, such that its lookup is right between nodes: not R itself at those of low alpha | \[0, 1\] |
//!
//! A .csv holds one line a node, alpha-major; a .dds holds one texel a node, x = alpha, y = mu.
//!
//! [`SlabTable`], for path tracers, holds the slab's multiple scattering over `(alpha, mu_i, mu_o)`: see [`slab`]. Its .dds is a volume.

mod csv;
mod dds;
mod ltc;
pub mod slab;
mod slab_dds;

pub use ltc::Ltc;
pub use slab::{LEAST_SLAB_ALPHA, SLAB_SIDE, SlabModes, SlabSlice, SlabTable, SlabWarp, slab_alpha};

use half::f16;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Most nodes that a side of a table may have. A shipped table has 32; a million cells are more than any lobe needs.
pub const MAX_SIDE: usize = 1024;

/// Longest file that [`LtcTable::load`] reads, in bytes: room for the largest table as text.
pub const MAX_FILE_BYTES: u64 = 128 << 20;

/// How far the `alpha` and `mu` columns of a file may be from the nodes.
const NODE_TOLERANCE: f64 = 1e-4;

/// Why a table was not read. Each message is one line: what is wrong, where, and what to do.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    #[error("{}: {problem}", .path.display())]
    In { path: PathBuf, problem: Box<TableError> },
    #[error("cannot be read ({0}); give the path of a table's .csv or .dds")]
    Unreadable(#[from] std::io::Error),
    #[error("is no ordinary file; give the path of a table's .csv or .dds")]
    NoFile,
    #[error("is neither .csv nor .dds; name the table by its format")]
    UnknownExtension,
    #[error("is longer than {MAX_FILE_BYTES} bytes; a table has at most {MAX_SIDE} nodes a side")]
    TooLong,
    #[error("byte {at} is not UTF-8 text; a table's .csv holds lines of alpha,mu,a,b,r")]
    NotText { at: usize },
    #[error("line {line}: {problem}")]
    Line { line: usize, problem: String },
    #[error("{problem}; a table holds n x m lines of alpha,mu,a,b,r, alpha-major, node k of n at k/(n-1)")]
    Lines { problem: String },
    #[error("{problem}; a table is one 2D texture of RGBA16F or RGBA32F with a DX10 header and no mips")]
    Dds { problem: String },
    #[error("{problem}; a slab's table is one volume of 32 x 32 x 32 texels of RGBA16F with a DX10 header and no mips")]
    Volume { problem: String },
}

/// A grid of transformed cosines: `a`, `b`, `r` at the nodes of `(alpha, mu)`.
#[derive(Clone, Debug, PartialEq)]
pub struct LtcTable {
    /// Nodes of alpha, nodes of mu; both >= 2.
    size: [usize; 2],
    /// `[a, b, r]` of each node, alpha-major: mu varies fastest.
    cells: Vec<[f64; 3]>,
}

impl LtcTable {
    /// A table of `size` (alpha, mu) nodes from its alpha-major cells `[a, b, r]`.
    ///
    /// Panics unless both sides are in `[2, MAX_SIDE]`, the count fits and every cell obeys the column ranges.
    pub fn new(size: [usize; 2], cells: Vec<[f64; 3]>) -> Self {
        assert!(
            size.iter().all(|side| (2..=MAX_SIDE).contains(side)),
            "a table's sides are in [2, {MAX_SIDE}]: {size:?}"
        );
        assert_eq!(cells.len(), size[0] * size[1], "cells of a table of {size:?} nodes");
        for (index, cell) in cells.iter().enumerate() {
            let defect = cell_defect(*cell);
            assert!(defect.is_none(), "cell {index}: {}", defect.unwrap_or_default());
        }
        Self { size, cells }
    }

    /// The table that is shipped: fitted by `velour fit`, embedded in the program.
    pub fn embedded() -> Self {
        match Self::from_csv(include_str!("../../tables/sheen_ltc.csv")) {
            Ok(table) => table,
            Err(error) => panic!("the embedded table is built in and its tests read it: {error}"),
        }
    }

    /// Reads a .csv or .dds file, told apart by its extension.
    ///
    /// A file past [`MAX_FILE_BYTES`] is refused before more than that is held.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, TableError> {
        let path = path.as_ref();
        load(path).map_err(|problem| TableError::In { path: path.to_owned(), problem: Box::new(problem) })
    }

    /// Nodes of alpha, nodes of mu.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// `[a, b, r]` of every node, alpha-major.
    pub fn cells(&self) -> &[[f64; 3]] {
        &self.cells
    }

    /// `[a, b, r]` of node `(i, j)` of (alpha, mu).
    pub fn cell(&self, i: usize, j: usize) -> [f64; 3] {
        assert!(i < self.size[0] && j < self.size[1], "node ({i}, {j}) of a table of {:?}", self.size);
        self.cells[i * self.size[1] + j]
    }

    /// The largest difference to `other` over all numbers, in steps from one half-float to the next; none where the sizes differ.
    ///
    /// One step is what rounding differently on another machine may leave.
    pub fn half_steps(&self, other: &Self) -> Option<u32> {
        let pairs = self.cells.as_flattened().iter().zip(other.cells.as_flattened());
        let steps = |(one, other): (&f64, &f64)| half_steps(f16::from_f64(*one), f16::from_f64(*other));
        (self.size == other.size).then(|| pairs.map(steps).max().unwrap_or_default())
    }

    /// `[a, b, r]` at `alpha` and `mu` in \[0, 1\] (clamped to it), bilinear between the nodes.
    pub fn lookup(&self, alpha: f64, mu: f64) -> [f64; 3] {
        assert!(!alpha.is_nan() && !mu.is_nan(), "lookup at alpha {alpha}, mu {mu}");
        let (i, s) = cell(alpha.clamp(0.0, 1.0), self.size[0]);
        let (j, t) = cell(mu.clamp(0.0, 1.0), self.size[1]);
        let corners = [self.cell(i, j), self.cell(i, j + 1), self.cell(i + 1, j), self.cell(i + 1, j + 1)];
        std::array::from_fn(|k| {
            let [c00, c01, c10, c11] = corners.map(|corner| corner[k]);
            (1.0 - s) * ((1.0 - t) * c00 + t * c01) + s * ((1.0 - t) * c10 + t * c11)
        })
    }

    /// What a texture takes: `[a, b, r, 1]` row by row, x = alpha, y = mu.
    pub fn texels(&self) -> Vec<[f32; 4]> {
        let [width, height] = self.size;
        let texel = |x, y| {
            let [a, b, r] = self.cell(x, y).map(|value| value as f32);
            [a, b, r, 1.0]
        };
        (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| texel(x, y)).collect()
    }

    /// CRC-32 of the texels as little-endian floats: the same for a table whatever file format it came in, as long as
    /// the numbers are the same.
    pub fn checksum(&self) -> u32 {
        let mut hasher = crc32fast::Hasher::new();
        for value in self.texels().as_flattened() {
            hasher.update(&value.to_le_bytes());
        }
        hasher.finalize()
    }
}

fn load(path: &Path) -> Result<LtcTable, TableError> {
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default().to_ascii_lowercase();
    if extension != "csv" && extension != "dds" {
        return Err(TableError::UnknownExtension);
    }
    let bytes = read_file(path)?;
    if extension == "dds" {
        return LtcTable::from_dds(&bytes);
    }
    let text = std::str::from_utf8(&bytes).map_err(|error| TableError::NotText { at: error.valid_up_to() })?;
    LtcTable::from_csv(text)
}

/// What an ordinary file of bounded length holds.
fn read_file(path: &Path) -> Result<Vec<u8>, TableError> {
    if !std::fs::metadata(path)?.is_file() {
        return Err(TableError::NoFile);
    }
    let mut bytes = Vec::new();
    File::open(path)?.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MAX_FILE_BYTES {
        return Err(TableError::TooLong);
    }
    Ok(bytes)
}

/// Where node `k` of `n` sits.
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
fn half_steps(one: f16, other: f16) -> u32 {
    // Without their sign, bits of halves ascend with the number.
    let place = |value: f16| {
        let bits = i32::from(value.to_bits());
        if bits & 0x8000 == 0 { bits } else { 0x8000 - bits }
    };
    place(one).abs_diff(place(other))
}

/// What is wrong with a cell `[a, b, r]`, if anything.
fn cell_defect([a, b, r]: [f64; 3]) -> Option<String> {
    // A GPU holds the numbers as f32: what overflows there is as bad as an infinity.
    let finite = |value: f64| (value as f32).is_finite();
    if !(finite(a) && finite(b) && finite(r)) {
        Some(format!("a, b, r must be finite numbers: {a}, {b}, {r}"))
    } else if a < 0.0 {
        Some(format!("a must be at least 0: {a}"))
    } else if !(0.0..=1.0).contains(&r) {
        Some(format!("r must be in [0, 1]: {r}"))
    } else {
        None
    }
}
