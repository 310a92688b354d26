//! Emitters that overlap in one plane: what is seen shines once.

use glam::{DVec2, DVec3, Vec3};
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::simplify::SimplifyShape;
use i_overlay::float::single::SingleFloatOverlay;

use super::outline::crosses;
use super::{Bounds, Light, Polygon};

/// How far from a polygon's plane the vertices of another may lie to be in it, relative to the size of both: what
/// rounding leaves of doubled faces, and less than anyone keeps two faces apart by.
const PLANE_TOLERANCE: f64 = 1e-5;
/// The share of the smaller of two polygons up to which an overlap is the rounding of a common edge.
const AREA_TOLERANCE: f64 = 1e-5;
/// How near to a vertex the library's grid may have moved it, relative to the polygon's size.
const SNAP_TOLERANCE: f64 = 1e-7;

type Contour = Vec<[f64; 2]>;

/// Makes what overlaps in one plane, and shines to the same side, shine once: of two polygons the one that comes first
/// keeps the overlap, those that shine to both sides before all others. A light of which nothing is left is taken out,
/// and its emitter becomes one of the light's that covers it.
///
/// The time grows with the square of the number of polygons.
pub(super) fn separate(lights: &mut Vec<Light>) {
    for light in lights.iter_mut() {
        light.polygons.iter_mut().for_each(simplify);
    }
    let mut faces: Vec<Face> = Vec::new();
    let mut covers: Vec<Option<usize>> = vec![None; lights.len()];
    let (both, one): (Vec<usize>, Vec<usize>) = (0..lights.len()).partition(|&light| lights[light].two_sided);
    for light in both.into_iter().chain(one) {
        let two_sided = lights[light].two_sided;
        let own = std::mem::take(&mut lights[light].polygons);
        let first = faces.len();
        for polygon in own {
            let face = Face::new(light, two_sided, polygon);
            match face.without(&faces) {
                Ok(rest) => faces.push(rest),
                Err(cover) => covers[light] = covers[light].or(Some(faces[cover].light)),
            }
        }
        let is_left = faces.len() > first;
        covers[light] = covers[light].filter(|_| !is_left);
    }
    faces.sort_by_key(|face| face.light);
    faces.into_iter().for_each(|face| lights[face.light].polygons.push(face.polygon));
    for (light, cover) in covers.into_iter().enumerate() {
        if let Some(cover) = cover {
            let emitter = lights[light].instance;
            lights[cover].doubles.push(emitter);
        }
    }
    lights.retain(|light| !light.polygons.is_empty());
}

/// Replaces an outline that crosses or repeats itself by that of what it covers.
fn simplify(polygon: &mut Polygon) {
    if polygon.contours.len() == 1 && !crosses(&polygon.contours, polygon.normal) {
        return;
    }
    let plane = Plane::new(polygon);
    let contours = plane.flattened(&polygon.contours);
    let covered: Vec<Contour> = contours.simplify_shape(FillRule::NonZero).into_iter().flatten().collect();
    if (area(&contours) - area(&covered)).abs() > AREA_TOLERANCE * area(&contours) {
        polygon.contours = plane.lifted(covered, &polygon.contours);
    }
}

/// A polygon among those of all lights.
struct Face {
    /// Its index.
    light: usize,
    two_sided: bool,
    polygon: Polygon,
    bounds: Bounds,
    size: f64,
}

impl Face {
    fn new(light: usize, two_sided: bool, polygon: Polygon) -> Self {
        let vertices: Vec<Vec3> = polygon.contours.iter().flatten().copied().collect();
        let bounds = Bounds::of_points(&vertices);
        Self { light, two_sided, polygon, bounds, size: bounds.diagonal() }
    }

