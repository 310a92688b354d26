//! The outline of a set of triangles in a plane.

use std::collections::HashMap;

use glam::{DVec2, DVec3, Vec3};

/// How far the outline may move where a vertex is dropped, relative to the island's size: far below what a picture
/// shows, and above the noise of rounded positions.
const STRAIGHT_TOLERANCE: f64 = 1e-6;
/// How far edges must reach past each other to count as crossing, relative to the island's size.
const CROSSING_TOLERANCE: f64 = 1e-4;

/// The closed contours around `triangles` in a plane, whose vertices are in `positions`. They lie in a plane of unit `normal` and
/// run counter-clockwise seen from the side to which it points. So do the contours around their area; contours around
/// holes run clockwise. Vertices on straight runs are dropped. Linear functions have the same integral over
/// the contours as over the triangles.
pub(super) fn outline(triangles: impl Iterator<Item = [u32; 3]>, positions: &[DVec3], normal: DVec3) -> Vec<Vec<Vec3>> {
    contours(triangles, positions, normal, STRAIGHT_TOLERANCE)
}

/// The same of triangles that lie near a plane: vertices are dropped that are nearer than `tolerance`, relative to the
/// contours' size, to the lines that replace them.
pub(super) fn contours(
    triangles: impl Iterator<Item = [u32; 3]>,
    positions: &[DVec3],
    normal: DVec3,
    tolerance: f64,
) -> Vec<Vec<Vec3>> {
    let (right, up) = normal.any_orthonormal_pair();
    let loops = loops(boundary(triangles));
    let corners = || loops.iter().flatten().map(|&corner| positions[corner as usize]);
    let Some(origin) = corners().next() else { return Vec::new() };
    let flatten = |corner: u32| {
        let arm = positions[corner as usize] - origin;
        DVec2::new(arm.dot(right), arm.dot(up))
    };
    let reach = corners().map(|corner| corner.distance(origin)).fold(0.0, f64::max);
    let magnitude = corners().map(|corner| corner.abs().max_element()).fold(0.0, f64::max);
    let tolerance = tolerance * reach + 2.0 * f64::from(f32::EPSILON) * magnitude;
    let contours = loops.iter().map(|corners| {
        let flat: Vec<DVec2> = corners.iter().map(|&corner| flatten(corner)).collect();
        let kept = bends(&flat, tolerance);
        kept.into_iter().map(|at| positions[corners[at] as usize].as_vec3()).collect::<Vec<Vec3>>()
    });
    contours.filter(|contour| contour.len() >= 3).collect()
}

/// Whether the edges of an outline in a plane of unit `normal` cross each other. Its triangles then overlap, and what
/// is covered twice counts twice. The time grows with the square of the number of edges.
pub(super) fn crosses(contours: &[Vec<Vec3>], normal: Vec3) -> bool {
    let (right, up) = normal.as_dvec3().any_orthonormal_pair();
    let flatten = |corner: Vec3| DVec2::new(corner.as_dvec3().dot(right), corner.as_dvec3().dot(up));
    let edges = contours.iter().flat_map(|contour| {
        let next = contour.iter().cycle().skip(1);
        contour.iter().zip(next).map(|(&from, &to)| (flatten(from), flatten(to)))
    });
    let edges: Vec<(DVec2, DVec2)> = edges.collect();
    let origin = edges.first().map_or(DVec2::ZERO, |edge| edge.0);
    let reach = edges.iter().map(|edge| edge.0.distance(origin)).fold(0.0, f64::max);
    // Corners that rounding has put on the wrong side of an edge do not count.
    let tolerance = CROSSING_TOLERANCE * reach;
    let parts = |(from, to): (DVec2, DVec2), (one, other): (DVec2, DVec2)| {
        let along = (to - from).normalize_or_zero();
        let (left, right) = (along.perp_dot(one - from), along.perp_dot(other - from));
        left.abs().min(right.abs()) > tolerance && left * right < 0.0
    };
    edges
        .iter()
        .enumerate()
        .any(|(at, &edge)| edges[at + 1..].iter().any(|&other| parts(edge, other) && parts(other, edge)))
}

