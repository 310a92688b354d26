//! From where a view shows something whole; and one of the whole scene, for files without a camera.

use glam::{Mat3, Mat4, Vec3};

use super::notices::Notices;
use super::orbit::within_reach;
use super::{Bounds, Camera, Orbit, Projection, Scene};

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
    let (center, radius) = (subject.center(), subject.radius());
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

impl Orbit {
    /// The least angle in radians, about 9 degrees, at which something flat is framed.
    const SHALLOWEST: f32 = 0.15;

    /// Centres on a box that is not empty, and goes where it fills a picture of this aspect (width / height). The direction of
    /// the view stays, but for something flat that would be seen along its plane, and so not at all.
    pub fn frame(&mut self, bounds: &Bounds, aspect: f32) {
        self.leave_plane(bounds);
        self.fit(bounds, aspect);
    }

    /// Centres on a point of something within this box: near enough that all of that would fill the picture, and never
    /// farther than the point is.
    pub fn centre(&mut self, point: Vec3, bounds: &Bounds, aspect: f32) {
        let (depth, before) = (self.depth(point), self.projection);
        self.fit(bounds, aspect);
        self.target = within_reach(point);
        match (&mut self.projection, before) {
            (Projection::Orthographic { ymag, .. }, Projection::Orthographic { ymag: before, .. }) => {
                *ymag = ymag.min(before);
            }
            _ => self.distance = self.distance.min(depth),
        }
    }

    /// Turns as far out of the plane of a flat box as it takes to see it.
    fn leave_plane(&mut self, bounds: &Bounds) {
        let Some(normal) = bounds.flat() else { return };
        let back = self.axes().z_axis;
        let height = back.dot(normal);
        let side = if height < 0.0 { -normal } else { normal };
        if height.abs() < Self::SHALLOWEST.sin() {
            let along = (back - height * normal).normalize();
            let back = Self::SHALLOWEST.cos() * along + Self::SHALLOWEST.sin() * side;
            self.look_from(back.x.atan2(back.z), back.y.clamp(-1.0, 1.0).asin());
        }
    }

    /// Frames a box from where the view looks.
    fn fit(&mut self, bounds: &Bounds, aspect: f32) {
        self.target = within_reach(bounds.center());
        let axes = self.axes();
        match &mut self.projection {
            Projection::Orthographic { ymag, near, .. } => {
                *ymag = half_height(bounds, &axes, aspect);
                // Nothing of it is before the near plane.
                self.distance = self.distance.max(*near + bounds.radius());
            }
            Projection::Perspective { yfov, .. } => self.distance = distance(bounds, &axes, *yfov, aspect),
        }
    }
}

/// The distance from its middle at which a box is seen whole along the axes' -z, in a picture of this vertical field of
/// view (radians) and aspect (width / height).
fn distance(bounds: &Bounds, axes: &Mat3, yfov: f32, aspect: f32) -> f32 {
    // From there the outmost corner is seen at the edge of the field of view, to the side or above.
    let [across, up] = [aspect, 1.0].map(|side| side * (0.5 * yfov).tan());
    let needed = corners(bounds, axes).map(|corner| corner.z + (corner.x.abs() / across).max(corner.y.abs() / up));
    MARGIN * needed.into_iter().fold(bounds.radius(), f32::max)
}

/// Half the height of a picture of this aspect that shows a box along the axes' -z without perspective, metres.
fn half_height(bounds: &Bounds, axes: &Mat3, aspect: f32) -> f32 {
    let needed = corners(bounds, axes).map(|corner| (corner.x.abs() / aspect).max(corner.y.abs()));
    MARGIN * needed.into_iter().fold(1e-3 * bounds.radius(), f32::max)
}

/// The corners of a box from its middle, in these axes.
fn corners(bounds: &Bounds, axes: &Mat3) -> [Vec3; 8] {
    bounds.corners().map(|corner| axes.transpose() * (corner - bounds.center()))
}

#[cfg(test)]
mod tests {
    use super::super::orbit::tests::{orbits, seen};
    use super::*;
    use glam::Vec2;
    use std::f32::consts::FRAC_PI_2;

