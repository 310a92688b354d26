//! The slab's multiple scattering: a grid over (alpha, mu_i, mu_o) of azimuthal modes, for path tracers.
//!
//! With rho_m = mode m of multiple scattering's f_r over X, X = mode 0 of single scattering's f_r, and s = sqrt(1 - mu^2), a node holds
//!
//! ```text
//! v0 = ln(1 + rho_0),   v1 = rho_1 / (s_i s_o),   v2 = rho_2 / (s_i s_o)^2,
//! ```
//!
//! which vary slowly, so that for c = mu_i mu_o - dot(wi, wo)
//!
//! ```text
//! f_r of multiple scattering = X [exp(v0) - 1 + 2 v1 c + 2 v2 (2 c^2 - s_i^2 s_o^2)],   never below 0.
//! ```
//!
//! | axis | texel coordinate | node k of 32 |
//! |---|---|---|
//! | x = alpha | 45 alpha^(1/4) - 14 | ((14 + k) / 45)^4: 0.0094 to 1 |
//! | y = mu_i, z = mu_o | 31 w^(1/3), w = mu^2 (1 + K alpha^4) / (mu^2 + K (1 - (1 - alpha^4) mu^2)), K = 16 alpha^(8/3) | where that is k |
//!
//! Light at mu scatters 1 / mu times, and its turns add up to its own elevation where mu is near
//! sigma^(2/3) = alpha^(4/3): there the nodes are densest, for the alpha of the lookup itself, not for that of a node.
//! Lookups are linear between the nodes, whose values are fitted for that. Two modes leave out 0.3% of a lobe
//! (relative L2), three 0.05%.

use super::TableError;
use super::grid::{cell, half_steps};
use crate::math::{check_cosine, cube_root};
use half::f16;
use std::fmt;
use std::path::Path;

/// Nodes along each axis.
pub const SLAB_SIDE: usize = 32;

/// Alpha below which the texel coordinate stands still; from the first node, .0094, down to here values are
/// extrapolated.
pub const LEAST_SLAB_ALPHA: f64 = 0.005;

/// Ranges of v0, v1, v2 in a table that is read, within which nothing overflows. The slab's own are \[-.01, 12\],
/// \[-.01, .3\], \[-.02, .01\].
const RANGES: [(f64, f64); 3] = [(-1.0, 16.0), (-1.0, 1.0), (-1.0, 1.0)];

/// The multiple scattering of slabs of all roughnesses, in halves.
#[derive(Clone, PartialEq)]
pub struct SlabTable {
    /// v0, v1, v2; mu_o varies fastest, alpha slowest. Exchanging mu_i and mu_o changes nothing.
    cells: Vec<[f16; 3]>,
}

/// What a table says of one alpha: its values between the alpha nodes.
#[derive(Clone, Debug)]
pub struct SlabSlice {
    warp: SlabWarp,
    /// v0, v1, v2, 0; mu_o varies fastest. In `f32`: precise enough for interpolated halves, and small enough to stay in
    /// the processor's cache.
    cells: Box<[[f32; 4]; SLAB_SIDE * SLAB_SIDE]>,
}

/// The modes at one pair of cosines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlabModes {
    /// exp(v0) = 1 + rho_0: mode 0 of all scattering over that of single scattering.
    pub growth: f64,
    /// v1.
    pub first: f64,
    /// v2.
    pub second: f64,
}

/// The table's axis of mu for one alpha.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlabWarp {
    /// K.
    scale: f64,
    /// 1 + K alpha^4.
    whole: f64,
    /// 1 - K (1 - alpha^4).
    slope: f64,
}

impl SlabTable {
    /// The table of `[v0, v1, v2]` at all nodes, mu_o fastest and alpha slowest, rounded to halves.
    ///
    /// Panics unless the count fits, values are in range and those of (mu_i, mu_o) and (mu_o, mu_i) are equal.
    pub fn new(cells: &[[f64; 3]]) -> Self {
        let cells: Vec<[f16; 3]> = cells.iter().map(|cell| cell.map(f16::from_f64)).collect();
        assert_eq!(cells.len(), SLAB_SIDE.pow(3), "cells of a table of {SLAB_SIDE} nodes a side");
        let defect = defect(&cells);
        assert!(defect.is_none(), "node (alpha, mu_i, mu_o) = {defect:?}");
        Self { cells }
    }

    /// The table that is shipped: made by `velour fit`, embedded in the program.
    pub fn embedded() -> Self {
        super::embedded(Self::from_dds(include_bytes!("../../tables/sheen_slab.dds")))
    }

