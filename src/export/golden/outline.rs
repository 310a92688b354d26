//! A walk around a polygon: its edges, cut at the horizon, and what each adds to a lobe's sum and to the turn.

use super::flat::{Flat, flat};
use super::function::{Definition, none};
use super::mistake::Mistake;
use glam::{DMat3, DVec2, DVec3};

flat!(
    /// `LtcOutline`.
    Outline { corner: DVec3, p: DVec3, q: DVec3, normal: DVec3, sine: f64, turn: DVec2 }
);

flat!(Last { last: DVec3 });
flat!(Step { outline: Outline, corner: DVec3 });
flat!(Edge { outline: Outline, m_inv: DMat3 });
flat!(Turning { turn: DVec2, outline: Outline, m_inv: DMat3 });

/// The turn before any edge.
pub(super) const LEVEL: DVec2 = DVec2::X;
/// Vertices no higher than this are below the horizon.
const HORIZON: f64 = 1e-20;
/// Two roundings of an `f32`.
pub(super) const ROUNDING: f64 = 2.4e-7;

pub(super) const BEGIN: Definition<Last, Outline> = Definition {
    name: "ltc_begin",
    output: "",
    answer: |input| begin(input.last),
    tolerance: |_, outline| magnitudes(*outline, ROUNDING),
    reason: "2.4e-7 of each number, two roundings: they are copied.",
    mistaken: none,
};

pub(super) const NEXT: Definition<Step, Outline> = Definition {
    name: "ltc_next",
    output: "",
    answer: |step| next(&step.outline, step.corner),
    tolerance: next_tolerance,
    reason: "2.4e-7 of each number, two roundings; of products besides 2^-31 of the product of both vertices' distances, which an \
             ordinary cross product misses by far. Of an edge below the horizon p and q are free, and of one without a length the sine.",
    mistaken: none,
};

pub(super) const EDGE: Definition<Edge, f64> = Definition {
    name: "ltc_edge",
    output: "sum",
    answer: |edge| edge_vector(edge).z,
    tolerance: |edge, _| edge_tolerance(edge),
    reason: EDGE_REASON,
    mistaken: |edge, mistake| misread(edge, mistake).map(|edge| edge_vector(&edge).z),
};

pub(super) const EDGE_VECTOR: Definition<Edge, DVec3> = Definition {
    name: "ltc_edge_vector",
    output: "sum",
    answer: edge_vector,
    tolerance: |edge, _| DVec3::splat(edge_tolerance(edge)),
    reason: EDGE_REASON,
    mistaken: |edge, mistake| misread(edge, mistake).map(|edge| edge_vector(&edge)),
};

const EDGE_REASON: &str = "1e-6: 3e-7 of the arctangent and some roundings of an angle up to pi; times what cancels where the lobe's matrix is \
                           applied to p, q and the normal.";

pub(super) const TURN: Definition<Turning, DVec2> = Definition {
    name: "ltc_turn",
    output: "turn",
    answer: turn,
    tolerance: |_, _| DVec2::splat(1e-6),
    reason: "1e-6, some roundings of numbers up to 1. The turn is scaled such that |x| + |y| = 1.",
    mistaken: |turning, mistake| {
        (mistake == Mistake::TurnForgotten).then(|| turning.turn / (turning.turn.x.abs() + turning.turn.y.abs()))
    },
};

pub(super) fn begin(last: DVec3) -> Outline {
    Outline { corner: last, p: DVec3::ZERO, q: DVec3::ZERO, normal: DVec3::ZERO, sine: 0.0, turn: LEVEL }
}

/// The edge to the next vertex. Where it crosses the horizon, at start |z of corner| + corner |z of start|.
pub(super) fn next(before: &Outline, corner: DVec3) -> Outline {
    let start = before.corner;
    let crossing = (start * corner.z.abs() + corner * start.z.abs()).with_z(0.0);
    let (p, q, turn) = match (start.z > HORIZON, corner.z > HORIZON) {
        (true, true) => (start, corner, LEVEL),
        (true, false) => (start, crossing, DVec2::new(crossing.x, -crossing.y)),
        (false, true) => (crossing, corner, crossing.truncate()),
        (false, false) => (DVec3::ZERO, DVec3::ZERO, LEVEL),
    };
    let normal = corner.cross(start);
    let sine = if normal == DVec3::ZERO { 0.0 } else { q.cross(p).length() / normal.length() };
    Outline { corner, p, q, normal, sine, turn }
}

