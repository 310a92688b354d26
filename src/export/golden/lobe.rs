//! A lobe's density in a direction, and directions of that density.

use super::flat::flat;
use super::function::{Definition, Function, Row};
use super::mistake::Mistake;
use super::outline::mistaken_matrix;
use super::walks::lobe;
use glam::{DMat3, DVec2, DVec3};
use std::f64::consts::{PI, TAU};

flat!(Towards { m_inv: DMat3, direction: DVec3 });
flat!(Drawing { m_inv: DMat3, uniforms: DVec2 });

/// How far the sines of a driver may be off.
const SINE: f64 = 1.0 / 2048.0;

const DENSITY: Definition<Towards, f64> = Definition {
    name: "ltc_density",
    output: "density",
    answer: |towards| density(towards.m_inv, towards.direction),
    tolerance: |towards, density| 2e-6 * cancelled(towards) * density + 1e-9,
    reason: "2e-6 of it, some roundings of a squared length that counts twice; times what cancels in that length, which a narrow lobe's lean \
             enlarges.",
    mistaken: |towards, mistake| match mistake {
        Mistake::MInvTransposed => Some(density(towards.m_inv.transpose(), towards.direction)),
        other => mistaken_matrix(towards.m_inv, other).map(|m_inv| density(m_inv, towards.direction)),
    },
};

const SAMPLE: Definition<Drawing, DVec3> = Definition {
    name: "ltc_sample",
    output: "direction",
    answer: |drawing| sample(drawing.m_inv, drawing.uniforms, DVec2::ZERO),
    tolerance: |drawing, exact| {
        let moved = |by| (sample(drawing.m_inv, drawing.uniforms, by) - exact).abs();
        moved(SINE * DVec2::X) + moved(SINE * DVec2::Y) + 2e-6
    },
    reason: "2e-6, and what a sine and a cosine that are off by 2^-11 do: drivers may err by as much.",
    mistaken: |drawing, mistake| {
        mistaken_matrix(drawing.m_inv, mistake).map(|m_inv| sample(m_inv, drawing.uniforms, DVec2::ZERO))
    },
};

/// The cosine's density at w' = M^-1 w / |M^-1 w| times the Jacobian of w -> w', det / |M^-1 w|^3.
fn density(m_inv: DMat3, direction: DVec3) -> f64 {
    let transformed = m_inv * direction;
    let length = transformed.length();
    let cosine = if direction.z > 0.0 { transformed.z.max(0.0) / length } else { 0.0 };
    let jacobian = m_inv.determinant() / length.powi(3);
    if length > 0.0 { cosine / PI * jacobian } else { 0.0 }
}

/// By how much the sums of magnitudes in the squared length of M^-1 w exceed it.
fn cancelled(Towards { m_inv, direction }: &Towards) -> f64 {
    let transformed = *m_inv * *direction;
    let [x, y, z] = [m_inv.x_axis.abs(), m_inv.y_axis.abs(), m_inv.z_axis.abs()];
    let magnitudes = DMat3::from_cols(x, y, z) * direction.abs();
    let square = transformed.length_squared();
    if square > 0.0 { transformed.abs().dot(magnitudes) / square } else { 1.0 }
}

/// A sample of the cosine, from the unit disc, under the lobe's matrix; `off` is added to the azimuth's cosine and sine.
fn sample(m_inv: DMat3, uniforms: DVec2, off: DVec2) -> DVec3 {
    if m_inv.determinant() <= 0.0 {
        return DVec3::Z;
    }
    let across = uniforms.y.sqrt() * (DVec2::from_angle(TAU * uniforms.x) + off);
    (m_inv.inverse() * across.extend((1.0 - uniforms.y).sqrt())).normalize()
}

pub(super) fn densities(index: usize) -> (Function, Vec<Row>) {
    let towards = |m_inv: DMat3, direction: [f64; 3]| Towards { m_inv, direction: DVec3::from(direction).normalize() };
    let (dust, fuzz, mirror) = (lobe(0.75, -0.25, 0.75), lobe(0.2, -0.85, 0.2), lobe(6.0, 7.5, 14.0));
    DENSITY.rows(
        index,
        [
            ("diffuse along the normal", towards(lobe(1.0, 0.0, 1.0), [0.0, 0.0, 1.0])),
            ("dust away from the view", towards(dust, [-0.6, 0.2, 0.7])),
            ("dust towards the view", towards(dust, [0.5, 0.4, 0.6])),
            ("fuzz at grazing angles", towards(fuzz, [0.9, -0.2, 0.2])),
            ("fuzz along the normal", towards(fuzz, [0.0, 0.0, 1.0])),
            ("fuzz at its peak", towards(fuzz, [0.85, 0.0, 0.2])),
            ("broad mirror", towards(lobe(1.25, 0.9, 1.75), [-0.5, 0.3, 0.7])),
            ("narrow mirror at its peak", towards(mirror, [-0.78, 0.0, 0.62])),
            ("narrow mirror beside its peak", towards(mirror, [-0.7, 0.15, 0.62])),
            ("a matrix of six numbers", towards(general(), [0.4, -0.3, 0.7])),
            ("on the horizon", towards(dust, [0.6, -0.8, 0.0])),
            ("below the horizon", towards(fuzz, [0.6, 0.2, -0.3])),
            ("a = 0", towards(lobe(0.0, -0.4, 0.0), [0.3, 0.2, 0.8])),
        ],
    )
}

/// A matrix that no table holds.
fn general() -> DMat3 {
    DMat3::from_cols_array(&[0.9, 0.3, 0.0, -0.2, 0.5, 0.0, 0.4, -0.3, 1.0])
}

pub(super) fn samples(index: usize) -> (Function, Vec<Row>) {
    let drawing = |m_inv: DMat3, uniforms: [f64; 2]| Drawing { m_inv, uniforms: uniforms.into() };
    let (dust, fuzz) = (lobe(0.75, -0.25, 0.75), lobe(0.2, -0.85, 0.2));
    SAMPLE.rows(
        index,
        [
            ("diffuse", drawing(lobe(1.0, 0.0, 1.0), [0.15, 0.4])),
            ("diffuse along the normal", drawing(lobe(1.0, 0.0, 1.0), [0.7, 0.0])),
            ("dust", drawing(dust, [0.3, 0.6])),
            ("dust after nearly a whole turn", drawing(dust, [0.95, 0.8])),
            ("fuzz", drawing(fuzz, [0.55, 0.3])),
            ("fuzz at grazing angles", drawing(fuzz, [0.8, 0.95])),
            ("broad mirror", drawing(lobe(1.25, 0.9, 1.75), [0.4, 0.5])),
            ("narrow mirror", drawing(lobe(6.0, 7.5, 14.0), [0.65, 0.25])),
            ("a matrix of six numbers", drawing(general(), [0.2, 0.7])),
            ("a = 0", drawing(lobe(0.0, -0.4, 0.0), [0.3, 0.6])),
        ],
    )
}
