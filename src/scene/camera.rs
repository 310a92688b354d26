use glam::Mat4;

/// A view: it looks along its own -z, with +y up.
#[derive(Clone, Debug)]
pub struct Camera {
    /// What users call it; may be empty.
    pub name: String,
    /// A rotation and a translation: no scale.
    pub world_from_camera: Mat4,
    /// How space is mapped to the picture.
    pub projection: Projection,
}

/// How a camera maps space to the picture. The vertical extent is kept whatever the picture's aspect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// From the camera's place, with a field of view.
    Perspective {
        /// Vertical field of view in radians, in (0, pi).
        yfov: f32,
        /// Nearest distance along the view that is shown, in metres, > 0.
        near: f32,
        /// Farthest distance along the view that is shown, in metres, > `near`; may be infinite.
        far: f32,
    },
    /// Along parallel rays.
    Orthographic {
        /// Half the height of the view in metres, > 0.
        ymag: f32,
        /// Nearest distance along the view that is shown, in metres, >= 0.
        near: f32,
        /// Farthest distance along the view that is shown, in metres, > `near`, finite.
        far: f32,
    },
}
