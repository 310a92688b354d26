use glam::Mat4;

/// A view: looks along its own -z with +y up.
#[derive(Clone, Debug)]
pub struct Camera {
    pub name: String,
    /// A rotation and a translation: no scale.
    pub world_from_camera: Mat4,
    pub projection: Projection,
}

/// How a camera maps space to the picture. The vertical extent is kept whatever the picture's aspect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Vertical field of view in radians, in (0, pi); near > 0 and far > near (or infinite) in metres.
    Perspective { yfov: f32, near: f32, far: f32 },
    /// Half the height of the view in metres, > 0; 0 <= near < far in metres.
    Orthographic { ymag: f32, near: f32, far: f32 },
}
