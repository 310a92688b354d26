// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// Points of convex polygons, drawn by the share of a linearly transformed cosine that falls on them: density ltc_density / ltc_sample_share.
// Copy with it: ltc.wgsl, whose outlines it is given, edge by edge; m_inv is one of its lobes, with rows (a,0,b), (0,c,0), (0,0,1).
// Frame: z = normal; directions as in ltc.wgsl; either winding. Projected to the unit disc arcs are ellipses (Peters 2021): a fan of triangles is summed.
// Example: fan = ltc_sample_edge(fan, outline.p, outline.q, outline.normal, outline.sine, m_inv); let wo = ltc_sample_point(fan, m_inv, number);
// Ranges: as of ltc.wgsl, and coordinates from 1e-8; parts convex as seen from the point, any number of vertices; uniform numbers in [0,1); never NaN.
// Greatest error: @

const LTC_SAMPLE_PI = 3.14159265358979;
// Halley's steps towards an azimuth. The area up to it is off by 1e-6 of the triangle's in the mean after three, 2e-5 after two.
const LTC_SAMPLE_STEPS = 3u;

// The triangles between a part's first vertex and its edges: those so far, and one of them, drawn in proportion to its area.
struct LtcSampleFan {
    area: f32,               // twice that of all so far, projected from the lobe's sphere to the disc
    number: f32,             // uniform in [0,1], whichever was drawn
    apex: vec3<f32>,         // the first vertex above the horizon; 0 before it
    reached: vec3<f32>,      // and the last
    spoke: vec3<f32>,        // apex x reached
    spoke_sector: f32,
    corners: mat3x3<f32>,    // of the triangle that was drawn
    normals: mat3x3<f32>,    // corner x next corner
    sectors: vec3<f32>,      // twice the signed areas between its sides and the zenith
}

// What lies between two arcs that part at a corner, up to where the nearer other corner stands in azimuth. Along the outer arc,
// by an angle t from the corner, the inner one is met at the angle u: cot u = (inner cot t - lean) / outer.
struct LtcSampleWedge {
    outer: f32,        // heights of the arcs' unit normals; inner is 0 for the zenith itself
    inner: f32,
    lean: f32,
    end: vec2<f32>,    // cosine and sine of the greatest t
    area: f32,         // twice
}

// Before the first part of a light; the uniform number draws the triangle and the azimuth in it.
fn ltc_sample_begin(number: f32) -> LtcSampleFan {
    let none = vec3(0.0);
    let nothing = mat3x3(none, none, none);
    return LtcSampleFan(0.0, number, none, none, none, 0.0, nothing, nothing, none);
}

// Before each further one: the point is then of any, by their shares.
fn ltc_sample_part(before: LtcSampleFan) -> LtcSampleFan {
    var fan = before;
    fan.apex = vec3(0.0);
    return fan;
}

// Adds the edge that an LtcOutline walked last. What closes the outline along the horizon is added on the way.
fn ltc_sample_edge(before: LtcSampleFan, p: vec3<f32>, q: vec3<f32>, normal: vec3<f32>, sine: f32, m_inv: mat3x3<f32>) -> LtcSampleFan {
    var fan = before;
    if sine <= 0.0 {
        return fan;
    }
    let p_scale = ltc_sample_scale(p);
    let q_scale = ltc_sample_scale(q);
    let start = p_scale * p;
    if all(fan.apex == vec3(0.0)) {
        fan.apex = start;
        fan.reached = start;
    } else if any(fan.reached != start) {
        fan = ltc_sample_triangle(fan, start, ltc_sample_cross(fan.reached, start), m_inv);
    }
    return ltc_sample_triangle(fan, q_scale * q, -(p_scale * normal) * (q_scale * sine), m_inv);
}

// The share of the lobe on all parts so far: their form factor. Where it is 0 there is no point.
fn ltc_sample_share(fan: LtcSampleFan) -> f32 {
    return min(fan.area / (2.0 * LTC_SAMPLE_PI), 1.0);
}

