//! Points of polygons: a fan of triangles, and the point in one of them.

use super::flat::{Flat, flat};
use super::function::{Definition, none};
use super::outline::{Outline, cofactors};
use crate::reference::convex::Convex;
use glam::{DMat3, DVec3};
use std::f64::consts::TAU;

flat!(
    /// `LtcSampleFan`.
    Fan {
        left: f64,
        drawn: f64,
        apex: DVec3,
        reached: DVec3,
        spoke: DVec3,
        spoke_sector: f64,
        corners: DMat3,
        normals: DMat3,
        sectors: DVec3,
    }
);

flat!(Beginning { number: f64, form_factor: f64 });
flat!(FanEdge { fan: Fan, p: DVec3, q: DVec3, normal: DVec3, sine: f64, m_inv: DMat3 });
flat!(Point { fan: Fan, m_inv: DMat3, number: f64 });

/// Error of an area, over c / a.
const AREA: f64 = 3e-6;

pub(super) const BEGIN: Definition<Beginning, Fan> = Definition {
    name: "ltc_sample_begin",
    output: "",
    answer: begin,
    tolerance: |_, fan| same(1e-6 + 2.4e-7 * fan.left.abs()),
    reason: "1e-6 and two roundings.",
    mistaken: none,
};

pub(super) const EDGE: Definition<FanEdge, Fan> = Definition {
    name: "ltc_sample_edge",
    output: "",
    answer: edge,
    tolerance: |step, _| {
        let area = AREA * narrowness(step.m_inv);
        Fan { left: area, drawn: area, spoke_sector: area, sectors: DVec3::splat(area), ..same(2e-6) }
    },
    reason: "3e-6 of areas: three angles up to pi, of 3e-7 and some roundings each, times c/a. 2e-6 of vectors, whose greatest number is \
             between 1 and 2, and of their products.",
    mistaken: none,
};

pub(super) const POINT: Definition<Point, DVec3> = Definition {
    name: "ltc_sample_point",
    output: "direction",
    answer: |point| sampled(point, 0.0, 0.0),
    tolerance: point_tolerance,
    reason: "5e-6, and what areas that are off by 3e-6 times c/a, and a number that is off by 2e-6, move the point by.",
    mistaken: none,
};

/// c / a, at least 1.
fn narrowness(m_inv: DMat3) -> f64 {
    if m_inv.x_axis.x > 0.0 { (m_inv.y_axis.y / m_inv.x_axis.x).max(1.0) } else { 1.0 }
}

/// The same number everywhere.
fn same(number: f64) -> Fan {
    let mut fan = begin(&Beginning { number: 0.0, form_factor: 0.0 });
    fan.each("", &mut |_, value| *value = number);
    fan
}

pub(super) fn begin(Beginning { number, form_factor }: &Beginning) -> Fan {
    let left = if *form_factor > 0.0 { TAU * number * form_factor } else { -1.0 };
    let (none, nowhere) = (DVec3::ZERO, DMat3::ZERO);
    Fan {
        left,
        drawn: 0.0,
        apex: none,
        reached: none,
        spoke: none,
        spoke_sector: 0.0,
        corners: nowhere,
        normals: nowhere,
        sectors: none,
    }
}

/// The edge's part above the horizon, after what along the horizon leads to it.
pub(super) fn edge(step: &FanEdge) -> Fan {
    let mut fan = step.fan;
    if step.sine == 0.0 {
        return fan;
    }
    let [start, end] = [step.p, step.q].map(scaled);
    if fan.apex == DVec3::ZERO {
        [fan.apex, fan.reached] = [start; 2];
    }
    if fan.reached != start {
        fan = triangle(&fan, start, step.m_inv);
    }
    triangle(&fan, end, step.m_inv)
}

/// By the power of two that brings its greatest number into \[1, 2).
fn scaled(v: DVec3) -> DVec3 {
    v / v.abs().max_element().log2().floor().exp2()
}

/// The triangle between the apex, the vertex reached and the next one. Areas are twice those on the disc: of the angle of an
/// arc and its normal's height, for each side.
fn triangle(before: &Fan, corner: DVec3, m_inv: DMat3) -> Fan {
    let spoke = before.apex.cross(corner);
    let spoke_sector = sector(before.apex, corner, m_inv);
    let sectors = DVec3::new(before.spoke_sector, sector(before.reached, corner, m_inv), -spoke_sector);
    let is_none = before.reached == before.apex || corner == before.apex || m_inv.determinant() <= 0.0;
    let area = if is_none { 0.0 } else { sectors.element_sum().abs() };
    let mut fan = Fan { left: before.left - area, reached: corner, spoke, spoke_sector, ..*before };
    if area > 0.0 && before.left >= 0.0 {
        fan.drawn = before.left;
        fan.corners = DMat3::from_cols(before.apex, before.reached, corner);
        fan.normals = DMat3::from_cols(before.spoke, before.reached.cross(corner), -spoke);
        fan.sectors = sectors;
    }
    fan
}

fn sector(p: DVec3, q: DVec3, m_inv: DMat3) -> f64 {
    let normal = cofactors(m_inv) * p.cross(q);
    let angle = normal.length().atan2((m_inv * p).dot(m_inv * q));
    normal.normalize_or_zero().z * angle
}

/// The point of the fan's triangle by the reference's sampler of the cosine; area and number may be off.
fn sampled(point: &Point, area_off: f64, number_off: f64) -> DVec3 {
    let whole = point.fan.sectors.element_sum().abs();
    if whole == 0.0 {
        return DVec3::ZERO;
    }
    let corners = point.m_inv * point.fan.corners;
    let triangle = Convex::new(&[corners.x_axis, corners.y_axis, corners.z_axis]);
    let inside = |share: f64| share.clamp(0.0, 1.0 - 1e-12);
    let share = inside((point.fan.drawn / whole).fract() + area_off / whole);
    let cosine = triangle.sample([share, inside(point.number + number_off)]);
    cosine.map_or(DVec3::ZERO, |cosine| (point.m_inv.inverse() * cosine).normalize())
}

fn point_tolerance(point: &Point, exact: &DVec3) -> DVec3 {
    let area = AREA * narrowness(point.m_inv);
    let off = |area_off, number_off| (sampled(point, area_off, number_off) - *exact).abs();
    off(area, 0.0).max(off(-area, 0.0)) + off(0.0, 2e-6).max(off(0.0, -2e-6)) + 5e-6
}

/// The step along an edge that an outline walked.
pub(super) fn step(fan: Fan, outline: &Outline, m_inv: DMat3) -> FanEdge {
    FanEdge { fan, p: outline.p, q: outline.q, normal: outline.normal, sine: outline.sine, m_inv }
}
