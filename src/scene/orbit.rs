//! A camera that circles a target: it is turned, panned and zoomed, and flown.

use std::f32::consts::{FRAC_PI_2, TAU};
use std::ops::RangeInclusive;

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
        let (axes, eye) = (self.axes(), self.eye());
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

    /// Looks around from where the eye is, by a drag of this many view heights. One view height is a quarter of a turn.
    pub fn look(&mut self, drag: Vec2) {
        let eye = self.eye();
        self.turn(0.5 * drag);
        self.put_eye(eye);
    }

    /// Looks from this azimuth and elevation, in radians, at the same target.
    pub fn look_from(&mut self, azimuth: f32, elevation: f32) {
        self.azimuth = azimuth;
        self.elevation = elevation.clamp(-Self::STEEPEST, Self::STEEPEST);
    }

    /// Moves such that what is `depth` metres in front of the eye follows a drag of this many view heights, to the right
    /// and down.
    pub fn pan(&mut self, drag: Vec2, depth: f32) {
        let axes = self.axes();
        let offset = self.view_height(depth) * (drag.y * axes.y_axis - drag.x * axes.x_axis);
        self.target = within_reach(self.target + offset);
    }

    /// Flies by so many metres to the right, up along y, and ahead.
    pub fn fly(&mut self, [right, up, ahead]: [f32; 3]) {
        let axes = self.axes();
        self.target = within_reach(self.target + right * axes.x_axis + up * Vec3::Y - ahead * axes.z_axis);
    }

    /// Goes nearer to `anchor` by this factor where it is above 1, or farther from it where it is below. Whatever lies in
    /// the anchor's direction stays where it is in the picture, and the target comes along: both views are similar about
    /// the anchor, so that zooming out by the same factor comes back.
    ///
    /// `range` is of what the view keeps between its eye and things, metres. Where the anchor is nearer than that, another
    /// one in its direction stands in for it, and the view goes on past it. Panics unless the factor is above 0.
    pub fn zoom(&mut self, anchor: Vec3, factor: f32, range: &RangeInclusive<f32>) {
        assert!(factor > 0.0, "a zoom factor is positive, not {factor}");
        let back = self.axes().z_axis.as_dvec3();
        let (target, eye) = (self.target.as_dvec3(), self.target.as_dvec3() + f64::from(self.distance) * back);
        let within = |size: f32| size.clamp(*range.start(), *range.end());
        match &mut self.projection {
            Projection::Orthographic { ymag, .. } => {
                let before = std::mem::replace(ymag, within(*ymag / factor));
                let offset = anchor.as_dvec3() - target;
                let across = offset - offset.dot(back) * back;
                self.target = (target + (1.0 - f64::from(*ymag / before)) * across).as_vec3();
            }
            Projection::Perspective { .. } => {
                let nearest = f64::from(*range.start());
                let offset = anchor.as_dvec3() - eye;
                // What is not in front of the eye leaves it going straight ahead.
                let offset = if offset.dot(back) < 0.0 { offset } else { -nearest * back };
                let depth = -offset.dot(back);
                let farthest = (depth / f64::from(*range.end())).min(1.0);
                let factor = if factor < 1.0 { f64::from(factor).max(farthest) } else { factor.into() };
                let stretch = depth.max(nearest) / depth;
                let eye = eye + (1.0 - factor.recip()) * stretch * offset;
                self.distance = within((f64::from(self.distance) / factor) as f32);
                self.target = (eye - f64::from(self.distance) * back).as_vec3();
            }
        }
        self.target = within_reach(self.target);
    }

    /// How far in front of the eye a point is, along the view, metres.
    pub fn depth(&self, point: Vec3) -> f32 {
        (self.eye() - point).dot(self.axes().z_axis)
    }

    fn eye(&self) -> Vec3 {
        self.target + self.distance * self.axes().z_axis
    }

    fn put_eye(&mut self, eye: Vec3) {
        self.target = within_reach(eye - self.distance * self.axes().z_axis);
    }

    /// Sets the distances between which the view shows something, metres.
    pub(super) fn set_planes(&mut self, nearest: f32, farthest: f32) {
        let (Projection::Perspective { near, far, .. } | Projection::Orthographic { near, far, .. }) =
            &mut self.projection;
        (*near, *far) = (nearest, farthest);
    }

    /// Metres that the view shows vertically this far in front of the eye.
    pub(super) fn view_height(&self, depth: f32) -> f32 {
        match self.projection {
            Projection::Perspective { yfov, .. } => 2.0 * depth * (0.5 * yfov).tan(),
            Projection::Orthographic { ymag, .. } => 2.0 * ymag,
        }
    }

    /// Right, up, and towards the eye.
    pub(super) fn axes(&self) -> Mat3 {
        Mat3::from_rotation_y(self.azimuth) * Mat3::from_rotation_x(-self.elevation)
    }
}

pub(super) fn within_reach(point: Vec3) -> Vec3 {
    point.clamp(Vec3::splat(-FARTHEST), Vec3::splat(FARTHEST))
}

#[cfg(test)]
pub(super) mod tests {
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

    pub fn orbits() -> [Orbit; 2] {
        let start = Orbit::new(&camera(), Vec3::new(1.0, 0.5, -2.0));
        [start, Orbit { projection: Projection::Orthographic { ymag: 1.5, near: 0.1, far: 50.0 }, ..start }]
    }