    /// Reads a .dds file; fails with [`TableError::In`].
    pub fn load(path: impl AsRef<Path>) -> Result<Self, TableError> {
        let path = path.as_ref();
        let table = super::read_file(path).and_then(|bytes| Self::from_dds(&bytes));
        table.map_err(|problem| TableError::In { path: path.to_owned(), problem: Box::new(problem) })
    }

    /// The table that a file holds, or the first node (alpha, mu_i, mu_o) that is wrong, and what is wrong with it.
    pub(super) fn from_halves(cells: Vec<[f16; 3]>) -> Result<Self, ([usize; 3], String)> {
        defect(&cells).map_or(Ok(Self { cells }), Err)
    }

    /// The largest difference from `other` over all numbers, in steps from one half-float to the next. Differences up
    /// to 1e-6 do not count: next to 0 halves are finer than anything here is known.
    pub fn half_steps(&self, other: &Self) -> u32 {
        let pairs = self.cells.as_flattened().iter().zip(other.cells.as_flattened());
        let apart = pairs.filter(|(one, other)| (one.to_f64() - other.to_f64()).abs() > 1e-6);
        apart.map(|(one, other)| half_steps(*one, *other)).max().unwrap_or_default()
    }

    /// CRC-32 of the .dds file: tells tables apart.
    pub fn checksum(&self) -> u32 {
        crc32fast::hash(&self.to_dds())
    }

    /// v0, v1, v2 of node (k, i, j) of (alpha, mu_i, mu_o); panics where one is not below [`SLAB_SIDE`].
    pub fn cell(&self, k: usize, i: usize, j: usize) -> [f64; 3] {
        self.halves(k, i, j).map(f16::to_f64)
    }

    pub(super) fn halves(&self, k: usize, i: usize, j: usize) -> [f16; 3] {
        assert!([k, i, j].iter().all(|node| *node < SLAB_SIDE), "node ({k}, {i}, {j}) of {SLAB_SIDE} a side");
        self.cells[(k * SLAB_SIDE + i) * SLAB_SIDE + j]
    }

    /// What the table says of `alpha` in (0, 1\].
    ///
    /// Below the first node, .0094, values are extrapolated linearly: the lobe is off by 2% at .008, 6% at .0065, 13% at
    /// [`LEAST_SLAB_ALPHA`] = .005 (relative L2, mean). Below that they stand still along the axis of mu, so that lobes
    /// fade too soon and are off by 42% at .004, 85% at .002.
    pub fn slice(&self, alpha: f64) -> SlabSlice {
        let warp = SlabWarp::new(alpha);
        let x = alpha_texel(alpha.max(LEAST_SLAB_ALPHA));
        let below = (x.max(0.0) as usize).min(SLAB_SIDE - 2);
        let fraction = x - below as f64;
        let layer = |k: usize| &self.cells[k * SLAB_SIDE * SLAB_SIDE..(k + 1) * SLAB_SIDE * SLAB_SIDE];
        let mut cells = Box::new([[0.0; 4]; SLAB_SIDE * SLAB_SIDE]);
        for (cell, (low, high)) in cells.iter_mut().zip(layer(below).iter().zip(layer(below + 1))) {
            for (value, (low, high)) in cell.iter_mut().zip(low.iter().zip(high)) {
                *value = ((1.0 - fraction) * low.to_f64() + fraction * high.to_f64()) as f32;
            }
        }
        SlabSlice { warp, cells }
    }
}

impl fmt::Debug for SlabTable {
    /// Without the hundred thousand numbers.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("SlabTable").finish_non_exhaustive()
    }
}

impl SlabSlice {
    /// The axis of mu for this alpha.
    #[inline]
    pub fn warp(&self) -> &SlabWarp {
        &self.warp
    }

    /// The modes at cosines in \[0, 1\]; exchanging them changes nothing.
    pub fn lookup(&self, mu_i: f64, mu_o: f64) -> SlabModes {
        self.at([mu_i, mu_o].map(|mu| self.warp.place(mu)))
    }

    /// The modes at two places along the axis, in \[0, 1\].
    #[inline]
    pub fn at(&self, places: [f64; 2]) -> SlabModes {
        let [(i, s), (j, t)] = places.map(|place| cell(place, SLAB_SIDE));
        let at = i * SLAB_SIDE + j;
        let (c00, c01) = (&self.cells[at], &self.cells[at + 1]);
        let (c10, c11) = (&self.cells[at + SLAB_SIDE], &self.cells[at + SLAB_SIDE + 1]);
        // Terms are paired so that the sum is the same to the bit when i and j are exchanged.
        let (w00, w01, w10, w11) = ((1.0 - s) * (1.0 - t), (1.0 - s) * t, s * (1.0 - t), s * t);
        let between = |m: usize| {
            let alike = w00 * f64::from(c00[m]) + w11 * f64::from(c11[m]);
            alike + (w01 * f64::from(c01[m]) + w10 * f64::from(c10[m]))
        };
        let (v0, first, second) = (between(0), between(1), between(2));
        SlabModes { growth: v0.exp(), first, second }
    }
}

