//! Convex polygons, sampled by projected solid angle.
//!
//! Projected from the unit sphere onto the plane z = 0, directions of density cos / pi become points of uniform density
//! on the unit disc. There a great circle is an ellipse about the origin, and the sector between the zenith and an arc
//! of it has the area (n_z / 2) x (the arc's angle), n the unit normal of the arc's plane (Lambert 1760). Where the
//! zenith lies in the polygon, its sectors make it up; otherwise what lies between an outer and an inner chain of arcs
//! does, azimuth by azimuth. Peters 2021, "BRDF importance sampling for polygonal lights", samples the same areas.

use glam::{DVec2, DVec3};
use smallvec::SmallVec;
use std::f64::consts::PI;

/// Newton steps towards an azimuth; as they are kept in a bracket, this is more than `f64` needs.
const STEPS: usize = 24;
/// How exactly an azimuth is found: error of the area up to it, as a share of the sector's.
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

/// A sector between two azimuths: what lies between an outer arc and an inner one, or the zenith.
struct Sector {
    /// Directions of the azimuths, of any length, less than pi apart.
    from: DVec2,
    to: DVec2,
    outer: DVec3,
    inner: Option<DVec3>,
    area: f64,
}

/// A convex polygon above the horizon, ready to be sampled with the density cos / pi over its own share.
pub(super) struct Convex {
    sectors: Sectors,
    area: f64,
}

type Sectors = SmallVec<[Sector; 8]>;

impl Convex {
    /// From the vertices in order, either way round, with z >= 0; the polygon is convex as seen from the origin.
    pub fn new(vertices: &[DVec3]) -> Self {
        let mut vertices: Outline = vertices.iter().filter_map(|vertex| vertex.try_normalize()).collect();
        let normal: DVec3 = edges(&vertices).map(|(p, q)| p.cross(q)).sum();
        if normal.dot(vertices.iter().sum()) < 0.0 {
            vertices.reverse();
        }
        let holds_zenith = edges(&vertices).all(|(p, q)| p.cross(q).z >= 0.0);
        let mut sectors = if holds_zenith { around_zenith(&vertices) } else { between_chains(&vertices) };
        sectors.retain(|sector| sector.area > 0.0);
        let area = sectors.iter().map(|sector| sector.area).sum();
        Self { sectors, area }
    }

    /// A unit direction of the polygon from two uniform numbers in \[0, 1); none where it has no area.
    pub fn sample(&self, [azimuth, height]: [f64; 2]) -> Option<DVec3> {
        let mut area = azimuth * self.area;
        let last = self.sectors.last()?;
        for sector in &self.sectors {
            if area < sector.area {
                return Some(sector.sample(area / sector.area, height));
            }
            area -= sector.area;
        }
        // Past the last by rounding.
        Some(last.sample(1.0, height))
    }
}

fn around_zenith(vertices: &[DVec3]) -> Sectors {
    let one = |(p, q): (DVec3, DVec3)| Sector {
        from: p.truncate(),
        to: q.truncate(),
        outer: p.cross(q).normalize_or_zero(),
        inner: None,
        area: sector(p, q),
    };
    edges(vertices).map(one).collect()
}