    /// What is left of it beside the faces before it; the index of one that overlaps it where nothing is.
    fn without(mut self, before: &[Face]) -> Result<Self, usize> {
        for (index, other) in before.iter().enumerate() {
            if !self.is_in_plane_of(other) {
                continue;
            }
            let plane = Plane::new(&self.polygon);
            let [own, others] = [&self.polygon, &other.polygon].map(|polygon| plane.flattened(&polygon.contours));
            let common: Vec<Contour> =
                own.overlay(&others, OverlayRule::Intersect, FillRule::NonZero).into_iter().flatten().collect();
            let whole = area(&own);
            if area(&common) <= AREA_TOLERANCE * whole.min(area(&others).abs()) {
                continue;
            }
            let rest = own.overlay(&others, OverlayRule::Difference, FillRule::NonZero);
            let is_left = |shape: &Vec<Contour>| area(shape) > AREA_TOLERANCE * whole;
            let rest: Vec<Contour> = rest.into_iter().filter(is_left).flatten().collect();
            if rest.is_empty() {
                return Err(index);
            }
            self.polygon.contours = plane.lifted(rest, &self.polygon.contours);
        }
        Ok(self)
    }

    /// Whether two faces lie in one plane, and shine to the same side of it in places that are not apart.
    fn is_in_plane_of(&self, other: &Self) -> bool {
        let tolerance = self.tolerance().max(other.tolerance());
        let apart = |axis: usize| {
            let gap =
                (self.bounds.min[axis] - other.bounds.max[axis]).max(other.bounds.min[axis] - self.bounds.max[axis]);
            f64::from(gap) > tolerance
        };
        let side = self.polygon.normal.dot(other.polygon.normal);
        let is_same_side = side > 0.0 || ((self.two_sided || other.two_sided) && side < 0.0);
        if !is_same_side || (0..3).any(apart) {
            return false;
        }
        // The larger one knows better where its plane is.
        let (larger, smaller) = if self.size >= other.size { (self, other) } else { (other, self) };
        let plane = Plane::new(&larger.polygon);
        let vertices = smaller.polygon.contours.iter().flatten();
        vertices.map(|vertex| plane.height(*vertex)).all(|height| height.abs() <= tolerance)
    }

    fn tolerance(&self) -> f64 {
        let reach = self.bounds.min.abs().max(self.bounds.max.abs()).max_element();
        PLANE_TOLERANCE * self.size + 4.0 * f64::from(f32::EPSILON * reach)
    }
}

/// A polygon's plane: x and y within it, counter-clockwise seen from the emitting side.
struct Plane {
    origin: DVec3,
    x: DVec3,
    y: DVec3,
    normal: DVec3,
}

impl Plane {
    fn new(polygon: &Polygon) -> Self {
        let normal = polygon.normal.as_dvec3().normalize_or(DVec3::Z);
        let (x, y) = normal.any_orthonormal_pair();
        Self { origin: polygon.contours[0][0].as_dvec3(), x, y, normal }
    }

    fn height(&self, vertex: Vec3) -> f64 {
        self.normal.dot(vertex.as_dvec3() - self.origin)
    }

    fn flattened(&self, contours: &[Vec<Vec3>]) -> Vec<Contour> {
        let flat = |vertex: &Vec3| {
            let arm = vertex.as_dvec3() - self.origin;
            [self.x.dot(arm), self.y.dot(arm)]
        };
        contours.iter().map(|contour| contour.iter().map(flat).collect()).collect()
    }

    /// Contours in space; vertices that are those of `old` are so to the bit.
    fn lifted(&self, contours: Vec<Contour>, old: &[Vec<Vec3>]) -> Vec<Vec<Vec3>> {
        let known = self.flattened(old).into_iter().flatten().map(DVec2::from).zip(old.iter().flatten().copied());
        let known: Vec<(DVec2, Vec3)> = known.collect();
        let reach = known.iter().map(|(flat, _)| flat.length()).fold(0.0, f64::max);
        let lift = |at: [f64; 2]| {
            let at = DVec2::from(at);
            let same = known.iter().find(|(flat, _)| flat.distance(at) <= SNAP_TOLERANCE * reach);
            same.map_or_else(|| (self.origin + at.x * self.x + at.y * self.y).as_vec3(), |&(_, vertex)| vertex)
        };
        contours.into_iter().map(|contour| contour.into_iter().map(lift).collect()).collect()
    }
}

/// What counter-clockwise contours enclose, less what clockwise ones do.
fn area(contours: &[Contour]) -> f64 {
    let of_contour = |contour: &Contour| -> f64 {
        let next = contour.iter().cycle().skip(1);
        contour.iter().zip(next).map(|(&p, &q)| 0.5 * DVec2::from(p).perp_dot(q.into())).sum()
    };
    contours.iter().map(of_contour).sum()
}
