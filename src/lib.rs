//! Velour shades fuzzy and dusty surfaces under polygonal area lights in real time.
//!
//! Light transport in a layer of fibres is solved once, each reflected lobe is fitted with a linearly transformed cosine
//! (LTC), and a fragment shader integrates that cosine over the lights' polygons in closed form.
//! Data runs one way: [`physics`] -> [`fit`] -> `tables/` -> `renderer` -> `viewer`.
//!
//! # Map
//!
//! | module | what stands there | with feature |
//! |---|---|---|
//! | [`math`] | quadrature, sampling warps, frames: `f64`, no domain knowledge | |
//! | [`table`] | the tables of lobes, and in 3D the slab's: lookup, .csv and .dds in and out | |
//! | [`physics`] | the slab of fibres, stated and solved: without noise, and by random walk; GGX microfacets | |
//! | [`fit`] | lobe to table: the sheen's, the specular base's, the slab's, each with its report | |
//! | [`models`] | how surfaces scatter light, for path tracers: evaluate, sample, density, albedo | |
//! | [`mod@reference`] | the picture in `f64`: the exact form factor of a polygon; points of convex ones; path tracing | path tracing: `gpu` or `cli` |
//! | `scene` | camera, material, light, mesh as loaded; what a user changes, and what is drawn; glTF in | `gpu` or `cli` |
//! | `picture` | a linear image; .png and .exr in and out, tone curves; how two pictures differ, FLIP with `cli` | `gpu` or `cli` |
//! | `bvh` | the hierarchy over a scene's triangles, for rays | `gpu` or `cli` |
//! | `renderer` | wgpu: device, targets, passes | `gpu` |
//! | `figures` | the table, its lobes and its errors; explicit fibres; the paper's figures | `cli` |
//! | `viewer` | a window with orbit and panel | `window` |
//! | `export` | the shaders in other languages, golden numbers, the tables in other forms | `cli` |
//! | `file` | a file appears whole or not at all | `cli` or `window` |
//!
//! # Examples
//!
//! | to | look at | with feature |
//! |---|---|---|
//! | render a picture without a window | `examples/offscreen.rs`, `renderer::Offscreen` | `gpu` |
//! | compare pictures in a test | `examples/screenshot_test.rs`, `picture::FlipMap` | `gpu`, `cli` |
//! | scatter light in a path tracer | `examples/brdf.rs`, [`models`] | |
//! | the same on a device | `examples/path_tracer` | `gpu`, `cli` |
//! | light surfaces by polygons in a shader | `examples/lights.wgsl`, `shaders/`, `docs/integration.md` | |
//! | put the sheen into an engine | `examples/three`, `examples/babylon`, `examples/bevy` | |
//!
//! The sheen's numbers at any roughness and view angle, without a graphics device:
//!
//! ```
//! let table = velour::table::SheenTable::embedded();
//! let [a, b, r] = table.lookup(0.5, 0.3);
//! assert!(a > 0.0 && b < 0.0 && r < 1.0);
//! ```
//!
//! # Glossary
//!
//! Z: Zeltner, Burley, Chiang 2022; H: Heitz, Dupuy, Hill, Neubelt 2016; S: Heitz, Dupuy, Crassin, Dachsbacher 2015.
//!
//! | symbol | name | range | source |
//! |---|---|---|---|
//! | `roughness` | the user's parameter; of the specular base, `alpha = roughness^2` | \[0, 1\] | glTF: sheenRoughnessFactor, roughnessFactor |
//! | `alpha` | roughness of the layer: small is fuzz, large is dust; `alpha = roughness` unless another `RoughnessMap` is chosen | \[0, 1\] | Z |
//! | `sigma` | cross-section of the fibres seen along their axis, `alpha^2` | (0, 1] | S |
//! | `C_sheen` | colour of the sheen, linear Rec. 709 | \[0, 1\] each | Z eq. 1 |
//! | `wi` | direction whose elevation picks the lobe (the view in rendering), unit, away from the surface | upper hemisphere | Z |
//! | `wo` | the other direction (the light's side) | upper hemisphere | Z |
//! | `mu` | cosine to the normal | \[0, 1\] | |
//! | `phi` | azimuth around the normal, 0 towards `wi` | \[-pi, pi\] | |
//! | `tau` | optical depth | \[0, infinity) | |
//! | `K`, `K_m` | the kernel, extinction x phase function, and its azimuthal modes | \[0, infinity) | S; [`physics::modes`] |
//! | lobe | f_r(wi, wo) mu_o: reflected radiance times cosine per unit of flux from `wi` | | Z |
//! | `R`, `r` | albedo: the share of light that the layer sends back up; `r` is the table's column, fitted for lookups between its nodes | \[0, 1\] | Z eq. 1 |
//! | `a`, `b` | the table's columns of the inverse matrix | a >= 0 | Z section 2 |
//! | `m_inv` | inverse matrix of the transformed cosine, rows (a,0,b), (0,a,0), (0,0,1); of the specular base (a,0,b), (0,c,0), (0,0,1) | | Z section 2, H |
//! | `f0`, `f90` | reflectance of the specular base head on and at grazing angles | \[0, 1\] each | [`models::Schlick`] |
//! | `D` | the clamped cosine on the unit sphere, `max(w_z, 0) / pi` | | H |
//! | form factor | integral of a transformed cosine over a polygon; the whole hemisphere is 1 | \[0, 1\] | H section 3 |
//! | radiance | of a light or a surface, in any linear unit | \[0, infinity) | |
//!
//! Local frame: z is the normal, x is `wi` projected on the surface. `a_from_b` names a transform, `p_world` a point.

#![warn(missing_docs)]

#[cfg(feature = "scenes")]
pub mod bvh;
#[cfg(feature = "cli")]
pub mod export;
#[cfg(feature = "cli")]
pub mod figures;
#[cfg(any(feature = "cli", feature = "window"))]
pub mod file;
pub mod fit;
pub mod math;
pub mod models;
pub mod physics;
#[cfg(feature = "scenes")]
pub mod picture;
pub mod reference;
#[cfg(feature = "gpu")]
pub mod renderer;
#[cfg(feature = "scenes")]
pub mod scene;
pub mod table;
#[cfg(feature = "window")]
pub mod viewer;
