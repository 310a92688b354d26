//! Small files made in memory, read back.

mod attributes;
mod builder;
mod bytes;
mod compressed;
mod extras;
mod files;
mod images;
mod instancing;
mod ktx2;
mod lenience;
mod lights;
mod materials;
mod morphs;
mod mutations;
mod odd_skins;
mod origin;
mod poses;
mod reads;
mod skins;
mod spelling;
mod textures;
mod values;
mod visibility;
