//! Lights as paths find them: polygons cut into convex parts, and lights without extent.

use glam::{DMat3, DVec3};
use smallvec::SmallVec;

use super::patterned::{SeenTexels, Texels};
use crate::reference::convex::{Convex, Outline, clip, cosine_share, edges};
use crate::scene::{Drawn, Light, Polygon, PunctualKind, PunctualLight};
use crate::table::Ltc;

/// A point is in a light's plane where its distance from it is at most this share of the largest coordinate, as in real
/// time: emitters are stored in `f32`, and no light shines on itself.
const IN_PLANE: f64 = 1e-6;
/// Least distance to a light without extent, metres.
const NEAREST: f64 = 1e-6;

/// A convex part of a polygon light.
pub(super) struct Part {
    vertices: Vec<DVec3>,
    normal: DVec3,
    /// The light's, of which its texels are factors.
    radiance: DVec3,
    texels: Option<Texels>,
    two_sided: bool,
    /// Its emitter, in `Scene::instances`.
    instance: usize,
    /// Of a sphere around it.
    center: DVec3,
    radius: f64,
}

/// All lights of a scene.
pub(super) struct Lights<'a> {
    parts: Vec<Part>,
    pub punctual: &'a [PunctualLight],
}

/// A part as a point sees it: as much of it as is above the horizon, in the point's frame.
pub(super) struct Seen<'a> {
    part: &'a Part,
    index: usize,
    outline: Outline,
    texels: Option<SeenTexels<'a>>,
}

/// A direction that is lit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lit {
    /// Unit, in the point's frame.
    pub wo: DVec3,
    pub radiance: DVec3,
    /// That of the whole light, of which the radiance is what its texel makes.
    pub mean: DVec3,
    /// How many samples of texels are expected per steradian; none where the light has no pattern.
    pub by_texels: Option<f64>,
    pub distance: f64,
    /// Its emitter, in `Scene::instances`.
    pub instance: usize,
    /// Index among the parts of all lights.
    pub part: usize,
}

impl<'a> Lights<'a> {
    pub fn new(drawn: &'a Drawn) -> Self {
        let lit = drawn.lights.iter().filter(|light| light.radiance != glam::Vec3::ZERO);
        let parts = lit.flat_map(|light| light.polygons.iter().flat_map(move |polygon| parts(light, polygon)));
        Self { parts: parts.collect(), punctual: &drawn.punctual_lights }
    }

    /// The parts that a point sees, in the point's frame; `up` is the interpolated normal in it, from which a normal
    /// map turns away.
    pub fn seen(&self, p_world: DVec3, local_from_world: DMat3, up: DVec3) -> SmallVec<[Seen<'_>; 4]> {
        let seen = |part: &'_ Part| {
            let to_vertex = part.vertices[0] - p_world;
            let height = -part.normal.dot(to_vertex);
            let size = (p_world.abs() + to_vertex.abs()).max_element();
            if height.abs() <= IN_PLANE * size || (height < 0.0 && !part.two_sided) {
                return None;
            }
            if local_from_world.row(2).dot(part.center - p_world) < -part.radius {
                return None;
            }
            let outline: Outline = part.vertices.iter().map(|vertex| local_from_world * (*vertex - p_world)).collect();
            let mut outline = clip(&outline, DVec3::Z);
            if up != DVec3::Z {
                outline = clip(&outline, up);
            }
            (outline.len() >= 3).then_some(outline)
        };
        let place = move |point: DVec3| local_from_world * (point - p_world);
        let parts = self.parts.iter().enumerate().filter_map(|(index, part)| {
            let texels = || part.texels.as_ref().map(|texels| texels.seen(place));
            seen(part).map(|outline| Seen { part, index, outline, texels: texels() })
        });
        parts.collect()
    }
}