// A unit direction from the triangle that was drawn and another uniform number; the normal where the share is 0.
fn ltc_sample_point(fan: LtcSampleFan, m_inv: mat3x3<f32>, number: f32) -> vec3<f32> {
    if fan.area <= 0.0 {
        return vec3(0.0, 0.0, 1.0);
    }
    let sectors = fan.sectors * sign(fan.sectors.x + fan.sectors.y + fan.sectors.z);
    let below = sectors < vec3(0.0);
    let holds_zenith = !any(below);
    // Where the zenith is inside, one of the sectors; elsewhere the side that faces it alone, or turns away alone.
    let drawn = fan.number * (sectors.x + sectors.y + sectors.z);
    let is_third = select(below.x == below.y, drawn > sectors.x + sectors.y, holds_zenith);
    let is_second = !is_third && select(below.x == below.z, drawn > sectors.x, holds_zenith);
    let order = ltc_sample_order(fan.corners, is_second, is_third);
    let p = ltc_sample_lobe(m_inv, order[0]);
    let q = ltc_sample_lobe(m_inv, order[1]);
    let r = ltc_sample_lobe(m_inv, order[2]);
    let normals = ltc_sample_order(fan.normals, is_second, is_third);
    let pq = ltc_sample_normal(m_inv, normals[0]);
    let qr = ltc_sample_normal(m_inv, normals[1]);
    let rp = ltc_sample_normal(m_inv, normals[2]);
    let ahead = ltc_sample_unit(pq);
    var corner = ltc_sample_unit(p);
    var outer = ahead;
    var wedge = LtcSampleWedge(abs(ahead.z), 0.0, 0.0, ltc_sample_turn(dot(p, q), length(pq)), 0.0);
    var share = drawn - select(0.0, sectors.x, is_second) - select(0.0, sectors.x + sectors.y, is_third);
    wedge.area = ltc_sample_area(wedge, wedge.end);
    if !holds_zenith {
        let alone = select(select(sectors.x, sectors.y, is_second), sectors.z, is_third);
        let is_outer = alone > 0.0;
        wedge = ltc_sample_wedge(corner, ahead, ltc_sample_unit(rp), ltc_sample_turn(dot(p, r), length(rp)), is_outer);
        let other = ltc_sample_wedge(ltc_sample_unit(q), ahead, ltc_sample_unit(qr), ltc_sample_turn(dot(q, r), length(qr)), is_outer);
        share = fan.number * (wedge.area + other.area);
        outer = select(-ltc_sample_unit(rp), ahead, is_outer);
        if share > wedge.area {
            share -= wedge.area;
            wedge = other;
            corner = ltc_sample_unit(q);
            outer = select(ltc_sample_unit(qr), -ahead, is_outer);
        }
    }
    let turn = ltc_sample_solve(wedge, clamp(share / max(wedge.area, 1e-37), 0.0, 1.0));
    // Uniform in the square of the radius, from the outer arc's to the inner one's.
    let edge = turn.x * corner + turn.y * cross(outer, corner);
    let inward = number * ltc_sample_growth(wedge, turn).x;
    let height = sqrt(max(edge.z * edge.z + inward * dot(edge.xy, edge.xy), 1e-30));
    let across = edge.xy * sqrt(1.0 - inward);
    return normalize(vec3((across.x - m_inv[2].x * height) / m_inv[0].x, across.y / m_inv[1].y, height));
}

