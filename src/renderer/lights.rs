//! Lights as the shaders walk through them.

use bytemuck::{Pod, Zeroable};
use glam::{Vec3, Vec4};

use crate::scene::{Light, Polygon, PunctualKind, PunctualLight, Scene};

/// `PolygonsLight` of `polygons.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(super) struct GpuPolygon {
    radiance: Vec3,
    two_sided: u32,
    normal: Vec3,
    first_vertex: u32,
    center: Vec3,
    radius: f32,
    end_vertex: u32,
    padding: [u32; 3],
}

/// `LightsPunctual` of `lights.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(super) struct GpuPunctual {
    intensity: Vec3,
    inverse_range_squared: f32,
    position: Vec3,
    has_place: f32,
    direction: Vec3,
    cone_scale: f32,
    cone_offset: f32,
    padding: [u32; 3],
}

/// `LightsCounts` of `lights.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(super) struct GpuCounts {
    quads: u32,
    polygons: u32,
    punctual: u32,
}

/// Which kinds of lights there are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct LightKinds {
    /// Polygons of one outline of four vertices.
    pub quads: bool,
    /// Any others.
    pub polygons: bool,
    pub punctual: bool,
}

impl GpuCounts {
    pub fn kinds(self) -> LightKinds {
        LightKinds { quads: self.quads > 0, polygons: self.polygons > self.quads, punctual: self.punctual > 0 }
    }
}

fn is_quad(polygon: &Polygon) -> bool {
    polygon.contours.len() == 1 && polygon.contours[0].len() == 4
}

/// The lights of a scene as the shaders walk through them.
pub(super) struct GpuLights {
    pub counts: GpuCounts,
    /// Quads first.
    pub polygons: Vec<GpuPolygon>,
    /// Outlines: each one's first vertex is marked by w = 1 and comes again at its end, marked by -1.
    pub vertices: Vec<Vec4>,
    pub punctual: Vec<GpuPunctual>,
}

impl GpuLights {
    pub fn new(scene: &Scene) -> Self {
        let (mut polygons, mut vertices) = (Vec::new(), Vec::new());
        let mut add = |quads: bool| {
            // Black ones light nothing and are left out.
            for light in scene.lights.iter().filter(|light| light.radiance != Vec3::ZERO) {
                let wanted = light.polygons.iter().filter(|polygon| is_quad(polygon) == quads);
                polygons.extend(wanted.map(|polygon| gpu_polygon(light, polygon, &mut vertices)));
            }
            polygons.len() as u32
        };
        let (quads, all) = (add(true), add(false));
        let punctual: Vec<GpuPunctual> = scene.punctual_lights.iter().map(one_punctual).collect();
        let counts = GpuCounts { quads, polygons: all, punctual: punctual.len() as u32 };
        Self { counts, polygons, vertices, punctual }
    }
}

/// Adds the vertices of the polygon's outlines.
fn gpu_polygon(light: &Light, polygon: &Polygon, vertices: &mut Vec<Vec4>) -> GpuPolygon {
    let first_vertex = vertices.len() as u32;
    for contour in &polygon.contours {
        vertices.extend(contour.iter().enumerate().map(|(i, p)| p.extend(if i == 0 { 1.0 } else { 0.0 })));
        vertices.extend(contour.first().map(|first| first.extend(-1.0)));
    }
    let (center, radius) = sphere(polygon);
    GpuPolygon {
        radiance: light.radiance,
        two_sided: light.two_sided.into(),
        normal: polygon.normal,
        first_vertex,
        center,
        radius,
        end_vertex: vertices.len() as u32,
        padding: [0; 3],
    }
}

/// A sphere around a polygon. Its centre lies in the plane through the first vertex, so that both tell the same side of the light.
fn sphere(polygon: &Polygon) -> (Vec3, f32) {
    let vertices = || polygon.contours.iter().flatten().map(|vertex| vertex.as_dvec3());
    let (normal, first) = (polygon.normal.as_dvec3(), polygon.contours[0][0].as_dvec3());
    let low = vertices().fold(first, |low, vertex| low.min(vertex));
    let high = vertices().fold(first, |high, vertex| high.max(vertex));
    let middle = 0.5 * (low + high);
    let center = (middle - normal * normal.dot(middle - first)).as_vec3();
    let radius = vertices().map(|vertex| vertex.distance(center.as_dvec3())).fold(0.0, f64::max);
    // Room for the rounding of the shader's comparison, which is one of world coordinates.
    let size = center.abs().max_element() + radius as f32;
    (center, radius as f32 + 1e-6 * size)
}

fn one_punctual(light: &PunctualLight) -> GpuPunctual {
    let (range, cone) = match light.kind {
        PunctualKind::Point { range } => (range, None),
        PunctualKind::Spot { range, inner, outer } => (range, Some((inner, outer))),
        PunctualKind::Directional => (f32::INFINITY, None),
    };
    // KHR_lights_punctual's recommended falloff between the cones' cosines.
    let scale = |(inner, outer): (f32, f32)| 1.0 / (inner.cos() - outer.cos()).max(1e-3);
    let cone_scale = cone.map_or(0.0, scale);
    GpuPunctual {
        intensity: light.intensity,
        inverse_range_squared: range.recip().powi(2),
        position: light.position,
        has_place: f32::from(u8::from(light.kind != PunctualKind::Directional)),
        direction: light.direction,
        cone_scale,
        cone_offset: cone.map_or(1.0, |(_, outer)| -outer.cos() * cone_scale),
        padding: [0; 3],
    }
}

#[cfg(test)]
mod tests {
    use super::super::layout::{differences, members};
    use super::super::surfaces::SURFACES_WGSL;
    use super::*;

    #[test]
    fn structs_stand_as_the_shader_reads_them() {
        let polygon = members!(GpuPolygon { radiance, two_sided, normal, first_vertex, center, radius, end_vertex });
        let punctual = members!(GpuPunctual {
            intensity,
            inverse_range_squared,
            position,
            has_place,
            direction,
            cone_scale,
            cone_offset
        });
        let counts = members!(GpuCounts { quads, polygons, punctual });
        for (name, size, members) in [
            ("PolygonsLight", size_of::<GpuPolygon>(), &polygon[..]),
            ("LightsPunctual", size_of::<GpuPunctual>(), punctual),
            ("LightsCounts", size_of::<GpuCounts>(), counts),
        ] {
            assert_eq!(differences(SURFACES_WGSL, name, size, members), [""; 0]);
        }
    }

    #[test]
    fn a_sphere_holds_all_of_its_polygon() {
        let contours = vec![vec![Vec3::new(5.0, 1.0, 0.0), Vec3::new(9.0, 1.0, 0.001), Vec3::new(5.0, 2.0, -0.001)]];
        let (center, radius) = sphere(&Polygon { contours: contours.clone(), normal: Vec3::Z });
        assert!(contours[0].iter().all(|vertex| vertex.distance(center) <= radius) && radius < 2.2);
        assert!(Vec3::Z.dot(center - contours[0][0]).abs() < 1e-7);
    }
}
