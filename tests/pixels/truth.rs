//! The radiance of a stage at a point of its picture, in `f64` and by hand: a ray, the triangles, the design's sum.

use glam::{DMat3, DMat4, DVec3, Vec3};
use velour::reference::polygon::form_factor;
use velour::scene::{Projection, Settings};
use velour::table::LtcTable;

use super::stage::{Stage, Thing};

/// What is seen at a point of the picture.
pub struct Hit {
    /// Which thing, and which of its triangles.
    pub thing: usize,
    pub triangle: usize,
    pub radiance: DVec3,
}

/// A ray, and how far along it things are drawn.
struct Ray {
    origin: DVec3,
    direction: DVec3,
    range: [f64; 2],
    /// Unit, towards the eye.
    view: DVec3,
}

/// A stage as it is lit and seen.
pub struct Truth<'a> {
    stage: &'a Stage,
    table: &'a LtcTable,
    settings: &'a Settings,
    size: [u32; 2],
    /// Radiance, outlines in the world, two-sided.
    lights: Vec<(DVec3, Vec<Vec<DVec3>>, bool)>,
}

impl<'a> Truth<'a> {
    pub fn new(stage: &'a Stage, table: &'a LtcTable, settings: &'a Settings, size: [u32; 2]) -> Self {
        let outline = |thing: &Thing| {
            let world_from_mesh = thing.world_from_mesh.as_dmat4();
            let place = |corner: &Vec3| world_from_mesh.transform_point3(corner.as_dvec3());
            let mut contours: Vec<Vec<DVec3>> =
                thing.contours.iter().map(|contour| contour.iter().map(place).collect()).collect();
            if world_from_mesh.determinant() < 0.0 {
                contours.iter_mut().for_each(|contour| contour.reverse());
            }
            (thing.material.emission.as_dvec3(), contours, thing.material.double_sided)
        };
        let lights = stage.things.iter().filter(|thing| thing.glows()).map(outline).collect();
        Self { stage, table, settings, size, lights }
    }

    /// At a point of the picture, in pixels from its upper left corner; the centre of the first is (0.5, 0.5).
    pub fn at(&self, point: [f64; 2]) -> Option<Hit> {
        let ray = self.ray(point);
        let seen =
            self.stage.things.iter().enumerate().filter(|(_, thing)| self.settings.lights_visible || !thing.glows());
        let meetings = seen.filter_map(|(index, thing)| Some((index, nearest(thing, &ray)?)));
        let (thing, meeting) = meetings.min_by(|(_, left), (_, right)| left.depth.total_cmp(&right.depth))?;
        let radiance = self.radiance(thing, &meeting, ray.view);
        Some(Hit { thing, triangle: meeting.triangle, radiance })
    }

    fn ray(&self, [x, y]: [f64; 2]) -> Ray {
        let [width, height] = self.size.map(f64::from);
        let right = (2.0 * x - width) / height;
        let up = 1.0 - 2.0 * y / height;
        let world_from_camera = self.stage.world_from_camera.as_dmat4();
        let (origin, direction, [near, far]) = match self.stage.projection {
            Projection::Perspective { yfov, near, far } => {
                let extent = (0.5 * f64::from(yfov)).tan();
                (DVec3::ZERO, DVec3::new(right * extent, up * extent, -1.0), [near, far])
            }
            Projection::Orthographic { ymag, near, far } => {
                let extent = f64::from(ymag);
                (DVec3::new(right * extent, up * extent, 0.0), DVec3::NEG_Z, [near, far])
            }
        };
        // The direction goes one unit deep, so distances along it are depths.
        let direction = world_from_camera.transform_vector3(direction);
        let view = -direction.normalize();
        Ray { origin: world_from_camera.transform_point3(origin), direction, range: [near.into(), far.into()], view }
    }

