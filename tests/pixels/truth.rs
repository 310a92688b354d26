//! The radiance of a stage at a point of its picture, in `f64` and by hand: a ray, the triangles, the design's sum.

use std::sync::LazyLock;

use glam::{DMat3, DMat4, DVec3, Vec3};
use velour::reference::polygon::form_factor;
use velour::scene::{Edits, Layering, Lobes, Projection, PunctualKind, PunctualLight, Settings, Sheen};
use velour::table::{GgxTable, SheenTable};

use super::stage::{Stage, Thing};

/// The specular base's numbers.
static GGX: LazyLock<GgxTable> = LazyLock::new(GgxTable::embedded);

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
    table: &'a SheenTable,
    edits: &'a Edits,
    settings: Settings,
    size: [u32; 2],
    lights: Vec<Lit>,
}

impl<'a> Truth<'a> {
    pub fn new(stage: &'a Stage, table: &'a SheenTable, edits: &'a Edits, size: [u32; 2]) -> Self {
        let outline = |thing: &Thing| {
            let world_from_mesh = thing.world_from_mesh.as_dmat4();
            let place = |corner: &Vec3| world_from_mesh.transform_point3(corner.as_dvec3());
            let mut contours: Vec<Vec<DVec3>> =
                thing.contours.iter().map(|contour| contour.iter().map(place).collect()).collect();
            if world_from_mesh.determinant() < 0.0 {
                contours.iter_mut().for_each(|contour| contour.reverse());
            }
            let corners = |triangle: &[u32; 3]| triangle.map(|corner| place(&thing.positions[corner as usize]));
            Lit {
                radiance: thing.material.emission.as_dvec3(),
                contours,
                triangles: thing.triangles.iter().map(corners).collect(),
                two_sided: thing.material.double_sided,
            }
        };
        let lights = stage.things.iter().filter(|thing| thing.glows()).map(outline).collect();
        Self { stage, table, edits, settings: edits.settings(), size, lights }
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
        // The direction reaches one unit of depth, so distances along it are depths.
        let direction = world_from_camera.transform_vector3(direction);
        let view = -direction.normalize();
        Ray { origin: world_from_camera.transform_point3(origin), direction, range: [near.into(), far.into()], view }
    }

    /// The design's sum: lobes weighted, over all lights.
    fn radiance(&self, index: usize, &Meeting { p_world, normal, .. }: &Meeting, view: DVec3) -> DVec3 {
        let thing = &self.stage.things[index];
        let look = Look::new(self, index, normal.dot(view).max(0.0));
        let lobes = self.settings.lobes;
        let local_from_world = frame(normal, view).transpose();
        let mut sum = if lobes.emission { thing.material.emission.as_dvec3() } else { DVec3::ZERO };
        for light in &self.lights {
            let local = |corner: &DVec3| local_from_world * (*corner - p_world);
            let contours: Vec<Vec<DVec3>> =
                light.contours.iter().map(|contour| contour.iter().map(local).collect()).collect();
            let form_factor = |m_inv| form_factor(&contours, m_inv, light.two_sided);
            let base = match look.light_side {
                None => look.base_weight,
                Some(_) => light.mean_cosine_weighted(p_world, normal, |mu| look.weight_from(mu)),
            };
            sum += light.radiance * look.reflected(lobes, base, form_factor);
        }
        for light in &self.stage.punctual {
            let (wo, irradiance) = arriving(light, p_world);
            let wo = local_from_world * wo;
            let density = |m_inv: DMat3| {
                let transformed = m_inv * wo;
                wo.z.max(0.0) * m_inv.determinant() / (std::f64::consts::PI * transformed.length().powi(4))
            };
            sum += irradiance * look.reflected(lobes, look.weight_from(wo.z.max(0.0)), density);
        }
        // A uniform environment: each lobe's albedo, and the mean over the hemisphere of what the sheen leaves of the
        // base.
        let mean = |k: i32| 2.0 * (f64::from(k) + 0.5) / 256.0 / 256.0 * look.weight_from((f64::from(k) + 0.5) / 256.0);
        let base = if look.light_side.is_some() { (0..256).map(mean).sum() } else { look.base_weight };
        sum + self.settings.ambient.as_dvec3() * look.reflected(lobes, base, |_| 1.0)
    }
}

