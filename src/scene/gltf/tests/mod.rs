//! Small files made in memory, read back.

mod attributes;
mod builder;
mod bytes;
mod extras;
mod files;
mod lights;
mod mutations;
mod reads;
mod values;
