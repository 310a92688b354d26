//! From lobes to the tables: [`sheen`] and [`ggx`] as transformed cosines, [`slab`] for path tracers, each with its report.
//!
//! Beside them stands what they share: the solved [`lobe`]s of slabs on a [`hemisphere`], what [`nodes`] hold for the sake of what is
//! interpolated between them, and the statistics of [`Errors`].

mod errors;
pub mod ggx;
pub mod hemisphere;
pub mod lobe;
pub mod nodes;
pub mod sheen;
pub mod slab;

pub use errors::{DIM, Errors};

use std::ops::RangeInclusive;

/// The first lines of every table's .csv, which is made to be copied.
const LICENCE: [&str; 2] =
    ["SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD", "SPDX-FileCopyrightText: 2026 The Velour authors"];

/// Nodes a side of the shipped tables of transformed cosines.
pub const RESOLUTION: usize = 32;

/// The numbers of nodes a side that a table may be asked to have.
pub const RESOLUTIONS: RangeInclusive<usize> = 2..=128;