    #[test]
    fn what_is_framed_fills_the_picture_and_is_within_it() {
        let bounds = Bounds { min: Vec3::new(3.0, -1.0, 2.0), max: Vec3::new(5.0, 0.5, 2.5) };
        for start in orbits() {
            for (azimuth, elevation, aspect) in [(0.0, 0.0, 1.6), (1.2, 0.4, 0.5), (0.3, 2.0, 1.0)] {
                let mut orbit = start;
                orbit.look_from(azimuth, elevation);
                orbit.frame(&bounds, aspect);
                let corners = bounds.corners().map(|corner| (seen(&orbit, corner) / Vec2::new(aspect, 1.0)).abs());
                let outmost = corners.iter().fold(0.0_f32, |most, corner| most.max(corner.max_element()));
                // Half a height is the picture's edge.
                assert!(outmost < 0.5 && outmost > 0.4, "{outmost}: {orbit:?}");
            }
        }
    }

    /// Along each axis and between them, from both sides.
    fn directions() -> impl Iterator<Item = [f32; 2]> {
        (-8..8).flat_map(|turn| [-9.0, -1.5, -0.7, 0.0, 0.7, 9.0].map(|up| [0.25 * FRAC_PI_2 * turn as f32, up]))
    }

    #[test]
    fn something_flat_is_framed_where_it_can_be_seen() {
        let middle = Vec3::new(0.3, -0.2, 0.5);
        for (start, axis) in orbits().into_iter().flat_map(|start| [0, 1, 2].map(|axis| (start, axis))) {
            let mut half = Vec3::new(1.0, 1.5, 2.0);
            half[axis] = 0.0;
            let bounds = Bounds { min: middle - half, max: middle + half };
            for [azimuth, elevation] in directions() {
                let mut orbit = start;
                orbit.look_from(azimuth, elevation);
                let before = orbit.axes().z_axis;
                orbit.frame(&bounds, 1.5);
                let after = orbit.axes().z_axis;
                let corners = bounds.corners().map(|corner| seen(&orbit, corner) / Vec2::new(1.5, 1.0));
                assert!(corners.iter().all(|corner| corner.abs().max_element() < 0.5), "{orbit:?}: {corners:?}");
                // Twice the area of the quadrilateral that is seen of it, in pictures.
                let [one, other] = [(axis + 1) % 3, (axis + 2) % 3];
                let diagonals = [corners[7] - corners[0], corners[1 << one] - corners[1 << other]];
                let area = diagonals[0].perp_dot(diagonals[1]).abs();
                assert!(area > 0.02, "{area}: {orbit:?}");
                // It is turned no farther than it takes, and to the nearer side.
                let turned = before.angle_between(after);
                let is_shallow = before[axis].abs() < 0.149;
                assert!(if is_shallow { turned < 0.165 } else { turned < 0.01 }, "by {turned} from {before}");
                assert!(before[axis].abs() < 1e-6 || before[axis] * after[axis] > 0.0);
            }
        }
    }

    #[test]
    fn what_has_no_extent_is_framed_and_leaves_the_view_sound() {
        for middle in [Vec3::ZERO, Vec3::new(3.0, -2.0, 1.0), Vec3::splat(1e10), Vec3::splat(1e-30)] {
            for half in [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, 1e-20 * Vec3::ONE] {
                let bounds = Bounds { min: middle - half, max: middle + half };
                for start in orbits() {
                    for [azimuth, elevation] in directions() {
                        let mut orbit = start;
                        orbit.look_from(azimuth, elevation);
                        let before = orbit.axes();
                        orbit.frame(&bounds, 1.5);
                        assert!(orbit.axes().abs_diff_eq(before, 1e-6), "{orbit:?}");
                        assert!(orbit.distance > 0.0 && orbit.camera().world_from_camera.is_finite(), "{orbit:?}");
                        let height = orbit.view_height(orbit.distance);
                        assert!(height > 0.0 && height.is_finite(), "{orbit:?}");
                        // The middle is in the middle, in front of the eye, as far as coordinates go there.
                        assert!(orbit.depth(middle) > 0.5 * orbit.distance, "{orbit:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn what_is_centred_comes_to_the_middle_and_no_farther_away() {
        for start in orbits() {
            let point = Vec3::new(1.2, 0.3, -1.8);
            for size in [0.1, 100.0] {
                let mut orbit = start;
                let bounds = Bounds { min: point - size, max: point + size };
                let height = orbit.view_height(orbit.depth(point));
                orbit.centre(point, &bounds, 1.5);
                assert!(seen(&orbit, point).length() < 1e-5);
                let after = orbit.view_height(orbit.depth(point));
                assert!(if size < 1.0 { after < 0.5 * height } else { (after / height - 1.0).abs() < 1e-4 }, "{after}");
            }
        }
    }
}
