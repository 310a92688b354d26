//! A view of the whole scene, for files without a camera.

use glam::{Mat3, Mat4, Vec3};

use super::notices::Notices;
use super::{Bounds, Camera, Projection, Scene};

/// To the right and slightly above, from where a photographer would look at something on a table (glTF's front is +z).
const TOWARDS_CAMERA: Vec3 = Vec3::new(0.55, 0.4, 1.0);
/// Vertical field of view in radians: that of a short telephoto lens.
const YFOV: f32 = 0.6;
/// The scene's distance from the camera, relative to that at which its box would touch the edge of a square picture.
const MARGIN: f32 = 1.1;

/// Adds a camera that shows what is lit, where the scene has no camera.
pub(super) fn add_camera(scene: &mut Scene, notices: &mut Notices) {
    if !scene.cameras.is_empty() {
        return;
    }
    let subject = scene.subject();
    let (center, radius) = (subject.center(), radius(&subject));
    let back = TOWARDS_CAMERA.normalize();
    let right = Vec3::Y.cross(back).normalize();
    let axes = Mat3::from_cols(right, back.cross(right), back);
    // The distance from which a corner is seen at the edge of the field of view, to the side or above, whichever is
    // farther out.
    let needed = subject.corners().map(|corner| {
        let corner = axes.transpose() * (corner - center);
        corner.z + corner.x.abs().max(corner.y.abs()) / (0.5 * YFOV).tan()
    });
    let distance = MARGIN * needed.into_iter().fold(radius, f32::max);
    let eye = center + distance * back;
    let world_from_camera = Mat4::from_translation(eye) * Mat4::from_mat3(axes);
    // Lights may stand in front of the subject and behind it.
    let farthest = scene.bounds().corners().map(|corner| corner.distance(eye)).into_iter().fold(distance, f32::max);
    let projection = Projection::Perspective { yfov: YFOV, near: 0.01 * distance, far: 1.1 * farthest + radius };
    scene.cameras.push(Camera { name: "framing".to_owned(), world_from_camera, projection });
    notices.add("no camera in the file", || "the whole scene is framed".to_owned());
}

/// Half the diagonal in metres, but never so small, for where the box is, that it would be lost in rounding.
pub(super) fn radius(bounds: &Bounds) -> f32 {
    let magnitude = bounds.min.abs().max(bounds.max.abs()).max_element();
    (0.5 * bounds.diagonal() as f32).max(1e-5 * magnitude).max(1e-12)
}