impl Seen<'_> {
    /// Index among the parts of all lights.
    pub fn index(&self) -> usize {
        self.index
    }

    /// The light's, whatever its pattern.
    pub fn radiance(&self) -> DVec3 {
        self.part.radiance
    }

    pub fn is_patterned(&self) -> bool {
        self.texels.is_some()
    }

    /// The share of a transformed cosine that falls on it.
    pub fn share(&self, ltc: &Ltc) -> f64 {
        cosine_share(&self.transformed(ltc)).abs()
    }

    fn transformed(&self, ltc: &Ltc) -> Outline {
        let place = |v: &DVec3| DVec3::new(ltc.a * v.x + ltc.b * v.z, ltc.c * v.y, v.z.max(0.0));
        self.outline.iter().map(place).collect()
    }

    /// A direction with the transformed cosine's density over its share.
    pub fn sample(&self, ltc: &Ltc, uniforms: [f64; 2]) -> Option<Lit> {
        let cosine = Convex::new(&self.transformed(ltc)).sample(uniforms)?;
        let wo = ltc.direction(cosine);
        Some(self.lit(wo)).filter(|_| wo.z > 0.0)
    }

    /// A direction in which a texel lies, by the light that texels send; none where it is not seen there.
    pub fn sample_texels(&self, choice: f64, uniforms: [f64; 2]) -> Option<Lit> {
        let point = self.texels.as_ref()?.sample(choice, uniforms)?;
        self.along(point.try_normalize()?).filter(|lit| lit.wo.z > 0.0)
    }

    fn lit(&self, wo: DVec3) -> Lit {
        // The outline is cut, but still in the part's plane: all its corners together span that best.
        let normal: DVec3 = edges(&self.outline).map(|(p, q)| (p - self.outline[0]).cross(q - self.outline[0])).sum();
        let distance = normal.dot(self.outline[0]) / normal.dot(wo);
        let distance = if distance.is_finite() { distance.abs() } else { self.outline[0].length() };
        let mean = self.part.radiance;
        let (radiance, by_texels) = self.texels.as_ref().map_or((mean, None), |texels| {
            let (factor, by_area) = texels.at(distance * wo);
            let across = normal.normalize_or_zero().dot(wo).abs();
            (mean * factor, Some(by_area * distance * distance / across.max(f64::MIN_POSITIVE)))
        });
        Lit { wo, radiance, mean, by_texels, distance, instance: self.part.instance, part: self.index }
    }

    /// Where a direction meets it, if it does.
    pub fn along(&self, wo: DVec3) -> Option<Lit> {
        let sides = || edges(&self.outline).map(|(p, q)| p.cross(q).dot(wo));
        let inside = sides().all(|side| side >= 0.0) || sides().all(|side| side <= 0.0);
        let ahead = self.outline.iter().sum::<DVec3>().dot(wo) > 0.0 || self.outline.iter().any(|v| v.dot(wo) > 0.0);
        (inside && ahead).then(|| self.lit(wo))
    }
}

/// The convex parts of one of a light's polygons.
fn parts(light: &Light, polygon: &Polygon) -> impl Iterator<Item = Part> {
    polygon.convex_parts().into_iter().map(|vertices| Part {
        center: middle(&vertices),
        radius: vertices.iter().map(|vertex| vertex.distance(middle(&vertices))).fold(0.0, f64::max),
        texels: polygon.pattern.as_ref().map(|pattern| Texels::new(pattern, light.radiance.as_dvec3(), &vertices)),
        vertices,
        normal: polygon.normal.as_dvec3(),
        radiance: light.radiance.as_dvec3(),
        two_sided: light.two_sided,
        instance: light.instance,
    })
}

/// What a light without extent sends to a point: the direction to it, the distance (infinite for directional ones), and
/// the irradiance across the ray (KHR_lights_punctual).
pub(super) fn arriving(light: &PunctualLight, p_world: DVec3) -> (DVec3, f64, DVec3) {
    let (intensity, direction) = (light.intensity.as_dvec3(), light.direction.as_dvec3());
    let way = light.position.as_dvec3() - p_world;
    let distance = way.length().max(NEAREST);
    let falloff = |range: f32| (1.0 - (distance / f64::from(range)).powi(4)).clamp(0.0, 1.0) / (distance * distance);
    match light.kind {
        PunctualKind::Directional => (-direction, f64::INFINITY, intensity),
        PunctualKind::Point { range } => (way / distance, distance, intensity * falloff(range)),
        PunctualKind::Spot { range, inner, outer } => {
            let cosine = direction.dot(-way / distance);
            let [inner, outer] = [inner, outer].map(|angle| f64::from(angle).cos());
            let cone = match inner > outer {
                true => ((cosine - outer) / (inner - outer)).clamp(0.0, 1.0).powi(2),
                false => f64::from(u8::from(cosine > outer)),
            };
            (way / distance, distance, intensity * falloff(range) * cone)
        }
    }
}

fn middle(vertices: &[DVec3]) -> DVec3 {
    vertices.iter().sum::<DVec3>() / vertices.len().max(1) as f64
}
