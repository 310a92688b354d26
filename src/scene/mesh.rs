use glam::{Mat4, Vec3};

/// An indexed triangle mesh in its own space.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// For messages: the glTF mesh and primitive.
    pub name: String,
    /// Metres.
    pub positions: Vec<Vec3>,
    /// Unit length, one per position.
    pub normals: Vec<Vec3>,
    /// Three per triangle, counter-clockwise seen from the front.
    pub indices: Vec<u32>,
    /// Index into `Scene::materials`.
    pub material: usize,
}

/// A mesh placed in the world.
#[derive(Clone, Debug)]
pub struct Instance {
    /// The glTF node's name.
    pub name: String,
    /// Index into `Scene::meshes`.
    pub mesh: usize,
    /// Affine. A negative determinant mirrors the mesh: the winding of its front faces is then flipped.
    pub world_from_mesh: Mat4,
}
