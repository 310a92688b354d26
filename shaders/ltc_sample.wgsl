// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// Points of convex polygons, drawn with the density of a linearly transformed cosine: ltc_density over their form factor.
// Copy with it: ltc.wgsl, whose outlines it is given, edge by edge; m_inv is one of its lobes, with rows (a,0,b), (0,c,0), (0,0,1).
// Frame: z = normal; outlines run round either way. On the lobe's unit disc arcs are ellipses (Peters 2021); a fan of triangles is summed.
// Example: fan = ltc_sample_edge(fan, outline.p, outline.q, outline.normal, outline.sine, m_inv); let wo = ltc_sample_point(fan, m_inv, number);
// Ranges: coordinates 1e-8 to 1e5, lobes as of ltc.wgsl; parts convex as seen from the point, of any number of vertices; never NaN.
// Greatest error: areas 3e-7, times c/a; over a form factor, so that is how far points of small and narrow lights are moved within them.

const LTC_SAMPLE_PI = 3.14159265358979;
const LTC_SAMPLE_STEPS = 3u;  // Halley's, towards an azimuth

// The triangles between each part's first vertex and its edges, and the one on which the point is. Areas are twice those on the disc.
struct LtcSampleFan {
    left: f32,              // from here to the point; negative beyond it. It falls by 2 pi times the parts' form factors
    drawn: f32,             // from the point's triangle on
    apex: vec3<f32>,        // the part's first vertex above the horizon; 0 before it: set it so for each further part
    reached: vec3<f32>,     // and its last
    spoke: vec3<f32>,       // apex x reached
    spoke_sector: f32,
    corners: mat3x3<f32>,   // of the point's triangle
    normals: mat3x3<f32>,   // corner x next corner
    sectors: vec3<f32>,     // between its sides and the zenith, signed
}

// Between two arcs from a corner to an azimuth: at the angle t of the outer one, the inner one's is u, cot u = (inner cot t - lean) / outer.
struct LtcSampleWedge {
    corner: vec3<f32>,
    normal: vec3<f32>,      // unit, of the outer arc
    outer: f32,             // heights of both arcs' unit normals; inner is 0 for the zenith itself
    inner: f32,
    lean: f32,
    steep: f32,             // outer^2 + lean^2 - inner^2
    end: vec2<f32>,         // cosine and sine of the greatest t
}

// Before the first part of a light: a uniform number in [0,1), and the form factor of all parts together.
fn ltc_sample_begin(number: f32, form_factor: f32) -> LtcSampleFan {
    return LtcSampleFan(select(-1.0, 2.0 * LTC_SAMPLE_PI * number * form_factor, form_factor > 0.0), 0.0, vec3(0.0), vec3(0.0), vec3(0.0), 0.0, mat3x3<f32>(), mat3x3<f32>(), vec3(0.0));
}

// Adds the edge that an LtcOutline walked last, after what along the horizon leads to it: in a loop, as drivers that do both sides of a branch can leave it.
fn ltc_sample_edge(before: LtcSampleFan, p: vec3<f32>, q: vec3<f32>, normal: vec3<f32>, sine: f32, m_inv: mat3x3<f32>) -> LtcSampleFan {
    var fan = before;
    if sine > 0.0 {
        let scale = vec2(ltc_sample_scale(p), ltc_sample_scale(q));
        let start = scale.x * p;
        fan.reached = select(fan.reached, start, all(fan.apex == vec3(0.0)));
        fan.apex = select(fan.apex, start, all(fan.apex == vec3(0.0)));
        for (var is_edge = all(fan.reached == start); ; is_edge = true) {
            let plane = select(ltc_sample_cross(fan.reached, start), -(scale.x * normal) * (scale.y * sine), is_edge);
            fan = ltc_sample_triangle(fan, select(start, scale.y * q, is_edge), plane, m_inv);
            if is_edge {
                break;
            }
        }
    }
    return fan;
}