/// The layer on a thing, as the design says that edits make it.
#[derive(Clone, Copy)]
struct Fibres {
    color: DVec3,
    weight: f64,
    alpha: f64,
    layering: Layering,
}

impl Fibres {
    fn new(truth: &Truth, thing: usize) -> Option<Self> {
        let own = |index: usize| truth.stage.things[index].material.sheen.filter(|sheen| sheen.weight > 0.0);
        let colored = |index: usize| own(index).filter(|sheen| sheen.color != Vec3::ZERO);
        let set = truth.edits.materials.get(&thing).copied().unwrap_or_default();
        let all = truth.edits.every_material;
        let is_set = set.alpha.is_some() || set.sheen_color.is_some();
        let none_has = !(0..truth.stage.things.len()).any(|index| colored(index).is_some());
        let heeds_all = colored(thing).is_some() || is_set || none_has;
        let alpha = set.alpha.or(all.alpha.filter(|_| heeds_all));
        let color = set.sheen_color.or(all.sheen_color.filter(|_| heeds_all));
        let layering = set.layering.or(all.layering).unwrap_or_default();
        // Black fibres only hide the base, under a rule for which their colour does not count.
        let hiding = own(thing).filter(|_| layering == Layering::OpenPbr);
        let given = (alpha.is_some() || color.is_some()).then(|| Sheen::new(Vec3::ONE, 0.5));
        let start = colored(thing).or(hiding).or(given)?;
        let map = set.roughness_map.or(all.roughness_map).unwrap_or_default();
        let mapped = f64::from(start.roughness).powf(f64::from(map.exponent()));
        Some(Self {
            color: color.unwrap_or(start.color).as_dvec3(),
            weight: if color.is_some() { 1.0 } else { start.weight.into() },
            alpha: alpha.map_or(mapped, f64::from),
            layering,
        })
    }
}

/// A surface as it is seen from one side.
struct Look<'a> {
    table: &'a SheenTable,
    sheen: DVec3,
    sheen_m_inv: DMat3,
    diffuse: DVec3,
    specular: DVec3,
    specular_m_inv: DMat3,
    /// What the sheen leaves of the base as seen from the view.
    base_weight: f64,
    /// Where that depends on the light's cosine too: alpha and the strongest channel of the sheen's colour.
    light_side: Option<(f64, f64)>,
}

impl<'a> Look<'a> {
    fn new(truth: &Truth<'a>, thing: usize, mu: f64) -> Self {
        let material = &truth.stage.things[thing].material;
        let fibres = Fibres::new(truth, thing);
        let color = fibres.map_or(DVec3::ZERO, |fibres| fibres.color * fibres.weight);
        let alpha = fibres.map_or(0.0, |fibres| fibres.alpha);
        let [a, b, r] = truth.table.lookup(alpha, mu);
        let ggx = GGX.lookup(material.roughness.into(), mu);
        let rows = |a: f64, b: f64, c: f64| DMat3::from_cols(DVec3::X * a, DVec3::Y * c, DVec3::new(b, 0.0, 1.0));
        // Fresnel's reflectance, and what light that facets reflect more than once adds.
        let albedo = |f0: DVec3, f90: f64| {
            let once = f0 * (ggx.albedo - ggx.fresnel) + f90 * ggx.fresnel;
            once * (1.0 + f0 * (1.0 / ggx.albedo - 1.0))
        };
        let (metallic, specular) = (f64::from(material.metallic), f64::from(material.specular));
        let base_color = material.base_color.as_dvec3();
        let normal = ((f64::from(material.ior) - 1.0) / (f64::from(material.ior) + 1.0)).powi(2);
        let f0 = (normal * material.specular_color.as_dvec3()).min(DVec3::ONE) * specular;
        let layering = fibres.map_or(Layering::None, |fibres| fibres.layering);
        let base_weight = match layering {
            Layering::Gltf | Layering::Reciprocal => 1.0 - color.max_element() * r,
            Layering::OpenPbr => 1.0 - fibres.map_or(0.0, |fibres| fibres.weight) * r,
            Layering::Manual(share) => share.into(),
            Layering::None | Layering::Walk => 1.0,
        };
        Self {
            table: truth.table,
            sheen: color * r,
            sheen_m_inv: rows(a, b, a),
            diffuse: base_color * (1.0 - metallic) * (1.0 - albedo(f0, specular).max_element()),
            specular: albedo(f0.lerp(base_color, metallic), specular + (1.0 - specular) * metallic),
            specular_m_inv: rows(ggx.ltc.a, ggx.ltc.b, ggx.ltc.c),
            base_weight,
            light_side: (layering == Layering::Reciprocal).then(|| (alpha, color.max_element())),
        }
    }

