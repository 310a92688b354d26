//! What is changed in lights, and lights that are added.

use std::f32::consts::PI;

use glam::{Quat, Vec2, Vec3};

use crate::scene::{Light, PunctualKind, PunctualLight, black_body};

/// What is changed in a polygon light and in the emitter that is drawn for it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LightEdits {
    /// Linear Rec. 709, >= 0.
    pub radiance: Option<Vec3>,
    /// A factor of the radiance, >= 0; at 0 its hue is kept.
    pub strength: Option<f32>,
    /// The hue is that of a black body so hot, kelvin, in [`black_body::RANGE`]; the strongest channel of the radiance stays.
    pub temperature: Option<f32>,
    /// What it sends out in all, in the strongest channel, watts (or the unit of radiance times m^2 sr), >= 0: whatever radiance
    /// and strength say but for the hue, and however large the light is.
    pub power: Option<f32>,
    /// Where the mean of its outlines' vertices is moved to, metres.
    pub position: Option<Vec3>,
    /// By what it is turned about its position from where it was loaded, unit.
    pub rotation: Option<Quat>,
    /// What it measures along its own x and y, metres, > 0: see [`Light::frame`].
    pub size: Option<Vec2>,
    /// Whether both of its faces shine.
    pub two_sided: Option<bool>,
    /// Whether it is lit; one that is not is as if it were not there, but that it stays what carries it.
    pub on: Option<bool>,
    /// Whether it is one of those that alone are lit.
    pub solo: Option<bool>,
    /// Whether it is taken away.
    pub removed: Option<bool>,
}

/// What is changed in a light without extent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PunctualEdits {
    /// Linear Rec. 709, >= 0, in the unit of [`PunctualLight::intensity`].
    pub intensity: Option<Vec3>,
    /// A factor of the intensity, >= 0; at 0 its hue is kept.
    pub strength: Option<f32>,
    /// The hue is that of a black body so hot, kelvin, in [`black_body::RANGE`]; the strongest channel of the intensity stays.
    pub temperature: Option<f32>,
    /// What a point or a spot sends out in all, in the strongest channel, watts, >= 0, whatever intensity and strength say but for
    /// the hue. A directional light has none.
    pub power: Option<f32>,
    /// Metres.
    pub position: Option<Vec3>,
    /// The direction in which it shines; its length does not count.
    pub direction: Option<Vec3>,
    /// Metres, > 0: the light has fallen to nothing there.
    pub range: Option<f32>,
    /// The angle to its direction up to which a spot is full, radians, in \[0, outer\].
    pub inner: Option<f32>,
    /// The angle to its direction from which on a spot gives no light, radians, in (0, pi / 2\].
    pub outer: Option<f32>,
    /// Whether it is lit.
    pub on: Option<bool>,
    /// Whether it is one of those that alone are lit.
    pub solo: Option<bool>,
    /// Whether it is taken away.
    pub removed: Option<bool>,
}

/// The most corners of all polygon lights of a scene together, those that are added among them.
pub const MOST_CORNERS: usize = crate::scene::lights::CORNERS_MAX;
/// The most lights without extent that are added.
pub const MOST_PUNCTUAL: usize = 1024;

/// A light that the file does not have.
#[derive(Clone, Debug, PartialEq)]
pub struct Added<Shape, Changes> {
    /// What users call it; may be empty.
    pub name: String,
    /// What it is before it is changed.
    pub shape: Shape,
    /// What makes it other than all of its shape are.
    pub changes: Changes,
}

/// An added polygon light.
pub type AddedLight = Added<LightShape, LightEdits>;
/// An added light without extent.
pub type AddedPunctual = Added<PunctualShape, PunctualEdits>;

/// What an added light looks like; where not said otherwise it stands at the origin, shines towards +z with a white radiance of
/// 1, to one side, and is 1 m wide and high.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightShape {
    /// A square.
    Rectangle,
    /// A regular polygon of 32 sides with the area of the disk that is as wide and high.
    Disk,
    /// A regular polygon of so many corners, 3 to 64, that lie on a circle of a diameter of 1 m; one of them is uppermost.
    Polygon(u16),
    /// As the light of this index was loaded, where it stands.
    Copy(usize),
}

