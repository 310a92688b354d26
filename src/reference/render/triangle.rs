//! Triangles in the world.

use glam::DVec3;

use crate::reference::bvh::{Primitive, Ray};

/// How far outside an edge a ray still meets a triangle, in weights of the corners, so that neighbours leave no gap.
const EDGE: f64 = 1e-12;

/// A triangle of an instance.
#[derive(Clone, Debug)]
pub(super) struct Triangle {
    corner: DVec3,
    /// From the first corner to the second, and to the third.
    edges: [DVec3; 2],
    /// Index into `Scene::instances`.
    pub instance: u32,
    /// Which of its mesh's triangles it is.
    pub index: u32,
}

impl Triangle {
    pub fn new([a, b, c]: [DVec3; 3], instance: u32, index: u32) -> Self {
        Self { corner: a, edges: [b - a, c - a], instance, index }
    }

    /// The face's normal by winding, twice the area long.
    pub fn face(&self) -> DVec3 {
        self.edges[0].cross(self.edges[1])
    }
}

impl Primitive for Triangle {
    /// Weights of the second and the third corner.
    type Place = [f64; 2];

    fn bounds(&self) -> [DVec3; 2] {
        let corners = [self.corner, self.corner + self.edges[0], self.corner + self.edges[1]];
        [corners[0].min(corners[1]).min(corners[2]), corners[0].max(corners[1]).max(corners[2])]
    }

    /// Möller and Trumbore 1997.
    #[inline]
    fn meet(&self, ray: &Ray) -> Option<(f64, [f64; 2])> {
        let [first, second] = self.edges;
        let across = ray.direction.cross(second);
        let slope = first.dot(across);
        if slope == 0.0 {
            return None;
        }
        let inverse = 1.0 / slope;
        let to_origin = ray.origin - self.corner;
        let u = to_origin.dot(across) * inverse;
        if !(-EDGE..=1.0 + EDGE).contains(&u) {
            return None;
        }
        let over = to_origin.cross(first);
        let v = ray.direction.dot(over) * inverse;
        if v < -EDGE || u + v > 1.0 + EDGE {
            return None;
        }
        Some((second.dot(over) * inverse, [u, v]))
    }
}
