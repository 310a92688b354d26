//! What leaves for other engines: the shaders in their languages, golden numbers to check a port by, the tables in the
//! forms that they read. Everything is made in memory; whoever asks for it writes the files.

pub mod golden;
pub mod shaders;
pub mod tables;
