// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// Points of convex polygons, drawn with the density of a linearly transformed cosine: ltc_density over their form factor.
// Copy with it: ltc.glsl, whose outlines it is given, edge by edge; m_inv is one of its lobes, with rows (a,0,b), (0,c,0), (0,0,1).
// Frame: z = normal; outlines run round either way. On the lobe's unit disc arcs are ellipses (Peters 2021); a fan of triangles is summed.
// Example: fan = ltc_sample_edge(fan, outline.p, outline.q, outline.normal, outline.sine, m_inv); vec3 wo = ltc_sample_point(fan, m_inv, number);
// Ranges: coordinates 1e-8 to 1e5, lobes as of ltc.glsl; parts convex as seen from the point, of any number of vertices; never NaN.
// Greatest error: areas 3e-7, times c/a; over a form factor, so that is how far points of small and narrow lights are moved within them.
// Language: GLSL ES 3.00, where `precision highp float; precision highp int; precision highp sampler2D;` come before it, or any later GLSL.

const float LTC_SAMPLE_PI = 3.14159265358979;
const uint LTC_SAMPLE_STEPS = 3u;  // Halley's, towards an azimuth

// The triangles between each part's first vertex and its edges, and the one on which the point is. Areas are twice those on the disc.
struct LtcSampleFan {
    float left;    // from here to the point; negative beyond it. It falls by 2 pi times the parts' form factors
    float drawn;   // from the point's triangle on
    vec3 apex;     // the part's first vertex above the horizon; 0 before it: set it so for each further part
    vec3 reached;  // and its last
    vec3 spoke;    // apex x reached
    float spoke_sector;
    mat3 corners;  // of the point's triangle
    mat3 normals;  // corner x next corner
    vec3 sectors;  // between its sides and the zenith, signed
};

// Between two arcs from a corner to an azimuth: at the angle t of the outer one, the inner one's is u, cot u = (inner cot t - lean) / outer.
struct LtcSampleWedge {
    vec3 corner;
    vec3 normal;  // unit, of the outer arc
    float outer;  // heights of both arcs' unit normals; inner is 0 for the zenith itself
    float inner;
    float lean;
    float steep;  // outer^2 + lean^2 - inner^2
    vec2 end;     // cosine and sine of the greatest t
};

// Used above their definitions.
LtcSampleFan ltc_sample_triangle(LtcSampleFan before, vec3 corner, vec3 normal, mat3 m_inv);
LtcSampleWedge ltc_sample_wedge(vec3 corner, vec3 alone, vec3 there, vec3 other, bool is_outer);
vec3 ltc_sample_swept(LtcSampleWedge wedge, vec2 turn);
vec2 ltc_sample_solve(LtcSampleWedge wedge, float area);
vec3 ltc_sample_unit(vec3 v);
float ltc_sample_scale(vec3 v);
mat3 ltc_sample_order(mat3 m, bool is_second, bool is_third);
vec3 ltc_sample_normal(mat3 m_inv, vec3 n);
float ltc_sample_sector(vec3 plane, vec3 p, vec3 q, mat3 m_inv);
float ltc_sample_angle(float sine, float cosine);
vec3 ltc_sample_cross(vec3 p, vec3 q);

// Before the first part of a light: a uniform number in [0,1), and the form factor of all parts together.
LtcSampleFan ltc_sample_begin(float number, float form_factor) {
    return LtcSampleFan(form_factor > 0.0 ? 2.0 * LTC_SAMPLE_PI * number * form_factor : -1.0, 0.0, vec3(0.0), vec3(0.0), vec3(0.0), 0.0, mat3(0.0), mat3(0.0), vec3(0.0));
}

// Adds the edge that an LtcOutline walked last, after what along the horizon leads to it: in a loop, as drivers that do both sides of a branch can leave it.
LtcSampleFan ltc_sample_edge(LtcSampleFan before, vec3 p, vec3 q, vec3 normal, float sine, mat3 m_inv) {
    LtcSampleFan fan = before;
    if (sine > 0.0) {
        vec2 scale = vec2(ltc_sample_scale(p), ltc_sample_scale(q));
        vec3 start = scale.x * p;
        fan.reached = all(equal(fan.apex, vec3(0.0))) ? start : fan.reached;
        fan.apex = all(equal(fan.apex, vec3(0.0))) ? start : fan.apex;
        for (bool is_edge = all(equal(fan.reached, start));; is_edge = true) {
            vec3 plane = is_edge ? -(scale.x * normal) * (scale.y * sine) : ltc_sample_cross(fan.reached, start);
            fan = ltc_sample_triangle(fan, is_edge ? scale.y * q : start, plane, m_inv);
            if (is_edge) {
                break;
            }
        }
    }
    return fan;
}

