//! The shader files in other languages: each is compiled by a compiler of its language, and run on the golden numbers.
//!
//! `scripts/setup languages` installs the compilers.

mod compilers;
mod device;
mod golden;
mod metal;
mod shells;
mod theirs;
mod vulkan;
