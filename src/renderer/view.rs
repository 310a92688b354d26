//! From a camera and a picture's size to what the vertex shader needs.

use glam::{DMat4, DVec3, DVec4, Mat4, Vec3, Vec4};

use crate::scene::{Camera, Projection};

/// A rectangle of pixels, from the picture's upper left corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rect {
    /// Columns left of it.
    pub x: u32,
    /// Rows above it.
    pub y: u32,
    /// Columns in it.
    pub width: u32,
    /// Rows in it.
    pub height: u32,
}

impl Rect {
    /// The whole of a picture.
    pub fn full([width, height]: [u32; 2]) -> Self {
        Self { x: 0, y: 0, width, height }
    }

    /// Covers a picture with tiles of at most `side` x `side` pixels, row by row. Panics where `side` is 0.
    pub fn tiles(size: [u32; 2], side: u32) -> impl Iterator<Item = Self> {
        assert!(side > 0, "a tile's side is positive, not {side}");
        (0..size[1]).step_by(side as usize).flat_map(move |y| {
            (0..size[0]).step_by(side as usize).map(move |x| Self {
                x,
                y,
                width: side.min(size[0] - x),
                height: side.min(size[1] - y),
            })
        })
    }
}

/// What the vertex shader needs of a camera.
///
/// Clip space has depth 1 at the near plane and 0 at the far one ("reversed"), which spreads the precision of a
/// floating-point depth evenly over the distance.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// From world to clip space, for the tile.
    pub clip_from_world: Mat4,
    /// The eye's place (w = 1) or, for an orthographic view, the direction towards it (w = 0); in world space.
    pub eye: Vec4,
    /// The camera's place in world space.
    pub origin: Vec3,
}

impl View {
    /// The same moved by a part of a pixel: what lies that far to the right of a pixel's centre, and below it, of `size` pixels in
    /// all, comes to lie there.
    pub fn shifted(self, [right, down]: [f32; 2], [width, height]: [u32; 2]) -> Self {
        let shift = DMat4::from_translation(DVec3::new(
            -2.0 * f64::from(right) / f64::from(width),
            2.0 * f64::from(down) / f64::from(height),
            0.0,
        ));
        Self { clip_from_world: (shift * self.clip_from_world.as_dmat4()).as_mat4(), ..self }
    }

    /// What the camera sees in the `tile` of a picture of `size` pixels.
    pub fn new(camera: &Camera, size: [u32; 2], tile: Rect) -> Self {
        let [width, height] = size.map(f64::from);
        let world_from_camera = camera.world_from_camera.as_dmat4();
        let clip_from_camera = clip_from_camera(camera.projection, width / height);
        let clip_from_world = tile_from_clip([width, height], tile) * clip_from_camera * world_from_camera.inverse();
        let eye = match camera.projection {
            Projection::Perspective { .. } => world_from_camera.w_axis,
            Projection::Orthographic { .. } => world_from_camera.z_axis,
        };
        let origin = world_from_camera.w_axis.truncate().as_vec3();
        Self { clip_from_world: clip_from_world.as_mat4(), eye: eye.as_vec4(), origin }
    }
}

/// The projection alone; `aspect` = width / height.
fn clip_from_camera(projection: Projection, aspect: f64) -> DMat4 {
    let scale = |y: f64, depth: [DVec4; 2]| DMat4::from_cols(DVec4::X * (y / aspect), DVec4::Y * y, depth[0], depth[1]);
    match projection {
        Projection::Perspective { yfov, near, far } => {
            let (near, far) = (f64::from(near), f64::from(far));
            // As far grows, the first tends to 0 and the second to near.
            let (a, b) = if far.is_finite() { (near / (far - near), near * far / (far - near)) } else { (0.0, near) };
            scale(1.0 / (0.5 * f64::from(yfov)).tan(), [DVec4::new(0.0, 0.0, a, -1.0), DVec4::Z * b])
        }
        Projection::Orthographic { ymag, near, far } => {
            let (near, far) = (f64::from(near), f64::from(far));
            let range = far - near;
            scale(1.0 / f64::from(ymag), [DVec4::Z / range, DVec4::new(0.0, 0.0, far / range, 1.0)])
        }
    }
}

