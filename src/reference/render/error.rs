//! Why a reference picture cannot be made.

/// A reference picture could not be made.
#[derive(Debug, thiserror::Error)]
pub enum ReferenceError {
    /// More triangles than the hierarchy holds.
    #[error(
        "the scene's instances have {triangles} triangles in all, past the {most} that the reference holds: draw fewer instances"
    )]
    Triangles {
        /// Of all instances that are drawn.
        triangles: usize,
        /// That the hierarchy holds.
        most: usize,
    },
    /// More pixels than the film holds.
    #[error("a picture of {}x{} pixels is past what the reference holds: use at most {most} pixels", size[0], size[1])]
    Size {
        /// Width and height that were asked for, in pixels.
        size: [u32; 2],
        /// Pixels that the film holds.
        most: u64,
    },
}
