//! Small files made in memory, read back.

mod attributes;
mod builder;
mod bytes;
mod compressed;
mod extras;
mod files;
mod images;
mod ktx2;
mod lights;
mod materials;
mod mutations;
mod reads;
mod textures;
mod values;