impl SlabModes {
    /// Multiple scattering's f_r over X, 0 or more, for c = mu_i mu_o - dot(wi, wo) and `across_square` = (s_i s_o)^2.
    #[inline]
    pub fn over_single(&self, c: f64, across_square: f64) -> f64 {
        let Self { growth, first, second } = self;
        (growth - 1.0 + 2.0 * first * c + 2.0 * second * (2.0 * c * c - across_square)).max(0.0)
    }
}

impl SlabWarp {
    /// The axis for `alpha` in (0, 1\].
    pub fn new(alpha: f64) -> Self {
        assert!(alpha > 0.0 && alpha <= 1.0, "alpha is in (0, 1]: {alpha}");
        let fourth = alpha.powi(4);
        let scale = 16.0 * alpha.powf(8.0 / 3.0);
        Self { scale, whole: 1.0 + scale * fourth, slope: 1.0 - scale * (1.0 - fourth) }
    }

    /// w, in \[0, 1\], at a cosine in \[0, 1\].
    #[inline]
    pub fn w(&self, mu: f64) -> f64 {
        check_cosine(mu);
        let square = mu * mu;
        (square * self.whole / (self.scale + self.slope * square)).min(1.0)
    }

    /// The place along the axis of a cosine in \[0, 1\]: node k of n is at k / (n - 1).
    #[inline]
    pub fn place(&self, mu: f64) -> f64 {
        cube_root(self.w(mu))
    }

    /// sqrt(w), in \[0, 1\], at a cosine in \[0, 1\]: proportional to the cosine near 0.
    #[inline]
    pub fn root(&self, mu: f64) -> f64 {
        self.w(mu).sqrt()
    }

    /// The derivative of [`Self::root`] by mu; above 0.
    #[inline]
    pub fn root_slope(&self, mu: f64) -> f64 {
        let below = self.scale + self.slope * mu * mu;
        self.whole.sqrt() * self.scale / (below * below.sqrt())
    }

    /// The cosine whose [`Self::root`] is `root` in \[0, 1\].
    #[inline]
    pub fn mu(&self, root: f64) -> f64 {
        self.mu_and_log_slope(root * root).0
    }

    /// The cosine whose [`Self::w`] is `w` in \[0, 1\], and [`Self::log_slope`] there.
    #[inline]
    pub fn mu_and_log_slope(&self, w: f64) -> (f64, f64) {
        let below = self.whole - w * self.slope;
        let mu = (w * self.scale / below).sqrt().min(1.0);
        (mu, below / (mu * self.whole))
    }

    /// The derivative of the logarithm of [`Self::root`] by mu.
    #[inline]
    pub fn log_slope(&self, mu: f64) -> f64 {
        self.scale / (mu * (self.scale + self.slope * mu * mu))
    }

    /// The root of a place along the axis, in \[0, 1\].
    #[inline]
    pub fn root_from_place(place: f64) -> f64 {
        place * place.sqrt()
    }
}

/// Alpha at a texel coordinate; node k is at coordinate k.
pub fn slab_alpha(texel: f64) -> f64 {
    ((14.0 + texel) / 45.0).powi(4)
}

/// The texel coordinate of `alpha` > 0; it is negative before the first node.
fn alpha_texel(alpha: f64) -> f64 {
    45.0 * alpha.sqrt().sqrt() - 14.0
}

/// The first node (alpha, mu_i, mu_o) that is wrong, and what is wrong with it.
fn defect(cells: &[[f16; 3]]) -> Option<([usize; 3], String)> {
    let n = SLAB_SIDE;
    cells.iter().enumerate().find_map(|(index, cell)| {
        let [k, i, j] = [index / (n * n), index / n % n, index % n];
        for (m, (value, (low, high))) in cell.iter().zip(RANGES).enumerate() {
            if !(low..=high).contains(&value.to_f64()) {
                return Some(([k, i, j], format!("v{m} must be in [{low}, {high}]: {value}")));
            }
        }
        let mirrored = cells[(k * n + j) * n + i] == *cell;
        (!mirrored).then(|| ([k, i, j], "mu_i and mu_o exchanged must give the same".to_owned()))
    })
}