/// A share of the size of each number.
fn magnitudes(mut outline: Outline, share: f64) -> Outline {
    outline.each("", &mut |_, number| *number = number.abs() * share);
    outline
}

fn next_tolerance(step: &Step, outline: &Outline) -> Outline {
    let start = step.outline.corner;
    let product = (start.length() * step.corner.length()) / f64::from(1_u32 << 31);
    let mut tolerance = magnitudes(*outline, ROUNDING);
    tolerance.normal += product;
    let both = [start, step.corner].map(|vertex| vertex.z > HORIZON);
    if both[0] != both[1] {
        let cut = if both[0] { &mut tolerance.q } else { &mut tolerance.p };
        *cut += DVec3::new(product, product, 0.0);
        tolerance.turn += product;
    }
    if both == [false, false] {
        [tolerance.p, tolerance.q] = [DVec3::INFINITY; 2];
    } else if outline.normal == DVec3::ZERO {
        tolerance.sine = f64::INFINITY;
    }
    tolerance
}

/// How a matrix carries normals: its determinant times the inverse's transpose, which is there for a singular one too.
pub(super) fn cofactors(m: DMat3) -> DMat3 {
    DMat3::from_cols(m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis))
}

/// The arc's angle along its unit normal, in the lobe's space.
pub(super) fn edge_vector(Edge { outline, m_inv }: &Edge) -> DVec3 {
    let normal = cofactors(*m_inv) * outline.normal;
    let angle = (outline.sine * normal.length()).atan2((*m_inv * outline.p).dot(*m_inv * outline.q));
    normal.normalize_or_zero() * angle
}

fn edge_tolerance(Edge { outline, m_inv }: &Edge) -> f64 {
    // By how much sums of magnitudes exceed magnitudes of sums.
    let cancelled = |m: DMat3, v: DVec3| {
        let magnitudes = DMat3::from_cols(m.x_axis.abs(), m.y_axis.abs(), m.z_axis.abs());
        let length = (m * v).length();
        if length > 0.0 { (magnitudes * v.abs()).length() / length } else { 1.0 }
    };
    let most =
        [cancelled(*m_inv, outline.p), cancelled(*m_inv, outline.q), cancelled(cofactors(*m_inv), outline.normal)];
    1e-6 * most.into_iter().fold(1.0, f64::max)
}

/// The matrix as it is taken for by mistake where its entries are read.
pub(super) fn mistaken_matrix(m_inv: DMat3, mistake: Mistake) -> Option<DMat3> {
    let leaning = |m: DMat3, factor: f64| DMat3::from_cols(m.x_axis, m.y_axis, (factor * m.z_axis).with_z(1.0));
    match mistake {
        // In the third row there is 0 where b is in the third column.
        Mistake::MInvTransposed => {
            let rows = m_inv.transpose();
            Some(leaning(DMat3::from_cols(rows.x_axis.with_z(0.0), rows.y_axis.with_z(0.0), DVec3::Z), 0.0))
        }
        Mistake::BSign => Some(leaning(m_inv, -1.0)),
        _ => None,
    }
}

fn misread(edge: &Edge, mistake: Mistake) -> Option<Edge> {
    mistaken_matrix(edge.m_inv, mistake).map(|m_inv| Edge { m_inv, ..*edge })
}

/// The arguments of both add up; the result is as long as `ltc_turn` makes it.
fn turn(turning: &Turning) -> DVec2 {
    let by = DVec2::new(turning.m_inv.x_axis.x, turning.m_inv.y_axis.y) * turning.outline.turn;
    let argument = turning.turn.y.atan2(turning.turn.x) + by.y.atan2(by.x);
    let direction = DVec2::from_angle(argument);
    direction / (direction.x.abs() + direction.y.abs())
}