    /// What the sheen leaves of light of this cosine.
    fn weight_from(&self, mu: f64) -> f64 {
        let light = self.light_side.map(|(alpha, color)| 1.0 - color * self.table.lookup(alpha, mu)[2]);
        light.map_or(self.base_weight, |light| light.min(self.base_weight))
    }

    /// The sum over the lobes that are asked for; `form_factor` is how much light reaches each.
    fn reflected(&self, lobes: Lobes, base: f64, form_factor: impl Fn(DMat3) -> f64) -> DVec3 {
        let mut sum = DVec3::ZERO;
        if lobes.sheen {
            sum += self.sheen * form_factor(self.sheen_m_inv);
        }
        if lobes.diffuse {
            sum += base * self.diffuse * form_factor(DMat3::IDENTITY);
        }
        if lobes.specular && self.specular != DVec3::ZERO {
            sum += base * self.specular * form_factor(self.specular_m_inv);
        }
        sum
    }
}

/// A polygon light in the world.
struct Lit {
    radiance: DVec3,
    contours: Vec<Vec<DVec3>>,
    triangles: Vec<[DVec3; 3]>,
    two_sided: bool,
}

impl Lit {
    /// The mean of a function of the cosine over the light's directions, weighted by the cosine, by a sum over its
    /// area.
    fn mean_cosine_weighted(&self, p_world: DVec3, normal: DVec3, value: impl Fn(f64) -> f64) -> f64 {
        const PARTS: usize = 12;
        let (mut sum, mut weights) = (0.0, 0.0);
        for [a, b, c] in &self.triangles {
            let face = (b - a).cross(c - a);
            for (i, j) in (0..PARTS).flat_map(|i| (0..PARTS).map(move |j| (i, j))) {
                // The square of parameters folded to the triangle.
                let [u, v] = [i, j].map(|k| (k as f64 + 0.5) / PARTS as f64);
                let point = a + u.sqrt() * (1.0 - v) * (b - a) + u.sqrt() * v * (c - a);
                let way = point - p_world;
                let mu = normal.dot(way.normalize()).max(0.0);
                let weight = mu * face.dot(way).abs() / way.length().powi(3);
                (sum, weights) = (sum + weight * value(mu), weights + weight);
            }
        }
        if weights > 0.0 { sum / weights } else { 0.0 }
    }
}

/// The direction from which a light without extent comes, and its irradiance across the ray (KHR_lights_punctual).
fn arriving(light: &PunctualLight, p_world: DVec3) -> (DVec3, DVec3) {
    let (intensity, direction) = (light.intensity.as_dvec3(), light.direction.as_dvec3());
    let way = light.position.as_dvec3() - p_world;
    let falloff = |range: f32| (1.0 - (way.length() / f64::from(range)).powi(4)).clamp(0.0, 1.0) / way.length_squared();
    match light.kind {
        PunctualKind::Directional => (-direction, intensity),
        PunctualKind::Point { range } => (way.normalize(), intensity * falloff(range)),
        PunctualKind::Spot { range, inner, outer } => {
            let cosine = direction.dot(-way.normalize());
            let (inner, outer) = (f64::from(inner).cos(), f64::from(outer).cos());
            let cone = ((cosine - outer) / (inner - outer).max(1e-9)).clamp(0.0, 1.0).powi(2);
            (way.normalize(), intensity * falloff(range) * cone)
        }
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