// Adds the triangle of the apex, the point reached and the next one.
fn ltc_sample_triangle(before: LtcSampleFan, corner: vec3<f32>, normal: vec3<f32>, m_inv: mat3x3<f32>) -> LtcSampleFan {
    var fan = before;
    fan.reached = corner;
    fan.spoke = ltc_sample_cross(fan.apex, corner);
    fan.spoke_sector = ltc_sample_sector(fan.spoke, fan.apex, corner, m_inv);
    let sectors = vec3(before.spoke_sector, ltc_sample_sector(normal, before.reached, corner, m_inv), -fan.spoke_sector);
    let area = abs(sectors.x + sectors.y + sectors.z);
    // The first edge, and the last, end at the apex.
    if all(before.reached == fan.apex) || all(corner == fan.apex) || area <= 0.0 || m_inv[0].x * m_inv[1].y <= 0.0 {
        return fan;
    }
    fan.area += area;
    let drawn = fan.number * fan.area;
    if drawn <= area {
        fan.number = drawn / area;
        fan.corners = mat3x3(fan.apex, before.reached, corner);
        fan.normals = mat3x3(before.spoke, normal, -fan.spoke);
        fan.sectors = sectors;
    } else {
        fan.number = min((drawn - area) / before.area, 1.0);
    }
    return fan;
}

// A corner's wedge between the side that is alone and another, which ends at the third corner.
fn ltc_sample_wedge(corner: vec3<f32>, alone: vec3<f32>, side: vec3<f32>, end: vec2<f32>, is_outer: bool) -> LtcSampleWedge {
    let outer = abs(select(side.z, alone.z, is_outer));
    let inner = abs(select(alone.z, side.z, is_outer));
    let lean = -length(cross(alone, side)) * corner.z;
    let met = ltc_sample_turn(outer * end.x + lean * end.y, inner * end.y);
    var wedge = LtcSampleWedge(outer, inner, lean, select(end, met, is_outer), 0.0);
    wedge.area = max(ltc_sample_area(wedge, wedge.end), 0.0);
    return wedge;
}

// Twice the area up to an angle.
fn ltc_sample_area(wedge: LtcSampleWedge, turn: vec2<f32>) -> f32 {
    let met = ltc_sample_angle(wedge.outer * turn.y, wedge.inner * turn.x - wedge.lean * turn.y);
    return wedge.outer * ltc_sample_angle(turn.y, turn.x) - wedge.inner * met;
}

// x: how much of what the outer arc sweeps is the wedge's, in [0,1]; y: its derivative, over it.
fn ltc_sample_growth(wedge: LtcSampleWedge, turn: vec2<f32>) -> vec2<f32> {
    let met = vec2(wedge.inner * turn.x - wedge.lean * turn.y, wedge.outer * turn.y);
    let square = max(dot(met, met), 1e-30);
    let steep = wedge.outer * wedge.outer + wedge.lean * wedge.lean - wedge.inner * wedge.inner;
    let growth = turn.y * (turn.y * steep - 2.0 * wedge.inner * wedge.lean * turn.x) / square;
    let change = met.y * wedge.outer * turn.x - met.x * (wedge.inner * turn.y + wedge.lean * turn.x);
    let bend = 2.0 * wedge.inner * wedge.inner * change / (square * square);
    return vec2(clamp(growth, 0.0, 1.0), bend / max(growth, 1e-20));
}

// Cosine and sine of the angle up to which a share of the wedge lies. The first guess is a power that has the right slope at the end:
// 1 where the inner arc does not matter, 1/2 where both arcs are straight.
fn ltc_sample_solve(wedge: LtcSampleWedge, share: f32) -> vec2<f32> {
    let whole = ltc_sample_angle(wedge.end.y, wedge.end.x);
    let slope = wedge.outer * ltc_sample_growth(wedge, wedge.end).x * whole;
    let first = whole * pow(max(share, 1e-12), clamp(wedge.area / max(slope, 1e-37), 0.25, 1.0));
    var turn = vec2(cos(first), sin(first));
    for (var k = 0u; k < LTC_SAMPLE_STEPS; k++) {
        let growth = ltc_sample_growth(wedge, turn);
        let excess = ltc_sample_area(wedge, turn) - share * wedge.area;
        let newton = clamp(excess / max(wedge.outer * growth.x, 1e-20), -4.0, 4.0);
        let next = turn - newton / max(1.0 - 0.5 * newton * growth.y, 0.5) * vec2(-turn.y, turn.x);
        // No further than the ends.
        let halved = select(next, 0.5 * (turn + vec2(1.0, 0.0)), next.y < 0.0);
        let is_past = halved.x * wedge.end.y < halved.y * wedge.end.x;
        turn = ltc_sample_turn(select(halved.x, wedge.end.x, is_past), select(halved.y, wedge.end.y, is_past));
    }
    return turn;
}

