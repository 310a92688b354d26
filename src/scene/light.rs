use glam::Vec3;

/// A polygonal area light: the planar islands of one emissive instance, all of the same radiance.
#[derive(Clone, Debug)]
pub struct Light {
    pub name: String,
    /// Linear Rec. 709, >= 0; of a textured emitter the mean over it.
    pub radiance: Vec3,
    /// Mean of the emission texture over the emitter, linear; 1 where there is none.
    pub texture_mean: Vec3,
    /// Emits from both faces; otherwise only to the side of its polygons' normals.
    pub two_sided: bool,
    /// At least one.
    pub polygons: Vec<Polygon>,
    /// The emitter that is drawn for it (index into `Scene::instances`).
    pub instance: usize,
}

impl Light {
    /// The radiance of the emitter's surface where its texture is white; black where no texel is.
    pub fn emission(&self) -> Vec3 {
        let divide = |radiance: f32, mean: f32| if mean > 0.0 { radiance / mean } else { 0.0 };
        let [r, g, b] = [0, 1, 2].map(|channel| divide(self.radiance[channel], self.texture_mean[channel]));
        Vec3::new(r, g, b)
    }

    /// The mean of the outlines' vertices: where the light is said to be.
    pub fn position(&self) -> Vec3 {
        let vertices = self.polygons.iter().flat_map(|polygon| &polygon.contours).flatten();
        let (sum, count) = vertices.fold((Vec3::ZERO, 0.0), |(sum, count), vertex| (sum + vertex, count + 1.0));
        sum / f32::max(count, 1.0)
    }
}

/// A planar polygon in world space, any number of vertices, convex or not, holes allowed.
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
    pub name: String,
    pub kind: PunctualKind,
    /// Colour times intensity, linear Rec. 709, >= 0: radiant intensity (W/sr) of points and spots, irradiance (W/m^2) across a
    /// directional light's rays.
    pub intensity: Vec3,
    /// Metres; of directional lights without meaning.
    pub position: Vec3,
    /// The way that it shines, unit; of points without meaning.
    pub direction: Vec3,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PunctualKind {
    /// Falls off with the distance squared, and to nothing at `range` (metres, may be infinite).
    Point {
        range: f32,
    },
    /// Likewise; full within the angle `inner` about its direction, nothing beyond `outer`; 0 <= inner < outer <= pi / 2.
    Spot {
        range: f32,
        inner: f32,
        outer: f32,
    },
    Directional,
}
