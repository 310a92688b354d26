//! The tables: grids, their lookup, and their files.
//!
//! [`SheenTable`], for real time, holds `(a, b, r)` over `(alpha, mu)`:
//!
//! | column | meaning | range |
//! |---|---|---|
//! | `alpha` | the paper's roughness | node k of n at k/(n-1) |
//! | `mu` | cosine between `wi` and the normal | node k of n at k/(n-1) |
//! | `a`, `b` | inverse matrix of the transformed cosine, rows (a,0,b), (0,a,0), (0,0,1) | a >= 0; b of either sign |
//! | `r` | albedo of the lobe, such that its lookup is right between nodes: at nodes of low alpha it is not R itself | \[0, 1\] |
//!
//! A .csv holds one line for each node, alpha-major; a .dds holds one texel for each node, x = alpha, y = mu.
//!
//! [`GgxTable`] holds the same and more for the specular base, over `(roughness, mu)`: see [`ggx`].
//!
//! [`SlabTable`], for path tracers, holds the slab's multiple scattering over `(alpha, mu_i, mu_o)`: see [`slab`]. Its .dds is a volume.

mod csv;
mod dds;
pub mod ggx;
mod grid;
mod ltc;
pub mod slab;
mod slab_dds;

pub use ggx::{GgxLobe, GgxTable};
pub use ltc::{Ltc, SheenLtc};
pub use slab::{LEAST_SLAB_ALPHA, SLAB_SIDE, SlabModes, SlabSlice, SlabTable, SlabWarp, slab_alpha};

use csv::Columns;
use dds::Texture;
use grid::Grid;
use half::f16;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Most nodes that a side of a table may have. A shipped table has 32; the million cells of the largest are more than
/// any lobe needs.
pub const MAX_SIDE: usize = 1024;

/// Longest file that [`SheenTable::load`] reads, in bytes: room for the largest table as text.
pub const MAX_FILE_BYTES: u64 = 128 << 20;

/// How far the `alpha` and `mu` columns of a file may be from the nodes.
const NODE_TOLERANCE: f64 = 1e-4;

/// Why a table was not read. Each message is one line: what is wrong, where, and what to do.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    /// The file at `path` was not read because of `problem`.
    #[error("{}: {problem}", .path.display())]
    In { path: PathBuf, problem: Box<TableError> },
    /// Opening or reading the file failed.
    #[error("cannot be read ({0}); give the path of a table's .csv or .dds")]
    Unreadable(#[from] std::io::Error),
    /// The path leads to a folder, a device or the like.
    #[error("is no ordinary file; give the path of a table's .csv or .dds")]
    NoFile,
    /// The file's extension is neither .csv nor .dds.
    #[error("is neither .csv nor .dds; name the table by its format")]
    UnknownExtension,
    /// The file is longer than [`MAX_FILE_BYTES`].
    #[error("is longer than {MAX_FILE_BYTES} bytes; a table has at most {MAX_SIDE} nodes a side")]
    TooLong,
    /// A .csv is not UTF-8 from the byte `at` on.
    #[error("byte {at} is not UTF-8 text; a table's .csv holds lines of numbers")]
    NotText { at: usize },
    /// The line `line` of a .csv, counted from 1, does not hold the numbers that it should: see `problem`.
    #[error("line {line}: {problem}")]
    Line { line: usize, problem: String },
    /// The lines of a .csv, taken together, do not fill a grid: see `problem`. `columns` names the columns that it
    /// needs.
    #[error("{problem}; a table holds n x m lines of {columns}, in order of the first two, node k of n at k/(n-1)")]
    Lines { columns: String, problem: String },
    /// A .dds does not hold the texture of a [`SheenTable`] or [`GgxTable`], or one of its texels is out of range: see
    /// `problem`.
    #[error("{problem}; a table is one 2D texture of RGBA16F or RGBA32F with a DX10 header and no mips")]
    Dds { problem: String },
    /// A .dds does not hold the volume of a [`SlabTable`], or one of its texels is out of range: see `problem`.
    #[error("{problem}; a slab's table is one volume of 32 x 32 x 32 texels of RGBA16F with a DX10 header and no mips")]
    Volume { problem: String },
}

/// A grid of transformed cosines: `a`, `b`, `r` at the nodes of `(alpha, mu)`.
#[derive(Clone, Debug, PartialEq)]
pub struct SheenTable {
    /// `[a, b, r]` over (alpha, mu).
    grid: Grid<3>,
}

impl SheenTable {
    /// A table of `size` (alpha, mu) nodes from its alpha-major cells `[a, b, r]`.
    ///
    /// Panics unless both sides are in `[2, MAX_SIDE]`, the count fits and every cell obeys the column ranges.
    pub fn new(size: [usize; 2], cells: Vec<[f64; 3]>) -> Self {
        Self { grid: Grid::new(size, cells, cell_defect) }
    }

