use glam::{Mat4, Vec3};

/// Metres from the origin within which things must stand: farther than the Moon, and near enough for the cube of any
/// distance, with lights set up around the things, to fit in 32-bit floats.
pub const FARTHEST: f32 = 1e10;

/// The thickness of a flat box, of its longest side.
const FLAT: f32 = 1e-3;

/// An axis-aligned box in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The least coordinates.
    pub min: Vec3,
    /// The greatest coordinates.
    pub max: Vec3,
}

impl Bounds {
    /// The empty box: widened by a point, it is that point alone.
    pub const EMPTY: Self = Self { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };

    /// The smallest box around `points`.
    pub fn of_points(points: &[Vec3]) -> Self {
        points.iter().fold(Self::EMPTY, |bounds, &point| bounds.with(point))
    }

    /// Widened so that it holds `point`.
    pub fn with(self, point: Vec3) -> Self {
        Self { min: self.min.min(point), max: self.max.max(point) }
    }

    /// Widened so that it holds `other`.
    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The eight corners.
    pub fn corners(&self) -> [Vec3; 8] {
        std::array::from_fn(|corner| {
            let side = |axis: usize| if corner >> axis & 1 == 0 { self.min[axis] } else { self.max[axis] };
            Vec3::new(side(0), side(1), side(2))
        })
    }

    /// The smallest box around this one as an affine transform places it.
    pub fn transformed(&self, matrix: Mat4) -> Self {
        Self::of_points(&self.corners().map(|corner| matrix.transform_point3(corner)))
    }

    /// The middle of the box, which must not be empty.
    pub fn center(&self) -> Vec3 {
        0.5 * self.min + 0.5 * self.max
    }

    /// The distance between opposite corners, 0 for an empty box.
    pub fn diagonal(&self) -> f64 {
        (self.max.as_dvec3() - self.min.as_dvec3()).max(glam::DVec3::ZERO).length()
    }

    /// The axis across which it has no extent to speak of, of a box that has some along both others: that of a floor or a wall.
    pub fn flat(&self) -> Option<Vec3> {
        let size = self.max - self.min;
        let is_thin = size.to_array().map(|side| side < FLAT * size.max_element());
        let axis = is_thin.iter().position(|&is_thin| is_thin)?;
        (is_thin.iter().filter(|is_thin| **is_thin).count() == 1).then_some(Vec3::AXES[axis])
    }

    /// Half the diagonal in metres, but never so small, for where the box is, that it would be lost in rounding. The box must
    /// not be empty.
    pub fn radius(&self) -> f32 {
        let magnitude = self.min.abs().max(self.max.abs()).max_element();
        (0.5 * self.diagonal() as f32).max(1e-5 * magnitude).max(1e-12)
    }
}
