//! Convex polygons, sampled by projected solid angle.
//!
//! Projected from the unit sphere onto the plane z = 0, directions of density cos / pi become points of uniform density
//! on the unit disc. There a great circle is an ellipse about the origin, and the sector between the zenith and an arc
//! of it has the area (n_z / 2) x (the arc's angle), n the unit normal of the arc's plane (Lambert 1760). A polygon is a
//! fan of triangles, and a triangle around the zenith is made up of its sides' sectors; any other is cut at the azimuth of
//! the corner in between into two wedges, each between two arcs that part at a corner. Peters 2021, "BRDF importance
//! sampling for polygonal lights", samples the same areas; `shaders/ltc_sample.wgsl` takes this way too, in `f32`.

use glam::DVec3;
use smallvec::SmallVec;
use std::f64::consts::PI;

/// Newton steps towards an azimuth; as they are kept in a bracket, this is more than `f64` needs.
const STEPS: usize = 24;
/// How exactly an azimuth is found: error of the area up to it, as a share of the wedge's.
const TOLERANCE: f64 = 1e-14;

/// Vertices in order; a few, as most lights have, without an allocation.
pub(super) type Outline = SmallVec<[DVec3; 8]>;

/// The share of the cosine's hemisphere that a polygon above the horizon takes: in \[0, 1\] where its azimuth runs
/// counter-clockwise about z, negative where it runs clockwise. Vertices need not be of unit length.
pub(super) fn cosine_share(vertices: &[DVec3]) -> f64 {
    edges(vertices).map(|(p, q)| sector(p, q)).sum::<f64>() / PI
}

pub(super) fn edges(vertices: &[DVec3]) -> impl Iterator<Item = (DVec3, DVec3)> + '_ {
    vertices.iter().copied().zip(vertices.iter().copied().cycle().skip(1))
}

/// The area between the zenith and the arc from `p` to `q`, projected onto the disc.
fn sector(p: DVec3, q: DVec3) -> f64 {
    let normal = p.cross(q);
    let length = normal.length();
    if length > 0.0 { 0.5 * normal.z / length * length.atan2(p.dot(q)) } else { 0.0 }
}

/// The part of an outline on the side to which `plane` points (Sutherland and Hodgman 1974).
pub(super) fn clip(outline: &[DVec3], plane: DVec3) -> Outline {
    let mut kept = Outline::with_capacity(outline.len() + 2);
    for (p, q) in edges(outline) {
        let [start, end] = [p, q].map(|vertex| plane.dot(vertex));
        if start >= 0.0 {
            kept.push(p);
        }
        if (start < 0.0) != (end < 0.0) {
            let crossing = p.lerp(q, start / (start - end));
            kept.push(crossing - plane * plane.dot(crossing));
        }
    }
    kept
}

/// What lies between two arcs that part at a corner, up to an azimuth. Along the outer arc, by an angle t from the corner,
/// the inner one is met at the angle u with cot u = (inner cot t - lean) / outer.
struct Wedge {
    corner: DVec3,
    /// Unit, square to the corner: in which direction the outer arc leaves it.
    ahead: DVec3,
    /// |n_z| of the outer and the inner arc; the latter is 0 for the zenith itself.
    outer: f64,
    inner: f64,
    /// -|sine of the angle between the arcs| x the corner's height.
    lean: f64,
    /// The greatest angle t.
    end: f64,
}

impl Wedge {
    /// The sector of the arc from `p` to `q`, unit directions.
    fn sector(p: DVec3, q: DVec3) -> Self {
        let normal = p.cross(q);
        let end = normal.length().atan2(p.dot(q));
        let normal = normal.normalize_or_zero();
        Self { corner: p, ahead: normal.cross(p), outer: normal.z.abs(), inner: 0.0, lean: 0.0, end }
    }

    /// At the corner `p` of a triangle, between the side to `q` and the side to `r`, whose azimuth lies in between.
    fn between([p, q, r]: [DVec3; 3], is_outer: bool) -> Self {
        let [long, short] = [q, r].map(|to| p.cross(to).normalize_or_zero());
        let (end, normal) = (p.cross(r).length().atan2(p.dot(r)), if is_outer { long } else { short });
        let (outer, inner) = if is_outer { (long.z.abs(), short.z.abs()) } else { (short.z.abs(), long.z.abs()) };
        let lean = -long.cross(short).length() * p.z;
        let met = || (inner * end.sin()).atan2(outer * end.cos() + lean * end.sin());
        let end = if is_outer { met() } else { end };
        Self { corner: p, ahead: normal.cross(p), outer, inner, lean, end }
    }

