//! Golden numbers: what every function of the copied shaders gives for some inputs, to check a port by, with a key to mistakes.
//!
//! Inputs are exact in `f32`. Outputs are computed in `f64` from the shipped halves, by definitions that share none of the
//! shaders' devices: matrices with their inverses and determinants, [`f64::atan2`], the exact polygon of
//! [`reference::polygon`](crate::reference::polygon). Each comes with a tolerance that any `f32` port of the same method keeps.
//!
//! Structs are their fields in order, vectors their numbers from x on, matrices their columns, bools 0 or 1; textures are
//! left out, for they are the shipped tables.

mod angles;
mod answers;
mod fan;
mod fans;
mod flat;
mod frame;
mod function;
mod judge;
mod lobe;
mod lobes;
mod lookup;
mod mistake;
mod numbers;
mod outline;
mod scenes;
mod text;
mod walks;
mod whole;

pub use answers::{Answers, AnswersError};
pub use function::{Function, Row};
pub use judge::{Cause, Judgement, Off};
pub use mistake::Mistake;
pub use numbers::Golden;
