//! What a cell of a table stands for: a clamped cosine, linearly transformed.

use crate::math::warp::cosine_hemisphere;
use glam::DVec3;
use std::f64::consts::PI;

/// The inverse matrix (a, 0, b), (0, c, 0), (0, 0, 1), by rows. The diffuse lobe's is the identity, the sheen's has c = a.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ltc {
    /// Scale along x, >= 0; the lobe of a = 0, which tables may hold, is none.
    pub a: f64,
    /// Shear along x, of either sign.
    pub b: f64,
    /// Scale along y, >= 0.
    pub c: f64,
}

impl Ltc {
    /// The clamped cosine itself: the identity matrix.
    pub const COSINE: Self = Self { a: 1.0, b: 0.0, c: 1.0 };

    /// The sheen's matrix, of the table's columns a and b: c = a.
    pub const fn sheen(a: f64, b: f64) -> Self {
        Self { a, b, c: a }
    }

    /// The transformed cosine's density at the unit vector `wo`, per steradian: its integral over the upper hemisphere is 1.
    ///
    /// D(v) |det M^-1| / |v|^3 with v = M^-1 wo and D the cosine's density z/pi on the unit sphere, thus
    /// a c z / (pi |v|^4).
    #[inline]
    pub fn density(&self, wo: DVec3) -> f64 {
        let (x, y, z) = (self.a * wo.x + self.b * wo.z, self.c * wo.y, wo.z);
        let square = x * x + y * y + z * z;
        self.a * self.c * z.max(0.0) / (PI * square * square)
    }

    /// A direction of that density from two uniform numbers in \[0, 1): a sample of the cosine, taken where
    /// [`Self::direction`] takes it. Panics unless `a` and `c` are above 0.
    pub fn sample(&self, uniforms: [f64; 2]) -> DVec3 {
        let Self { a, c, .. } = *self;
        assert!(a > 0.0 && c > 0.0, "a singular matrix has no samples: a = {a}, c = {c}");
        self.direction(cosine_hemisphere(uniforms))
    }

    /// Where the transform takes a unit direction of the cosine: by the matrix with the rows (1/a, 0, -b/a), (0, 1/c,
    /// 0), (0, 0, 1), normalised. `a` and `c` are above 0.
    pub fn direction(&self, cosine: DVec3) -> DVec3 {
        let Self { a, b, c } = *self;
        DVec3::new(cosine.x - b * cosine.z, a / c * cosine.y, a * cosine.z).normalize()
    }
}