    /// Where a point lies in the picture, in view heights from its middle: right and up are positive.
    pub fn seen(orbit: &Orbit, point: Vec3) -> Vec2 {
        let camera = orbit.camera();
        let p_camera = camera.world_from_camera.as_dmat4().inverse().transform_point3(point.as_dvec3());
        let height = match camera.projection {
            Projection::Perspective { yfov, .. } => -2.0 * p_camera.z * (0.5 * f64::from(yfov)).tan(),
            Projection::Orthographic { ymag, .. } => 2.0 * f64::from(ymag),
        };
        (p_camera.truncate() / height).as_vec2()
    }

    #[test]
    fn what_is_dragged_stays_under_the_pointer() {
        for mut orbit in orbits() {
            for point in [orbit.target, Vec3::new(0.7, 0.9, -1.2)] {
                let before = seen(&orbit, point);
                orbit.pan(Vec2::new(0.25, -0.1), orbit.depth(point));
                let moved = seen(&orbit, point) - before;
                assert!(moved.abs_diff_eq(Vec2::new(0.25, 0.1), 1e-5), "{moved}");
            }
        }
    }

    const RANGE: RangeInclusive<f32> = 1e-4..=1e4;
    /// Points that a pointer may be on: in front of the target and behind it, beside it and far from it.
    const ANCHORS: [Vec3; 4] =
        [Vec3::new(1.1, 0.4, -1.0), Vec3::new(0.4, 0.2, -3.5), Vec3::new(1.6, 0.9, -2.0), Vec3::new(-4.0, -2.0, -9.0)];

    /// A pixel of a picture of 1000 rows, in view heights, is 1e-3.
    #[test]
    fn what_is_zoomed_to_stays_under_the_pointer() {
        for start in orbits() {
            for anchor in ANCHORS {
                let before = seen(&start, anchor);
                for factor in [1.25_f32, 0.8] {
                    let mut orbit = start;
                    for notch in 0..16 {
                        orbit.zoom(anchor, factor, &RANGE);
                        let moved = seen(&orbit, anchor).distance(before);
                        assert!(moved < 2e-4, "{moved} after {notch} of {factor} to {anchor}");
                    }
                    assert!(orbit.target.is_finite());
                    (0..16).for_each(|_| orbit.zoom(anchor, factor.recip(), &RANGE));
                    let (after, back) = (orbit.camera(), start.camera());
                    let moved = after.world_from_camera.w_axis.distance(back.world_from_camera.w_axis);
                    assert!(moved < 1e-4 && orbit.target.distance(start.target) < 1e-4, "{moved}");
                    assert!((orbit.distance / start.distance - 1.0).abs() < 1e-4);
                }
            }
        }
    }

    #[test]
    fn zooming_in_is_never_stuck_and_zooming_out_ends() {
        let [start, orthographic] = orbits();
        for anchor in ANCHORS {
            let mut orbit = start;
            let eye = |orbit: &Orbit| orbit.camera().world_from_camera.w_axis.truncate();
            let direction = (anchor - eye(&orbit)).normalize();
            for notch in 0..200 {
                let before = eye(&orbit);
                // As the pointer does: once it has gone past the anchor, it is on something else in the same direction.
                let ahead = if orbit.depth(anchor) > 1e-4 { anchor } else { before + 1e-4 * direction };
                orbit.zoom(ahead, 1.25, &RANGE);
                assert!((eye(&orbit) - before).dot(direction) > 1e-6, "{notch} to {anchor}");
            }
            assert!(eye(&orbit).distance(anchor) < 0.01 && orbit.distance >= 1e-4);
            for _ in 0..400 {
                let is_ahead = orbit.depth(anchor) > 1e-4;
                let ahead = if is_ahead { anchor } else { eye(&orbit) + orbit.distance * direction };
                orbit.zoom(ahead, 0.8, &RANGE);
            }
            assert!(orbit.depth(anchor) < 2e4 && orbit.depth(anchor) > 5e3, "{}", orbit.depth(anchor));
        }
        let mut orbit = orthographic;
        (0..200).for_each(|_| orbit.zoom(ANCHORS[0], 1.25, &RANGE));
        assert!(matches!(orbit.projection, Projection::Orthographic { ymag: 1e-4, .. }));
        assert!(seen(&orbit, ANCHORS[0]).is_finite());
    }

    #[test]
    fn looking_around_leaves_the_eye_and_turns_towards_the_pointer() {
        let start = orbits()[0];
        let mut orbit = start;
        orbit.look(Vec2::new(0.1, 0.05));
        assert!(orbit.eye().distance(start.eye()) < 1e-5);
        // What was in the middle is now left of it and above.
        let moved = seen(&orbit, start.target);
        assert!(moved.x < -0.05 && moved.y > 0.05, "{moved}");
    }

    #[test]
    fn flying_goes_where_the_view_looks() {
        let start = orbits()[0];
        let flown = |step| {
            let mut orbit = start;
            orbit.fly(step);
            orbit.eye() - start.eye()
        };
        let ahead = (start.target - start.eye()).normalize();
        assert!(flown([0.0, 0.0, 2.0]).abs_diff_eq(2.0 * ahead, 1e-5));
        assert!(flown([0.0, 2.0, 0.0]).abs_diff_eq(2.0 * Vec3::Y, 1e-5));
        assert!(flown([2.0, 0.0, 0.0]).abs_diff_eq(2.0 * ahead.cross(Vec3::Y).normalize(), 1e-5));
    }
}
