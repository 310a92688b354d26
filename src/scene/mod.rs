//! What there is to be drawn: meshes, materials, polygon lights and cameras, in metres and linear Rec. 709.
//!
//! A scene is plain data. [`gltf`] makes one from a file; whoever draws it reads it and changes nothing.

mod camera;
pub mod gltf;
mod light;
mod material;
mod mesh;
mod settings;

pub use camera::{Camera, Projection};
pub use light::{Light, Polygon};
pub use material::{Material, Sheen};
pub use mesh::{Instance, Mesh};
pub use settings::{Lobes, Settings};

/// Everything that a picture is made of.
///
/// Indices between the parts are valid: whoever makes a `Scene` sees to it.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Triangles in their own space, one mesh per glTF primitive.
    pub meshes: Vec<Mesh>,
    /// Meshes placed in the world.
    pub instances: Vec<Instance>,
    pub materials: Vec<Material>,
    pub lights: Vec<Light>,
    /// At least one, after loading: the first is the default view.
    pub cameras: Vec<Camera>,
    /// What the file holds and Velour does not draw, or what was added (a framing camera, a default rig): one line each,
    /// one per kind, for the caller to print.
    pub notices: Vec<String>,
}
