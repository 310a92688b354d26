//! Frames around the normal.

use glam::DVec3;

/// The frame of a direction: z stays, x lies along the direction's projection on the plane z = 0.
///
/// Where that projection vanishes (the direction is the z axis), x stays too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AzimuthFrame {
    cos: f64,
    sin: f64,
}

impl AzimuthFrame {
    /// The frame of `w`, whose length is near 1.
    #[inline]
    pub fn of(w: DVec3) -> Self {
        let across = (w.x * w.x + w.y * w.y).sqrt();
        if across > 0.0 { Self { cos: w.x / across, sin: w.y / across } } else { Self { cos: 1.0, sin: 0.0 } }
    }

    /// From outside into the frame.
    #[inline]
    pub fn local(&self, w: DVec3) -> DVec3 {
        DVec3::new(self.cos * w.x + self.sin * w.y, self.cos * w.y - self.sin * w.x, w.z)
    }

    /// From the frame to outside.
    #[inline]
    pub fn outside(&self, w: DVec3) -> DVec3 {
        DVec3::new(self.cos * w.x - self.sin * w.y, self.sin * w.x + self.cos * w.y, w.z)
    }
}
