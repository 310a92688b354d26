use glam::Vec3;

/// A polygonal area light: the planar islands of one emissive instance, all of the same radiance.
#[derive(Clone, Debug)]
pub struct Light {
    pub name: String,
    /// Linear Rec. 709, >= 0.
    pub radiance: Vec3,
    /// Emits from both faces; otherwise only to the side of its polygons' normals.
    pub two_sided: bool,
    /// At least one.
    pub polygons: Vec<Polygon>,
    /// The emitter that is drawn for it (index into `Scene::instances`).
    pub instance: usize,
}

impl Light {
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
