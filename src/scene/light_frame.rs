//! A polygon light's own axes, and how it is moved, turned and made larger along them.

use glam::{DAffine3, DMat3, DQuat, DVec2, DVec3, Mat4, Quat, Vec2, Vec3};

use super::{Light, Polygon};

/// Where a polygon light stands: its middle, its own axes, and what it measures along them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightFrame {
    /// The mean of the outlines' vertices, metres.
    pub position: Vec3,
    /// Turns the light's own axes into the world's, unit: z is the side to which its first polygon shines, x lies along the rows
    /// of that one's pattern, else along its longest edge.
    pub rotation: Quat,
    /// Along its own x and y, metres, > 0.
    pub size: Vec2,
    /// Whether all of it lies in one plane; if not, it is made larger the same way along all axes.
    pub is_flat: bool,
}

/// How far from a plane, in shares of the size, a light may reach that is flat.
const FLAT: f64 = 1e-3;

impl LightFrame {
    /// Of an added shape: 1 m wide and high, about the origin, towards +z.
    pub(super) const UNIT: Self =
        Self { position: Vec3::ZERO, rotation: Quat::IDENTITY, size: Vec2::ONE, is_flat: true };

    /// Of a light as it is.
    pub(super) fn new(light: &Light) -> Self {
        let position = light.position();
        let axes = axes(&light.polygons[0]);
        let from_middle = |vertex: &Vec3| axes.transpose() * (vertex.as_dvec3() - position.as_dvec3());
        let places = || light.polygons.iter().flat_map(|polygon| &polygon.contours).flatten().map(from_middle);
        let low = places().fold(DVec3::INFINITY, DVec3::min);
        let high = places().fold(DVec3::NEG_INFINITY, DVec3::max);
        let size = (high - low).max(DVec3::splat(f64::from(f32::MIN_POSITIVE)));
        let is_flat = size.z <= FLAT * size.x.max(size.y);
        let rotation = DQuat::from_mat3(&axes).normalize().as_quat();
        Self { position, rotation, size: size.truncate().as_vec2(), is_flat }
    }

    /// What takes it to where it stands after these changes.
    pub(super) fn moved(&self, position: Option<Vec3>, rotation: Option<Quat>, size: Option<Vec2>) -> DAffine3 {
        let axes = DMat3::from_quat(self.rotation.as_dquat().normalize());
        let factors = self.factors(size);
        // What is the same moves nothing, not even by a rounding.
        let stretched = match factors == DVec3::ONE {
            true => DMat3::IDENTITY,
            false => axes * DMat3::from_diagonal(factors) * axes.transpose(),
        };
        let turned = rotation
            .filter(|turn| *turn != Quat::IDENTITY)
            .map_or(DMat3::IDENTITY, |turn| DMat3::from_quat(turn.as_dquat().normalize()));
        let matrix = turned * stretched;
        let from = self.position.as_dvec3();
        let to = position.unwrap_or(self.position).as_dvec3();
        DAffine3::from_mat3_translation(matrix, to - matrix * from)
    }

    /// It after these changes.
    pub fn with(&self, position: Option<Vec3>, rotation: Option<Quat>, size: Option<Vec2>) -> Self {
        let factors = self.factors(size).truncate();
        Self {
            position: position.unwrap_or(self.position),
            rotation: rotation.map_or(self.rotation, |turn| (turn * self.rotation).normalize()),
            size: (factors * self.size.as_dvec2()).as_vec2(),
            is_flat: self.is_flat,
        }
    }

    /// Along its own axes; all the same where it is not flat.
    fn factors(&self, size: Option<Vec2>) -> DVec3 {
        let factors = size.map_or(DVec2::ONE, |size| size.as_dvec2() / self.size.as_dvec2());
        let mean = (factors.x * factors.y).sqrt();
        if self.is_flat { factors.extend(mean) } else { DVec3::splat(mean) }
    }

    /// The side to which its first polygon shines, unit.
    pub fn normal(&self) -> Vec3 {
        self.rotation * Vec3::Z
    }
}

/// Own axes of a polygon as columns.
fn axes(polygon: &Polygon) -> DMat3 {
    let normal = polygon.normal.as_dvec3().normalize();
    let along = match &polygon.pattern {
        Some(pattern) => pattern.axes[0].as_dvec3(),
        None => longest_edge(&polygon.contours[0]),
    };
    let x = (along - along.dot(normal) * normal).try_normalize().unwrap_or(normal.any_orthonormal_vector());
    DMat3::from_cols(x, normal.cross(x), normal)
}

/// The first one of those that are longest, to rounding.
fn longest_edge(contour: &[Vec3]) -> DVec3 {
    let next = contour.iter().cycle().skip(1);
    let edges = contour.iter().zip(next).map(|(from, to)| to.as_dvec3() - from.as_dvec3());
    edges
        .reduce(|longest, edge| if edge.length() > 1.000_01 * longest.length() { edge } else { longest })
        .unwrap_or(DVec3::X)
}

impl Light {
    /// Its own axes, and what it measures along them.
    pub fn frame(&self) -> LightFrame {
        LightFrame::new(self)
    }

    /// What it would send out in all, W, with this radiance in W m^-2 sr^-1: pi times its area, of both faces where both shine, and
    /// by the mean over its patterns.
    pub fn power(&self, radiance: f32) -> f32 {
        let area: f64 = self.polygons.iter().map(Polygon::area).sum();
        let sides = if self.two_sided { 2.0 } else { 1.0 };
        (sides * std::f64::consts::PI * area * f64::from(radiance)) as f32
    }

    /// Takes all that it is to another place: a turn, and factors that are the same along all axes unless it is flat and they are
    /// along its own.
    pub(super) fn transform(&mut self, place: &DAffine3) {
        let point = |point: &mut Vec3| *point = place.transform_point3(point.as_dvec3()).as_vec3();
        let normals = super::mesh::normal_matrix(place.matrix3);
        for polygon in &mut self.polygons {
            polygon.contours.iter_mut().flatten().for_each(point);
            polygon.normal = (normals * polygon.normal.as_dvec3()).normalize().as_vec3();
            if let Some(pattern) = &mut polygon.pattern {
                point(&mut pattern.origin);
                pattern.axes = pattern.axes.map(|axis| (place.matrix3 * axis.as_dvec3()).as_vec3());
            }
        }
    }
}

impl Polygon {
    /// Square metres; what holes leave.
    pub fn area(&self) -> f64 {
        let twice = |contour: &Vec<Vec3>| {
            let from = contour[0].as_dvec3();
            let edges = contour.windows(2).map(|pair| (pair[0].as_dvec3() - from).cross(pair[1].as_dvec3() - from));
            edges.sum::<DVec3>().dot(self.normal.as_dvec3())
        };
        (0.5 * self.contours.iter().map(twice).sum::<f64>()).abs()
    }
}

/// The same of a matrix of an instance.
pub(super) fn placed(world_from_mesh: Mat4, place: &DAffine3) -> Mat4 {
    (glam::DMat4::from(*place) * world_from_mesh.as_dmat4()).as_mat4()
}
