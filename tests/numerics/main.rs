//! The numbers: the medium, the slab, its walk, the fit, the tables and their files, the models.
//!
//! Statistical tests have fixed seeds. A chi-square test fails where its probability falls below `SIGNIFICANCE`, and a
//! comparison of means where it is off by more than the stated number of standard errors.

mod base;
#[cfg(feature = "scenes")]
mod disk_light;
#[cfg(feature = "cli")]
mod fibres;
mod fit;
#[cfg(feature = "cli")]
mod forms;
mod ggx_table;
mod hostile_table;
mod lobes;
mod medium;
mod microfacet;
mod models;
mod prior_models;
mod ranges;
mod shipped_ggx;
mod shipped_table;
mod slab;
mod slab_table;
mod statistics;
mod table;
#[cfg(feature = "scenes")]
mod textured_lights;
mod transport;
mod walk;

/// The unit vector of cosine `mu` to the normal and azimuth `phi`.
fn direction(mu: f64, phi: f64) -> glam::DVec3 {
    let s = velour::math::sine(mu);
    glam::DVec3::new(s * phi.cos(), s * phi.sin(), mu)
}
