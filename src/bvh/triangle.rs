use glam::DVec3;

use super::{Primitive, Ray};

/// How far outside an edge a ray still meets a triangle, in weights of the corners, so that neighbours leave no gap.
const EDGE: f64 = 1e-12;

/// A triangle of a scene's instance, in the world.
#[derive(Clone, Debug)]
pub struct Triangle {
    corner: DVec3,
    /// From the first corner to the second, and to the third.
    edges: [DVec3; 2],
    /// Index into [`Scene::instances`](crate::scene::Scene::instances).
    pub instance: u32,
    /// Which of its mesh's triangles it is.
    pub index: u32,
}

impl Triangle {
    /// Triangle `index` of an instance's mesh, by its corners in the world.
    pub fn new([a, b, c]: [DVec3; 3], instance: u32, index: u32) -> Self {
        Self { corner: a, edges: [b - a, c - a], instance, index }
    }

    /// The first corner.
    pub fn corner(&self) -> DVec3 {
        self.corner
    }

    /// From the first corner to the second, and to the third.
    pub fn edges(&self) -> [DVec3; 2] {
        self.edges
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::warp::{uniform, unit_sphere};
    use rand::SeedableRng;
    use rand_pcg::Pcg64;

    /// Rays through the edge that two triangles share meet one of them, at the place that its weights give.
    #[test]
    fn neighbouring_triangles_leave_no_gap() {
        let mut rng = Pcg64::seed_from_u64(7);
        for _ in 0..2000 {
            let [a, b, c, d] = std::array::from_fn(|_| unit_sphere(&mut rng));
            let on_edge = a.lerp(b, uniform(&mut rng));
            let direction = unit_sphere(&mut rng);
            let ray = Ray { origin: on_edge - 3.0 * direction, direction };
            let corners = [[a, b, c], [b, a, d]];
            let met = |corners: [DVec3; 3]| {
                let (distance, [u, v]) = Triangle::new(corners, 0, 0).meet(&ray)?;
                let by_weights = corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
                assert!((ray.at(distance) - by_weights).length() < 1e-9, "{corners:?}");
                Some(distance)
            };
            let distances: Vec<f64> = corners.into_iter().filter_map(met).collect();
            assert!(distances.iter().any(|distance| (distance - 3.0).abs() < 1e-9), "{corners:?} {ray:?}");
        }
    }
}
