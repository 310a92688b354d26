//! The tables in the forms that engines take.
//!
//! Every form holds the same texels: rows from y = 0 on, along x within a row, four numbers a texel. A form says so
//! itself where it can hold text ([`Texture::layout`]).
//!
//! | form | numbers | for |
//! |---|---|---|
//! | `dds`, `ktx2`, `exr` | halves | loaders of textures |
//! | `bin` | halves | uploads without a loader |
//! | `js`, `glsl` | halves | pasting where there are no files |
//! | `c`, `rust` | the .csv's numbers | pasting into the engine itself |
//! | `npy`, `csv` | the .csv's numbers | scripts |

mod difference;
mod exr;
mod file;
mod form;
mod ktx2;
mod npy;
mod resample;
mod source;
mod texture;

pub use difference::Difference;
pub use form::Form;
pub use resample::{SIDES, resample, resampled, resampled_stem};
pub use texture::Texture;
