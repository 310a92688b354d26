//! Small files made in memory, read back.

mod builder;
mod files;
mod hostile;
mod mutations;
mod reads;