/// Sectors from the azimuth of one vertex to that of the next, of a polygon that does not hold the zenith.
fn between_chains(vertices: &[DVec3]) -> Sectors {
    let count = vertices.len();
    let middle = vertices.iter().sum::<DVec3>().truncate().normalize_or_zero();
    // The tangent of half the azimuth from the middle, which grows with it.
    let azimuth = |vertex: &DVec3| {
        let across = vertex.truncate();
        middle.perp_dot(across) / (across.length() + middle.dot(across)).max(f64::MIN_POSITIVE)
    };
    let azimuths: SmallVec<[f64; 8]> = vertices.iter().map(azimuth).collect();
    let extreme = |sign: f64| (0..count).max_by(|&i, &j| (sign * azimuths[i]).total_cmp(&(sign * azimuths[j])));
    let (Some(first), Some(last)) = (extreme(-1.0), extreme(1.0)) else { return Sectors::new() };
    // On the outside the vertices run from the first azimuth to the last, and on the inside back.
    let chain = |from: usize, to: usize, step: usize| {
        let mut chain: SmallVec<[usize; 8]> = smallvec::smallvec![from];
        while chain[chain.len() - 1] != to {
            chain.push((chain[chain.len() - 1] + step) % count);
        }
        chain
    };
    let (outer, inner) = (chain(first, last, 1), chain(first, last, count - 1));
    let normal = |chain: &[usize], at: usize| vertices[chain[at]].cross(vertices[chain[at + 1]]).normalize_or_zero();
    let (mut out, mut into) = (0, 0);
    let mut from = vertices[first].truncate();
    let mut sectors = Sectors::with_capacity(count);
    while out + 1 < outer.len() && into + 1 < inner.len() {
        let (next_out, next_in) = (outer[out + 1], inner[into + 1]);
        let outer_first = azimuths[next_out] <= azimuths[next_in];
        let to = vertices[if outer_first { next_out } else { next_in }].truncate();
        let mut sector = Sector { from, to, outer: normal(&outer, out), inner: Some(normal(&inner, into)), area: 0.0 };
        sector.area = sector.area_to(1.0);
        sectors.push(sector);
        from = to;
        // At the same azimuth both chains advance.
        let both = azimuths[next_out] == azimuths[next_in];
        out += usize::from(outer_first);
        into += usize::from(!outer_first || both);
    }
    sectors
}

/// The direction in which the great circle of this normal, n_z > 0, meets an azimuth; of any length.
fn meeting(normal: DVec3, azimuth: DVec2) -> DVec3 {
    (azimuth * normal.z).extend(-normal.truncate().dot(azimuth))
}

/// The square of z at which it does.
fn height_square(normal: DVec3, azimuth: DVec2) -> f64 {
    let across = normal.truncate().dot(azimuth);
    let square = across * across;
    let whole = square + normal.z * normal.z * azimuth.length_squared();
    if whole > 0.0 { square / whole } else { 1.0 }
}

impl Sector {
    /// The azimuth's direction a share of the way along the chord.
    fn azimuth(&self, share: f64) -> DVec2 {
        self.from + share * (self.to - self.from)
    }

    /// The squares of z on the outer and the inner arc.
    fn heights(&self, azimuth: DVec2) -> [f64; 2] {
        [height_square(self.outer, azimuth), self.inner.map_or(1.0, |inner| height_square(inner, azimuth))]
    }

    /// The area up to the azimuth of `share`.
    fn area_to(&self, share: f64) -> f64 {
        let part = |normal: DVec3| sector(meeting(normal, self.from), meeting(normal, self.azimuth(share)));
        part(self.outer) - self.inner.map_or(0.0, part)
    }

    /// The share of the chord that holds a share of the area. Newton's method between bounds.
    fn share_of(&self, area: f64) -> f64 {
        let (mut low, mut high, mut share) = (0.0, 1.0, area);
        let turn = self.from.perp_dot(self.to);
        for _ in 0..STEPS {
            let excess = self.area_to(share) - area * self.area;
            if excess.abs() <= TOLERANCE * self.area {
                break;
            }
            if excess > 0.0 {
                high = share
            } else {
                low = share
            }
            let azimuth = self.azimuth(share);
            let [outer, inner] = self.heights(azimuth);
            let slope = 0.5 * (inner - outer) * turn / azimuth.length_squared();
            let next = share - excess / slope;
            share = if next > low && next < high { next } else { 0.5 * (low + high) };
        }
        share
    }

    fn sample(&self, area: f64, height: f64) -> DVec3 {
        let azimuth = self.azimuth(self.share_of(area));
        let [outer, inner] = self.heights(azimuth);
        // Uniform in the square of the radius, and so in that of z.
        let square = inner + height * (outer - inner);
        (azimuth.normalize_or_zero() * (1.0 - square).max(0.0).sqrt()).extend(square.sqrt()).normalize()
    }
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
