//! Small files made in memory, read back.

mod attributes;
mod builder;
mod bytes;
mod extras;
mod files;
mod images;
mod lenience;
mod lights;
mod materials;
mod mutations;
mod reads;
mod spelling;
mod textures;
mod values;
