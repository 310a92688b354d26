//! The tables: grids, their lookup, and their files.
//!
//! [`SheenTable`], for real time, holds the sheen's transformed cosines over `(alpha, mu)`: see [`sheen`].
//!
//! [`GgxTable`] holds the same and more for the specular base, over `(roughness, mu)`: see [`ggx`].
//!
//! [`SlabTable`], for path tracers, holds the slab's multiple scattering over `(alpha, mu_i, mu_o)`: see [`slab`]. Its .dds is a volume.

mod csv;
mod dds;
pub mod ggx;
mod grid;
mod ltc;
pub mod sheen;
pub mod slab;
mod slab_dds;

pub use ggx::{GgxLobe, GgxTable};
pub use grid::{MAX_SIDE, cell, centres, node};
pub use ltc::Ltc;
pub use sheen::SheenTable;
pub use slab::{LEAST_SLAB_ALPHA, SLAB_SIDE, SlabModes, SlabSlice, SlabTable, SlabWarp, slab_alpha};

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Longest file that a table is loaded from, in bytes: room for the largest table as text.
pub const MAX_FILE_BYTES: u64 = 128 << 20;

/// Why a table was not read. Each message is one line: what is wrong, where, and what to do.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    /// A file was not read.
    #[error("{}: {problem}", .path.display())]
    In {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        problem: Box<TableError>,
    },
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
    /// A .csv is not UTF-8.
    #[error("byte {at} is not UTF-8 text; a table's .csv holds lines of numbers")]
    NotText {
        /// The first byte that is no text, counted from 0.
        at: usize,
    },
    /// A line of a .csv does not hold the numbers that it should.
    #[error("line {line}: {problem}")]
    Line {
        /// Counted from 1.
        line: usize,
        /// What is wrong with it, and what belongs there.
        problem: String,
    },
    /// The lines of a .csv, taken together, do not fill a grid.
    #[error("{problem}; a table holds n x m lines of {columns}, in order of the first two, node k of n at k/(n-1)")]
    Lines {
        /// The names of the columns that a line has.
        columns: String,
        /// What is wrong with the lines.
        problem: String,
    },
    /// A .dds does not hold the texture of a [`SheenTable`] or [`GgxTable`], or one of its texels is out of range.
    #[error("{problem}; a table is one 2D texture of RGBA16F or RGBA32F with a DX10 header and no mips")]
    Dds {
        /// What is wrong with it.
        problem: String,
    },
    /// A .dds does not hold the volume of a [`SlabTable`], or one of its texels is out of range.
    #[error("{problem}; a slab's table is one volume of 32 x 32 x 32 texels of RGBA16F with a DX10 header and no mips")]
    Volume {
        /// What is wrong with it.
        problem: String,
    },
}

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
