//! The sheen: the slab's lobes as transformed cosines, over (alpha, mu).
//!
//! | column | meaning | range |
//! |---|---|---|
//! | `alpha` | the paper's roughness | node k of n at k/(n-1) |
//! | `mu` | cosine between `wi` and the normal | node k of n at k/(n-1) |
//! | `a`, `b` | inverse matrix of the transformed cosine, rows (a,0,b), (0,a,0), (0,0,1) | a >= 0; b of either sign |
//! | `r` | albedo of the lobe, such that its lookup is right between nodes: at nodes of low alpha it is not R itself | \[0, 1\] |
//!
//! A .csv holds one line for each node, alpha-major; a .dds holds one texel for each node, x = alpha, y = mu.

use super::TableError;
use super::csv::Columns;
use super::dds::{self, Texture};
use super::grid::{self, Grid};
use std::path::Path;

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
        super::embedded(Self::from_csv(include_str!("../../tables/sheen_ltc.csv")))
    }

    /// Reads a .csv or .dds file, told apart by its extension; fails with [`TableError::In`].
    ///
    /// A file past [`MAX_FILE_BYTES`](super::MAX_FILE_BYTES) is refused before more than that is held.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, TableError> {
        super::load(path.as_ref(), Self::from_csv, Self::from_dds)
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
