// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// Points of convex polygons, drawn with the density of a linearly transformed cosine: ltc_density / ltc_sample_share, exactly.
// Copy with it: ltc.wgsl, whose outlines it is given, edge by edge; m_inv is one of its lobes, with rows (a,0,b), (0,c,0), (0,0,1).
// Frame: z = normal; outlines run round either way. On the lobe's unit disc arcs are ellipses (Peters 2021); a fan of triangles is summed.
// Example: fan = ltc_sample_edge(fan, outline.p, outline.q, outline.normal, outline.sine, m_inv); let wo = ltc_sample_point(fan, m_inv, number);
// Ranges: coordinates 1e-8 to 1e5, lobes as of ltc.wgsl; parts convex as seen from the point, of any number of vertices; never NaN.
// Greatest error: @

const LTC_SAMPLE_PI = 3.14159265358979;
// Halley's steps towards an azimuth: in exact numbers three leave less than 1e-6 of a triangle's area, two 1e-4, one 2e-2.
const LTC_SAMPLE_STEPS = 3u;

// The triangles between each part's first vertex and its edges, and the one on which the point is. Areas are twice those that the
// triangles have on the disc when they are projected from the lobe's sphere.
struct LtcSampleFan {
    area: f32,              // of all so far
    left: f32,              // from here to the point; negative beyond it
    drawn: f32,             // from the point's triangle on
    apex: vec3<f32>,        // the part's first vertex above the horizon; 0 before it
    reached: vec3<f32>,     // and its last
    spoke: vec3<f32>,       // apex x reached
    spoke_sector: f32,
    corners: mat3x3<f32>,   // of the point's triangle
    normals: mat3x3<f32>,   // corner x next corner
    sectors: vec3<f32>,     // between its sides and the zenith, signed
}

// What lies between two arcs that part at a corner, up to an azimuth. Where the outer one has come by an angle t, the inner one is met at u,
// cot u = (inner cot t - lean) / outer.
struct LtcSampleWedge {
    outer: f32,         // heights of the arcs' unit normals; inner is 0 for the zenith itself
    inner: f32,
    lean: f32,
    end: vec2<f32>,     // cosine and sine of the greatest t
    area: f32,
}

// Before the first part of a light: a uniform number in [0,1), and the form factor of all parts together.
fn ltc_sample_begin(number: f32, form_factor: f32) -> LtcSampleFan {
    let none = vec3(0.0);
    let nothing = mat3x3(none, none, none);
    return LtcSampleFan(0.0, 2.0 * LTC_SAMPLE_PI * number * form_factor, 0.0, none, none, none, 0.0, nothing, nothing, none);
}

// Before each further one.
fn ltc_sample_part(before: LtcSampleFan) -> LtcSampleFan {
    var fan = before;
    fan.apex = vec3(0.0);
    return fan;
}

// Adds the edge that an LtcOutline walked last, and what along the horizon leads to it.
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

