//! From a lobe's sum and the turn to the form factor, and the arithmetic below it.

use super::flat::flat;
use super::function::{Definition, Function, Row, none};
use super::outline::ROUNDING;
use super::walks::lobe;
use glam::{DMat3, DVec2, DVec3};
use std::f64::consts::TAU;

flat!(Closed { sum: f64, turn: DVec2, m_inv: DMat3, side: f64 });
flat!(ClosedVector { sum: DVec3, turn: DVec2, side: f64 });
flat!(Arc { normal: DVec3, sine: f64, cosine: f64 });
flat!(Angle { sine: f64, cosine: f64 });
flat!(Pair { p: DVec3, q: DVec3 });

const FORM_FACTOR: Definition<Closed, f64> = Definition {
    name: "ltc_form_factor",
    output: "form_factor",
    answer: |closed| {
        let share = (closed.side * closed.sum + closing(closed.turn, closed.side)) / TAU;
        if closed.m_inv.determinant() > 0.0 { share.clamp(0.0, 1.0) } else { 0.0 }
    },
    tolerance: |_, _| 5e-7,
    reason: "5e-7, the shader's stated error.",
    mistaken: none,
};

const VECTOR: Definition<ClosedVector, DVec3> = Definition {
    name: "ltc_vector",
    output: "vector",
    answer: |closed| (closed.side * closed.sum + DVec3::Z * closing(closed.turn, closed.side)) / TAU,
    tolerance: |_, _| DVec3::splat(5e-7),
    reason: "5e-7, the shader's stated error.",
    mistaken: none,
};

const ARC: Definition<Arc, f64> = Definition {
    name: "ltc_arc",
    output: "angle",
    answer: |arc| {
        let size = arc.normal.length();
        if size > 0.0 { (arc.sine * size).atan2(arc.cosine) / size } else { 0.0 }
    },
    tolerance: |arc, _| 1e-6 / arc.normal.length().max(1e-6),
    reason: "1e-6 over the normal's length: 3e-7 of the arctangent and some roundings of an angle up to pi.",
    mistaken: none,
};

const ANGLE: Definition<Angle, f64> = Definition {
    name: "ltc_angle",
    output: "angle",
    answer: |angle| angle.sine.atan2(angle.cosine),
    tolerance: |_, _| 8e-7,
    reason: "8e-7: 3e-7 of the arctangent, and two roundings of an angle up to pi.",
    mistaken: none,
};

const CROSS: Definition<Pair, DVec3> = Definition {
    name: "ltc_cross",
    output: "product",
    answer: |pair| pair.p.cross(pair.q),
    tolerance: |pair, product| {
        let split = pair.p.length() * pair.q.length() / f64::from(1_u32 << 31);
        product.abs() * ROUNDING + split
    },
    reason: "2.4e-7 of each number, two roundings, and 2^-31 of the product of both lengths, which an ordinary cross product misses by \
             far.",
    mistaken: none,
};

/// The angle along the horizon that closes the contours.
fn closing(turn: DVec2, side: f64) -> f64 {
    side.abs() * turn.y.atan2(turn.x).abs()
}

pub(super) fn form_factors(index: usize) -> (Function, Vec<Row>) {
    let closed = |sum: f64, turn: [f64; 2], [a, b, c]: [f64; 3], side: f64| Closed {
        sum,
        turn: turn.into(),
        m_inv: lobe(a, b, c),
        side,
    };
    let (diffuse, sheen) = ([1.0, 0.0, 1.0], [0.3, -0.6, 0.3]);
    FORM_FACTOR.rows(
        index,
        [
            ("above the horizon", closed(1.75, [1.0, 0.0], diffuse, 1.0)),
            ("across the horizon", closed(-0.5, [0.375, 0.625], sheen, 1.0)),
            ("across the horizon and turned the other way", closed(-0.5, [0.375, -0.625], sheen, 1.0)),
            ("turned by more than a right angle", closed(-1.5, [-0.75, 0.25], sheen, 1.0)),
            ("turned by nearly pi", closed(0.0, [-1.0, 1e-4], diffuse, 1.0)),
            ("two-sided from behind", closed(-1.75, [1.0, 0.0], diffuse, -1.0)),
            ("two-sided from behind across the horizon", closed(0.5, [0.375, -0.625], sheen, -1.0)),
            ("none of it arrives", closed(1.75, [0.375, 0.625], sheen, 0.0)),
            ("a hair below 0 is 0", closed(-1e-3, [1.0, 0.0], diffuse, 1.0)),
            ("the whole hemisphere and a hair is 1", closed(6.29, [1.0, 0.0], diffuse, 1.0)),
            ("a = 0", closed(1.75, [0.5, 0.5], [0.0, -0.4, 0.0], 1.0)),
            ("narrow mirror", closed(0.01, [1.0, 0.0], [6.0, 7.5, 14.0], 1.0)),
        ],
    )
}

