use std::f64::consts::PI;

use glam::Vec3;

use super::Pattern;

/// The share of a thing's seen area from which on, if it glows, the thing is a lamp.
const LAMP_SHARE: f32 = 0.5;

/// A polygonal area light: the flat parts of one emissive instance, all of the same radiance.
#[derive(Clone, Debug)]
pub struct Light {
    /// What users call it; may be empty.
    pub name: String,
    /// Linear Rec. 709, >= 0; the mean over the emitter of what is seen of its glow.
    pub radiance: Vec3,
    /// The share of the emitter's emission that is seen, in \[0, 1\], by channel: the mean over it of what its emissive
    /// texture, and its opacity where that counts, leave.
    pub seen_share: Vec3,
    /// The share of the emitter's seen area that glows, in (0, 1\].
    pub glowing_share: f32,
    /// Emits from both faces; otherwise only to the side of its polygons' normals.
    pub two_sided: bool,
    /// In world space; at least one.
    pub polygons: Vec<Polygon>,
    /// The emitter that is drawn for it (index into `Scene::instances`).
    pub instance: usize,
    /// More emitters that are drawn for it: each lies in its plane, within others that shine to the same side.
    pub doubles: Vec<usize>,
}

impl Default for Light {
    /// Black and without area; all of its emitter is seen to glow.
    fn default() -> Self {
        Self {
            name: String::new(),
            radiance: Vec3::ZERO,
            seen_share: Vec3::ONE,
            glowing_share: 1.0,
            two_sided: false,
            polygons: Vec::new(),
            instance: 0,
            doubles: Vec::new(),
        }
    }
}

impl Light {
    /// Whether its emitter is a lamp: at least half of what is seen of it glows. Otherwise it is a thing that carries a
    /// light, a screen or a label perhaps.
    pub fn is_lamp(&self) -> bool {
        self.glowing_share >= LAMP_SHARE
    }

    /// The emitters that are drawn for it: indices into `Scene::instances`.
    pub fn emitters(&self) -> impl Iterator<Item = usize> {
        std::iter::once(self.instance).chain(self.doubles.iter().copied())
    }

    /// The radiance of the emitter's surface where its texture is white, linear Rec. 709, >= 0; 0 in the channels of
    /// which nothing is seen.
    pub fn emission(&self) -> Vec3 {
        let divide = |radiance: f32, share: f32| if share > 0.0 { radiance / share } else { 0.0 };
        let [r, g, b] = [0, 1, 2].map(|channel| divide(self.radiance[channel], self.seen_share[channel]));
        Vec3::new(r, g, b).min(Vec3::MAX)
    }

    /// The mean of the outlines' vertices, in metres: where users are told that the light is.
    pub fn position(&self) -> Vec3 {
        let vertices = self.polygons.iter().flat_map(|polygon| &polygon.contours).flatten();
        let (sum, count) = vertices.fold((Vec3::ZERO, 0.0), |(sum, count), vertex| (sum + vertex, count + 1.0));
        sum / f32::max(count, 1.0)
    }
}

/// A planar polygon in world space, in metres, with any number of vertices, convex or not; it may have holes.
#[derive(Clone, Debug)]
pub struct Polygon {
    /// Closed outlines of at least three vertices each: counter-clockwise seen from the emitting side around the area,
    /// clockwise around holes.
    pub contours: Vec<Vec<Vec3>>,
    /// Unit normal, towards the emitting side.
    pub normal: Vec3,
    /// How the light varies over it; none where it is even.
    pub pattern: Option<Pattern>,
}

/// A light without extent (KHR_lights_punctual).
#[derive(Clone, Debug, PartialEq)]
pub struct PunctualLight {
    /// What users call it; may be empty.
    pub name: String,
    /// Point, spot or directional.
    pub kind: PunctualKind,
    /// Colour times intensity, linear Rec. 709, >= 0: radiant intensity (W/sr) of points and spots, irradiance (W/m^2)
    /// across a directional light's rays.
    pub intensity: Vec3,
    /// Metres; without meaning for directional lights.
    pub position: Vec3,
    /// The direction in which it shines, unit; without meaning for points.
    pub direction: Vec3,
}

impl PunctualLight {
    /// What it would send out in all, W, with this intensity in W/sr, by KHR_lights_punctual's falloff from the inner to the outer
    /// angle; a directional light's has no end.
    pub fn power(&self, intensity: f32) -> Option<f32> {
        let solid_angle = match self.kind {
            PunctualKind::Point { .. } => 4.0 * PI,
            // The falloff is the square of what is linear in the cosine, of which the mean is a third.
            PunctualKind::Spot { inner, outer, .. } => {
                let [full, none] = [inner, outer].map(|angle| 2.0 * (0.5 * f64::from(angle)).sin().powi(2));
                2.0 * PI * (full + (none - full) / 3.0)
            }
            PunctualKind::Directional => return None,
        };
        Some((solid_angle * f64::from(intensity)) as f32)
    }
}

/// How a light without extent shines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PunctualKind {
    /// In all directions, falling off with the square of the distance.
    Point {
        /// Metres, > 0, may be infinite: the light has fallen to nothing there.
        range: f32,
    },
    /// Like a point, but only within a cone about its direction.
    Spot {
        /// Metres, > 0, may be infinite: the light has fallen to nothing there.
        range: f32,
        /// Angle to the direction in radians, in \[0, `outer`\]: up to here the light is full.
        inner: f32,
        /// Angle to the direction in radians, in (0, pi / 2\]: from here on there is no light. Where it is `inner`, the
        /// cone has a hard edge.
        outer: f32,
    },
    /// From infinitely far away: everywhere the same.
    Directional,
}
