//! Lights as the shaders read them.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3, Vec4};

use super::patterns::{GpuSheet, Patterns, Shown};
use crate::math::quadrature::gauss_legendre;
use crate::scene::{Drawn, Light, Polygon, PunctualKind, PunctualLight};

/// `EmittersPolygon` of `emitters.wgsl`.
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
    first_point: u32,
    end_point: u32,
    light: u32,
    first_part_vertex: u32,
    end_part_vertex: u32,
    pattern: u32,
    pattern_texels: f32,
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
    cone_versine: f32,
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

/// Points on each polygon, all its pieces together, at which sheens without a closed form are summed; there are more where it has many triangles.
const POINTS: f64 = 128.0;

/// Which kinds of lights there are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct LightKinds {
    /// Polygons of one outline of four vertices.
    pub quads: bool,
    /// Any other polygons.
    pub polygons: bool,
    pub punctual: bool,
    /// Polygons with patterns.
    pub patterns: bool,
}

fn is_quad(polygon: &Polygon) -> bool {
    polygon.contours.len() == 1 && polygon.contours[0].len() == 4
}

/// The lights of a scene as the shaders read them.
pub(super) struct GpuLights {
    pub counts: GpuCounts,
    /// Quads first.
    pub polygons: Vec<GpuPolygon>,
    /// Outlines: the first vertex of each is marked by w = 1, and is repeated at its end with w = -1.
    pub vertices: Vec<Vec4>,
    pub punctual: Vec<GpuPunctual>,
    /// Points on the polygons, with the areas that they stand for as w; empty where they are not needed.
    pub points: Vec<Vec4>,
    /// The polygons' patterns.
    pub sheets: Vec<GpuSheet>,
}

impl GpuLights {
    /// The lights of a scene; with points on them where `sampled`. `patterns` take what they show.
    pub fn new(drawn: &Drawn, sampled: bool, patterns: &mut Patterns) -> Self {
        let (mut polygons, mut vertices, mut points) = (Vec::new(), Vec::new(), Vec::new());
        let mut sheets = Vec::new();
        // Black lights contribute nothing and are left out.
        let lit = || drawn.lights.iter().enumerate().filter(|(_, light)| light.radiance != Vec3::ZERO);
        let all = lit().flat_map(|(index, light)| (0..).zip(&light.polygons).map(move |(at, of)| ([index, at], of)));
        let pieces = all.flat_map(|(indices, polygon)| {
            let [light, at] = indices;
            // Copies show what they are copies of.
            let of = [drawn.loaded_light(light).unwrap_or(light), at];
            patterns.shown(of, polygon, &mut sheets).into_iter().map(move |shown| (light, shown))
        });
        let pieces: Vec<(usize, Shown)> = pieces.collect();
        let mut add = |quads: bool| {
            for (index, shown) in pieces.iter().filter(|(_, shown)| is_quad(&shown.polygon) == quads) {
                let first_point = points.len() as u32;
                if sampled {
                    points.extend(spread(&shown.polygon, POINTS * shown.share));
                }
                let of_points = first_point..points.len() as u32;
                let polygon = gpu_polygon(&drawn.lights[*index], shown, &mut vertices, of_points);
                polygons.push(GpuPolygon { light: *index as u32, ..polygon });
            }
            polygons.len() as u32
        };
        let (quads, all) = (add(true), add(false));
        let punctual: Vec<GpuPunctual> = drawn.punctual_lights.iter().map(one_punctual).collect();
        let counts = GpuCounts { quads, polygons: all, punctual: punctual.len() as u32 };
        Self { counts, polygons, vertices, punctual, points, sheets }
    }

    pub fn kinds(&self) -> LightKinds {
        let GpuCounts { quads, polygons, punctual } = self.counts;
        let patterns = !self.sheets.is_empty();
        LightKinds { quads: quads > 0, polygons: polygons > quads, punctual: punctual > 0, patterns }
    }
}

