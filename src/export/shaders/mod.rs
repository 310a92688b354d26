//! The files at the top of `shaders/`, in other languages.
//!
//! What they are written in is a part of WGSL that other languages have too: constants, structs and functions of numbers,
//! with `let`, `var`, `if`, `for` and `return`. So they can be translated as one would by hand: names, comments and
//! layout stay, types that WGSL infers are written out, and what differs is said in the other language's own way. What
//! is outside of that part is refused ([`Refusal`]).
//!
//! Data runs one way: `tokens` -> `parse` -> `declarations` and `scope`, which find the types -> `write`.

mod cursor;
mod declarations;
mod expressions;
mod functions;
mod language;
mod parse;
mod refusal;
mod reserved;
mod scope;
mod sources;
mod spelling;
mod spirv;
mod statements;
mod syntax;
mod tokens;
mod translate;
mod types;
mod walk;
mod write;

pub use language::Language;
pub use refusal::Refusal;
pub use reserved::is_reserved;
pub use sources::{SOURCES, Source};
pub use spirv::spirv;
pub use translate::translate;
