//! Small files made in memory, read back.

mod builder;
mod reads;
