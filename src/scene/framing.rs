//! How far away a view has to be to show something whole; and one of the whole scene, for files without a camera.

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
    let distance = distance(&subject, &axes, YFOV, 1.0);
    let eye = center + distance * back;
    let world_from_camera = Mat4::from_translation(eye) * Mat4::from_mat3(axes);
    // Lights may stand in front of the subject and behind it.
    let farthest = scene.bounds().corners().map(|corner| corner.distance(eye)).into_iter().fold(distance, f32::max);
    let projection = Projection::Perspective { yfov: YFOV, near: 0.01 * distance, far: 1.1 * farthest + radius };
    scene.cameras.push(Camera { name: "framing".to_owned(), world_from_camera, projection });
    notices.add("no camera in the file", || "the whole scene is framed".to_owned());
}

/// The distance from its middle at which a box is seen whole along the axes' -z, in a picture of this vertical field of
/// view (radians) and aspect (width / height).
pub(super) fn distance(bounds: &Bounds, axes: &Mat3, yfov: f32, aspect: f32) -> f32 {
    // From there the outmost corner is seen at the edge of the field of view, to the side or above.
    let [across, up] = [aspect, 1.0].map(|side| side * (0.5 * yfov).tan());
    let needed = corners(bounds, axes).map(|corner| corner.z + (corner.x.abs() / across).max(corner.y.abs() / up));
    MARGIN * needed.into_iter().fold(radius(bounds), f32::max)
}

/// Half the height of a picture of this aspect that shows a box along the axes' -z without perspective, metres.
pub(super) fn half_height(bounds: &Bounds, axes: &Mat3, aspect: f32) -> f32 {
    let needed = corners(bounds, axes).map(|corner| (corner.x.abs() / aspect).max(corner.y.abs()));
    MARGIN * needed.into_iter().fold(1e-3 * radius(bounds), f32::max)
}

/// The corners of a box from its middle, in these axes.
fn corners(bounds: &Bounds, axes: &Mat3) -> [Vec3; 8] {
    bounds.corners().map(|corner| axes.transpose() * (corner - bounds.center()))
}

/// Half the diagonal in metres, but never so small, for where the box is, that it would be lost in rounding.
pub(super) fn radius(bounds: &Bounds) -> f32 {
    let magnitude = bounds.min.abs().max(bounds.max.abs()).max_element();
    (0.5 * bounds.diagonal() as f32).max(1e-5 * magnitude).max(1e-12)
}
