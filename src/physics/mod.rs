//! The slab of fibres, stated and solved; and the rough mirror below it: [`microfacet`].
//!
//! A flat layer of density 1 and thickness 1, of fibre-like SGGX microflakes whose axis is the normal, that absorb
//! nothing; black below, nothing above. [`sggx`] is the medium, [`slab`] the layer with what is known of it in closed
//! form; [`transport`] solves it without noise, on the kernel's [`modes`], and [`walk`] by random walk.

pub mod microfacet;
pub mod modes;
pub mod sggx;
pub mod slab;
pub mod transport;
pub mod walk;
