//! Where points of the world are in the picture.

use egui::{Pos2, Rect, pos2};
use glam::{DMat4, DVec3, Vec2, Vec3};

use super::pick::Ray;
use crate::scene::{Camera, Projection};

/// A camera and where its picture is, in points.
pub struct Lens {
    camera: Camera,
    camera_from_world: DMat4,
    picture: Rect,
}

/// What is nearer to the eye's plane than this share of what it is away from is not shown.
const NEAREST: f64 = 1e-3;

impl Lens {
    pub fn new(camera: Camera, picture: Rect) -> Self {
        let camera_from_world = camera.world_from_camera.as_dmat4().inverse();
        Self { camera, camera_from_world, picture }
    }

    /// The ray through a point of the picture.
    pub fn ray(&self, at: Pos2) -> Ray {
        let share = (at - self.picture.min) / self.picture.size();
        Ray::new(&self.camera, self.picture.aspect_ratio(), Vec2::new(share.x, share.y))
    }

    /// To the right, upwards, and towards the eye, unit.
    pub fn axes(&self) -> [Vec3; 3] {
        let world_from_camera = self.camera.world_from_camera;
        [world_from_camera.x_axis, world_from_camera.y_axis, world_from_camera.z_axis]
            .map(|axis| axis.truncate().normalize())
    }

    /// Towards the eye from a point, unit.
    pub fn to_eye(&self, point: Vec3) -> Vec3 {
        match self.camera.projection {
            Projection::Perspective { .. } => {
                (self.camera.world_from_camera.w_axis.truncate() - point).normalize_or(self.axes()[2])
            }
            Projection::Orthographic { .. } => self.axes()[2],
        }
    }

    /// Where a point is seen; none where it is behind the eye.
    pub fn project(&self, point: Vec3) -> Option<Pos2> {
        let point = self.in_camera(point);
        (point.z < -NEAREST * point.length() || !self.is_perspective()).then(|| self.place(point))
    }

    /// Where the part of a line that is before the eye is seen.
    pub fn segment(&self, ends: [Vec3; 2]) -> Option<[Pos2; 2]> {
        let mut ends = ends.map(|end| self.in_camera(end));
        if self.is_perspective() {
            let near = -NEAREST * ends[0].distance(ends[1]).max(f64::MIN_POSITIVE);
            let depths = ends.map(|end| end.z - near);
            if depths.iter().all(|depth| *depth >= 0.0) {
                return None;
            }
            let share = depths[0] / (depths[0] - depths[1]);
            let crossing = ends[0] + share * (ends[1] - ends[0]);
            (0..2).filter(|&end| depths[end] > 0.0).for_each(|end| ends[end] = crossing);
        }
        Some(ends.map(|end| self.place(end)))
    }

    /// How long a point of the screen is at a point of the world, metres.
    pub fn metres_a_point(&self, at: Vec3) -> f32 {
        let half_height = match self.camera.projection {
            Projection::Perspective { yfov, .. } => {
                let depth = self.in_camera(at).z.abs().max(f64::from(f32::MIN_POSITIVE)) as f32;
                depth * (0.5 * yfov).tan()
            }
            Projection::Orthographic { ymag, .. } => ymag,
        };
        2.0 * half_height / self.height()
    }

    /// Of the picture, in points, > 0.
    pub fn height(&self) -> f32 {
        self.picture.height().max(1.0)
    }

    fn is_perspective(&self) -> bool {
        matches!(self.camera.projection, Projection::Perspective { .. })
    }

    fn in_camera(&self, point: Vec3) -> DVec3 {
        self.camera_from_world.transform_point3(point.as_dvec3())
    }

    fn place(&self, point: DVec3) -> Pos2 {
        let half_height = match self.camera.projection {
            Projection::Perspective { yfov, .. } => -point.z * (0.5 * f64::from(yfov)).tan(),
            Projection::Orthographic { ymag, .. } => f64::from(ymag),
        };
        let scale = 0.5 * f64::from(self.picture.height()) / half_height;
        let center = self.picture.center();
        // What is very far beside is as far beside as a screen can tell.
        let far = |number: f64| number.clamp(-1e6, 1e6) as f32;
        pos2(center.x + far(scale * point.x), center.y - far(scale * point.y))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Mat4;

    fn lens(projection: Projection) -> Lens {
        let world_from_camera = Mat4::from_translation(Vec3::new(0.3, -0.2, 5.0)) * Mat4::from_rotation_y(0.4);
        let picture = Rect::from_min_size(pos2(10.0, 20.0), egui::vec2(300.0, 200.0));
        Lens::new(Camera { name: String::new(), world_from_camera, projection }, picture)
    }

    const PERSPECTIVE: Projection = Projection::Perspective { yfov: 0.8, near: 0.1, far: 100.0 };
    const ORTHOGRAPHIC: Projection = Projection::Orthographic { ymag: 2.0, near: 0.1, far: 100.0 };

    #[test]
    fn rays_go_where_their_points_are_seen() {
        for projection in [PERSPECTIVE, ORTHOGRAPHIC] {
            let lens = lens(projection);
            for at in [pos2(10.0, 20.0), pos2(160.0, 120.0), pos2(290.0, 35.0)] {
                let ray = lens.ray(at);
                for depth in [0.5, 4.0] {
                    let seen = lens.project(ray.at(depth)).unwrap();
                    assert!(seen.distance(at) < 1e-2, "{projection:?}: {seen} {at}");
                }
            }
            let point = lens.ray(pos2(100.0, 60.0)).at(3.0);
            let beside = lens.project(point + lens.metres_a_point(point) * lens.axes()[0]).unwrap();
            assert!((beside - lens.project(point).unwrap() - egui::vec2(1.0, 0.0)).length() < 1e-2);
        }
    }

    #[test]
    fn lines_are_shown_as_far_as_they_are_before_the_eye() {
        let lens = lens(PERSPECTIVE);
        let [ahead, behind] = [2.0, -2.0].map(|depth| lens.ray(pos2(200.0, 100.0)).at(depth));
        assert!(lens.project(behind).is_none() && lens.segment([behind, behind + 0.1 * lens.axes()[0]]).is_none());
        let line = lens.segment([ahead, behind]).unwrap();
        assert!(line[0].distance(pos2(200.0, 100.0)) < 1e-2 && line[1].is_finite());
        let both = lens.segment([ahead, ahead + lens.axes()[1]]).unwrap();
        assert!(both[1].distance(lens.project(ahead + lens.axes()[1]).unwrap()) < 1e-3);
    }
}
