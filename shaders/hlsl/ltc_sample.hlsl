// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// Points of convex polygons, drawn with the density of a linearly transformed cosine: ltc_density over their form factor.
// Copy with it: ltc.hlsl, whose outlines it is given, edge by edge; m_inv is one of its lobes, with rows (a,0,b), (0,c,0), (0,0,1).
// Frame: z = normal; outlines run round either way. On the lobe's unit disc arcs are ellipses (Peters 2021); a fan of triangles is summed.
// Example: fan = ltc_sample_edge(fan, outline.p, outline.q, outline.normal, outline.sine, m_inv); float3 wo = ltc_sample_point(fan, m_inv, number);
// Ranges: coordinates 1e-8 to 1e5, lobes as of ltc.hlsl; parts convex as seen from the point, of any number of vertices; never NaN.
// Greatest error: areas 3e-7, times c/a; over a form factor, so that is how far points of small and narrow lights are moved within them.
// Language: HLSL, shader model 5.0 and later. m_inv is used as mul(m_inv, v), whatever the packing of buffers.

static const float LTC_SAMPLE_PI = 3.14159265358979;
static const uint LTC_SAMPLE_STEPS = 3u;  // Halley's, towards an azimuth

// The triangles between each part's first vertex and its edges, and the one on which the point is. Areas are twice those on the disc.
struct LtcSampleFan {
    float left;        // from here to the point; negative beyond it. It falls by 2 pi times the parts' form factors
    float drawn;       // from the point's triangle on
    float3 apex;       // the part's first vertex above the horizon; 0 before it: set it so for each further part
    float3 reached;    // and its last
    float3 spoke;      // apex x reached
    float spoke_sector;
    float3x3 corners;  // of the point's triangle
    float3x3 normals;  // corner x next corner
    float3 sectors;    // between its sides and the zenith, signed
};

// Between two arcs from a corner to an azimuth: at the angle t of the outer one, the inner one's is u, cot u = (inner cot t - lean) / outer.
struct LtcSampleWedge {
    float3 corner;
    float3 normal;  // unit, of the outer arc
    float outer;    // heights of both arcs' unit normals; inner is 0 for the zenith itself
    float inner;
    float lean;
    float steep;    // outer^2 + lean^2 - inner^2
    float2 end;     // cosine and sine of the greatest t
};

// Used above their definitions.
LtcSampleFan ltc_sample_triangle(LtcSampleFan before, float3 corner, float3 normal, float3x3 m_inv);
LtcSampleWedge ltc_sample_wedge(float3 corner, float3 alone, float3 there, float3 other, bool is_outer);
float3 ltc_sample_swept(LtcSampleWedge wedge, float2 turn);
float2 ltc_sample_solve(LtcSampleWedge wedge, float area);
float3 ltc_sample_unit(float3 v);
float ltc_sample_scale(float3 v);
float3x3 ltc_sample_order(float3x3 m, bool is_second, bool is_third);
float3 ltc_sample_normal(float3x3 m_inv, float3 n);
float ltc_sample_sector(float3 plane, float3 p, float3 q, float3x3 m_inv);
float ltc_sample_angle(float sine, float cosine);
float3 ltc_sample_cross(float3 p, float3 q);

// Before the first part of a light: a uniform number in [0,1), and the form factor of all parts together.
LtcSampleFan ltc_sample_begin(float number, float form_factor) {
    LtcSampleFan result = { form_factor > 0.0 ? 2.0 * LTC_SAMPLE_PI * number * form_factor : -1.0, 0.0, (float3)0.0, (float3)0.0, (float3)0.0, 0.0, (float3x3)0.0, (float3x3)0.0, (float3)0.0 };
    return result;
}

// Adds the edge that an LtcOutline walked last, after what along the horizon leads to it: in a loop, as drivers that do both sides of a branch can leave it.
LtcSampleFan ltc_sample_edge(LtcSampleFan before, float3 p, float3 q, float3 normal, float sine, float3x3 m_inv) {
    LtcSampleFan fan = before;
    if (sine > 0.0) {
        float2 scale = float2(ltc_sample_scale(p), ltc_sample_scale(q));
        float3 start = scale.x * p;
        fan.reached = all(fan.apex == (float3)0.0) ? start : fan.reached;
        fan.apex = all(fan.apex == (float3)0.0) ? start : fan.apex;
        for (bool is_edge = all(fan.reached == start);; is_edge = true) {
            float3 plane = is_edge ? -(scale.x * normal) * (scale.y * sine) : ltc_sample_cross(fan.reached, start);
            fan = ltc_sample_triangle(fan, is_edge ? scale.y * q : start, plane, m_inv);
            if (is_edge) {
                break;
            }
        }
    }
    return fan;
}

