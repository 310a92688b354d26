//! Small files made in memory, read back.

mod builder;
mod bytes;
mod files;
mod mutations;
mod reads;
mod values;
