//! Rays through the pixels.

use glam::{DMat4, DVec3};

use crate::bvh::Ray;
use crate::scene::{Camera, Projection};

/// A camera and its picture's size.
pub(super) struct View {
    world_from_camera: DMat4,
    projection: Projection,
    size: [f64; 2],
}

impl View {
    pub fn new(camera: &Camera, size: [u32; 2]) -> Self {
        let world_from_camera = camera.world_from_camera.as_dmat4();
        Self { world_from_camera, projection: camera.projection, size: size.map(f64::from) }
    }

    /// The ray through a point of the picture, in pixels from its upper left corner, and the distances along it between
    /// which surfaces are seen.
    pub fn ray(&self, [x, y]: [f64; 2]) -> (Ray, [f64; 2]) {
        let [width, height] = self.size;
        let (right, up) = ((2.0 * x - width) / height, 1.0 - 2.0 * y / height);
        let (origin, direction, depths) = match self.projection {
            Projection::Perspective { yfov, near, far } => {
                let extent = (0.5 * f64::from(yfov)).tan();
                (DVec3::ZERO, DVec3::new(right * extent, up * extent, -1.0), [near, far])
            }
            Projection::Orthographic { ymag, near, far } => {
                let extent = f64::from(ymag);
                (DVec3::new(right * extent, up * extent, 0.0), DVec3::NEG_Z, [near, far])
            }
        };
        // The direction reaches one unit of depth, so depths times its length are distances.
        let length = direction.length();
        let ray = Ray {
            origin: self.world_from_camera.transform_point3(origin),
            direction: self.world_from_camera.transform_vector3(direction).normalize(),
        };
        (ray, depths.map(|depth| f64::from(depth) * length))
    }
}