    /// The area up to an angle.
    fn area(&self, angle: f64) -> f64 {
        let (sin, cos) = angle.sin_cos();
        0.5 * (self.outer * angle - self.inner * (self.outer * sin).atan2(self.inner * cos - self.lean * sin))
    }

    /// How much of what the outer arc sweeps at an angle is the wedge's.
    fn share(&self, angle: f64) -> f64 {
        let (sin, cos) = angle.sin_cos();
        let square = (self.outer * sin).powi(2) + (self.inner * cos - self.lean * sin).powi(2);
        let steep = self.outer * self.outer + self.lean * self.lean - self.inner * self.inner;
        let part = sin * (sin * steep - 2.0 * self.inner * self.lean * cos);
        if square > 0.0 { (part / square).clamp(0.0, 1.0) } else { 0.0 }
    }

    /// The angle up to which the wedge has this area. Newton's method between bounds.
    fn angle(&self, area: f64) -> f64 {
        let (mut low, mut high) = (0.0, self.end);
        let whole = self.area(self.end);
        let mut angle = self.end * (area / whole).sqrt();
        for _ in 0..STEPS {
            let excess = self.area(angle) - area;
            if excess.abs() <= TOLERANCE * whole {
                break;
            }
            if excess > 0.0 {
                high = angle
            } else {
                low = angle
            }
            let next = angle - 2.0 * excess / (self.outer * self.share(angle));
            angle = if next > low && next < high { next } else { 0.5 * (low + high) };
        }
        angle
    }

    fn sample(&self, area: f64, height: f64) -> DVec3 {
        let angle = self.angle(area);
        let outer = angle.cos() * self.corner + angle.sin() * self.ahead;
        // Uniform in the square of the radius, and so in that of z: from the outer arc's to the inner one's.
        let inward = height * self.share(angle);
        let across = outer.truncate();
        (across * (1.0 - inward).sqrt()).extend((outer.z * outer.z + inward * across.length_squared()).sqrt())
    }
}

/// A convex polygon above the horizon, ready to be sampled with the density cos / pi over its own share.
pub struct Convex {
    wedges: SmallVec<[(Wedge, f64); 8]>,
    area: f64,
}

impl Convex {
    /// From the vertices in order, either way round, with z >= 0; the polygon is convex as seen from the origin.
    pub fn new(vertices: &[DVec3]) -> Self {
        let vertices: Outline = vertices.iter().filter_map(|vertex| vertex.try_normalize()).collect();
        let triangles = (2..vertices.len()).map(|k| [vertices[0], vertices[k - 1], vertices[k]]);
        let measured = |wedge: Wedge| {
            let area = wedge.area(wedge.end);
            (wedge, area)
        };
        let wedges = triangles.flat_map(wedges_of).map(measured).filter(|(_, area)| *area > 0.0);
        let wedges: SmallVec<[(Wedge, f64); 8]> = wedges.collect();
        let area = wedges.iter().map(|(_, area)| area).sum();
        Self { wedges, area }
    }

    /// A unit direction of the polygon from two uniform numbers in \[0, 1); none where it has no area.
    pub fn sample(&self, [azimuth, height]: [f64; 2]) -> Option<DVec3> {
        let mut left = azimuth * self.area;
        let (last, whole) = self.wedges.last()?;
        for (wedge, whole) in &self.wedges {
            if left < *whole {
                return Some(wedge.sample(left, height));
            }
            left -= whole;
        }
        // Past the last by rounding.
        Some(last.sample(*whole, height))
    }
}