// Of unit length.
fn ltc_sample_turn(cosine: f32, sine: f32) -> vec2<f32> {
    let square = cosine * cosine + sine * sine;
    return select(vec2(1.0, 0.0), vec2(cosine, sine) * inverseSqrt(max(square, 1e-36)), square > 1e-36);
}

fn ltc_sample_unit(vector: vec3<f32>) -> vec3<f32> {
    return vector / max(length(vector), 1e-18);
}

// A power of two that brings a vector's length near 1: products keep their digits, and stay in range.
fn ltc_sample_scale(vector: vec3<f32>) -> f32 {
    let size = max(max(abs(vector.x), abs(vector.y)), abs(vector.z));
    return bitcast<f32>(0x7f000000u - (bitcast<u32>(size) & 0x7f800000u));
}

// Three columns, from the second on or from the third on.
fn ltc_sample_order(columns: mat3x3<f32>, is_second: bool, is_third: bool) -> mat3x3<f32> {
    if is_third {
        return mat3x3(columns[2], columns[0], columns[1]);
    }
    if is_second {
        return mat3x3(columns[1], columns[2], columns[0]);
    }
    return columns;
}

// A direction in the lobe's space.
fn ltc_sample_lobe(m_inv: mat3x3<f32>, p: vec3<f32>) -> vec3<f32> {
    return vec3(m_inv[0].x * p.x + m_inv[2].x * p.z, m_inv[1].y * p.y, p.z);
}

// A plane's normal there: by the cofactors, as in ltc.wgsl.
fn ltc_sample_normal(m_inv: mat3x3<f32>, n: vec3<f32>) -> vec3<f32> {
    let a = m_inv[0].x;
    let c = m_inv[1].y;
    return vec3(c * n.x, a * n.y, c * (a * n.z - m_inv[2].x * n.x));
}

// Twice the area between an arc and the zenith, counter-clockwise.
fn ltc_sample_sector(plane: vec3<f32>, p: vec3<f32>, q: vec3<f32>, m_inv: mat3x3<f32>) -> f32 {
    let normal = ltc_sample_normal(m_inv, plane);
    let size = length(normal);
    return normal.z * ltc_sample_angle(size, dot(ltc_sample_lobe(m_inv, p), ltc_sample_lobe(m_inv, q))) / max(size, 1e-18);
}

// ltc_angle of ltc.wgsl.
fn ltc_sample_angle(sine: f32, cosine: f32) -> f32 {
    let steep = sine > abs(cosine);
    let ratio = select(sine, abs(cosine), steep) / max(select(abs(cosine), sine, steep), 1e-37);
    let s = ratio * ratio;
    let low = ratio * ((0.0405516 * s + 0.65590577) * s + 0.99999753) / ((0.1708228 * s + 0.98917014) * s + 1.0);
    let acute = select(low, 0.5 * LTC_SAMPLE_PI - low, steep);
    return select(acute, LTC_SAMPLE_PI - acute, cosine < 0.0);
}

// ltc_cross of ltc.wgsl.
fn ltc_sample_cross(p: vec3<f32>, q: vec3<f32>) -> vec3<f32> {
    let p_high = bitcast<vec3<f32>>(bitcast<vec3<u32>>(p) & vec3(0xfffff000u));
    let q_high = bitcast<vec3<f32>>(bitcast<vec3<u32>>(q) & vec3(0xfffff000u));
    let rest = cross(p - p_high, q + q_high) + cross(p + p_high, q - q_high);
    return (p_high.yzx * q_high.zxy - p_high.zxy * q_high.yzx) + 0.5 * rest;
}