// The point's unit direction, from another uniform number; where there is nothing to draw, 0.
fn ltc_sample_point(fan: LtcSampleFan, m_inv: mat3x3<f32>, number: f32) -> vec3<f32> {
    let sum = fan.sectors.x + fan.sectors.y + fan.sectors.z;
    let sectors = fan.sectors * sign(sum);
    let below = sectors < vec3(0.0);
    let is_around = !any(below);
    // A form factor that has been rounded up leads past the last triangle, which is then gone through again.
    let share = fract(min(fan.drawn / max(abs(sum), 1e-37), 1e6));
    let at = share * abs(sum);
    // The first side is the one whose sector it is, if the zenith is inside; else the one that alone faces it, or alone turns away.
    let is_third = select(below.x == below.y, at >= sectors.x + sectors.y, is_around);
    let is_second = !is_third && select(below.x == below.z, at >= sectors.x, is_around);
    let corners = m_inv * ltc_sample_order(fan.corners, is_second, is_third);
    let normals = ltc_sample_order(fan.normals, is_second, is_third);
    let side = ltc_sample_normal(m_inv, normals[0]);
    var wedge = ltc_sample_wedge(corners[0], vec3(0.0), corners[1], side, false);
    var left = at - select(select(0.0, sectors.x, is_second), sectors.x + sectors.y, is_third);
    if !is_around {
        let is_outer = select(select(sectors.x, sectors.y, is_second), sectors.z, is_third) > 0.0;
        wedge = ltc_sample_wedge(corners[0], side, corners[2], -ltc_sample_normal(m_inv, normals[2]), is_outer);
        let other = ltc_sample_wedge(corners[1], -side, corners[2], ltc_sample_normal(m_inv, normals[1]), is_outer);
        let area = ltc_sample_swept(wedge, wedge.end).x;
        left = share * (area + ltc_sample_swept(other, other.end).x);
        if left >= area {
            left -= area;
            wedge = other;
        }
    }
    let turn = ltc_sample_solve(wedge, left);
    // Uniform in the square of the radius, from the outer arc to the inner one.
    let arc = turn.x * wedge.corner + turn.y * cross(wedge.normal, wedge.corner);
    let inward = number * ltc_sample_swept(wedge, turn).y;
    let height = sqrt(max(arc.z * arc.z + inward * dot(arc.xy, arc.xy), 1e-30));
    let across = (arc.xy * sqrt(1.0 - inward) - vec2(m_inv[2].x * height, 0.0)) / vec2(m_inv[0].x, m_inv[1].y);
    return select(vec3(0.0), normalize(vec3(across, height)), sum != 0.0);
}

