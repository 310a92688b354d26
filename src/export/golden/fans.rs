//! Rows of the fan of triangles: every step around some lights, and points of them.

use super::fan::{BEGIN, Beginning, EDGE, Fan, FanEdge, POINT, Point, begin, edge, step};
use super::flat::Flat;
use super::function::{Function, Row};
use super::outline::{begin as outline_begin, next};
use super::walks::lobe;
use glam::DMat3;
use std::f64::consts::TAU;

/// What is special about it, its corners in the shading frame, and a lobe's a, b and c.
type Light = (&'static str, &'static [[f64; 3]], [f64; 3]);

/// Convex ones.
const LIGHTS: [Light; 6] = [
    ("triangle beside the zenith; diffuse", &[[0.2, 0.1, 1.0], [1.0, 0.3, 0.7], [0.5, 1.0, 0.4]], [1.0, 0.0, 1.0]),
    (
        "quadrilateral around the zenith; dust",
        &[[-1.0, -1.0, 1.0], [1.0, -1.2, 0.6], [1.1, 1.0, 1.0], [-1.0, 0.9, 1.4]],
        [0.75, -0.25, 0.75],
    ),
    (
        "across the horizon; fuzz",
        &[[1.0, -1.0, -0.5], [1.0, 1.0, -0.7], [1.0, 1.1, 1.0], [1.0, -1.0, 0.8]],
        [0.3, -0.7, 0.3],
    ),
    ("one vertex above the horizon; dust", &[[1.0, -0.9, -0.5], [1.0, 1.0, -0.7], [1.0, 0.1, 1.0]], [0.6, -0.3, 0.6]),
    (
        "pentagon seen from its other side; broad mirror",
        &[[-0.4, 0.5, 0.9], [-1.1, 0.6, 0.8], [-1.3, 0.1, 0.7], [-0.9, -0.4, 0.8], [-0.3, -0.2, 1.0]],
        [1.25, 0.9, 1.75],
    ),
    ("far from the point; diffuse", &[[40.0, 10.0, 90.0], [70.0, -20.0, 80.0], [90.0, 30.0, 70.0]], [1.0, 0.0, 1.0]),
];

/// Each step around a light, with what it is given, from a number in \[0, 1) and the light's form factor.
fn steps(corners: &[[f64; 3]], m_inv: DMat3, number: f64) -> Vec<FanEdge> {
    let walk = |mut fan: Fan| {
        let mut outline = outline_begin(corners[corners.len() - 1].into()).rounded();
        let mut steps = Vec::new();
        for corner in corners {
            outline = next(&outline, (*corner).into()).rounded();
            let given = step(fan, &outline, m_inv).rounded();
            fan = edge(&given).rounded();
            steps.push(given);
        }
        (steps, fan)
    };
    let full = Beginning { number: 1.0, form_factor: 1.0 };
    let (_, around) = walk(begin(&full));
    let form_factor = (begin(&full).left - around.left) / TAU;
    walk(begin(&Beginning { number, form_factor })).0
}

pub(super) fn begins(index: usize) -> (Function, Vec<Row>) {
    let beginning = |number: f64, form_factor: f64| Beginning { number, form_factor };
    BEGIN.rows(
        index,
        [
            ("a light", beginning(0.3, 0.25)),
            ("the whole hemisphere", beginning(0.875, 1.0)),
            ("number 0", beginning(0.0, 0.125)),
            ("form factor 0: nothing to draw", beginning(0.5, 0.0)),
        ],
    )
}

pub(super) fn edges(index: usize) -> (Function, Vec<Row>) {
    let mut cases = Vec::new();
    for (name, corners, [a, b, c]) in LIGHTS {
        for (k, given) in steps(corners, lobe(a, b, c), 0.6).into_iter().enumerate() {
            cases.push((format!("{name}; edge {}", k + 1), given));
        }
    }
    let (name, corners, _) = LIGHTS[1];
    let singular = steps(corners, lobe(0.0, -0.4, 0.0), 0.6).into_iter().nth(2);
    cases.extend(singular.map(|given| (format!("{name} with a = 0; edge 3"), given)));
    EDGE.rows(index, cases.iter().map(|(case, input)| (case.as_str(), *input)))
}

pub(super) fn points(index: usize) -> (Function, Vec<Row>) {
    let mut cases = Vec::new();
    for (name, corners, [a, b, c]) in LIGHTS {
        let m_inv = lobe(a, b, c);
        for [first, second] in [[0.15, 0.7], [0.5, 0.35], [0.85, 0.9]] {
            let fan = steps(corners, m_inv, first).last().map(edge);
            let case = format!("{name}; numbers {first} and {second}");
            cases.extend(fan.map(|fan| (case, Point { fan, m_inv, number: second })));
        }
    }
    let nothing = begin(&Beginning { number: 0.5, form_factor: 0.0 });
    cases.push(("nothing to draw".to_owned(), Point { fan: nothing, m_inv: lobe(0.75, -0.25, 0.75), number: 0.5 }));
    if let Some((_, point)) = cases.first().cloned() {
        let whole = point.fan.sectors.element_sum().abs();
        let past = Fan { drawn: 1.25 * whole, ..point.fan };
        cases.push(("past the last triangle by rounding: through it again".to_owned(), Point { fan: past, ..point }));
    }
    POINT.rows(index, cases.iter().map(|(case, input)| (case.as_str(), *input)))
}
