// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// Form factors of polygonal lights under linearly transformed cosines (Heitz et al. 2016), clipped exactly at the horizon.
// Copy with it: nothing. Lobes are matrices m_inv with rows (a,0,b), (0,c,0), (0,0,1): the identity is the diffuse one, sheen.glsl gives another.
// Frame: z = normal, x = view projected on the surface; vertices are relative to the shaded point, counter-clockwise seen from the lit side.
// Example: outline = ltc_next(outline, frame * (corner - position)); sum += ltc_edge(outline, m_inv); turn = ltc_turn(turn, outline, m_inv);
// Ranges: coordinates to 1e5, a and c to 1e3; any number of vertices, in contours that do not cross; form factors in [0,1]; never NaN.
// Greatest error: 5e-7 for vertices exact in the frame, 5e-6 a millionth of its size from an edge, times c/a; taking them there adds 1e-7 size/distance.
// Language: GLSL ES 3.00, where `precision highp float; precision highp int; precision highp sampler2D;` come before it, or any later GLSL.

const float LTC_PI = 3.14159265358979;
// A point closer to a light's plane than this share of its distance to the light's vertex is in the plane: f32 sees no side.
const float LTC_IN_PLANE = 4.8e-7;
// Vertices no higher than this are below the horizon; far below the range, it keeps products of two heights from underflow.
const float LTC_HORIZON = 1e-20;
// The turn before any edge.
const vec2 LTC_LEVEL = vec2(1.0, 0.0);

// An outline on its way round: the edge walked last, cut to its part above the horizon.
struct LtcOutline {
    vec3 corner;  // the vertex reached
    vec3 p;       // the part above the horizon starts in this direction
    vec3 q;       // and ends in this one
    vec3 normal;  // of the plane through the edge and the shaded point: q x p, up to a factor
    float sine;   // |q x p| = sine |normal|; 0 where the edge lies below the horizon
    vec2 turn;    // where it enters the upper hemisphere; where it leaves, mirrored at x; else LTC_LEVEL
};

// Used above their definitions.
vec3 ltc_edge_vector(LtcOutline outline, mat3 m_inv);
vec3 ltc_vector(vec3 sum, vec2 turn, float side);
float ltc_arc(vec3 normal, float sine, float cosine);
float ltc_angle(float sine, float cosine);
vec3 ltc_cross(vec3 p, vec3 q);

// local_from_world for a unit normal and a unit view on either side of the surface. Where they coincide x is any tangent.
mat3 ltc_frame(vec3 normal, vec3 view) {
    // An orthonormal basis of the normal alone (Duff et al. 2017), then turned: orthogonal however close the view is to the normal.
    float side = normal.z >= 0.0 ? 1.0 : -1.0;
    float u = -1.0 / (side + normal.z);
    float v = normal.x * normal.y * u;
    vec3 s = vec3(1.0 + side * normal.x * normal.x * u, side * v, -side * normal.x);
    vec3 t = vec3(v, side + normal.y * normal.y * u, -normal.y);
    vec2 across = vec2(dot(view, s), dot(view, t));
    float square = dot(across, across);
    vec2 turn = square > 1e-36 ? across * inversesqrt(max(square, 1e-36)) : vec2(1.0, 0.0);
    return transpose(mat3(turn.x * s + turn.y * t, turn.x * t - turn.y * s, normal));
}

// On which side of a light the shaded point lies: 1 in front, 0 where none of it arrives, -1 behind one that shines both ways.
// light_normal points to the lit side; to_vertex goes from the shaded point to any vertex (both in one frame, whichever).
float ltc_side(vec3 light_normal, vec3 to_vertex, bool two_sided) {
    float height = -dot(light_normal, to_vertex);
    if (abs(height) <= LTC_IN_PLANE * length(to_vertex) || (height < 0.0 && !two_sided)) {
        return 0.0;
    }
    return sign(height);
}

// Starts a contour at its last vertex, so that walking on to every vertex in turn closes it.
LtcOutline ltc_begin(vec3 last) {
    vec3 none = vec3(0.0);
    return LtcOutline(last, none, none, none, 0.0, LTC_LEVEL);
}

// Walks to the next vertex.
LtcOutline ltc_next(LtcOutline outline, vec3 corner) {
    vec3 start = outline.corner;
    bool starts_above = start.z > LTC_HORIZON;
    bool ends_above = corner.z > LTC_HORIZON;
    vec3 normal = ltc_cross(corner, start);
    // The crossing start corner.z - corner start.z is z x (start x corner): it inherits the accuracy of the product.
    vec3 across = (starts_above ? -1.0 : 1.0) * normal;
    vec3 crossing = vec3(across.y, -across.x, 0.0);
    vec3 p = starts_above ? start : crossing;
    vec3 q = ends_above ? corner : crossing;
    float height = max(max(start.z, corner.z) - LTC_HORIZON, 0.0);
    float sine = starts_above && ends_above ? 1.0 : height;
    vec2 turn = starts_above != ends_above ? vec2(across.y, -normal.x) : LTC_LEVEL;
    return LtcOutline(corner, p, q, normal, sine, turn);
}

