//! Polygons split into convex parts.
//!
//! A polygon that is not convex is triangulated, and then of each two parts that share an edge one is made where that
//! is convex too (Hertel and Mehlhorn 1983, "Fast triangulation of simple polygons"): at most four times as many as the
//! fewest that there can be.

use std::collections::HashMap;
use std::f64::consts::TAU;

use earcut::Earcut;
use glam::{DVec2, DVec3};

use super::Polygon;

/// How far an outline may turn to the wrong side at a corner of a convex part, radians: what rounding makes of a
/// straight run. Of the part's area this leaves less than as much in doubt.
const STRAIGHT: f64 = 1e-6;

impl Polygon {
    /// Convex parts that cover the polygon without overlapping: the polygon itself where it is convex. The vertices of
    /// each are in order, clockwise or counter-clockwise. A polygon without area may have no parts.
    pub fn convex_parts(&self) -> Vec<Vec<DVec3>> {
        let normal = self.normal.as_dvec3();
        let contours: Vec<Vec<DVec3>> =
            self.contours.iter().map(|contour| contour.iter().map(|vertex| vertex.as_dvec3()).collect()).collect();
        match &contours[..] {
            [contour] if is_convex(&flattened(contour, normal)) => contours,
            _ => parts(&contours, normal),
        }
    }
}

/// Whether an outline turns left everywhere, and once in all.
fn is_convex(flat: &[DVec2]) -> bool {
    let count = flat.len();
    let turns = (0..count).map(|at| turn([flat[at], flat[(at + 1) % count], flat[(at + 2) % count]]));
    let turns: Vec<f64> = turns.collect();
    turns.iter().all(|turn| *turn >= -STRAIGHT) && (turns.iter().sum::<f64>() - TAU).abs() < 1.0
}

/// By which angle the way from `a` by `b` to `c` turns left, in \[-pi, pi\].
fn turn([a, b, c]: [DVec2; 3]) -> f64 {
    let (to, from) = (b - a, c - b);
    to.perp_dot(from).atan2(to.dot(from))
}

fn flattened(contour: &[DVec3], normal: DVec3) -> Vec<DVec2> {
    let (x, y) = normal.any_orthonormal_pair();
    contour.iter().map(|vertex| DVec2::new(x.dot(*vertex), y.dot(*vertex))).collect()
}

/// The convex parts of a polygon that may have holes. Contours around areas are told from holes by their winding; each
/// area is split with the holes in it.
fn parts(contours: &[Vec<DVec3>], normal: DVec3) -> Vec<Vec<DVec3>> {
    let flat: Vec<Vec<DVec2>> = contours.iter().map(|contour| flattened(contour, normal)).collect();
    let (areas, holes): (Vec<usize>, Vec<usize>) = (0..flat.len()).partition(|&at| signed_area(&flat[at]) >= 0.0);
    let mut found = Vec::new();
    let mut cutter = Earcut::new();
    for &area in &areas {
        // A hole belongs to the innermost area around it.
        let own = holes.iter().filter(|&&hole| {
            let around = areas.iter().filter(|&&other| surrounds(&flat[other], flat[hole][0]));
            around.min_by(|&&i, &&j| signed_area(&flat[i]).total_cmp(&signed_area(&flat[j]))) == Some(&area)
        });
        let mut order = vec![area];
        order.extend(own);
        let vertices: Vec<DVec3> = order.iter().flat_map(|&at| contours[at].iter().copied()).collect();
        let starts: Vec<u32> = order[..order.len() - 1]
            .iter()
            .scan(0, |sum, &at| {
                *sum += contours[at].len() as u32;
                Some(*sum)
            })
            .collect();
        let mut corners: Vec<u32> = Vec::new();
        let flat: Vec<DVec2> = order.iter().flat_map(|&at| flat[at].iter().copied()).collect();
        cutter.earcut(flat.iter().map(|vertex| [vertex.x, vertex.y]), &starts, &mut corners);
        let parts = merged(corners.as_chunks::<3>().0, &flat);
        let placed = parts.iter().map(|part| part.iter().map(|&corner| vertices[corner as usize]).collect());
        found.extend(placed);
    }
    found
}

