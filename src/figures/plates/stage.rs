//! Where the sphere stands that the plates show: its camera and its window.

use glam::Vec3;

/// The window's distance from the sphere's middle, its half side, and its radiance; the sphere's radius is 1.
pub const DISTANCE: f32 = 4.0;
pub const HALF: f32 = 1.2;
pub const RADIANCE: f32 = 8.0;
/// The camera's distance, and its vertical field of view in radians.
pub const EYE: f32 = 6.0;
pub const YFOV: f32 = 0.4;

/// The window at an angle from the camera, which is at +z: its middle, and its two half sides. It is invisible, and
/// hides nothing.
pub fn window(angle: f32) -> [Vec3; 3] {
    let middle = DISTANCE * Vec3::new(angle.sin(), 0.0, angle.cos());
    let back = -middle.normalize();
    let right = Vec3::Y.cross(back).normalize();
    [middle, HALF * right, HALF * back.cross(right)]
}