/// Scales and shifts clip space such that the tile fills it.
fn tile_from_clip([width, height]: [f64; 2], tile: Rect) -> DMat4 {
    let [x, y, w, h] = [tile.x, tile.y, tile.width, tile.height].map(f64::from);
    DMat4::from_cols(
        DVec4::X * (width / w),
        DVec4::Y * (height / h),
        DVec4::Z,
        DVec4::new((width - 2.0 * x - w) / w, (h - height + 2.0 * y) / h, 0.0, 1.0),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec4Swizzles;

    fn camera(projection: Projection) -> Camera {
        let turned = Mat4::from_rotation_translation(glam::Quat::from_rotation_y(0.3), Vec3::new(1.0, 2.0, 3.0));
        Camera { name: "camera".into(), world_from_camera: turned, projection }
    }

    fn depth(view: &View, camera: &Camera, distance: f32) -> f32 {
        let p_world = camera.world_from_camera * Vec4::new(0.0, 0.0, -distance, 1.0);
        let clip = view.clip_from_world * p_world;
        clip.z / clip.w
    }

    #[test]
    fn depth_runs_from_one_to_zero() {
        let size = [200, 100];
        for (projection, last) in [
            (Projection::Perspective { yfov: 0.7, near: 0.5, far: 20.0 }, 20.0),
            (Projection::Perspective { yfov: 0.7, near: 0.5, far: f32::INFINITY }, 1e9),
            (Projection::Orthographic { ymag: 2.0, near: 0.5, far: 20.0 }, 20.0),
        ] {
            let camera = camera(projection);
            let view = View::new(&camera, size, Rect::full(size));
            assert!((depth(&view, &camera, 0.5) - 1.0).abs() < 1e-5, "{projection:?}");
            assert!(depth(&view, &camera, last).abs() < 1e-5, "{projection:?}");
        }
    }

    #[test]
    fn the_vertical_extent_is_the_cameras() {
        let camera = camera(Projection::Perspective { yfov: 0.7, near: 0.1, far: 10.0 });
        for size in [[200, 100], [100, 200]] {
            let view = View::new(&camera, size, Rect::full(size));
            let top = camera.world_from_camera * Vec4::new(0.0, (0.35_f32).tan(), -1.0, 1.0);
            let clip = view.clip_from_world * top;
            assert!((clip.y / clip.w - 1.0).abs() < 1e-5);
        }
    }

    #[test]
    fn tiles_cover_the_picture_once_and_see_what_the_whole_sees() {
        let size = [130, 70];
        let tiles: Vec<Rect> = Rect::tiles(size, 64).collect();
        assert_eq!(tiles.iter().map(|tile| tile.width * tile.height).sum::<u32>(), 130 * 70);
        let camera = camera(Projection::Perspective { yfov: 0.7, near: 0.1, far: 10.0 });
        let pixel = |view: &View, rect: Rect, p_world: Vec4| {
            let clip = view.clip_from_world * p_world;
            let ndc = clip.xy() / clip.w;
            let size = glam::Vec2::new(rect.width as f32, rect.height as f32);
            (ndc * glam::Vec2::new(0.5, -0.5) + 0.5) * size + glam::Vec2::new(rect.x as f32, rect.y as f32)
        };
        let p_world = camera.world_from_camera * Vec4::new(0.21, -0.13, -2.0, 1.0);
        let whole = Rect::full(size);
        let expected = pixel(&View::new(&camera, size, whole), whole, p_world);
        for tile in tiles {
            let found = pixel(&View::new(&camera, size, tile), tile, p_world);
            assert!(found.distance(expected) < 1e-3, "{tile:?}: {found} {expected}");
        }
    }
}