pub(super) fn vectors(index: usize) -> (Function, Vec<Row>) {
    let closed = |sum: [f64; 3], turn: [f64; 2], side: f64| ClosedVector { sum: sum.into(), turn: turn.into(), side };
    VECTOR.rows(
        index,
        [
            ("above the horizon", closed([0.3, -0.2, 1.75], [1.0, 0.0], 1.0)),
            ("across the horizon", closed([0.9, 0.4, -0.5], [0.375, 0.625], 1.0)),
            ("turned by more than a right angle", closed([0.9, 0.4, -1.5], [-0.75, -0.25], 1.0)),
            ("two-sided from behind", closed([-0.3, 0.2, -1.75], [0.875, 0.125], -1.0)),
            ("none of it arrives", closed([0.3, -0.2, 1.75], [0.375, 0.625], 0.0)),
        ],
    )
}

pub(super) fn arcs(index: usize) -> (Function, Vec<Row>) {
    let arc = |normal: [f64; 3], sine: f64, cosine: f64| Arc { normal: normal.into(), sine, cosine };
    ARC.rows(
        index,
        [
            ("acute", arc([0.1, -0.4, 0.5], 1.0, 0.8)),
            ("obtuse", arc([0.3, 0.2, -0.6], 1.0, -0.5)),
            ("cut at the horizon", arc([0.7, 0.1, 0.2], 0.35, 0.6)),
            ("long normal", arc([30.0, -20.0, 10.0], 1.0, 100.0)),
            ("short normal", arc([2e-4, -1e-4, 3e-4], 1.0, 0.9)),
            ("below the horizon", arc([0.7, 0.1, 0.2], 0.0, 0.6)),
            ("degenerate: no normal", arc([0.0, 0.0, 0.0], 1.0, 0.6)),
        ],
    )
}

pub(super) fn angles(index: usize) -> (Function, Vec<Row>) {
    let angle = |sine: f64, cosine: f64| Angle { sine, cosine };
    ANGLE.rows(
        index,
        [
            ("0", angle(0.0, 2.0)),
            ("small", angle(1e-4, 1.0)),
            ("an eighth of a turn", angle(0.5, 0.5)),
            ("acute", angle(0.3, 0.7)),
            ("steep", angle(0.7, 0.3)),
            ("a quarter", angle(3.0, 0.0)),
            ("obtuse and steep", angle(0.7, -0.3)),
            ("obtuse", angle(0.3, -0.7)),
            ("nearly half a turn", angle(1e-4, -1.0)),
            ("half a turn", angle(0.0, -2.0)),
            ("large numbers", angle(2e9, -5e9)),
            ("small numbers", angle(2e-9, 5e-9)),
            ("two zeros", angle(0.0, 0.0)),
        ],
    )
}

pub(super) fn crosses(index: usize) -> (Function, Vec<Row>) {
    let pair = |p: [f64; 3], q: [f64; 3]| Pair { p: p.into(), q: q.into() };
    CROSS.rows(
        index,
        [
            ("wide apart", pair([0.4, -0.3, 0.6], [1.1, 0.2, -0.3])),
            ("nearly parallel", pair([0.7, 0.3, 0.9], [0.70001, 0.29999, 0.90002])),
            ("nearly parallel and far", pair([812.3, 310.7, 505.9], [812.3, 310.8, 505.8])),
            ("nearly opposite", pair([0.7, 0.3, 0.9], [-1.4, -0.60001, -1.80002])),
            ("of very different lengths", pair([3e4, -2e4, 1e4], [1e-3, 2e-3, -4e-3])),
            ("parallel", pair([0.25, -0.5, 0.75], [0.5, -1.0, 1.5])),
            ("a zero", pair([0.0, 0.0, 0.0], [0.3, 0.2, 0.1])),
        ],
    )
}
