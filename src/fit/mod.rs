//! From lobes to the table.

pub mod hemisphere;
pub mod least_squares;
pub mod lobe;
pub mod ltc;
