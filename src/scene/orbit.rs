//! A camera that circles a target: it is turned, panned and zoomed.

use std::f32::consts::{FRAC_PI_2, TAU};

use glam::{Mat3, Mat4, Vec2, Vec3};

use super::{Camera, FARTHEST, Projection};

/// A view that circles a target; y is up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    /// What the view is centred on, metres.
    pub target: Vec3,
    /// Azimuth of the eye around +y, radians; 0 is towards +z.
    pub azimuth: f32,
    /// Elevation of the eye above the horizontal plane, radians, short of straight up and down.
    pub elevation: f32,
    /// From the target to the eye, metres, > 0.
    pub distance: f32,
    /// How space is mapped to the picture; of a perspective one, the near and far planes follow the distance.
    pub projection: Projection,
}

impl Orbit {
    /// The greatest elevation in radians, a little short of straight up and down, where the azimuth would lose its
    /// meaning.
    pub const STEEPEST: f32 = FRAC_PI_2 - 0.01;

    /// Starts at the camera; the target is the point on its axis that is nearest to `center`. A camera's roll is lost.
    pub fn new(camera: &Camera, center: Vec3) -> Self {
        let eye = camera.world_from_camera.w_axis.truncate();
        let back = camera.world_from_camera.z_axis.truncate();
        let distance = (eye - center).dot(back);
        // A camera that looks away from the scene turns around a point in front of it.
        let distance = if distance > 0.0 { distance } else { eye.distance(center).max(1e-3) };
        let elevation = back.y.clamp(-1.0, 1.0).asin().clamp(-Self::STEEPEST, Self::STEEPEST);
        Self {
            target: eye - distance * back,
            azimuth: back.x.atan2(back.z),
            elevation,
            distance,
            projection: camera.projection,
        }
    }

    /// The camera in its present place.
    pub fn camera(&self) -> Camera {
        let axes = self.axes();
        let eye = self.target + self.distance * axes.z_axis;
        let projection = match self.projection {
            // The near plane must not reach the target; depth is precise even without a far plane.
            Projection::Perspective { yfov, near, .. } => {
                Projection::Perspective { yfov, near: near.min(0.01 * self.distance), far: f32::INFINITY }
            }
            orthographic => orthographic,
        };
        let world_from_camera =
            Mat4::from_cols(axes.x_axis.extend(0.0), axes.y_axis.extend(0.0), axes.z_axis.extend(0.0), eye.extend(1.0));
        Camera { name: "orbit".to_owned(), world_from_camera, projection }
    }

    /// Turns by a drag of this many view heights, to the right and down. One view height is half a turn.
    pub fn turn(&mut self, drag: Vec2) {
        self.azimuth = (self.azimuth - drag.x * 0.5 * TAU).rem_euclid(TAU);
        self.elevation = (self.elevation + drag.y * 0.5 * TAU).clamp(-Self::STEEPEST, Self::STEEPEST);
    }

    /// Moves such that the target follows a drag of this many view heights, to the right and down.
    pub fn pan(&mut self, drag: Vec2) {
        let axes = self.axes();
        let target = self.target + self.view_height() * (drag.y * axes.y_axis - drag.x * axes.x_axis);
        self.target = target.clamp(Vec3::splat(-FARTHEST), Vec3::splat(FARTHEST));
    }

    /// Goes nearer by this factor where it is above 1, or farther where it is below. Panics unless it is above 0.
    pub fn zoom(&mut self, factor: f32) {
        assert!(factor > 0.0, "a zoom factor is positive, not {factor}");
        let size = match &mut self.projection {
            Projection::Orthographic { ymag, .. } => ymag,
            Projection::Perspective { .. } => &mut self.distance,
        };
        // Limits within which floats still serve, for scenes of any size.
        *size = (*size / factor).clamp(1e-9, FARTHEST);
    }

    /// Sets the distances between which the view shows something, metres.
    pub(super) fn set_planes(&mut self, nearest: f32, farthest: f32) {
        let (Projection::Perspective { near, far, .. } | Projection::Orthographic { near, far, .. }) =
            &mut self.projection;
        (*near, *far) = (nearest, farthest);
    }

    /// Metres that the view shows vertically at the target.
    fn view_height(&self) -> f32 {
        match self.projection {
            Projection::Perspective { yfov, .. } => 2.0 * self.distance * (0.5 * yfov).tan(),
            Projection::Orthographic { ymag, .. } => 2.0 * ymag,
        }
    }

    /// Right, up, and towards the eye.
    fn axes(&self) -> Mat3 {
        Mat3::from_rotation_y(self.azimuth) * Mat3::from_rotation_x(-self.elevation)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        let axes = Mat3::from_rotation_y(0.7) * Mat3::from_rotation_x(-0.4);
        let world_from_camera = Mat4::from_mat3(axes);
        let eye = Vec3::new(1.0, 0.5, -2.0) + 3.0 * axes.z_axis;
        Camera {
            name: "camera".to_owned(),
            world_from_camera: Mat4::from_translation(eye) * world_from_camera,
            projection: Projection::Perspective { yfov: 0.6, near: 0.001, far: f32::INFINITY },
        }
    }

    #[test]
    fn starts_where_the_camera_stands() {
        let camera = camera();
        let orbit = Orbit::new(&camera, Vec3::new(1.0, 0.5, -2.0));
        assert!(orbit.camera().world_from_camera.abs_diff_eq(camera.world_from_camera, 1e-5));
        assert!((orbit.distance - 3.0).abs() < 1e-5);
    }

    #[test]
    fn a_whole_turn_comes_back_and_the_poles_are_not_passed() {
        let start = Orbit::new(&camera(), Vec3::new(1.0, 0.5, -2.0));
        let mut orbit = start;
        (0..20).for_each(|_| orbit.turn(Vec2::new(0.1, 0.0)));
        assert!(orbit.camera().world_from_camera.abs_diff_eq(start.camera().world_from_camera, 1e-4));
        orbit.turn(Vec2::new(0.0, 50.0));
        assert!(orbit.camera().world_from_camera.y_axis.y > 0.0);
        assert!(orbit.camera().world_from_camera.is_finite());
    }

    #[test]
    fn what_is_dragged_stays_under_the_pointer() {
        let mut orbit = Orbit::new(&camera(), Vec3::new(1.0, 0.5, -2.0));
        let target = orbit.target;
        orbit.pan(Vec2::new(0.25, -0.1));
        let p_camera = orbit.camera().world_from_camera.inverse().transform_point3(target);
        // Heights of the view at the target's distance, from its middle: right and up are positive.
        let height = orbit.view_height();
        assert!((p_camera.x / height - 0.25).abs() < 1e-5 && (p_camera.y / height - 0.1).abs() < 1e-5, "{p_camera}");
    }

    #[test]
    fn zooming_in_and_out_comes_back() {
        let start = Orbit::new(&camera(), Vec3::ZERO);
        let mut orbit = start;
        orbit.zoom(1.25);
        assert!(orbit.distance < start.distance);
        orbit.zoom(1.0 / 1.25);
        assert!((orbit.distance - start.distance).abs() < 1e-5);
    }
}