// What the edge walked last adds to a lobe's sum over all contours of a polygon.
float ltc_edge(LtcOutline outline, mat3 m_inv) {
    return ltc_edge_vector(outline, m_inv).z;
}

// The same as a vector in the lobe's space, which has the sum as its z: of it, ltc_vector makes the light's mean direction there.
vec3 ltc_edge_vector(LtcOutline outline, mat3 m_inv) {
    float a = m_inv[0].x;
    float c = m_inv[1].y;
    float b = m_inv[2].x;
    // Normals go by the cofactors, which keep the accuracy of the product; transformed vertices would have to be multiplied anew.
    vec3 normal = vec3(c * outline.normal.x, a * outline.normal.y, c * (a * outline.normal.z - b * outline.normal.x));
    vec3 p = vec3(a * outline.p.x + b * outline.p.z, c * outline.p.y, outline.p.z);
    vec3 q = vec3(a * outline.q.x + b * outline.q.z, c * outline.q.y, outline.q.z);
    return normal * ltc_arc(normal, outline.sine, dot(p, q));
}

// The angle along the horizon from where the contours left to where they came back, which closes them, as a complex number's
// argument; it starts at LTC_LEVEL. Lobes with the same c / a, as the diffuse one and the sheen, share it.
// All crossings of a polygon lie on one line, so in any order the angles add up to less than pi: it is enough to multiply directions.
vec2 ltc_turn(vec2 turn, LtcOutline outline, mat3 m_inv) {
    vec2 by = vec2(m_inv[0].x * outline.turn.x, m_inv[1].y * outline.turn.y);
    vec2 turned = vec2(turn.x * by.x - turn.y * by.y, turn.x * by.y + turn.y * by.x);
    return turned / max(abs(turned.x) + abs(turned.y), 1e-37);
}

// The form factor from a lobe's sum and turn, and the light's side; 0 where m_inv is singular.
float ltc_form_factor(float sum, vec2 turn, mat3 m_inv, float side) {
    float share = ltc_vector(vec3(0.0, 0.0, sum), turn, side).z;
    return m_inv[0].x * m_inv[1].y > 0.0 ? clamp(share, 0.0, 1.0) : 0.0;
}

// The integral of the directions in which a light is seen above the horizon, over pi, in a lobe's space: its z is the form factor.
vec3 ltc_vector(vec3 sum, vec2 turn, float side) {
    vec3 closing = vec3(0.0, 0.0, abs(side) * ltc_angle(abs(turn.y), turn.x));
    return (side * sum + closing) / (2.0 * LTC_PI);
}

// The angle of an arc, over the length of its normal; 0 where it has none.
float ltc_arc(vec3 normal, float sine, float cosine) {
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
vec3 ltc_cross(vec3 p, vec3 q) {
    vec3 p_high = uintBitsToFloat(floatBitsToUint(p) & uvec3(0xfffff000u));
    vec3 q_high = uintBitsToFloat(floatBitsToUint(q) & uvec3(0xfffff000u));
    vec3 rest = cross(p - p_high, q + q_high) + cross(p + p_high, q - q_high);
    return (p_high.yzx * q_high.zxy - p_high.zxy * q_high.yzx) + 0.5 * rest;
}

// The lobe's density in a unit direction, per steradian: its integral over the hemisphere is 1, or 0 where m_inv is singular.
// It is the pdf of ltc_sample too.
float ltc_density(mat3 m_inv, vec3 direction) {
    float area = m_inv[0].x * m_inv[1].y - m_inv[0].y * m_inv[1].x;
    vec3 transformed = m_inv * direction;
    float square = max(dot(transformed, transformed), 1e-37);
    return max(direction.z, 0.0) * (area / square) / (LTC_PI * square);
}

// A direction of that density from two uniform numbers in [0,1). A singular m_inv gives the normal, whose density is then 0.
vec3 ltc_sample(mat3 m_inv, vec2 uniforms) {
    vec2 x = m_inv[0].xy;
    vec2 y = m_inv[1].xy;
    float area = x.x * y.y - x.y * y.x;
    if (area <= 0.0) {
        return vec3(0.0, 0.0, 1.0);
    }
    float azimuth = 2.0 * LTC_PI * uniforms.x;
    float height = sqrt(1.0 - uniforms.y);
    vec2 across = sqrt(uniforms.y) * vec2(cos(azimuth), sin(azimuth)) - height * m_inv[2].xy;
    return normalize(vec3(y.y * across.x - y.x * across.y, x.x * across.y - x.y * across.x, area * height));
}