// Adds the triangle of the apex, the point reached and the next one. The first edge and the last have none.
fn ltc_sample_triangle(before: LtcSampleFan, corner: vec3<f32>, normal: vec3<f32>, m_inv: mat3x3<f32>) -> LtcSampleFan {
    var fan = before;
    fan.reached = corner;
    fan.spoke = ltc_sample_cross(fan.apex, corner);
    fan.spoke_sector = ltc_sample_sector(fan.spoke, fan.apex, corner, m_inv);
    let sectors = vec3(before.spoke_sector, ltc_sample_sector(normal, before.reached, corner, m_inv), -fan.spoke_sector);
    let is_none = all(before.reached == fan.apex) || all(corner == fan.apex) || m_inv[0].x * m_inv[1].y <= 0.0;
    let area = select(abs(sectors.x + sectors.y + sectors.z), 0.0, is_none);
    if area > 0.0 && fan.left >= 0.0 {
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
    let p = ltc_sample_unit(corner);
    let u = ltc_sample_unit(alone);
    let v = ltc_sample_unit(other);
    let k = vec3(abs(select(vec2(v.z, u.z), vec2(u.z, v.z), is_outer)), -length(cross(u, v)) * p.z);
    let met = ltc_sample_unit(vec3(select(end, vec2(k.x * end.x + k.z * end.y, k.y * end.y), is_outer), 0.0));
    return LtcSampleWedge(p, select(v, u, is_outer), k.x, k.y, k.z, k.x * k.x + k.z * k.z - k.y * k.y, met.xy);
}

// x: the area up to an angle; y: its derivative, as a share of the outer arc's; z: the derivative of y, over y.
fn ltc_sample_swept(wedge: LtcSampleWedge, turn: vec2<f32>) -> vec3<f32> {
    let met = vec2(wedge.inner * turn.x - wedge.lean * turn.y, wedge.outer * turn.y);
    let square = max(dot(met, met), 1e-30);
    let share = turn.y * (turn.y * wedge.steep - 2.0 * wedge.inner * wedge.lean * turn.x) / square;
    let change = 2.0 * wedge.inner * wedge.inner / square * (met.y * wedge.outer * turn.x - met.x * (wedge.inner * turn.y + wedge.lean * turn.x)) / square;
    let area = wedge.outer * ltc_sample_angle(turn.y, turn.x) - wedge.inner * ltc_sample_angle(met.y, met.x);
    return vec3(max(area, 0.0), clamp(share, 0.0, 1.0), change / max(share, 1e-20));
}

// Cosine and sine of the angle up to which an area lies. First guess: the areas' power of the angle at the end, or 2 or 3 at the corner.
fn ltc_sample_solve(wedge: LtcSampleWedge, area: f32) -> vec2<f32> {
    let whole = ltc_sample_swept(wedge, wedge.end);
    let share = clamp(area / max(whole.x, 1e-37), 0.0, 1.0);
    let greatest = ltc_sample_angle(wedge.end.y, wedge.end.x);
    let cube = max(3.0 * area * wedge.inner * wedge.inner / max(wedge.outer * wedge.steep, 1e-37), 1e-30);
    let at_corner = 0.8 * min(sqrt(area * wedge.inner / max(-wedge.outer * wedge.lean, 1e-37)), pow(cube, 1.0 / 3.0));
    let at_end = greatest * pow(max(share, 1e-12), clamp(whole.x / max(wedge.outer * whole.y * greatest, 1e-37), 0.25, 1.0));
    let guess = max(at_end, min(at_corner, greatest * sqrt(share)));
    var turn = vec2(cos(guess), sin(guess));
    for (var k = 0u; k < LTC_SAMPLE_STEPS; k++) {
        let swept = ltc_sample_swept(wedge, turn);
        let newton = clamp((swept.x - share * whole.x) / max(wedge.outer * swept.y, 1e-20), -4.0, 4.0);
        let next = turn - newton / max(1.0 - 0.5 * newton * swept.z, 0.5) * vec2(-turn.y, turn.x);
        let bounded = select(next, wedge.end, next.x * wedge.end.y < next.y * wedge.end.x);
        turn = ltc_sample_unit(vec3(bounded.x, max(bounded.y, 0.0), 0.0)).xy;
    }
    return turn;
}

fn ltc_sample_unit(v: vec3<f32>) -> vec3<f32> {
    return v / max(length(v), 1e-18);
}

// A power of two that brings a length near 1: products keep their digits and stay in range.
fn ltc_sample_scale(v: vec3<f32>) -> f32 {
    return bitcast<f32>(0x7f000000u - (bitcast<u32>(max(max(abs(v.x), abs(v.y)), abs(v.z))) & 0x7f800000u));
}

// The columns from the second on, or from the third on.
fn ltc_sample_order(m: mat3x3<f32>, is_second: bool, is_third: bool) -> mat3x3<f32> {
    let first = select(select(m[0], m[1], is_second), m[2], is_third);
    return mat3x3(first, select(select(m[1], m[2], is_second), m[0], is_third), select(select(m[2], m[0], is_second), m[1], is_third));
}

// A plane's normal in the lobe's space, by the cofactors.
fn ltc_sample_normal(m_inv: mat3x3<f32>, n: vec3<f32>) -> vec3<f32> {
    return vec3(m_inv[1].y * n.x, m_inv[0].x * n.y, m_inv[1].y * (m_inv[0].x * n.z - m_inv[2].x * n.x));
}

// The area between an arc and the zenith, counter-clockwise.
fn ltc_sample_sector(plane: vec3<f32>, p: vec3<f32>, q: vec3<f32>, m_inv: mat3x3<f32>) -> f32 {
    let normal = ltc_sample_normal(m_inv, plane);
    return ltc_sample_unit(normal).z * ltc_sample_angle(length(normal), dot(m_inv * p, m_inv * q));
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
