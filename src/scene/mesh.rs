use glam::{DMat3, Mat3, Mat4, Vec2, Vec3, Vec4};

/// An indexed triangle mesh in its own space.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// The glTF mesh and primitive, for messages.
    pub name: String,
    /// In metres, in the mesh's own space.
    pub positions: Vec<Vec3>,
    /// Unit length, one per position.
    pub normals: Vec<Vec3>,
    /// Unit length, one per position, w = 1 or -1: the bitangent is w (normal x tangent). Empty where nothing is
    /// normal-mapped.
    pub tangents: Vec<Vec4>,
    /// Two sets of texture coordinates, each one per position, or empty where no texture of the material uses the set
    /// or all its coordinates are 0.
    pub tex_coords: [Vec<Vec2>; 2],
    /// Linear colour and opacity by which the material's base colour is multiplied, 65535 for 1: one per position, or
    /// empty.
    pub colors: Vec<[u16; 4]>,
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
    /// Takes the mesh's normals to the world's, up to a positive factor: the inverse transpose of the transform, scaled
    /// so that its largest entry is 1 or -1. Finite whatever the transform's scale.
    pub fn world_from_normal(&self) -> Mat3 {
        normal_matrix(DMat3::from_mat4(self.world_from_mesh.as_dmat4())).as_mat3()
    }

    /// Whether the transform mirrors the mesh: by winding, front faces are then back faces.
    pub fn mirrors(&self) -> bool {
        DMat3::from_mat4(self.world_from_mesh.as_dmat4()).determinant() < 0.0
    }
}

/// Takes normals where a matrix takes the surface, up to a positive factor: the matrix's inverse transpose, scaled so
/// that its largest entry is 1 or -1. Finite whatever the matrix; zero where that leaves less than a plane.
pub(super) fn normal_matrix(matrix: DMat3) -> DMat3 {
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * matrix.determinant().signum();
    let largest =
        cofactors.to_cols_array().into_iter().fold(f64::MIN_POSITIVE, |largest, entry| largest.max(entry.abs()));
    cofactors * largest.recip()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn instance(linear: DMat3) -> Instance {
        Instance { name: String::new(), mesh: 0, world_from_mesh: Mat4::from_mat3(linear.as_mat3()) }
    }

    #[test]
    fn normals_stay_perpendicular_and_outside_under_any_transform() {
        let (tangent, bitangent, normal) = (DVec3::X, DVec3::new(0.0, 0.6, 0.8), DVec3::new(0.0, -0.8, 0.6));
        for scale in [DVec3::new(1.0, 2.0, 3.0), DVec3::new(-1.0, 2.0, 0.5), DVec3::new(1e-9, 2e-9, 1e-9)] {
            let rotation = DMat3::from_euler(glam::EulerRot::XYZ, 0.3, -1.1, 2.0);
            let linear = rotation * DMat3::from_diagonal(scale);
            let transformed = instance(linear).world_from_normal().as_dmat3() * normal;
            for edge in [linear * tangent, linear * bitangent] {
                assert!(transformed.normalize().dot(edge.normalize()).abs() < 1e-6, "{scale}");
            }
            assert!(transformed.dot(linear * normal) > 0.0, "{scale}");
        }
    }

    #[test]
    fn a_flattening_transform_gives_finite_normals() {
        for scale in [DVec3::new(1.0, 1.0, 0.0), DVec3::ZERO, DVec3::new(0.0, 1.0, 0.0)] {
            assert!(instance(DMat3::from_diagonal(scale)).world_from_normal().is_finite());
        }
    }
}