/// Triangles merged into convex parts, all wound as they were. An edge between two parts is dropped where both of its
/// ends stay convex without it; what is dropped elsewhere later can only make them less so.
fn merged(triangles: &[[u32; 3]], flat: &[DVec2]) -> Vec<Vec<u32>> {
    let mut parts: Vec<Vec<u32>> = triangles.iter().map(|triangle| triangle.to_vec()).collect();
    let area = |triangle: &[u32; 3]| signed_area(&triangle.map(|corner| flat[corner as usize]));
    let side = triangles.iter().map(area).sum::<f64>().signum();
    let mut owners = owners(&parts);
    for (start, end) in triangles.iter().flat_map(|triangle| edges(triangle)) {
        let (Some(&one), Some(&other)) = (owners.get(&(start, end)), owners.get(&(end, start))) else { continue };
        let union = joined(&parts[one], &parts[other], (start, end));
        let place = |at: usize| flat[union[at % union.len()] as usize];
        let stays_convex =
            |at: usize| side * turn([place(at + union.len() - 1), place(at), place(at + 1)]) >= -STRAIGHT;
        // Where the two have been joined.
        if stays_convex(0) && stays_convex(parts[one].len() - 1) {
            owners.remove(&(start, end));
            owners.remove(&(end, start));
            let taken = std::mem::take(&mut parts[other]);
            for edge in edges(&taken) {
                owners.entry(edge).and_modify(|owner| *owner = one);
            }
            parts[one] = union;
        }
    }
    parts.retain(|part| !part.is_empty());
    parts
}

/// Which part runs along an edge in its direction; edges of crossing outlines along which more than one does are left
/// out.
fn owners(parts: &[Vec<u32>]) -> HashMap<(u32, u32), usize> {
    let mut owners = HashMap::new();
    let mut shared = Vec::new();
    for (index, part) in parts.iter().enumerate() {
        shared.extend(edges(part).filter(|&edge| owners.insert(edge, index).is_some()));
    }
    for edge in shared {
        owners.remove(&edge);
    }
    owners
}

fn edges(part: &[u32]) -> impl Iterator<Item = (u32, u32)> + '_ {
    part.iter().copied().zip(part.iter().copied().cycle().skip(1))
}

/// The outline of two parts without the edge between them, along which the first runs from `start` to `end`. It begins
/// at `end`, and comes to `start` as many corners later as the first part has but one.
fn joined(one: &[u32], other: &[u32], (start, end): (u32, u32)) -> Vec<u32> {
    let from = |part: &[u32], first: u32| {
        let at = part.iter().position(|&corner| corner == first).unwrap_or_default();
        let mut turned = part.to_vec();
        turned.rotate_left(at);
        turned
    };
    let mut union = from(one, end);
    union.extend(&from(other, start)[1..other.len() - 1]);
    union
}

fn signed_area(contour: &[DVec2]) -> f64 {
    let next = contour.iter().cycle().skip(1);
    let origin = contour[0];
    contour.iter().zip(next).map(|(p, q)| 0.5 * (*p - origin).perp_dot(*q - origin)).sum()
}