// The point's unit direction, from another uniform number; the normal where the share is 0.
fn ltc_sample_point(fan: LtcSampleFan, m_inv: mat3x3<f32>, number: f32) -> vec3<f32> {
    if fan.area <= 0.0 {
        return vec3(0.0, 0.0, 1.0);
    }
    let sum = fan.sectors.x + fan.sectors.y + fan.sectors.z;
    let sectors = fan.sectors * sign(sum);
    let below = sectors < vec3(0.0);
    let is_around = !any(below);
    // Where the form factor has been rounded up, the last triangle is gone through again.
    let share = fract(min(fan.drawn / abs(sum), 1e6));
    let at = share * abs(sum);
    // The sector of one side, if the zenith is inside; else the side that alone faces it, or alone turns away.
    let is_third = select(below.x == below.y, at >= sectors.x + sectors.y, is_around);
    let is_second = !is_third && select(below.x == below.z, at >= sectors.x, is_around);
    let corners = ltc_sample_order(fan.corners, is_second, is_third);
    let normals = ltc_sample_order(fan.normals, is_second, is_third);
    let p = ltc_sample_lobe(m_inv, corners[0]);
    let q = ltc_sample_lobe(m_inv, corners[1]);
    let ahead = ltc_sample_normal(m_inv, normals[0]);
    var corner = ltc_sample_unit(p);
    var outer = ltc_sample_unit(ahead);
    var wedge = LtcSampleWedge(abs(outer.z), 0.0, 0.0, ltc_sample_unit(vec3(dot(p, q), length(ahead), 0.0)).xy, 0.0);
    wedge.area = ltc_sample_area(wedge, wedge.end);
    var left = at - select(select(0.0, sectors.x, is_second), sectors.x + sectors.y, is_third);
    if !is_around {
        let r = ltc_sample_lobe(m_inv, corners[2]);
        let from_p = -ltc_sample_normal(m_inv, normals[2]);
        let from_q = ltc_sample_normal(m_inv, normals[1]);
        let is_outer = select(select(sectors.x, sectors.y, is_second), sectors.z, is_third) > 0.0;
        let first = ltc_sample_wedge(p, ahead, r, from_p, is_outer);
        let second = ltc_sample_wedge(q, ahead, r, from_q, is_outer);
        left = share * (first.area + second.area);
        let is_first = left < first.area;
        left -= select(first.area, 0.0, is_first);
        wedge = second;
        if is_first {
            wedge = first;
        }
        corner = ltc_sample_unit(select(q, p, is_first));
        outer = ltc_sample_unit(select(select(from_q, from_p, is_first), select(-ahead, ahead, is_first), is_outer));
    }
    let turn = ltc_sample_solve(wedge, clamp(left / max(wedge.area, 1e-37), 0.0, 1.0));
    // Uniform in the square of the radius, from the outer arc to the inner one.
    let arc = turn.x * corner + turn.y * cross(outer, corner);
    let inward = number * ltc_sample_growth(wedge, turn).x;
    let height = sqrt(max(arc.z * arc.z + inward * dot(arc.xy, arc.xy), 1e-30));
    let across = arc.xy * sqrt(1.0 - inward);
    return normalize(vec3((across.x - m_inv[2].x * height) / m_inv[0].x, across.y / m_inv[1].y, height));
}

// Adds the triangle of the apex, the point reached and the next one. The first edge and the last have none.
fn ltc_sample_triangle(before: LtcSampleFan, corner: vec3<f32>, normal: vec3<f32>, m_inv: mat3x3<f32>) -> LtcSampleFan {
    var fan = before;
    fan.reached = corner;
    fan.spoke = ltc_sample_cross(fan.apex, corner);
    fan.spoke_sector = ltc_sample_sector(fan.spoke, fan.apex, corner, m_inv);
    let sectors = vec3(before.spoke_sector, ltc_sample_sector(normal, before.reached, corner, m_inv), -fan.spoke_sector);
    let area = abs(sectors.x + sectors.y + sectors.z);
    let is_none = all(before.reached == fan.apex) || all(corner == fan.apex) || m_inv[0].x * m_inv[1].y <= 0.0;
    if is_none || area == 0.0 {
        return fan;
    }
    fan.area += area;
    if fan.left >= 0.0 {
        fan.drawn = fan.left;
        fan.corners = mat3x3(fan.apex, before.reached, corner);
        fan.normals = mat3x3(before.spoke, normal, -fan.spoke);
        fan.sectors = sectors;
    }
    fan.left -= area;
    return fan;
}

// At a corner, between the side that is alone and the other one, which ends there.
fn ltc_sample_wedge(corner: vec3<f32>, alone: vec3<f32>, there: vec3<f32>, other: vec3<f32>, is_outer: bool) -> LtcSampleWedge {
    let end = vec2(dot(corner, there), length(other));
    let u = ltc_sample_unit(alone);
    let v = ltc_sample_unit(other);
    let outer = abs(select(v.z, u.z, is_outer));
    let inner = abs(select(u.z, v.z, is_outer));
    let lean = -length(cross(u, v)) * ltc_sample_unit(corner).z;
    let met = select(end, vec2(outer * end.x + lean * end.y, inner * end.y), is_outer);
    var wedge = LtcSampleWedge(outer, inner, lean, ltc_sample_unit(vec3(met, 0.0)).xy, 0.0);
    wedge.area = max(ltc_sample_area(wedge, wedge.end), 0.0);
    return wedge;
}

