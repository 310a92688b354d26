//! Small files made in memory, read back.

mod builder;
mod bytes;
mod files;
mod images;
mod materials;
mod mutations;
mod reads;
mod textures;
mod values;
