use glam::Vec3;

/// A polygonal area light: the planar islands of one emissive instance, all of the same radiance.
#[derive(Clone, Debug)]
pub struct Light {
    /// What users call it; may be empty.
    pub name: String,
    /// Linear Rec. 709, >= 0; of a textured emitter, the mean over it.
    pub radiance: Vec3,
    /// Mean of the emissive texture over the emitter, linear, in \[0, 1\]; 1 where there is none.
    pub texture_mean: Vec3,
    /// Emits from both faces; otherwise only to the side of its polygons' normals.
    pub two_sided: bool,
    /// In world space; at least one.
    pub polygons: Vec<Polygon>,
    /// The emitter that is drawn for it (index into `Scene::instances`).
    pub instance: usize,
}

impl Light {
    /// The radiance of the emitter's surface where its texture is white, linear Rec. 709, >= 0; 0 in the channels in
    /// which all that it shows of the texture is black.
    pub fn emission(&self) -> Vec3 {
        let divide = |radiance: f32, mean: f32| if mean > 0.0 { radiance / mean } else { 0.0 };
        let [r, g, b] = [0, 1, 2].map(|channel| divide(self.radiance[channel], self.texture_mean[channel]));
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
