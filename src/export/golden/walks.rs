//! Rows of the walk around a polygon: edges in every position to the horizon.

use super::function::{Function, Row};
use super::outline::{BEGIN, EDGE, EDGE_VECTOR, Edge, LEVEL, Last, NEXT, Outline, Step, TURN, Turning, begin, next};
use glam::{DMat3, DVec2, DVec3};

/// The rows (a, 0, b), (0, c, 0), (0, 0, 1).
pub(super) fn lobe(a: f64, b: f64, c: f64) -> DMat3 {
    DMat3::from_cols(DVec3::X * a, DVec3::Y * c, DVec3::new(b, 0.0, 1.0))
}

/// Edges from one vertex to the next.
const EDGES: [(&str, [f64; 3], [f64; 3]); 18] = [
    ("above the horizon", [0.4, -0.3, 0.6], [1.1, 0.2, 0.3]),
    ("high above the horizon", [-0.5, 0.7, 2.0], [0.6, 0.4, 1.5]),
    ("leaves the upper hemisphere", [0.4, -0.3, 0.6], [1.1, 0.2, -0.3]),
    ("enters the upper hemisphere", [0.9, -0.5, -0.6], [-0.2, 0.9, 1.4]),
    ("leaves almost straight down", [0.5, 0.4, 0.3], [0.52, 0.41, -2.0]),
    ("below the horizon", [0.9, -0.5, -0.6], [-0.2, 0.9, -0.1]),
    ("starts on the horizon", [1.0, 0.5, 0.0], [0.3, 0.9, 0.7]),
    ("ends on the horizon", [0.3, 0.9, 0.7], [-1.0, 0.25, 0.0]),
    ("lies on the horizon", [1.0, 0.5, 0.0], [-0.3, 0.9, 0.0]),
    ("long", [-30.0, 1.0, 0.5], [40.0, 1.5, 0.7]),
    ("passes close to the point", [-1.0, 0.01, 0.3], [1.0, -0.01, 0.2]),
    ("passes close above the point", [-2.0, -0.7, 0.004], [1.5, 0.5, 0.003]),
    ("far and short: an ordinary cross product fails", [812.0, 310.0, 505.0], [812.0, 310.5, 505.25]),
    ("very far and short: an ordinary cross product fails", [5000.0, 5000.0, 9000.0], [5003.0, 5000.0, 9000.0]),
    ("huge", [6e4, -4e4, 2e4], [-3e4, 5e4, 7e4]),
    ("tiny", [2e-4, 1e-4, 3e-4], [-1e-4, 2e-4, 1e-4]),
    ("degenerate: no length", [0.5, -0.25, 0.75], [0.5, -0.25, 0.75]),
    ("degenerate: towards the point", [0.25, 0.5, 0.75], [0.5, 1.0, 1.5]),
];

/// The diffuse lobe, sheens from dust to fuzz, specular lobes from broad to narrow.
const LOBES: [(&str, [f64; 3]); 5] = [
    ("diffuse", [1.0, 0.0, 1.0]),
    ("dust", [0.75, -0.25, 0.75]),
    ("fuzz", [0.2, -0.85, 0.2]),
    ("broad mirror", [1.25, 0.9, 1.75]),
    ("narrow mirror", [6.0, 7.5, 14.0]),
];

fn edges() -> impl Iterator<Item = (&'static str, Outline, DVec3)> {
    EDGES.into_iter().map(|(case, start, corner)| {
        // A step that ended where this one starts.
        (case, begin(DVec3::from(start)), DVec3::from(corner))
    })
}

pub(super) fn begins(index: usize) -> (Function, Vec<Row>) {
    let last = |at: [f64; 3]| Last { last: at.into() };
    BEGIN.rows(index, [("above the horizon", last([0.3, -2.5, 1.7])), ("below the horizon", last([40.0, 1e-3, -7.0]))])
}

pub(super) fn nexts(index: usize) -> (Function, Vec<Row>) {
    let mut cases: Vec<(&str, Step)> =
        edges().map(|(case, outline, corner)| (case, Step { outline, corner })).collect();
    let before = begin(DVec3::new(0.9, -0.5, -0.6));
    let reached = next(&before, DVec3::new(-0.2, 0.9, 1.4));
    cases.push(("after an edge that entered", Step { outline: reached, corner: DVec3::new(-0.8, 0.1, -0.9) }));
    NEXT.rows(index, cases)
}

/// Edges with an angle, each under the next of the lobes; all lobes for the first ones.
fn walked() -> Vec<(String, Edge)> {
    let walked: Vec<(&str, Outline)> = edges().map(|(case, before, corner)| (case, next(&before, corner))).collect();
    let mut cases = Vec::new();
    for (k, (case, outline)) in walked.iter().enumerate() {
        for (l, (name, [a, b, c])) in LOBES.iter().enumerate() {
            if k < 3 || l == k % LOBES.len() {
                cases.push((format!("{case}; {name}"), Edge { outline: *outline, m_inv: lobe(*a, *b, *c) }));
            }
        }
    }
    cases.push(("above the horizon; a = 0".to_owned(), Edge { outline: walked[0].1, m_inv: lobe(0.0, -0.4, 0.0) }));
    cases
}

fn named<T: Copy>(cases: &[(String, T)]) -> impl Iterator<Item = (&str, T)> {
    cases.iter().map(|(case, input)| (case.as_str(), *input))
}

pub(super) fn edge_sums(index: usize) -> (Function, Vec<Row>) {
    EDGE.rows(index, named(&walked()))
}

pub(super) fn edge_vectors(index: usize) -> (Function, Vec<Row>) {
    EDGE_VECTOR.rows(index, named(&walked()[..16]))
}

pub(super) fn turns(index: usize) -> (Function, Vec<Row>) {
    let before =
        [("", LEVEL), (" after a turn", DVec2::new(0.25, -0.75)), (" after half a turn", DVec2::new(-0.875, 0.125))];
    let crossing = edges().map(|(case, before, corner)| (case, next(&before, corner))).take(8);
    let mut cases = Vec::new();
    for (k, (case, outline)) in crossing.enumerate() {
        for (l, (after, turn)) in before.iter().enumerate() {
            let (name, [a, b, c]) = LOBES[(k + 2 * l) % LOBES.len()];
            // Those that do not cross leave the turn as it is: once is enough.
            if l == 1 || outline.turn != LEVEL {
                cases.push((format!("{case}{after}; {name}"), Turning { turn: *turn, outline, m_inv: lobe(a, b, c) }));
            }
        }
    }
    TURN.rows(index, named(&cases))
}