/// Adds the vertices of the polygon's outlines.
fn gpu_polygon(light: &Light, shown: &Shown, vertices: &mut Vec<Vec4>, points: Range<u32>) -> GpuPolygon {
    let polygon = &shown.polygon;
    let first_vertex = vertices.len() as u32;
    polygon.contours.iter().for_each(|contour| add_outline(contour, vertices));
    let end_vertex = vertices.len() as u32;
    let convex = polygon.convex_parts();
    // A convex polygon is its own part.
    let parts = if polygon.contours.len() == 1 && convex.len() == 1 {
        first_vertex..end_vertex
    } else {
        for part in convex {
            add_outline(&part.iter().map(|vertex| vertex.as_vec3()).collect::<Vec<_>>(), vertices);
        }
        end_vertex..vertices.len() as u32
    };
    let (center, radius) = sphere(polygon);
    GpuPolygon {
        radiance: light.radiance * shown.factor,
        two_sided: light.two_sided.into(),
        normal: polygon.normal,
        first_vertex,
        center,
        radius,
        end_vertex,
        first_point: points.start,
        end_point: points.end,
        light: 0,
        first_part_vertex: parts.start,
        end_part_vertex: parts.end,
        pattern: shown.pattern,
        pattern_texels: shown.texels,
    }
}

/// An outline's vertices as shaders read them.
fn add_outline(outline: &[Vec3], vertices: &mut Vec<Vec4>) {
    vertices.extend(outline.iter().enumerate().map(|(i, p)| p.extend(if i == 0 { 1.0 } else { 0.0 })));
    vertices.extend(outline.first().map(|first| first.extend(-1.0)));
}

/// A sphere around a polygon. Its centre lies in the polygon's plane through the first vertex, so that a point is on
/// the same side of the light whichever of the two it is compared with.
fn sphere(polygon: &Polygon) -> (Vec3, f32) {
    let vertices = || polygon.contours.iter().flatten().map(|vertex| vertex.as_dvec3());
    let (normal, first) = (polygon.normal.as_dvec3(), polygon.contours[0][0].as_dvec3());
    let low = vertices().fold(first, |low, vertex| low.min(vertex));
    let high = vertices().fold(first, |high, vertex| high.max(vertex));
    let middle = 0.5 * (low + high);
    let center = (middle - normal * normal.dot(middle - first)).as_vec3();
    let radius = vertices().map(|vertex| vertex.distance(center.as_dvec3())).fold(0.0, f64::max);
    // Room for rounding in the shader's comparison, which is made in world coordinates.
    let size = center.abs().max_element() + radius as f32;
    (center, radius as f32 + 1e-6 * size)
}

/// Points on a polygon with the areas that they stand for, so many of them on a rectangle. Each triangle gets a
/// product of two Gauss-Legendre rules, one along the way from a corner to the opposite side and one across it, with as
/// many nodes as its share of the area calls for.
///
/// Functions that are smooth over the light are integrated far better than by as many points at random or in a
/// low-discrepancy sequence.
fn spread(polygon: &Polygon, count: f64) -> Vec<Vec4> {
    let parts = polygon.convex_parts();
    let fan = |part: &Vec<DVec3>| -> Vec<[DVec3; 3]> {
        part.windows(2).skip(1).map(|pair| [part[0], pair[0], pair[1]]).collect()
    };
    let triangles: Vec<[DVec3; 3]> = parts.iter().flat_map(fan).collect();
    let twice_area = |[a, b, c]: &[DVec3; 3]| (b - a).cross(c - a).length();
    let whole: f64 = triangles.iter().map(twice_area).sum();
    let mut points = Vec::new();
    for triangle in triangles.iter().filter(|triangle| twice_area(triangle) > 0.0) {
        let [a, b, c] = *triangle;
        let twice_area = twice_area(triangle);
        // Reduced by a rounding error, so that each half of a rectangle gets half of the points and not a row more.
        let side = ((count * twice_area / whole).sqrt() - 1e-6).ceil().max(1.0);
        let nodes = gauss_legendre(side as usize, 0.0, 1.0);
        for &(along, along_weight) in &nodes {
            for &(across, across_weight) in &nodes {
                let point = a + along * (b - a + across * (c - b));
                let area = twice_area * along * along_weight * across_weight;
                points.push(point.as_vec3().extend(area as f32));
            }
        }
    }
    points
}

fn one_punctual(light: &PunctualLight) -> GpuPunctual {
    let (range, cone) = match light.kind {
        PunctualKind::Point { range } => (range, None),
        PunctualKind::Spot { range, inner, outer } => (range, Some((inner, outer))),
        PunctualKind::Directional => (f32::INFINITY, None),
    };
    // KHR_lights_punctual's falloff between the cones' cosines, by 1 - cos; where these are equal, as steep as they
    // can be told apart. Without a cone all directions are well within.
    let (cone_versine, cone_scale) = cone.map_or((4.0, 1.0), |(inner, outer)| {
        let [inner, outer] = [inner, outer].map(|angle| 2.0 * (0.5 * f64::from(angle)).sin().powi(2));
        (outer as f32, (outer - inner).max(outer * f64::from(f32::EPSILON)).recip().min(f64::from(f32::MAX)) as f32)
    });
    GpuPunctual {
        intensity: light.intensity,
        inverse_range_squared: range.recip().powi(2),
        position: light.position,
        has_place: f32::from(u8::from(light.kind != PunctualKind::Directional)),
        direction: light.direction,
        cone_scale,
        cone_versine,
        padding: [0; 3],
    }
}