    /// The table that is shipped: fitted by `velour fit`, embedded in the program.
    pub fn embedded() -> Self {
        embedded(Self::from_csv(include_str!("../../tables/sheen_ltc.csv")))
    }

    /// Reads a .csv or .dds file, told apart by its extension; fails with [`TableError::In`].
    ///
    /// A file longer than [`MAX_FILE_BYTES`] is refused before more than that is in memory.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, TableError> {
        load(path.as_ref(), Self::from_csv, Self::from_dds)
    }

    /// Reads lines of `alpha,mu,a,b,r`, alpha-major.
    ///
    /// A line of column names at the top, empty lines and lines that begin with `#` are optional; spaces around numbers
    /// and CRLF line ends do not matter.
    pub fn from_csv(text: &str) -> Result<Self, TableError> {
        Ok(Self { grid: COLUMNS.read(text)? })
    }

    /// The table as text: `header` as `#` comments, the column names, a line for each node.
    ///
    /// Numbers are the shortest that read back as the same `f64`; the node positions have 7 digits.
    pub fn to_csv(&self, header: &[String]) -> String {
        COLUMNS.write(&self.grid, header)
    }

    /// Reads a 2D texture of RGBA16F or RGBA32F, x = alpha, y = mu; its A is ignored.
    pub fn from_dds(bytes: &[u8]) -> Result<Self, TableError> {
        let texture = Texture::read(bytes, 1)?;
        Ok(Self { grid: texture.grid(|[[a, b, r, _]]| [a, b, r], cell_defect)? })
    }

    /// The table as a texture: RGBA16F, DX10 header, no mips, x = alpha, y = mu, A = 1.
    pub fn to_dds(&self) -> Vec<u8> {
        dds::write(self.size(), self.grid.by_rows().map(|[a, b, r]| [a, b, r, 1.0]))
    }

    /// Nodes of alpha, nodes of mu.
    pub fn size(&self) -> [usize; 2] {
        self.grid.size
    }

    /// `[a, b, r]` of every node, alpha-major.
    pub fn cells(&self) -> &[[f64; 3]] {
        &self.grid.cells
    }

    /// `[a, b, r]` of node `(i, j)` of (alpha, mu); panics outside [`Self::size`].
    pub fn cell(&self, i: usize, j: usize) -> [f64; 3] {
        self.grid.cell(i, j)
    }

    /// The largest difference from `other` over all numbers, in steps from one half-float to the next; `None` where the
    /// sizes differ.
    ///
    /// One step may come from rounding that differs on another machine.
    pub fn half_steps(&self, other: &Self) -> Option<u32> {
        self.grid.half_steps(&other.grid, 0.0)
    }

    /// `[a, b, r]` at `alpha` and `mu`, which are clamped to \[0, 1\], bilinear between the nodes. Panics on NaN.
    pub fn lookup(&self, alpha: f64, mu: f64) -> [f64; 3] {
        assert!(!alpha.is_nan() && !mu.is_nan(), "lookup at alpha {alpha}, mu {mu}");
        self.grid.lookup(alpha, mu)
    }

    /// The texels of a texture: `[a, b, r, 1]` row by row, x = alpha, y = mu.
    pub fn texels(&self) -> Vec<[f32; 4]> {
        self.grid.by_rows().map(|[a, b, r]| [a as f32, b as f32, r as f32, 1.0]).collect()
    }

    /// CRC-32 of the texels as little-endian floats: whatever file format a table came in, it is the same as long as
    /// the numbers are.
    pub fn checksum(&self) -> u32 {
        grid::checksum(&self.texels())
    }
}

const COLUMNS: Columns<3> = Columns { axes: ["alpha", "mu"], values: ["a", "b", "r"], defect: cell_defect };

/// Unwraps a table that is built in.
fn embedded<T>(table: Result<T, TableError>) -> T {
    match table {
        Ok(table) => table,
        Err(error) => panic!("the embedded table is built in and its tests read it: {error}"),
    }
}

/// Reads a .csv or .dds file, told apart by its extension; errors name the file.
fn load<T>(
    path: &Path,
    from_csv: fn(&str) -> Result<T, TableError>,
    from_dds: fn(&[u8]) -> Result<T, TableError>,
) -> Result<T, TableError> {
    let read = || {
        let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
        let extension = extension.to_ascii_lowercase();
        if extension != "csv" && extension != "dds" {
            return Err(TableError::UnknownExtension);
        }
        let bytes = read_file(path)?;
        if extension == "dds" {
            return from_dds(&bytes);
        }
        from_csv(std::str::from_utf8(&bytes).map_err(|error| TableError::NotText { at: error.valid_up_to() })?)
    };
    read().map_err(|problem| TableError::In { path: path.to_owned(), problem: Box::new(problem) })
}

/// The bytes of an ordinary file of bounded length.
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
fn half_steps(one: f16, other: f16) -> u32 {
    // Without the sign, a half's bits ascend with its magnitude.
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
