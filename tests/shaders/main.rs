//! The shader files that people copy.

mod files;
