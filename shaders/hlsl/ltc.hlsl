// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// Form factors of polygonal lights under linearly transformed cosines (Heitz et al. 2016), clipped exactly at the horizon.
// Copy with it: nothing. Lobes are matrices m_inv with rows (a,0,b), (0,c,0), (0,0,1): the identity is the diffuse one, sheen.hlsl gives another.
// Frame: z = normal, x = view projected on the surface; vertices are relative to the shaded point, counter-clockwise seen from the lit side.
// Example: outline = ltc_next(outline, mul(frame, corner - position)); sum += ltc_edge(outline, m_inv); turn = ltc_turn(turn, outline, m_inv);
// Ranges: coordinates to 1e5, a and c to 1e3; any number of vertices, in contours that do not cross; form factors in [0,1]; never NaN.
// Greatest error: 5e-7 for vertices exact in the frame, 5e-6 a millionth of its size from an edge, times c/a; taking them there adds 1e-7 size/distance.
// Language: HLSL, shader model 5.0 and later. m_inv is used as mul(m_inv, v), whatever the packing of buffers.

static const float LTC_PI = 3.14159265358979;
// A point closer to a light's plane than this share of its distance to the light's vertex is in the plane: f32 sees no side.
static const float LTC_IN_PLANE = 4.8e-7;
// Vertices no higher than this are below the horizon; far below the range, it keeps products of two heights from underflow.
static const float LTC_HORIZON = 1e-20;
// The turn before any edge.
static const float2 LTC_LEVEL = float2(1.0, 0.0);

// An outline on its way round: the edge walked last, cut to its part above the horizon.
struct LtcOutline {
    float3 corner;  // the vertex reached
    float3 p;       // the part above the horizon starts in this direction
    float3 q;       // and ends in this one
    float3 normal;  // of the plane through the edge and the shaded point: q x p, up to a factor
    float sine;     // |q x p| = sine |normal|; 0 where the edge lies below the horizon
    float2 turn;    // where it enters the upper hemisphere; where it leaves, mirrored at x; else LTC_LEVEL
};

// Used above their definitions.
float3 ltc_edge_vector(LtcOutline outline, float3x3 m_inv);
float3 ltc_vector(float3 sum, float2 turn, float side);
float ltc_arc(float3 normal, float sine, float cosine);
float ltc_angle(float sine, float cosine);
float3 ltc_cross(float3 p, float3 q);

// local_from_world for a unit normal and a unit view on either side of the surface. Where they coincide x is any tangent.
float3x3 ltc_frame(float3 normal, float3 view) {
    // An orthonormal basis of the normal alone (Duff et al. 2017), then turned: orthogonal however close the view is to the normal.
    float side = normal.z >= 0.0 ? 1.0 : -1.0;
    float u = -1.0 / (side + normal.z);
    float v = normal.x * normal.y * u;
    float3 s = float3(1.0 + side * normal.x * normal.x * u, side * v, -side * normal.x);
    float3 t = float3(v, side + normal.y * normal.y * u, -normal.y);
    float2 across = float2(dot(view, s), dot(view, t));
    float square = dot(across, across);
    float2 turn = square > 1e-36 ? across * rsqrt(max(square, 1e-36)) : float2(1.0, 0.0);
    return float3x3(turn.x * s + turn.y * t, turn.x * t - turn.y * s, normal);
}

// On which side of a light the shaded point lies: 1 in front, 0 where none of it arrives, -1 behind one that shines both ways.
// light_normal points to the lit side; to_vertex goes from the shaded point to any vertex (both in one frame, whichever).
float ltc_side(float3 light_normal, float3 to_vertex, bool two_sided) {
    float height = -dot(light_normal, to_vertex);
    if (abs(height) <= LTC_IN_PLANE * length(to_vertex) || (height < 0.0 && !two_sided)) {
        return 0.0;
    }
    return float(sign(height));
}

// Starts a contour at its last vertex, so that walking on to every vertex in turn closes it.
LtcOutline ltc_begin(float3 last) {
    float3 none = (float3)0.0;
    LtcOutline result = { last, none, none, none, 0.0, LTC_LEVEL };
    return result;
}

// Walks to the next vertex.
LtcOutline ltc_next(LtcOutline outline, float3 corner) {
    float3 start = outline.corner;
    bool starts_above = start.z > LTC_HORIZON;
    bool ends_above = corner.z > LTC_HORIZON;
    float3 normal = ltc_cross(corner, start);
    // The crossing start corner.z - corner start.z is z x (start x corner): it inherits the accuracy of the product.
    float3 across = (starts_above ? -1.0 : 1.0) * normal;
    float3 crossing = float3(across.y, -across.x, 0.0);
    float3 p = starts_above ? start : crossing;
    float3 q = ends_above ? corner : crossing;
    float height = max(max(start.z, corner.z) - LTC_HORIZON, 0.0);
    float sine = starts_above && ends_above ? 1.0 : height;
    float2 turn = starts_above != ends_above ? float2(across.y, -normal.x) : LTC_LEVEL;
    LtcOutline result = { corner, p, q, normal, sine, turn };
    return result;
}

// What the edge walked last adds to a lobe's sum over all contours of a polygon.
float ltc_edge(LtcOutline outline, float3x3 m_inv) {
    return ltc_edge_vector(outline, m_inv).z;
}