/// Whether a ray from the point crosses the outline an odd number of times.
fn surrounds(contour: &[DVec2], at: DVec2) -> bool {
    let next = contour.iter().cycle().skip(1);
    let crossed = |(p, q): &(&DVec2, &DVec2)| {
        (p.y > at.y) != (q.y > at.y) && at.x < p.x + (at.y - p.y) / (q.y - p.y) * (q.x - p.x)
    };
    contour.iter().zip(next).filter(crossed).count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Quat, Vec2, Vec3};
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64;

    type Flat = Vec<[f32; 2]>;

    const TALL: [[f32; 2]; 8] =
        [[0.0, 0.0], [3.0, 0.0], [3.0, 2.0], [2.0, 2.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];

    fn square(center: [f32; 2], half: f32) -> Flat {
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
            .map(|[x, y]| [center[0] + half * x, center[1] + half * y])
            .into()
    }

    fn hole(center: [f32; 2], half: f32) -> Flat {
        square(center, half).into_iter().rev().collect()
    }

    fn star(points: u32) -> Flat {
        let corner = |at: u32| {
            let (sin, cos) = (std::f32::consts::PI * at as f32 / points as f32).sin_cos();
            let radius = if at.is_multiple_of(2) { 2.0 } else { 1.0 };
            [radius * cos, radius * sin]
        };
        (0..2 * points).map(corner).collect()
    }

    /// What has corners that are straight but for rounding: a comb whose back is divided at each tooth.
    fn comb() -> Flat {
        let back = (0..=6).map(|at| [at as f32 / 3.0, 0.0]);
        let teeth = (0..3).rev().flat_map(|tooth| {
            let x = 2.0 * tooth as f32 / 3.0;
            [[x + 2.0 / 3.0, 1.0], [x + 1.0 / 3.0, 1.0], [x + 1.0 / 3.0, 0.3], [x, 0.3]]
        });
        back.chain(teeth).collect()
    }

    /// Turned and moved, so that no number stays round.
    fn polygon(contours: &[Flat]) -> Polygon {
        let turned = Quat::from_axis_angle(Vec3::new(1.0, -2.0, 0.5).normalize(), 1.1);
        let place = |&[x, y]: &[f32; 2]| turned * Vec3::new(x, y, 0.0) + Vec3::new(3.0, -1.0, 2.0);
        let contours = contours.iter().map(|contour| contour.iter().map(place).collect()).collect();
        Polygon { contours, normal: turned * Vec3::Z, pattern: None }
    }

    /// Area, first and second moments about the middle of what is near.
    fn moments<'a>(contours: impl Iterator<Item = &'a [DVec3]>, normal: DVec3) -> [f64; 6] {
        let mut sums = [0.0; 6];
        for contour in contours {
            let flat = flattened(&contour.iter().map(|v| *v - DVec3::new(3.0, -1.0, 2.0)).collect::<Vec<_>>(), normal);
            for (p, q) in flat.iter().zip(flat.iter().cycle().skip(1)) {
                // Of the triangle from the origin.
                let area = 0.5 * p.perp_dot(*q);
                let middle = (*p + *q) / 3.0;
                let second = |a: f64, b: f64, c: f64, d: f64| (a * b + c * d + (a + c) * (b + d)) / 12.0;
                let terms = [
                    1.0,
                    middle.x,
                    middle.y,
                    second(p.x, p.x, q.x, q.x),
                    second(p.x, p.y, q.x, q.y),
                    second(p.y, p.y, q.y, q.y),
                ];
                sums.iter_mut().zip(terms).for_each(|(sum, term)| *sum += area * term);
            }
        }
        sums
    }

    /// Parts are convex, all wound one way, and together have the moments of the polygon.
    fn check(polygon: &Polygon, what: &str) -> usize {
        let normal = polygon.normal.as_dvec3();
        let parts = polygon.convex_parts();
        let contours: Vec<Vec<DVec3>> =
            polygon.contours.iter().map(|c| c.iter().map(|v| v.as_dvec3()).collect()).collect();
        let expected = moments(contours.iter().map(Vec::as_slice), normal);
        let mut found = moments(parts.iter().map(Vec::as_slice), normal);
        let side = found[0].signum();
        found = found.map(|moment| side * moment);
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-6 * (1.0 + expected.abs()), "{what}: {found} {expected}");
        }
        for part in &parts {
            let mut flat = flattened(part, normal);
            if side < 0.0 {
                flat.reverse();
            }
            assert!(signed_area(&flat) > 0.0 && is_convex(&flat), "{what}: {part:?}");
        }
        parts.len()
    }

    #[test]
    fn shapes_have_few_convex_parts() {
        let letter = vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
        let frame = [square([0.0; 2], 2.0), hole([0.0; 2], 1.0)];
        let rings = [&frame[..], &[square([0.0; 2], 0.8), hole([0.0; 2], 0.5), square([9.0, 0.0], 1.0)]].concat();
        for (what, contours, most) in [
            ("square", vec![square([0.0; 2], 1.0)], 1),
            ("U", vec![TALL.to_vec()], 3),
            ("U from another corner", vec![[&TALL[3..], &TALL[..3]].concat()], 3),
            ("L", vec![letter], 2),
            ("frame", frame.to_vec(), 4),
            ("rings and a square", rings, 9),
            ("star", vec![star(5)], 5),
            ("comb", vec![comb()], 4),
        ] {
            assert_eq!(check(&polygon(&contours), what), most, "{what}");
        }
    }

    /// No more parts than Hertel and Mehlhorn prove: at each corner that turns to the wrong side two edges are kept at
    /// most, and each hole takes one edge to be joined to the outline.
    #[test]
    fn any_outline_is_covered_by_its_parts() {
        let mut random = Pcg64::seed_from_u64(5);
        for count in (3..40).chain([200]) {
            let corner = |at: usize, radius: f64| {
                let (sin, cos) = (TAU * at as f64 / count as f64).sin_cos();
                [(radius * cos) as f32, (radius * sin) as f32]
            };
            let outline: Flat = (0..count).map(|at| corner(at, random.random_range(0.5..2.0))).collect();
            let at = |at: usize| Vec2::from(outline[at % count]).as_dvec2();
            let wrong = (0..count).filter(|&k| turn([at(k), at(k + 1), at(k + 2)]) < 0.0).count();
            let parts = check(&polygon(std::slice::from_ref(&outline)), "star");
            assert!(parts <= 2 * wrong + 1 && parts <= count - 2, "{count}: {parts} {wrong}");
            let parts = check(&polygon(&[outline, hole([0.0; 2], 0.1)]), "star with a hole");
            assert!(parts <= 2 * (wrong + 4), "{count}: {parts} {wrong}");
        }
    }

    #[test]
    fn what_has_no_area_has_no_parts_with_one() {
        let line: Flat = vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]];
        for contour in [line.clone(), vec![[1.0, 1.0]; 4]] {
            let polygon = polygon(&[contour]);
            let parts = polygon.convex_parts();
            assert!(moments(parts.iter().map(Vec::as_slice), polygon.normal.as_dvec3())[0].abs() < 1e-6);
        }
    }
}