// The point's unit direction, from another uniform number; where there is nothing to draw, 0.
vec3 ltc_sample_point(LtcSampleFan fan, mat3 m_inv, float number) {
    float sum = fan.sectors.x + fan.sectors.y + fan.sectors.z;
    vec3 sectors = fan.sectors * sign(sum);
    bvec3 below = lessThan(sectors, vec3(0.0));
    bool is_around = !any(below);
    // A form factor that has been rounded up leads past the last triangle, which is then gone through again.
    float share = fract(min(fan.drawn / max(abs(sum), 1e-37), 1e6));
    float at = share * abs(sum);
    // The first side is the one whose sector it is, if the zenith is inside; else the one that alone faces it, or alone turns away.
    bool is_third = is_around ? at >= sectors.x + sectors.y : below.x == below.y;
    bool is_second = !is_third && (is_around ? at >= sectors.x : below.x == below.z);
    mat3 corners = m_inv * ltc_sample_order(fan.corners, is_second, is_third);
    mat3 normals = ltc_sample_order(fan.normals, is_second, is_third);
    vec3 side = ltc_sample_normal(m_inv, normals[0]);
    LtcSampleWedge wedge = ltc_sample_wedge(corners[0], vec3(0.0), corners[1], side, false);
    float left = at - (is_third ? sectors.x + sectors.y : (is_second ? sectors.x : 0.0));
    if (!is_around) {
        bool is_outer = (is_third ? sectors.z : (is_second ? sectors.y : sectors.x)) > 0.0;
        wedge = ltc_sample_wedge(corners[0], side, corners[2], -ltc_sample_normal(m_inv, normals[2]), is_outer);
        LtcSampleWedge other = ltc_sample_wedge(corners[1], -side, corners[2], ltc_sample_normal(m_inv, normals[1]), is_outer);
        float area = ltc_sample_swept(wedge, wedge.end).x;
        left = share * (area + ltc_sample_swept(other, other.end).x);
        if (left >= area) {
            left -= area;
            wedge = other;
        }
    }
    vec2 turn = ltc_sample_solve(wedge, left);
    // Uniform in the square of the radius, from the outer arc to the inner one.
    vec3 arc = turn.x * wedge.corner + turn.y * cross(wedge.normal, wedge.corner);
    float inward = number * ltc_sample_swept(wedge, turn).y;
    float height = sqrt(max(arc.z * arc.z + inward * dot(arc.xy, arc.xy), 1e-30));
    vec2 across = (arc.xy * sqrt(1.0 - inward) - vec2(m_inv[2].x * height, 0.0)) / vec2(m_inv[0].x, m_inv[1].y);
    return sum != 0.0 ? normalize(vec3(across, height)) : vec3(0.0);
}

// Adds the triangle of the apex, the point reached and the next one. The first edge and the last have none.
LtcSampleFan ltc_sample_triangle(LtcSampleFan before, vec3 corner, vec3 normal, mat3 m_inv) {
    LtcSampleFan fan = before;
    fan.reached = corner;
    fan.spoke = ltc_sample_cross(fan.apex, corner);
    fan.spoke_sector = ltc_sample_sector(fan.spoke, fan.apex, corner, m_inv);
    vec3 sectors = vec3(before.spoke_sector, ltc_sample_sector(normal, before.reached, corner, m_inv), -fan.spoke_sector);
    bool is_none = all(equal(before.reached, fan.apex)) || all(equal(corner, fan.apex)) || m_inv[0].x * m_inv[1].y <= 0.0;
    float area = is_none ? 0.0 : abs(sectors.x + sectors.y + sectors.z);
    if (area > 0.0 && fan.left >= 0.0) {
        fan.drawn = fan.left;
        fan.corners = mat3(fan.apex, before.reached, corner);
        fan.normals = mat3(before.spoke, normal, -fan.spoke);
        fan.sectors = sectors;
    }
    fan.left -= area;
    return fan;
}

// At a corner, between the side that is alone and the other one, which ends there.
LtcSampleWedge ltc_sample_wedge(vec3 corner, vec3 alone, vec3 there, vec3 other, bool is_outer) {
    vec2 end = vec2(dot(corner, there), length(other));
    vec3 p = ltc_sample_unit(corner);
    vec3 u = ltc_sample_unit(alone);
    vec3 v = ltc_sample_unit(other);
    vec3 k = vec3(abs(is_outer ? vec2(u.z, v.z) : vec2(v.z, u.z)), -length(cross(u, v)) * p.z);
    vec3 met = ltc_sample_unit(vec3(is_outer ? vec2(k.x * end.x + k.z * end.y, k.y * end.y) : end, 0.0));
    return LtcSampleWedge(p, is_outer ? u : v, k.x, k.y, k.z, k.x * k.x + k.z * k.z - k.y * k.y, met.xy);
}