// The point's unit direction, from another uniform number; where there is nothing to draw, 0.
float3 ltc_sample_point(LtcSampleFan fan, float3x3 m_inv, float number) {
    float sum = fan.sectors.x + fan.sectors.y + fan.sectors.z;
    float3 sectors = fan.sectors * float(sign(sum));
    bool3 below = sectors < (float3)0.0;
    bool is_around = !any(below);
    // A form factor that has been rounded up leads past the last triangle, which is then gone through again.
    float share = frac(min(fan.drawn / max(abs(sum), 1e-37), 1e6));
    float at = share * abs(sum);
    // The first side is the one whose sector it is, if the zenith is inside; else the one that alone faces it, or alone turns away.
    bool is_third = is_around ? at >= sectors.x + sectors.y : below.x == below.y;
    bool is_second = !is_third && (is_around ? at >= sectors.x : below.x == below.z);
    float3x3 corners = mul(m_inv, ltc_sample_order(fan.corners, is_second, is_third));
    float3x3 normals = ltc_sample_order(fan.normals, is_second, is_third);
    float3 side = ltc_sample_normal(m_inv, transpose(normals)[0]);
    LtcSampleWedge wedge = ltc_sample_wedge(transpose(corners)[0], (float3)0.0, transpose(corners)[1], side, false);
    float left = at - (is_third ? sectors.x + sectors.y : (is_second ? sectors.x : 0.0));
    if (!is_around) {
        bool is_outer = (is_third ? sectors.z : (is_second ? sectors.y : sectors.x)) > 0.0;
        wedge = ltc_sample_wedge(transpose(corners)[0], side, transpose(corners)[2], -ltc_sample_normal(m_inv, transpose(normals)[2]), is_outer);
        LtcSampleWedge other = ltc_sample_wedge(transpose(corners)[1], -side, transpose(corners)[2], ltc_sample_normal(m_inv, transpose(normals)[1]), is_outer);
        float area = ltc_sample_swept(wedge, wedge.end).x;
        left = share * (area + ltc_sample_swept(other, other.end).x);
        if (left >= area) {
            left -= area;
            wedge = other;
        }
    }
    float2 turn = ltc_sample_solve(wedge, left);
    // Uniform in the square of the radius, from the outer arc to the inner one.
    float3 arc = turn.x * wedge.corner + turn.y * cross(wedge.normal, wedge.corner);
    float inward = number * ltc_sample_swept(wedge, turn).y;
    float height = sqrt(max(arc.z * arc.z + inward * dot(arc.xy, arc.xy), 1e-30));
    float2 across = (arc.xy * sqrt(1.0 - inward) - float2(m_inv[0][2] * height, 0.0)) / float2(m_inv[0][0], m_inv[1][1]);
    return sum != 0.0 ? normalize(float3(across, height)) : (float3)0.0;
}

// Adds the triangle of the apex, the point reached and the next one. The first edge and the last have none.
LtcSampleFan ltc_sample_triangle(LtcSampleFan before, float3 corner, float3 normal, float3x3 m_inv) {
    LtcSampleFan fan = before;
    fan.reached = corner;
    fan.spoke = ltc_sample_cross(fan.apex, corner);
    fan.spoke_sector = ltc_sample_sector(fan.spoke, fan.apex, corner, m_inv);
    float3 sectors = float3(before.spoke_sector, ltc_sample_sector(normal, before.reached, corner, m_inv), -fan.spoke_sector);
    bool is_none = all(before.reached == fan.apex) || all(corner == fan.apex) || m_inv[0][0] * m_inv[1][1] <= 0.0;
    float area = is_none ? 0.0 : abs(sectors.x + sectors.y + sectors.z);
    if (area > 0.0 && fan.left >= 0.0) {
        fan.drawn = fan.left;
        fan.corners = transpose(float3x3(fan.apex, before.reached, corner));
        fan.normals = transpose(float3x3(before.spoke, normal, -fan.spoke));
        fan.sectors = sectors;
    }
    fan.left -= area;
    return fan;
}

// At a corner, between the side that is alone and the other one, which ends there.
LtcSampleWedge ltc_sample_wedge(float3 corner, float3 alone, float3 there, float3 other, bool is_outer) {
    float2 end = float2(dot(corner, there), length(other));
    float3 p = ltc_sample_unit(corner);
    float3 u = ltc_sample_unit(alone);
    float3 v = ltc_sample_unit(other);
    float3 k = float3(abs(is_outer ? float2(u.z, v.z) : float2(v.z, u.z)), -length(cross(u, v)) * p.z);
    float3 met = ltc_sample_unit(float3(is_outer ? float2(k.x * end.x + k.z * end.y, k.y * end.y) : end, 0.0));
    LtcSampleWedge result = { p, is_outer ? u : v, k.x, k.y, k.z, k.x * k.x + k.z * k.z - k.y * k.y, met.xy };
    return result;
}