/// The triangles' directed edges that no opposite edge cancels, sorted.
fn boundary(triangles: impl Iterator<Item = [u32; 3]>) -> Vec<(u32, u32)> {
    let mut edges: Vec<(u32, u32)> = triangles.flat_map(|[a, b, c]| [(a, b), (b, c), (c, a)]).collect();
    edges.sort_unstable_by_key(|&(from, to)| (from.min(to), from.max(to), from));
    let mut boundary = Vec::new();
    for edge in edges.chunk_by(|left, right| {
        left.0.min(left.1) == right.0.min(right.1) && left.0.max(left.1) == right.0.max(right.1)
    }) {
        let (forward, backward) = edge.split_at(edge.partition_point(|(from, to)| from < to));
        let left = forward.len().abs_diff(backward.len());
        boundary.extend(if forward.len() > backward.len() { &forward[..left] } else { &backward[..left] });
    }
    boundary.sort_unstable();
    boundary
}

/// Joins edges, of which as many lead into each vertex as out of it, into loops that pass no vertex twice. Where there
/// is a choice, any will do: the integral over all loops is the same.
fn loops(edges: Vec<(u32, u32)>) -> Vec<Vec<u32>> {
    let mut unused: HashMap<u32, Vec<u32>> = HashMap::new();
    edges.iter().rev().for_each(|&(from, to)| unused.entry(from).or_default().push(to));
    let mut loops = Vec::new();
    for &(start, _) in &edges {
        // The walk so far, and each vertex's position in it. It ends where it began: anywhere else an edge leads on.
        let mut walk = vec![start];
        let mut places = HashMap::from([(start, 0)]);
        while let Some(next) = walk.last().and_then(|vertex| unused.get_mut(vertex)?.pop()) {
            match places.get(&next) {
                None => {
                    places.insert(next, walk.len());
                    walk.push(next);
                }
                Some(&place) => {
                    let closed = walk.split_off(place + 1);
                    for vertex in &closed {
                        places.remove(vertex);
                    }
                    loops.push(std::iter::once(next).chain(closed).collect());
                }
            }
        }
    }
    loops
}

/// Which vertices of a closed loop to keep so that no dropped one is farther than `tolerance` from the line that
/// replaces it: from each kept vertex, the line is drawn on for as long as some direction passes near all the vertices
/// in between.
fn bends(points: &[DVec2], tolerance: f64) -> Vec<usize> {
    // The lowest of the leftmost is a corner, whatever the shape.
    let order = |left: &DVec2, right: &DVec2| left.x.total_cmp(&right.x).then(left.y.total_cmp(&right.y));
    let Some(start) = (0..points.len()).min_by(|&left, &right| order(&points[left], &points[right])) else {
        return Vec::new();
    };
    let at = |step: usize| (start + step) % points.len();
    let mut kept = vec![start];
    let mut sector = Sector::new(points[start]);
    for step in 1..=points.len() {
        let point = points[at(step)];
        if !sector.passes(point) {
            kept.push(at(step - 1));
            sector = Sector::new(points[at(step - 1)]);
        }
        sector.narrow(point, tolerance);
    }
    kept
}

/// The directions from an apex that pass near all the points so far.
struct Sector {
    apex: DVec2,
    /// The rightmost and leftmost direction, less than half a turn apart; `None` as long as every direction will do.
    sides: Option<(DVec2, DVec2)>,
}

impl Sector {
    fn new(apex: DVec2) -> Self {
        Self { apex, sides: None }
    }

    /// Whether the direction to `point` is among them.
    fn passes(&self, point: DVec2) -> bool {
        let arm = point - self.apex;
        self.sides.is_none_or(|(right, left)| {
            right.perp_dot(arm) >= 0.0 && arm.perp_dot(left) >= 0.0 && arm.dot(right + left) > 0.0
        })
    }

    /// Leaves the directions that pass within `tolerance` of `point`.
    fn narrow(&mut self, point: DVec2, tolerance: f64) {
        let arm = point - self.apex;
        if arm.length() <= tolerance {
            return;
        }
        // The tangents from the apex to the circle of the tolerance around the point.
        let sine = tolerance / arm.length();
        let turn = DVec2::new((1.0 - sine * sine).sqrt(), sine);
        let (right, left) = (DVec2::new(turn.x, -turn.y).rotate(arm), turn.rotate(arm));
        self.sides = Some(match self.sides {
            None => (right, left),
            Some((old_right, old_left)) => (
                if old_right.perp_dot(right) > 0.0 { right } else { old_right },
                if left.perp_dot(old_left) > 0.0 { left } else { old_left },
            ),
        });
    }
}
