//! Small files made in memory, read back.

mod builder;
mod files;
mod hostile;
mod reads;
mod values;