// The same as a vector in the lobe's space, which has the sum as its z: of it, ltc_vector makes the light's mean direction there.
float3 ltc_edge_vector(LtcOutline outline, float3x3 m_inv) {
    float a = m_inv[0][0];
    float c = m_inv[1][1];
    float b = m_inv[0][2];
    // Normals go by the cofactors, which keep the accuracy of the product; transformed vertices would have to be multiplied anew.
    float3 normal = float3(c * outline.normal.x, a * outline.normal.y, c * (a * outline.normal.z - b * outline.normal.x));
    float3 p = float3(a * outline.p.x + b * outline.p.z, c * outline.p.y, outline.p.z);
    float3 q = float3(a * outline.q.x + b * outline.q.z, c * outline.q.y, outline.q.z);
    return normal * ltc_arc(normal, outline.sine, dot(p, q));
}

// The angle along the horizon from where the contours left to where they came back, which closes them, as a complex number's
// argument; it starts at LTC_LEVEL. Lobes with the same c / a, as the diffuse one and the sheen, share it.
// All crossings of a polygon lie on one line, so in any order the angles add up to less than pi: it is enough to multiply directions.
float2 ltc_turn(float2 turn, LtcOutline outline, float3x3 m_inv) {
    float2 by = float2(m_inv[0][0] * outline.turn.x, m_inv[1][1] * outline.turn.y);
    float2 turned = float2(turn.x * by.x - turn.y * by.y, turn.x * by.y + turn.y * by.x);
    return turned / max(abs(turned.x) + abs(turned.y), 1e-37);
}

// The form factor from a lobe's sum and turn, and the light's side; 0 where m_inv is singular.
float ltc_form_factor(float sum, float2 turn, float3x3 m_inv, float side) {
    float share = ltc_vector(float3(0.0, 0.0, sum), turn, side).z;
    return m_inv[0][0] * m_inv[1][1] > 0.0 ? clamp(share, 0.0, 1.0) : 0.0;
}

// The integral of the directions in which a light is seen above the horizon, over pi, in a lobe's space: its z is the form factor.
float3 ltc_vector(float3 sum, float2 turn, float side) {
    float3 closing = float3(0.0, 0.0, abs(side) * ltc_angle(abs(turn.y), turn.x));
    return (side * sum + closing) / (2.0 * LTC_PI);
}

// The angle of an arc, over the length of its normal; 0 where it has none.
float ltc_arc(float3 normal, float sine, float cosine) {
    float size = length(normal);
    return ltc_angle(sine * size, cosine) / max(size, 1e-18);
}

// The angle in [0, pi] of a sine >= 0 and a cosine, of any common scale; 0 for two zeros. Greatest error 3e-7.
float ltc_angle(float sine, float cosine) {
    bool steep = sine > abs(cosine);
    float ratio = (steep ? abs(cosine) : sine) / max(steep ? sine : abs(cosine), 1e-37);
    float s = ratio * ratio;
    // Minimax for arctangent on [0,1].
    float low = ratio * ((0.0405516 * s + 0.65590577) * s + 0.99999753) / ((0.1708228 * s + 0.98917014) * s + 1.0);
    float acute = steep ? 0.5 * LTC_PI - low : low;
    return cosine < 0.0 ? LTC_PI - acute : acute;
}

// p x q, accurate where p and q are nearly parallel. High halves have products that f32 holds exactly; the rest is small, and
// shares no factor with them, so that no compiler can fold the halves together again.
float3 ltc_cross(float3 p, float3 q) {
    float3 p_high = asfloat(asuint(p) & (uint3)0xfffff000u);
    float3 q_high = asfloat(asuint(q) & (uint3)0xfffff000u);
    float3 rest = cross(p - p_high, q + q_high) + cross(p + p_high, q - q_high);
    return (p_high.yzx * q_high.zxy - p_high.zxy * q_high.yzx) + 0.5 * rest;
}

// The lobe's density in a unit direction, per steradian: its integral over the hemisphere is 1, or 0 where m_inv is singular.
// It is the pdf of ltc_sample too.
float ltc_density(float3x3 m_inv, float3 direction) {
    float area = m_inv[0][0] * m_inv[1][1] - m_inv[1][0] * m_inv[0][1];
    float3 transformed = mul(m_inv, direction);
    float square = max(dot(transformed, transformed), 1e-37);
    return max(direction.z, 0.0) * (area / square) / (LTC_PI * square);
}

// A direction of that density from two uniform numbers in [0,1). A singular m_inv gives the normal, whose density is then 0.
float3 ltc_sample(float3x3 m_inv, float2 uniforms) {
    float2 x = float2(m_inv[0][0], m_inv[1][0]);
    float2 y = float2(m_inv[0][1], m_inv[1][1]);
    float area = x.x * y.y - x.y * y.x;
    if (area <= 0.0) {
        return float3(0.0, 0.0, 1.0);
    }
    float azimuth = 2.0 * LTC_PI * uniforms.x;
    float height = sqrt(1.0 - uniforms.y);
    float2 across = sqrt(uniforms.y) * float2(cos(azimuth), sin(azimuth)) - height * float2(m_inv[0][2], m_inv[1][2]);
    return normalize(float3(y.y * across.x - y.x * across.y, x.x * across.y - x.y * across.x, area * height));
}