/// What an added light without extent is; where not said otherwise it stands at the origin, shines towards -z, white, with an
/// intensity or irradiance of 1, however far, and where it is a spot fully to 30 degrees and to nothing at 45.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PunctualShape {
    /// It shines in all directions.
    Point,
    /// It shines into a cone.
    Spot,
    /// It shines from infinitely far away.
    Directional,
    /// As the light of this index was loaded.
    Copy(usize),
}

impl LightShape {
    /// The most corners of a polygon.
    pub const MOST_CORNERS: u16 = 64;

    /// Another number for each shape, below 65, that is not a copy.
    pub(in crate::scene) fn code(self) -> u16 {
        match self {
            Self::Copy(_) => 0,
            Self::Rectangle => 1,
            Self::Disk => 2,
            Self::Polygon(corners) => corners,
        }
    }
}

/// The colour of light that has `color`, but for what is said of strength, temperature and power: `unit` is what a power of 1 makes of
/// its strongest channel, none where it has no power.
fn colored(color: Vec3, strength: Option<f32>, temperature: Option<f32>, power: Option<(f32, f32)>) -> Vec3 {
    let color = temperature.map_or(color, |kelvin| color.max_element() * black_body::color(kelvin));
    match power {
        // Of a light that is black it is said in which hue it has any.
        Some((power, unit)) => {
            let most = color.max_element();
            let hue = if most > 0.0 { color / most } else { temperature.map_or(Vec3::ONE, black_body::color) };
            (power * unit * hue).min(Vec3::MAX)
        }
        None => (strength.unwrap_or(1.0) * color).min(Vec3::MAX),
    }
}

impl LightEdits {
    /// These, and `others` where these are `None`.
    pub fn or(self, others: Self) -> Self {
        Self {
            radiance: self.radiance.or(others.radiance),
            strength: self.strength.or(others.strength),
            temperature: self.temperature.or(others.temperature),
            power: self.power.or(others.power),
            position: self.position.or(others.position),
            rotation: self.rotation.or(others.rotation),
            size: self.size.or(others.size),
            two_sided: self.two_sided.or(others.two_sided),
            on: self.on.or(others.on),
            solo: self.solo.or(others.solo),
            removed: self.removed.or(others.removed),
        }
    }

    /// The radiance of a light that is already of the size and has the sides that it is to have, but for whether it is lit.
    pub(in crate::scene) fn radiance(&self, light: &Light) -> Vec3 {
        let unit = light.power(1.0).recip();
        let power = self.power.map(|power| (power, if unit.is_finite() { unit } else { 0.0 }));
        colored(self.radiance.unwrap_or(light.radiance), self.strength, self.temperature, power)
    }
}

impl PunctualEdits {
    /// These, and `others` where these are `None`.
    pub fn or(self, others: Self) -> Self {
        Self {
            intensity: self.intensity.or(others.intensity),
            strength: self.strength.or(others.strength),
            temperature: self.temperature.or(others.temperature),
            power: self.power.or(others.power),
            position: self.position.or(others.position),
            direction: self.direction.or(others.direction),
            range: self.range.or(others.range),
            inner: self.inner.or(others.inner),
            outer: self.outer.or(others.outer),
            on: self.on.or(others.on),
            solo: self.solo.or(others.solo),
            removed: self.removed.or(others.removed),
        }
    }

    /// What they make of a light, but for whether it is lit.
    pub fn applied(&self, light: &PunctualLight) -> PunctualLight {
        let kind = match light.kind {
            PunctualKind::Point { range } => PunctualKind::Point { range: self.range.unwrap_or(range) },
            PunctualKind::Spot { range, inner, outer } => {
                let outer = self.outer.unwrap_or(outer).clamp(f32::MIN_POSITIVE, 0.5 * PI);
                let inner = self.inner.unwrap_or(inner).min(outer);
                PunctualKind::Spot { range: self.range.unwrap_or(range), inner, outer }
            }
            PunctualKind::Directional => PunctualKind::Directional,
        };
        let direction = self.direction.and_then(Vec3::try_normalize).unwrap_or(light.direction);
        let position = self.position.unwrap_or(light.position);
        let light = PunctualLight { kind, direction, position, ..light.clone() };
        let power = self.power.zip(light.power(1.0).map(f32::recip));
        let color = self.intensity.unwrap_or(light.intensity);
        PunctualLight { intensity: colored(color, self.strength, self.temperature, power), ..light }
    }
}