// x: the area up to an angle; y: its derivative, as a share of the outer arc's; z: the derivative of y, over y.
float3 ltc_sample_swept(LtcSampleWedge wedge, float2 turn) {
    float2 met = float2(wedge.inner * turn.x - wedge.lean * turn.y, wedge.outer * turn.y);
    float square = max(dot(met, met), 1e-30);
    float share = turn.y * (turn.y * wedge.steep - 2.0 * wedge.inner * wedge.lean * turn.x) / square;
    float change = 2.0 * wedge.inner * wedge.inner / square * (met.y * wedge.outer * turn.x - met.x * (wedge.inner * turn.y + wedge.lean * turn.x)) / square;
    float area = wedge.outer * ltc_sample_angle(turn.y, turn.x) - wedge.inner * ltc_sample_angle(met.y, met.x);
    return float3(max(area, 0.0), clamp(share, 0.0, 1.0), change / max(share, 1e-20));
}

// Cosine and sine of the angle up to which an area lies. First guess: the areas' power of the angle at the end, or 2 or 3 at the corner.
float2 ltc_sample_solve(LtcSampleWedge wedge, float area) {
    float3 whole = ltc_sample_swept(wedge, wedge.end);
    float share = clamp(area / max(whole.x, 1e-37), 0.0, 1.0);
    float greatest = ltc_sample_angle(wedge.end.y, wedge.end.x);
    float cube = max(3.0 * area * wedge.inner * wedge.inner / max(wedge.outer * wedge.steep, 1e-37), 1e-30);
    float at_corner = 0.8 * min(sqrt(area * wedge.inner / max(-wedge.outer * wedge.lean, 1e-37)), pow(cube, 1.0 / 3.0));
    float at_end = greatest * pow(max(share, 1e-12), clamp(whole.x / max(wedge.outer * whole.y * greatest, 1e-37), 0.25, 1.0));
    float guess = max(at_end, min(at_corner, greatest * sqrt(share)));
    float2 turn = float2(cos(guess), sin(guess));
    for (uint k = 0u; k < LTC_SAMPLE_STEPS; k++) {
        float3 swept = ltc_sample_swept(wedge, turn);
        float newton = clamp((swept.x - share * whole.x) / max(wedge.outer * swept.y, 1e-20), -4.0, 4.0);
        float2 next = turn - newton / max(1.0 - 0.5 * newton * swept.z, 0.5) * float2(-turn.y, turn.x);
        float2 bounded = next.x * wedge.end.y < next.y * wedge.end.x ? wedge.end : next;
        turn = ltc_sample_unit(float3(bounded.x, max(bounded.y, 0.0), 0.0)).xy;
    }
    return turn;
}

float3 ltc_sample_unit(float3 v) {
    return v / max(length(v), 1e-18);
}

// A power of two that brings a length near 1: products keep their digits and stay in range.
float ltc_sample_scale(float3 v) {
    return asfloat(0x7f000000u - (asuint(max(max(abs(v.x), abs(v.y)), abs(v.z))) & 0x7f800000u));
}

// The columns from the second on, or from the third on.
float3x3 ltc_sample_order(float3x3 m, bool is_second, bool is_third) {
    float3 first = is_third ? transpose(m)[2] : (is_second ? transpose(m)[1] : transpose(m)[0]);
    return transpose(float3x3(first, is_third ? transpose(m)[0] : (is_second ? transpose(m)[2] : transpose(m)[1]), is_third ? transpose(m)[1] : (is_second ? transpose(m)[0] : transpose(m)[2])));
}

// A plane's normal in the lobe's space, by the cofactors.
float3 ltc_sample_normal(float3x3 m_inv, float3 n) {
    return float3(m_inv[1][1] * n.x, m_inv[0][0] * n.y, m_inv[1][1] * (m_inv[0][0] * n.z - m_inv[0][2] * n.x));
}

// The area between an arc and the zenith, counter-clockwise.
float ltc_sample_sector(float3 plane, float3 p, float3 q, float3x3 m_inv) {
    float3 normal = ltc_sample_normal(m_inv, plane);
    return ltc_sample_unit(normal).z * ltc_sample_angle(length(normal), dot(mul(m_inv, p), mul(m_inv, q)));
}

// ltc_angle of ltc.hlsl.
float ltc_sample_angle(float sine, float cosine) {
    bool steep = sine > abs(cosine);
    float ratio = (steep ? abs(cosine) : sine) / max(steep ? sine : abs(cosine), 1e-37);
    float s = ratio * ratio;
    float low = ratio * ((0.0405516 * s + 0.65590577) * s + 0.99999753) / ((0.1708228 * s + 0.98917014) * s + 1.0);
    float acute = steep ? 0.5 * LTC_SAMPLE_PI - low : low;
    return cosine < 0.0 ? LTC_SAMPLE_PI - acute : acute;
}

// ltc_cross of ltc.hlsl.
float3 ltc_sample_cross(float3 p, float3 q) {
    float3 p_high = asfloat(asuint(p) & (uint3)0xfffff000u);
    float3 q_high = asfloat(asuint(q) & (uint3)0xfffff000u);
    float3 rest = cross(p - p_high, q + q_high) + cross(p + p_high, q - q_high);
    return (p_high.yzx * q_high.zxy - p_high.zxy * q_high.yzx) + 0.5 * rest;
}