/// A triangle's, in order.
fn wedges_of([p, q, r]: [DVec3; 3]) -> SmallVec<[Wedge; 3]> {
    let sectors = [(p, q), (q, r), (r, p)].map(|(p, q)| sector(p, q));
    let turn = sectors.iter().sum::<f64>().signum();
    let below = sectors.map(|sector| sector * turn < 0.0);
    if below == [false; 3] {
        return [(p, q), (q, r), (r, p)].map(|(p, q)| Wedge::sector(p, q)).into_iter().collect();
    }
    // The side that faces the zenith alone, or turns away alone, goes round as far as both others.
    let differs = |k: usize| below[k] != below[(k + 1) % 3] && below[k] != below[(k + 2) % 3];
    let [p, q, r] = match [differs(0), differs(1)] {
        [true, _] => [p, q, r],
        [_, true] => [q, r, p],
        _ => [r, p, q],
    };
    let is_outer = below.iter().filter(|below| **below).count() == 2;
    SmallVec::from_iter([Wedge::between([p, q, r], is_outer), Wedge::between([q, p, r], is_outer)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat3;
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64;

    use crate::reference::polygon::form_factor;

    /// Polygons above the horizon: around the zenith, beside it, with it on an edge and at a corner, along the horizon,
    /// small, and narrow.
    fn polygons() -> Vec<Vec<DVec3>> {
        let at = |corners: &[[f64; 3]]| corners.iter().map(|corner| DVec3::from(*corner)).collect::<Vec<_>>();
        let disk = (0..32).map(|k| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / 32.0).sin_cos();
            DVec3::new(0.3 + cos, sin, 0.8)
        });
        vec![
            at(&[[-1.0, -1.0, 1.0], [1.0, -1.0, 0.5], [1.0, 1.0, 1.5], [-1.0, 1.0, 2.0]]),
            at(&[[0.2, 0.1, 1.0], [1.0, 0.3, 0.7], [0.5, 1.0, 0.2]]),
            at(&[[0.0, -1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, 1.0], [0.0, 1.0, 1.0]]),
            at(&[[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.0]]),
            at(&[[1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [1.0, -1.0, 1.0]]),
            at(&[[-3.0, 2.0, 0.0], [3.0, 2.0, 0.0], [3.0, 2.0, 0.1], [-3.0, 2.0, 0.2]]),
            at(&[[0.5, 0.5, 1.0], [0.5001, 0.5, 1.0], [0.5, 0.5001, 1.0]]),
            at(&[[-0.9, 0.3, 0.4], [0.9, 0.300001, 0.4], [0.9, 0.3, 0.4]]),
            disk.collect(),
        ]
    }

    #[test]
    fn shares_are_the_form_factors() {
        for vertices in polygons() {
            let share = cosine_share(&vertices).abs();
            let expected = form_factor(std::slice::from_ref(&vertices), DMat3::IDENTITY, true);
            assert!((share - expected).abs() < 1e-14, "{vertices:?}: {share} {expected}");
            let sectors = Convex::new(&vertices).area / PI;
            // Small and narrow ones are differences of large numbers.
            assert!((sectors - expected).abs() < 1e-14 + 1e-9 * expected, "{vertices:?}: {sectors} {expected}");
            let reversed: Vec<DVec3> = vertices.iter().rev().copied().collect();
            assert!((Convex::new(&reversed).area / PI - sectors).abs() < 1e-15, "{vertices:?}");
        }
    }

    /// Halves of each polygon, by planes through random directions in it, are found in proportion to their form
    /// factors.
    #[test]
    fn samples_fall_on_each_part_in_proportion_to_its_form_factor() {
        const SAMPLES: u32 = 40_000;
        let mut rng = Pcg64::seed_from_u64(1);
        for vertices in polygons() {
            let convex = Convex::new(&vertices);
            let samples: Vec<DVec3> =
                (0..SAMPLES).map(|_| convex.sample([rng.random(), rng.random()]).expect("it has an area")).collect();
            let outside = |wo: &&DVec3| {
                let sides = || edges(&vertices).map(|(p, q)| p.cross(q).normalize().dot(**wo));
                !(sides().all(|side| side > -1e-9) || sides().all(|side| side < 1e-9))
            };
            assert_eq!(samples.iter().filter(outside).count(), 0, "{vertices:?}");
            let whole = form_factor(std::slice::from_ref(&vertices), DMat3::IDENTITY, true);
            for _ in 0..12 {
                let through = samples[rng.random_range(0..samples.len())];
                let turned =
                    DVec3::new(rng.random::<f64>() - 0.5, rng.random::<f64>() - 0.5, rng.random::<f64>() - 0.5);
                let plane = through.cross(turned).normalize();
                let part = form_factor(&[clip(&vertices, plane).to_vec()], DMat3::IDENTITY, true) / whole;
                let found = samples.iter().filter(|wo| plane.dot(**wo) > 0.0).count() as f64 / f64::from(SAMPLES);
                let deviation = (part * (1.0 - part) / f64::from(SAMPLES)).sqrt();
                // 4.5 standard errors: 108 comparisons are off once in 1400 sets of them.
                assert!((found - part).abs() < 4.5 * deviation + 1e-6, "{vertices:?}: {found} {part}");
            }
        }
    }

    #[test]
    fn what_has_no_area_has_no_samples() {
        for vertices in [vec![], vec![DVec3::Z], vec![DVec3::Z, DVec3::X], vec![DVec3::ONE; 4]] {
            assert_eq!(Convex::new(&vertices).sample([0.5, 0.5]), None, "{vertices:?}");
        }
    }
}
