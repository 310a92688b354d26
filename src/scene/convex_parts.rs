//! Polygons split into convex parts.

use earcut::Earcut;
use glam::{DVec2, DVec3};

use super::Polygon;

impl Polygon {
    /// Convex parts that cover the polygon without overlapping: the polygon itself where it is convex, triangles
    /// otherwise. The vertices of each are in order, clockwise or counter-clockwise. A polygon without area may have no
    /// parts.
    pub fn convex_parts(&self) -> Vec<Vec<DVec3>> {
        let normal = self.normal.as_dvec3();
        let contours: Vec<Vec<DVec3>> =
            self.contours.iter().map(|contour| contour.iter().map(|vertex| vertex.as_dvec3()).collect()).collect();
        match &contours[..] {
            [contour] if is_convex(contour, normal) => contours,
            _ => triangles(&contours, normal).into_iter().map(|triangle| triangle.to_vec()).collect(),
        }
    }
}

/// Whether an outline turns left everywhere, and once in all.
fn is_convex(contour: &[DVec3], normal: DVec3) -> bool {
    let flat = flattened(contour, normal);
    let count = flat.len();
    let turn = |k: usize| (flat[(k + 1) % count] - flat[k]).angle_to(flat[(k + 2) % count] - flat[(k + 1) % count]);
    let turns: Vec<f64> = (0..count).map(turn).collect();
    turns.iter().all(|turn| *turn >= -1e-9) && (turns.iter().sum::<f64>() - std::f64::consts::TAU).abs() < 1e-6
}

fn flattened(contour: &[DVec3], normal: DVec3) -> Vec<DVec2> {
    let (x, y) = normal.any_orthonormal_pair();
    contour.iter().map(|vertex| DVec2::new(x.dot(*vertex), y.dot(*vertex))).collect()
}

/// The triangles of a polygon that may have holes. Contours around areas are told from holes by their winding; each
/// area is triangulated with the holes in it.
fn triangles(contours: &[Vec<DVec3>], normal: DVec3) -> Vec<[DVec3; 3]> {
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
        cutter.earcut(order.iter().flat_map(|&at| flat[at].iter().map(|v| [v.x, v.y])), &starts, &mut corners);
        found.extend(corners.as_chunks::<3>().0.iter().map(|corners| corners.map(|corner| vertices[corner as usize])));
    }
    found
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
