//! Whether polygon lights show a scene's subject, or are too faint to see it by, as labels and indicators are.
//!
//! What counts is the radiance that a white, matte surface would have in the subject's place, as if nothing cast a
//! shadow.

use std::f64::consts::PI;

use glam::{DMat3, DVec3};

use super::emission::spread;
use super::{Instance, Light, Scene};

/// Lights are faint that would give less than this to a white, matte surface which faces all of them from as far as the
/// subject reaches from its middle.
const FAINT: f64 = 0.001;
/// The least radiance that is seen: code 6 of 255 in a .png, before a tone curve.
const SEEN: f64 = 0.002;
/// The share of the subject's surface on which it has to be reached.
const SHARE: f64 = 0.02;
/// About how many points are spread over the subject's surface.
const POINTS: usize = 1024;
/// The most triangles that rays from lights are held against.
const TESTS_MAX: usize = 1 << 26;

/// A light's flat part as it is seen from afar.
struct Source {
    center: DVec3,
    /// Area along the normal.
    area: DVec3,
    two_sided: bool,
    /// The greatest of the light's three channels.
    radiance: f64,
}

/// A point of the subject.
struct Receiver {
    point: DVec3,
    /// Unit.
    normal: DVec3,
    two_sided: bool,
    /// Of the surface for which it stands, m^2.
    area: f64,
}

/// Whether the lights of a scene show its subject. All do but faint ones, of which all areas times radiances together
/// are below 0.001 pi times the square of the subject's radius; and these do, too, if on 2% of the subject's surface, or
/// where they shine straight at it, it would have a radiance of 0.002. Lights without extent always show it, and what
/// is nothing but lamps shows itself.
pub(super) fn shows_subject(scene: &Scene) -> bool {
    let mut sources: Vec<Source> = scene.lights.iter().flat_map(sources).collect();
    let power: f64 = sources.iter().map(Source::power).sum();
    let reach = f64::from(scene.subject().radius());
    if !scene.punctual_lights.is_empty() || power >= FAINT * PI * reach * reach {
        return true;
    }
    let receivers = receivers(scene);
    let whole: f64 = receivers.iter().map(|receiver| receiver.area).sum();
    let seen = receivers.iter().filter(|receiver| radiance(receiver, &sources) >= SEEN);
    let seen: f64 = seen.map(|receiver| receiver.area).sum();
    seen >= SHARE * whole || shines_at_subject(scene, &mut sources)
}

impl Source {
    fn power(&self) -> f64 {
        self.radiance * self.area.length()
    }
}

fn sources(light: &Light) -> impl Iterator<Item = Source> {
    let radiance = f64::from(light.radiance.max_element());
    light.polygons.iter().map(move |polygon| {
        let origin = polygon.contours[0][0].as_dvec3();
        let edges = || {
            polygon.contours.iter().flat_map(|contour| {
                let next = contour.iter().cycle().skip(1);
                contour.iter().zip(next).map(|(p, q)| (p.as_dvec3() - origin, q.as_dvec3() - origin))
            })
        };
        let normal = polygon.normal.as_dvec3();
        // Triangles from the origin, those of negative areas among them.
        let area: f64 = edges().map(|(p, q)| 0.5 * p.cross(q).dot(normal)).sum();
        let moment: DVec3 = edges().map(|(p, q)| 0.5 * p.cross(q).dot(normal) * (p + q) / 3.0).sum();
        let center = origin + if area > 0.0 { moment / area } else { DVec3::ZERO };
        Source { center, area: area.max(0.0) * normal, two_sided: light.two_sided, radiance }
    })
}

/// All that is no lamp.
fn subject(scene: &Scene) -> impl Iterator<Item = &Instance> {
    let mut is_lamp = vec![false; scene.instances.len()];
    for light in scene.lights.iter().filter(|light| light.is_lamp()) {
        light.emitters().for_each(|emitter| is_lamp[emitter] = true);
    }
    scene.instances.iter().zip(is_lamp).filter(|(_, is_lamp)| !is_lamp).map(|(instance, _)| instance)
}

