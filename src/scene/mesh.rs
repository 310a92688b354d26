use glam::{DMat3, Mat3, Mat4, Vec3};

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

impl Instance {
    /// Takes normals of the mesh to the world's, up to a positive factor: the inverse transpose, scaled so that its
    /// largest entry is 1. Finite whatever the scale.
    pub fn world_from_normal(&self) -> Mat3 {
        let matrix = DMat3::from_mat4(self.world_from_mesh.as_dmat4());
        let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
        let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * matrix.determinant().signum();
        let largest =
            cofactors.to_cols_array().into_iter().fold(f64::MIN_POSITIVE, |largest, entry| largest.max(entry.abs()));
        (cofactors * largest.recip()).as_mat3()
    }

    /// Whether the transform mirrors, and so turns front faces into back faces by winding.
    pub fn mirrors(&self) -> bool {
        DMat3::from_mat4(self.world_from_mesh.as_dmat4()).determinant() < 0.0
    }
}