    /// The design's sum: lobes weighted, over all lights.
    fn radiance(&self, index: usize, &Meeting { p_world, normal, .. }: &Meeting, view: DVec3) -> DVec3 {
        let thing = &self.stage.things[index];
        let sheen = self.settings.sheen_of(index, &thing.material);
        let color = sheen.map_or(DVec3::ZERO, |look| look.sheen.color.as_dvec3());
        let alpha = sheen.map_or(0.0, |look| f64::from(look.sheen.roughness));
        let [a, b, r] = self.table.lookup(alpha, normal.dot(view).max(0.0));
        let m_inv = DMat3::from_cols(DVec3::new(a, 0.0, 0.0), DVec3::new(0.0, a, 0.0), DVec3::new(b, 0.0, 1.0));
        let base = thing.material.base_color.as_dvec3() * (1.0 - color.max_element() * r);
        let lobes = self.settings.lobes;
        let local_from_world = frame(normal, view).transpose();
        let mut sum = if lobes.emission { thing.material.emission.as_dvec3() } else { DVec3::ZERO };
        for (radiance, contours, two_sided) in &self.lights {
            let local = |corner: &DVec3| local_from_world * (*corner - p_world);
            let contours: Vec<Vec<DVec3>> =
                contours.iter().map(|contour| contour.iter().map(local).collect()).collect();
            if lobes.sheen {
                sum += *radiance * color * r * form_factor(&contours, m_inv, *two_sided);
            }
            if lobes.diffuse {
                sum += *radiance * base * form_factor(&contours, DMat3::IDENTITY, *two_sided);
            }
        }
        sum
    }
}

/// Columns x, y, z: the normal is z, x lies towards the view's projection (anywhere where there is none).
fn frame(normal: DVec3, view: DVec3) -> DMat3 {
    let across = view - normal * normal.dot(view);
    let x = across.try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector());
    DMat3::from_cols(x, normal.cross(x), normal)
}

/// Where a ray meets a thing first.
struct Meeting {
    depth: f64,
    triangle: usize,
    p_world: DVec3,
    /// Interpolated, and turned on back faces.
    normal: DVec3,
}

/// The nearest triangle that is drawn.
fn nearest(thing: &Thing, ray: &Ray) -> Option<Meeting> {
    let meetings = (0..thing.triangles.len()).filter_map(|triangle| meet(thing, triangle, ray));
    meetings.min_by(|left, right| left.depth.total_cmp(&right.depth))
}

fn meet(thing: &Thing, triangle: usize, ray: &Ray) -> Option<Meeting> {
    let world_from_mesh: DMat4 = thing.world_from_mesh.as_dmat4();
    let linear = DMat3::from_mat4(world_from_mesh);
    let corners = thing.triangles[triangle].map(|corner| corner as usize);
    let [a, b, c] = corners.map(|corner| world_from_mesh.transform_point3(thing.positions[corner].as_dvec3()));
    let face = (b - a).cross(c - a);
    let slope = face.dot(ray.direction);
    let depth = face.dot(a - ray.origin) / slope;
    // Front faces wind counter-clockwise, unless the transform mirrors.
    let front = slope * linear.determinant() < 0.0;
    let drawn = slope != 0.0 && (front || thing.material.double_sided);
    if !drawn || !(ray.range[0]..=ray.range[1]).contains(&depth) {
        return None;
    }
    let p_world = ray.origin + depth * ray.direction;
    let weight = |p: DVec3, q: DVec3| (q - p).cross(p_world - p).dot(face) / face.length_squared();
    let weights = [weight(b, c), weight(c, a), weight(a, b)];
    if weights.iter().any(|weight| *weight < 0.0) {
        return None;
    }
    let normal_from_mesh = linear.inverse().transpose();
    let corner_normal = |corner: usize| (normal_from_mesh * thing.normals[corner].as_dvec3()).normalize();
    let sum: DVec3 = corners.into_iter().zip(weights).map(|(corner, weight)| weight * corner_normal(corner)).sum();
    Some(Meeting { depth, triangle, p_world, normal: sum.normalize() * if front { 1.0 } else { -1.0 } })
}