/// Points spread over the subject's surface.
fn receivers(scene: &Scene) -> Vec<Receiver> {
    let count: usize = subject(scene).map(|instance| scene.meshes[instance.mesh].indices.len() / 3).sum();
    let (step, points) = ((count / POINTS).max(1), (POINTS / count.max(1)).max(1));
    let mut receivers = Vec::new();
    let mut passed = 0;
    for instance in subject(scene) {
        let mesh = &scene.meshes[instance.mesh];
        let triangles = mesh.indices.as_chunks::<3>().0;
        let two_sided = scene.materials[mesh.material].double_sided;
        let world_from_mesh = instance.world_from_mesh.as_dmat4();
        let world_from_normal: DMat3 = instance.world_from_normal().as_dmat3();
        // Every step-th of all triangles.
        for triangle in triangles.iter().skip((step - passed % step) % step).step_by(step) {
            let [a, b, c] =
                triangle.map(|corner| world_from_mesh.transform_point3(mesh.positions[corner as usize].as_dvec3()));
            let normals = triangle.map(|corner| mesh.normals[corner as usize].as_dvec3());
            let area = 0.5 * (b - a).cross(c - a).length() / points as f64;
            for at in (0..points as u32).map(spread) {
                let normal = normals[0] + at.x * (normals[1] - normals[0]) + at.y * (normals[2] - normals[0]);
                let normal = (world_from_normal * normal).normalize_or_zero();
                receivers.push(Receiver { point: a + at.x * (b - a) + at.y * (c - a), normal, two_sided, area });
            }
        }
        passed += triangles.len();
    }
    receivers
}

/// Of a white, matte surface: form factors are those of small sources, and never more than 1.
fn radiance(receiver: &Receiver, sources: &[Source]) -> f64 {
    let of_source = |source: &Source| {
        let way = source.center - receiver.point;
        let facing = -source.area.dot(way);
        let facing = if source.two_sided { facing.abs() } else { facing.max(0.0) };
        let square = way.length_squared();
        let turned = receiver.normal.dot(way);
        let turned = if receiver.two_sided { turned.abs() } else { turned.max(0.0) };
        let spread = square * (PI * square + source.area.length());
        if spread > 0.0 { source.radiance * turned * facing / spread } else { 0.0 }
    };
    sources.iter().map(of_source).sum()
}

/// Whether any light is bright enough where it shines straight at a surface: what is far from all points may be near a
/// light. The brightest lights are tried, as many as [`TESTS_MAX`] allows.
fn shines_at_subject(scene: &Scene, sources: &mut [Source]) -> bool {
    let triangles: usize = subject(scene).map(|instance| scene.meshes[instance.mesh].indices.len() / 3).sum();
    sources.sort_by(|left, right| right.power().total_cmp(&left.power()));
    let tried = sources.iter().take(TESTS_MAX / triangles.max(1));
    let sides = tried.flat_map(|source| {
        let normal = source.area.normalize_or_zero();
        std::iter::once((source, normal)).chain(source.two_sided.then_some((source, -normal)))
    });
    sides.into_iter().any(|(source, direction)| {
        // Not the surface on which it lies.
        let least = 1e-3 * source.area.length().sqrt();
        let met = subject(scene).filter_map(|instance| met(scene, instance, [source.center, direction], least));
        let nearest = met.min_by(|left, right| left.0.total_cmp(&right.0));
        nearest.is_some_and(|(_, receiver)| radiance(&receiver, std::slice::from_ref(source)) >= SEEN)
    })
}

/// The nearest point of an instance that a ray meets from the front beyond a distance, with its distance.
fn met(scene: &Scene, instance: &Instance, [origin, direction]: [DVec3; 2], least: f64) -> Option<(f64, Receiver)> {
    let mesh = &scene.meshes[instance.mesh];
    let two_sided = scene.materials[mesh.material].double_sided;
    let world_from_mesh = instance.world_from_mesh.as_dmat4();
    let side = if instance.mirrors() { -1.0 } else { 1.0 };
    let of_triangle = |triangle: &[u32; 3]| {
        let place = |corner: u32| world_from_mesh.transform_point3(mesh.positions[corner as usize].as_dvec3());
        let [a, b, c] = triangle.map(place);
        let normal = side * (b - a).cross(c - a).normalize_or_zero();
        let DVec3 { x, y, z } = DMat3::from_cols(b - a, c - a, -direction).inverse() * (origin - a);
        let is_inside = x >= 0.0 && y >= 0.0 && x + y <= 1.0 && z > least;
        let is_front = two_sided || normal.dot(direction) < 0.0;
        let receiver = Receiver { point: origin + z * direction, normal, two_sided, area: 0.0 };
        (is_inside && is_front).then_some((z, receiver))
    };
    let all = mesh.indices.as_chunks::<3>().0.iter().filter_map(of_triangle);
    all.min_by(|left, right| left.0.total_cmp(&right.0))
}