#[cfg(test)]
mod tests {
    use super::super::layout::{differences, members};
    use super::super::shader::SURFACES_WGSL;
    use super::*;

    #[test]
    fn structs_stand_as_the_shader_reads_them() {
        let polygon = members!(GpuPolygon {
            radiance,
            two_sided,
            normal,
            first_vertex,
            center,
            radius,
            end_vertex,
            first_point,
            end_point,
            light,
            first_part_vertex,
            end_part_vertex,
            pattern,
            pattern_texels
        });
        let punctual = members!(GpuPunctual {
            intensity,
            inverse_range_squared,
            position,
            has_place,
            direction,
            cone_scale,
            cone_versine
        });
        let counts = members!(GpuCounts { quads, polygons, punctual });
        for (name, size, members) in [
            ("EmittersPolygon", size_of::<GpuPolygon>(), &polygon[..]),
            ("LightsPunctual", size_of::<GpuPunctual>(), punctual),
            ("LightsCounts", size_of::<GpuCounts>(), counts),
        ] {
            assert_eq!(differences(SURFACES_WGSL, name, size, members), [""; 0]);
        }
    }

    /// The points have the moments of the area without its holes.
    #[test]
    fn points_are_even_over_a_polygon() {
        let square = |half: f32| [[-half, -half], [half, -half], [half, half], [-half, half]];
        let place = |[x, y]: [f32; 2]| Vec3::new(x + 3.0, 1.0, -y);
        let outer: Vec<Vec3> = square(2.0).into_iter().map(place).collect();
        let hole: Vec<Vec3> = square(1.0).into_iter().rev().map(place).collect();
        let points = spread(&Polygon { contours: vec![outer.clone(), hole], normal: Vec3::Y, pattern: None }, POINTS);
        assert!((128..256).contains(&points.len()), "{}", points.len());
        let flat: Vec<[f32; 2]> = points.iter().map(|point| [point.x - 3.0, point.z]).collect();
        assert!(points.iter().all(|point| point.y == 1.0));
        assert!(flat.iter().all(|[x, y]| (1.0..=2.0).contains(&x.abs().max(y.abs()))), "{flat:?}");
        let sum = |moment: &dyn Fn(&[f32; 2]) -> f32| -> f32 {
            flat.iter().zip(&points).map(|(at, point)| moment(at) * point.w).sum()
        };
        for (found, expected) in [
            (sum(&|_| 1.0), 12.0),
            (sum(&|[x, _]| *x), 0.0),
            (sum(&|[_, y]| *y), 0.0),
            (sum(&|[x, _]| x * x), (64.0 - 4.0) / 3.0),
            (sum(&|[x, y]| x * y), 0.0),
        ] {
            assert!((found - expected).abs() < 1e-4, "{found}, not {expected}");
        }
        let square = Polygon { contours: vec![outer], normal: Vec3::Y, pattern: None };
        assert_eq!([POINTS, POINTS / 4.0].map(|count| spread(&square, count).len()), [128, 32]);
        let narrow =
            Polygon { contours: vec![vec![Vec3::X, 2.0 * Vec3::X, 3.0 * Vec3::X]], normal: Vec3::Z, pattern: None };
        assert!(spread(&narrow, POINTS).iter().all(|point| point.is_finite()));
    }

    #[test]
    fn a_sphere_holds_all_of_its_polygon() {
        let contours = vec![vec![Vec3::new(5.0, 1.0, 0.0), Vec3::new(9.0, 1.0, 0.001), Vec3::new(5.0, 2.0, -0.001)]];
        let (center, radius) = sphere(&Polygon { contours: contours.clone(), normal: Vec3::Z, pattern: None });
        assert!(contours[0].iter().all(|vertex| vertex.distance(center) <= radius) && radius < 2.2);
        assert!(Vec3::Z.dot(center - contours[0][0]).abs() < 1e-7);
    }
}
