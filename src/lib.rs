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
//! | [`table`] | the table of lobes: bilinear lookup, .csv and .dds in and out | |
//! | [`physics`] | the slab of fibres, stated and solved | |
//! | [`fit`] | lobe to LTC, the grid, the error report | |
//! | [`reference`] | the picture in `f64`: the exact form factor of a polygon | |
//! | `scene` | camera, material, light, mesh, settings; glTF in | `gpu` or `cli` |
//! | `picture` | a linear image; .png and .exr out, tone curves | `gpu` or `cli` |
//! | `renderer` | wgpu: device, targets, passes | `gpu` |
//! | `viewer` | a window with orbit and panel | `viewer` |

pub mod fit;
pub mod math;
pub mod physics;
#[cfg(any(feature = "gpu", feature = "cli"))]
pub mod picture;
pub mod reference;
#[cfg(feature = "gpu")]
pub mod renderer;
#[cfg(any(feature = "gpu", feature = "cli"))]
pub mod scene;
pub mod table;
#[cfg(feature = "viewer")]
pub mod viewer;