// x: the area up to an angle; y: its derivative, as a share of the outer arc's; z: the derivative of y, over y.
vec3 ltc_sample_swept(LtcSampleWedge wedge, vec2 turn) {
    vec2 met = vec2(wedge.inner * turn.x - wedge.lean * turn.y, wedge.outer * turn.y);
    float square = max(dot(met, met), 1e-30);
    float share = turn.y * (turn.y * wedge.steep - 2.0 * wedge.inner * wedge.lean * turn.x) / square;
    float change = 2.0 * wedge.inner * wedge.inner / square * (met.y * wedge.outer * turn.x - met.x * (wedge.inner * turn.y + wedge.lean * turn.x)) / square;
    float area = wedge.outer * ltc_sample_angle(turn.y, turn.x) - wedge.inner * ltc_sample_angle(met.y, met.x);
    return vec3(max(area, 0.0), clamp(share, 0.0, 1.0), change / max(share, 1e-20));
}

// Cosine and sine of the angle up to which an area lies. First guess: the areas' power of the angle at the end, or 2 or 3 at the corner.
vec2 ltc_sample_solve(LtcSampleWedge wedge, float area) {
    vec3 whole = ltc_sample_swept(wedge, wedge.end);
    float share = clamp(area / max(whole.x, 1e-37), 0.0, 1.0);
    float greatest = ltc_sample_angle(wedge.end.y, wedge.end.x);
    float cube = max(3.0 * area * wedge.inner * wedge.inner / max(wedge.outer * wedge.steep, 1e-37), 1e-30);
    float at_corner = 0.8 * min(sqrt(area * wedge.inner / max(-wedge.outer * wedge.lean, 1e-37)), pow(cube, 1.0 / 3.0));
    float at_end = greatest * pow(max(share, 1e-12), clamp(whole.x / max(wedge.outer * whole.y * greatest, 1e-37), 0.25, 1.0));
    float guess = max(at_end, min(at_corner, greatest * sqrt(share)));
    vec2 turn = vec2(cos(guess), sin(guess));
    for (uint k = 0u; k < LTC_SAMPLE_STEPS; k++) {
        vec3 swept = ltc_sample_swept(wedge, turn);
        float newton = clamp((swept.x - share * whole.x) / max(wedge.outer * swept.y, 1e-20), -4.0, 4.0);
        vec2 next = turn - newton / max(1.0 - 0.5 * newton * swept.z, 0.5) * vec2(-turn.y, turn.x);
        vec2 bounded = next.x * wedge.end.y < next.y * wedge.end.x ? wedge.end : next;
        turn = ltc_sample_unit(vec3(bounded.x, max(bounded.y, 0.0), 0.0)).xy;
    }
    return turn;
}

vec3 ltc_sample_unit(vec3 v) {
    return v / max(length(v), 1e-18);
}

// A power of two that brings a length near 1: products keep their digits and stay in range.
float ltc_sample_scale(vec3 v) {
    return uintBitsToFloat(0x7f000000u - (floatBitsToUint(max(max(abs(v.x), abs(v.y)), abs(v.z))) & 0x7f800000u));
}

// The columns from the second on, or from the third on.
mat3 ltc_sample_order(mat3 m, bool is_second, bool is_third) {
    vec3 first = is_third ? m[2] : (is_second ? m[1] : m[0]);
    return mat3(first, is_third ? m[0] : (is_second ? m[2] : m[1]), is_third ? m[1] : (is_second ? m[0] : m[2]));
}

// A plane's normal in the lobe's space, by the cofactors.
vec3 ltc_sample_normal(mat3 m_inv, vec3 n) {
    return vec3(m_inv[1].y * n.x, m_inv[0].x * n.y, m_inv[1].y * (m_inv[0].x * n.z - m_inv[2].x * n.x));
}

// The area between an arc and the zenith, counter-clockwise.
float ltc_sample_sector(vec3 plane, vec3 p, vec3 q, mat3 m_inv) {
    vec3 normal = ltc_sample_normal(m_inv, plane);
    return ltc_sample_unit(normal).z * ltc_sample_angle(length(normal), dot(m_inv * p, m_inv * q));
}

// ltc_angle of ltc.glsl.
float ltc_sample_angle(float sine, float cosine) {
    bool steep = sine > abs(cosine);
    float ratio = (steep ? abs(cosine) : sine) / max(steep ? sine : abs(cosine), 1e-37);
    float s = ratio * ratio;
    float low = ratio * ((0.0405516 * s + 0.65590577) * s + 0.99999753) / ((0.1708228 * s + 0.98917014) * s + 1.0);
    float acute = steep ? 0.5 * LTC_SAMPLE_PI - low : low;
    return cosine < 0.0 ? LTC_SAMPLE_PI - acute : acute;
}

// ltc_cross of ltc.glsl.
vec3 ltc_sample_cross(vec3 p, vec3 q) {
    vec3 p_high = uintBitsToFloat(floatBitsToUint(p) & uvec3(0xfffff000u));
    vec3 q_high = uintBitsToFloat(floatBitsToUint(q) & uvec3(0xfffff000u));
    vec3 rest = cross(p - p_high, q + q_high) + cross(p + p_high, q - q_high);
    return (p_high.yzx * q_high.zxy - p_high.zxy * q_high.yzx) + 0.5 * rest;
}
