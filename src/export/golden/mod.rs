//! Golden numbers: what every function of the copied shaders gives for some inputs, to check a port by, with a key to mistakes.
//!
//! Inputs are exact in `f32`. Outputs are computed in `f64` from the shipped halves. Independent of the shaders are the form factors of
//! the whole, by [`reference::polygon`](crate::reference::polygon); lookups, by [`table`](crate::table); points of fans, by the
//! reference's sampler of the cosine; angles and transformed lobes, by [`f64::atan2`] and matrices with inverses and determinants. The
//! crossing of the horizon, the angle that closes a contour, the weights of layers and the polynomials of `sheen_fit` are formulas by
//! definition: there the numbers check a port of them, not them. Each output comes with a tolerance that any `f32` port of the same
//! method keeps.
//!
//! Structs are their fields in order, vectors their numbers from x on, matrices their columns, bools 0 or 1; textures are
//! left out, for they are the shipped tables.

mod angles;
mod answers;
mod fan;
mod fans;
mod flat;
mod formulas;
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
