//! A fibre, and where a ray meets it.

use glam::DVec3;

/// A circular cylinder without its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fibre {
    /// The middle of its axis.
    pub middle: DVec3,
    /// Unit vector.
    pub axis: DVec3,
    /// Half of its length, along the axis.
    pub half_length: f64,
}

/// A ray's meeting with a fibre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// From the ray's origin, in lengths of its direction.
    pub distance: f64,
    /// Unit vector out of the fibre.
    pub normal: DVec3,
}

impl Hit {
    /// The direction in which a mirror there sends light that goes along `direction`, a unit vector.
    pub fn mirrored(&self, direction: DVec3) -> DVec3 {
        (direction - 2.0 * direction.dot(self.normal) * self.normal).normalize()
    }
}

impl Fibre {
    /// The distance at which a ray from `origin` along the unit vector `direction` enters the cylinder of `radius` by
    /// its side, ahead of the origin.
    ///
    /// From within, nothing is met: sides are seen only from outside, and ends are open. Accurate to about 1e-13 of the
    /// distance to the fibre's middle or of the radius, whichever is larger: the ray's offset from the axis is formed
    /// as a vector, not as a difference of squares (Haines et al. 2019). A ray that a fibre has just mirrored moves
    /// away from its axis and does not meet that fibre again.
    pub fn enter(&self, radius: f64, origin: DVec3, direction: DVec3) -> Option<f64> {
        let from_middle = origin - self.middle;
        let (along, height) = (direction.dot(self.axis), from_middle.dot(self.axis));
        let (across, off) = (direction - along * self.axis, from_middle - height * self.axis);
        let approach = off.dot(across);
        if approach >= 0.0 {
            return None;
        }
        let square = across.length_squared();
        let nearest = -approach / square;
        let inside = radius * radius - (off + nearest * across).length_squared();
        if inside <= 0.0 {
            return None;
        }
        let distance = nearest - (inside / square).sqrt();
        (distance > 0.0 && (height + distance * along).abs() <= self.half_length).then_some(distance)
    }

    /// The unit vector out of the fibre at a point of its side.
    pub fn normal(&self, point: DVec3) -> DVec3 {
        let off = point - self.middle;
        (off - off.dot(self.axis) * self.axis).normalize()
    }

    /// Corners of the axis-aligned box around the part of the fibre of `radius` between two heights along its axis,
    /// ends included.
    pub fn bounds(&self, radius: f64, [low, high]: [f64; 2]) -> [DVec3; 2] {
        let [one, other] = [low, high].map(|height| self.middle + height * self.axis);
        // How far a disc across the axis reaches along x, y, z.
        let reach = radius * (DVec3::ONE - self.axis * self.axis).max(DVec3::ZERO).map(f64::sqrt);
        [one.min(other) - reach, one.max(other) + reach]
    }
}
