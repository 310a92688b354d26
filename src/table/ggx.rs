//! The specular base: GGX microfacets as transformed cosines, over (roughness, mu).
//!
//! | column | meaning | range |
//! |---|---|---|
//! | `roughness` | the user's, alpha = roughness^2 | node k of n at k/(n-1) |
//! | `t` | sqrt(1 - mu), mu the cosine between `wi` and the normal | node k of n at k/(n-1) |
//! | `u`, `v`, `s` | the inverse matrix with the rows (a,0,b), (0,c,0), (0,0,1): c = 1 / s^2, a = c (m^2 + u), b = c (m sqrt(1 - m^2) + v), m = max(mu, 0.01) | s > 0 |
//! | `albedo` | R, the share that a perfect mirror of this roughness sends back | (0, 1\] |
//! | `fresnel` | the same weighted by (1 - dot(wi, h))^5 | \[0, albedo\] |
//!
//! A sharp lobe points in the mirrored direction and has c near 1 / (2 alpha): u and v are what is left of the matrix
//! once that is taken away, and s is nearly proportional to roughness. All three are smooth down to the mirror, where
//! a, b, c are not.
//!
//! A .csv holds one line for each node, in order of roughness; a .dds holds two textures one above the other,
//! x = roughness, y = t: at the top the texels u, v, s, 1, below them albedo, fresnel, 0, 1.

use super::TableError;
use super::csv::Columns;
use super::dds::{self, Texture};
use super::grid::{self, Grid};
use super::ltc::Ltc;
use crate::math::sine;
use std::path::Path;

/// Least a / c that a lookup gives, whatever a table's u is.
pub const LEAST_ASPECT: f64 = 1e-5;

/// The least cosine whose shape is its own: below it, shapes are those at this cosine.
pub const GRAZING_MU: f64 = 0.01;

/// Least s and albedo of a table that is read.
const LEAST: f64 = 1e-2;

/// Greatest |u|, |v| and s of a table that is read; those of ours stay below 2.
const GREATEST: f64 = 16.0;

/// Largest difference that does not count: near 0, halves are finer than the fit is known.
const NEGLIGIBLE: f64 = 1e-5;

/// The cosine mu at t = sqrt(1 - mu).
pub fn cosine(t: f64) -> f64 {
    1.0 - t * t
}

/// The lobe of a rough mirror.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GgxLobe {
    /// The transformed cosine, whose integral is 1.
    pub ltc: Ltc,
    /// R.
    pub albedo: f64,
    /// The Fresnel share: what multiplies f90 - f0.
    pub fresnel: f64,
}

/// A grid of lobes: `u`, `v`, `s`, `albedo`, `fresnel` at the nodes of `(roughness, t)`.
#[derive(Clone, Debug, PartialEq)]
pub struct GgxTable {
    /// `[u, v, s, albedo, fresnel]` over (roughness, t).
    grid: Grid<5>,
}

const COLUMNS: Columns<5> =
    Columns { axes: ["roughness", "t"], values: ["u", "v", "s", "albedo", "fresnel"], defect: cell_defect };

impl GgxTable {
    /// A table of `size` (roughness, t) nodes from its cells `[u, v, s, albedo, fresnel]` in order of roughness.
    ///
    /// Panics unless both sides are in \[2, [`MAX_SIDE`](super::MAX_SIDE)\], the count fits and every cell obeys the column ranges.
    pub fn new(size: [usize; 2], cells: Vec<[f64; 5]>) -> Self {
        Self { grid: Grid::new(size, cells, cell_defect) }
    }

    /// The table that is shipped: fitted by `velour fit`, embedded in the program.
    pub fn embedded() -> Self {
        super::embedded(Self::from_csv(include_str!("../../tables/ggx_ltc.csv")))
    }

    /// Reads a .csv or .dds file, told apart by its extension; fails with [`TableError::In`].
    pub fn load(path: impl AsRef<Path>) -> Result<Self, TableError> {
        super::load(path.as_ref(), Self::from_csv, Self::from_dds)
    }

    /// Reads lines of `roughness,t,u,v,s,albedo,fresnel`, as [`SheenTable::from_csv`](super::SheenTable::from_csv) does.
    pub fn from_csv(text: &str) -> Result<Self, TableError> {
        Ok(Self { grid: COLUMNS.read(text)? })
    }