// The area up to an angle.
fn ltc_sample_area(wedge: LtcSampleWedge, turn: vec2<f32>) -> f32 {
    let met = ltc_sample_angle(wedge.outer * turn.y, wedge.inner * turn.x - wedge.lean * turn.y);
    return wedge.outer * ltc_sample_angle(turn.y, turn.x) - wedge.inner * met;
}

// x: how much of what the outer arc sweeps is the wedge's, in [0,1]; y: its derivative, over it.
fn ltc_sample_growth(wedge: LtcSampleWedge, turn: vec2<f32>) -> vec2<f32> {
    let met = vec2(wedge.inner * turn.x - wedge.lean * turn.y, wedge.outer * turn.y);
    let square = max(dot(met, met), 1e-30);
    let growth = turn.y * (turn.y * ltc_sample_steep(wedge) - 2.0 * wedge.inner * wedge.lean * turn.x) / square;
    let change = met.y * wedge.outer * turn.x - met.x * (wedge.inner * turn.y + wedge.lean * turn.x);
    return vec2(clamp(growth, 0.0, 1.0), 2.0 * wedge.inner * wedge.inner * change / (square * square) / max(growth, 1e-20));
}

fn ltc_sample_steep(wedge: LtcSampleWedge) -> f32 {
    return wedge.outer * wedge.outer + wedge.lean * wedge.lean - wedge.inner * wedge.inner;
}

// Cosine and sine of the angle up to which a share of the wedge lies.
fn ltc_sample_solve(wedge: LtcSampleWedge, share: f32) -> vec2<f32> {
    // The area grows by a falling power of the angle. What the power at the end gives is too small; so is what the corner gives, where
    // the area's first term is a square or a cube.
    let area = share * wedge.area;
    let whole = ltc_sample_angle(wedge.end.y, wedge.end.x);
    let slope = max(wedge.outer * ltc_sample_growth(wedge, wedge.end).x * whole, 1e-37);
    let square = area * wedge.inner / max(-wedge.outer * wedge.lean, 1e-37);
    let cube = 3.0 * area * wedge.inner * wedge.inner / max(wedge.outer * ltc_sample_steep(wedge), 1e-37);
    let at_corner = min(0.8 * min(sqrt(square), pow(max(cube, 1e-30), 1.0 / 3.0)), sqrt(share) * whole);
    let guess = max(at_corner, whole * pow(max(share, 1e-12), clamp(wedge.area / slope, 0.25, 1.0)));
    var turn = vec2(cos(guess), sin(guess));
    for (var k = 0u; k < LTC_SAMPLE_STEPS; k++) {
        let growth = ltc_sample_growth(wedge, turn);
        let newton = clamp((ltc_sample_area(wedge, turn) - area) / max(wedge.outer * growth.x, 1e-20), -4.0, 4.0);
        let next = turn - newton / max(1.0 - 0.5 * newton * growth.y, 0.5) * vec2(-turn.y, turn.x);
        // Not past the ends.
        let halved = select(next, 0.5 * (turn + vec2(1.0, 0.0)), next.y < 0.0);
        let bounded = select(halved, wedge.end, halved.x * wedge.end.y < halved.y * wedge.end.x);
        turn = ltc_sample_unit(vec3(bounded, 0.0)).xy;
    }
    return turn;
}

fn ltc_sample_unit(v: vec3<f32>) -> vec3<f32> {
    return v / max(length(v), 1e-18);
}

// A power of two that brings a length near 1: products keep their digits and stay in range.
fn ltc_sample_scale(v: vec3<f32>) -> f32 {
    let size = max(max(abs(v.x), abs(v.y)), abs(v.z));
    return bitcast<f32>(0x7f000000u - (bitcast<u32>(size) & 0x7f800000u));
}

// The columns from the second on, or from the third on.
fn ltc_sample_order(m: mat3x3<f32>, is_second: bool, is_third: bool) -> mat3x3<f32> {
    let first = select(select(m[0], m[1], is_second), m[2], is_third);
    let second = select(select(m[1], m[2], is_second), m[0], is_third);
    return mat3x3(first, second, select(select(m[2], m[0], is_second), m[1], is_third));
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
