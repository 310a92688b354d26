//! A view of the whole scene, for files without a camera.

use glam::{Mat3, Mat4, Vec3};

use super::notices::Notices;
use super::{Bounds, Camera, Projection, Scene};

/// From the right and slightly above, as a photographer would look at a thing on a table (glTF's front is +z).
const TOWARDS_CAMERA: Vec3 = Vec3::new(0.55, 0.4, 1.0);
/// Vertical field of view in radians: that of a short telephoto lens.
const YFOV: f32 = 0.6;
/// Room left around the sphere about the scene.
const MARGIN: f32 = 1.05;

/// Adds a camera that shows what is lit where the scene has none.
pub(super) fn add_camera(scene: &mut Scene, notices: &mut Notices) {
    if !scene.cameras.is_empty() {
        return;
    }
    let subject = scene.subject();
    let (center, radius) = (subject.center(), radius(&subject));
    let back = TOWARDS_CAMERA.normalize();
    let distance = MARGIN * radius / (0.5 * YFOV).sin();
    let eye = center + distance * back;
    let right = Vec3::Y.cross(back).normalize();
    let axes = Mat3::from_cols(right, back.cross(right), back);
    let world_from_camera = Mat4::from_translation(eye) * Mat4::from_mat3(axes);
    // Lights may stand before the subject, and anywhere behind it.
    let projection = Projection::Perspective { yfov: YFOV, near: 0.01 * distance, far: f32::INFINITY };
    scene.cameras.push(Camera { name: "framing".to_owned(), world_from_camera, projection });
    notices.add("no camera in the file", || "the whole scene is framed".to_owned());
}

/// Half the diagonal, and something to work with for a box that is next to nothing where it stands.
pub(super) fn radius(bounds: &Bounds) -> f32 {
    let magnitude = bounds.min.abs().max(bounds.max.abs()).max_element();
    (0.5 * bounds.diagonal() as f32).max(1e-5 * magnitude).max(1e-12)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Instance, Material, Mesh};

    /// A scene of one mesh with these corners, in a row of triangles.
    fn scene(positions: Vec<Vec3>) -> Scene {
        let normals = vec![Vec3::Z; positions.len()];
        let indices = (2..positions.len() as u32).flat_map(|last| [last - 2, last - 1, last]).collect();
        Scene {
            meshes: vec![Mesh { name: String::new(), positions, normals, indices, material: 0 }],
            instances: vec![Instance { name: String::new(), mesh: 0, world_from_mesh: Mat4::IDENTITY }],
            materials: vec![Material::default()],
            ..Scene::default()
        }
    }

    #[test]
    fn the_whole_scene_is_in_the_frame() {
        let corners = [Vec3::ZERO, Vec3::new(1.0, 0.2, 0.0), Vec3::new(0.3, 2.0, -1.0), Vec3::new(-2.0, 0.0, 0.5)];
        for (scale, offset) in [(1.0, Vec3::ZERO), (1e-4, Vec3::ZERO), (1e6, Vec3::ONE), (1.0, Vec3::splat(1e4))] {
            let positions: Vec<Vec3> = corners.iter().map(|&corner| corner * scale + offset).collect();
            let mut scene = scene(positions.clone());
            add_camera(&mut scene, &mut Notices::default());
            let [camera] = &scene.cameras[..] else { panic!("{:?}", scene.cameras) };
            let Projection::Perspective { yfov, near, far } = camera.projection else { panic!("{camera:?}") };
            let seen = positions.iter().map(|&p| camera.world_from_camera.inverse().transform_point3(p));
            let heights = seen.map(|p| {
                assert!(-p.z > near && -p.z < far);
                p.truncate().length() / (-p.z * (0.5 * yfov).tan())
            });
            let highest = heights.fold(0.0, f32::max);
            // In the frame even where that is a square, and filling a good part of it.
            assert!((0.5..1.0).contains(&highest), "{highest}");
        }
    }

    #[test]
    fn a_scene_without_depth_or_extent_is_framed() {
        for positions in [vec![Vec3::ONE; 3], vec![Vec3::ZERO; 3], vec![Vec3::splat(1e12); 3]] {
            let mut scene = scene(positions);
            add_camera(&mut scene, &mut Notices::default());
            let camera = &scene.cameras[0];
            assert!(camera.world_from_camera.is_finite());
            assert!(matches!(camera.projection, Projection::Perspective { near, .. } if near > 0.0));
        }
    }
}