    /// The table as text: `header` as `#` comments, the column names, a line for each node.
    pub fn to_csv(&self, header: &[String]) -> String {
        COLUMNS.write(&self.grid, header)
    }

    /// Reads the two textures one above the other, RGBA16F or RGBA32F; the channels that hold 0 and 1 are ignored.
    pub fn from_dds(bytes: &[u8]) -> Result<Self, TableError> {
        let numbers = |[[u, v, s, _], [albedo, fresnel, ..]]: [[f64; 4]; 2]| [u, v, s, albedo, fresnel];
        Ok(Self { grid: Texture::read(bytes, 2)?.grid(numbers, cell_defect)? })
    }

    /// The table as a texture: RGBA16F, DX10 header, no mips.
    pub fn to_dds(&self) -> Vec<u8> {
        dds::write(self.texture_size(), self.rows())
    }

    /// Nodes of roughness, nodes of t.
    pub fn size(&self) -> [usize; 2] {
        self.grid.size
    }

    /// Width and height of the texture: twice as high as there are nodes of t.
    pub fn texture_size(&self) -> [usize; 2] {
        let [width, height] = self.size();
        [width, 2 * height]
    }

    /// `[u, v, s, albedo, fresnel]` of node `(i, j)` of (roughness, t); panics outside [`Self::size`].
    pub fn cell(&self, i: usize, j: usize) -> [f64; 5] {
        self.grid.cell(i, j)
    }

    /// The lobe at `roughness` and `mu`, which are clamped to \[0, 1\], bilinear between the nodes. Panics on NaN.
    pub fn lookup(&self, roughness: f64, mu: f64) -> GgxLobe {
        assert!(!roughness.is_nan() && !mu.is_nan(), "lookup at roughness {roughness}, mu {mu}");
        let mu = mu.clamp(0.0, 1.0);
        let [u, v, s, albedo, fresnel] = self.grid.lookup(roughness, (1.0 - mu).sqrt());
        let c = 1.0 / (s * s);
        let mu = mu.max(GRAZING_MU);
        let ltc = Ltc { a: c * (mu * mu + u).max(LEAST_ASPECT), b: c * (mu * sine(mu) + v), c };
        GgxLobe { ltc, albedo, fresnel }
    }

    /// The texels of a texture of [`Self::texture_size`], row by row.
    pub fn texels(&self) -> Vec<[f32; 4]> {
        self.rows().map(|texel| texel.map(|value| value as f32)).collect()
    }

    /// CRC-32 of the texels as little-endian floats.
    pub fn checksum(&self) -> u32 {
        grid::checksum(&self.texels())
    }

    /// The largest difference from `other` over all numbers, in steps from one half-float to the next; `None` where the
    /// sizes differ. Differences up to 1e-5 do not count.
    pub fn half_steps(&self, other: &Self) -> Option<u32> {
        self.grid.half_steps(&other.grid, NEGLIGIBLE)
    }

    /// The texels of both textures.
    fn rows(&self) -> impl Iterator<Item = [f64; 4]> {
        let shapes = self.grid.by_rows().map(|[u, v, s, ..]| [u, v, s, 1.0]);
        shapes.chain(self.grid.by_rows().map(|[.., albedo, fresnel]| [albedo, fresnel, 0.0, 1.0]))
    }
}

/// What is wrong with a cell, if anything.
fn cell_defect([u, v, s, albedo, fresnel]: [f64; 5]) -> Option<String> {
    if !(u.abs() <= GREATEST && v.abs() <= GREATEST) {
        Some(format!("u and v must be in [-{GREATEST}, {GREATEST}]: {u}, {v}"))
    } else if !(LEAST..=GREATEST).contains(&s) {
        Some(format!("s must be in [{LEAST}, {GREATEST}]: {s}"))
    } else if !(LEAST..=1.0).contains(&albedo) {
        Some(format!("albedo must be in [{LEAST}, 1]: {albedo}"))
    } else if !(0.0..=albedo).contains(&fresnel) {
        Some(format!("fresnel must be in [0, albedo]: {fresnel}, {albedo}"))
    } else {
        None
    }
}
