// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// Form factors of polygonal lights under linearly transformed cosines (Heitz et al. 2016), clipped exactly at the horizon.
// Copy with it: nothing. Lobes are matrices m_inv with rows (a,0,b), (0,c,0), (0,0,1): the identity is the diffuse one, sheen.wgsl gives another.
// Frame: z = normal, x = view projected on the surface; vertices are relative to the shaded point, counter-clockwise seen from the lit side.
// Example: outline = ltc_next(outline, frame * (corner - position)); sum += ltc_edge(outline, m_inv); turn = ltc_turn(turn, outline, m_inv);
// Ranges: coordinates to 1e5, a and c to 1e3; any number of vertices, in contours that do not cross; form factors in [0,1]; never NaN.
// Greatest error: 5e-7 for vertices exact in the frame, 5e-6 a millionth of its size from an edge, times c/a; taking them there adds 1e-7 size/distance.

const LTC_PI = 3.14159265358979;
// A point closer to a light's plane than this share of its distance to the light's vertex is in the plane: f32 sees no side.
const LTC_IN_PLANE = 4.8e-7;
// Vertices no higher than this are below the horizon; far below the range, it keeps products of two heights from underflow.
const LTC_HORIZON = 1e-20;
// The turn before any edge.
const LTC_LEVEL = vec2<f32>(1.0, 0.0);

// An outline on its way round: the edge walked last, cut to its part above the horizon.
struct LtcOutline {
    corner: vec3<f32>,  // the vertex reached
    p: vec3<f32>,       // the part above the horizon starts in this direction
    q: vec3<f32>,       // and ends in this one
    normal: vec3<f32>,  // of the plane through the edge and the shaded point: q x p, up to a factor
    sine: f32,          // |q x p| = sine |normal|; 0 where the edge lies below the horizon
    turn: vec2<f32>,    // where it enters the upper hemisphere; where it leaves, mirrored at x; else LTC_LEVEL
}

// local_from_world for a unit normal and a unit view on either side of the surface. Where they coincide x is any tangent.
fn ltc_frame(normal: vec3<f32>, view: vec3<f32>) -> mat3x3<f32> {
    // An orthonormal basis of the normal alone (Duff et al. 2017), then turned: orthogonal however close the view is to the normal.
    let side = select(-1.0, 1.0, normal.z >= 0.0);
    let u = -1.0 / (side + normal.z);
    let v = normal.x * normal.y * u;
    let s = vec3(1.0 + side * normal.x * normal.x * u, side * v, -side * normal.x);
    let t = vec3(v, side + normal.y * normal.y * u, -normal.y);
    let across = vec2(dot(view, s), dot(view, t));
    let square = dot(across, across);
    let turn = select(vec2(1.0, 0.0), across * inverseSqrt(max(square, 1e-36)), square > 1e-36);
    return transpose(mat3x3(turn.x * s + turn.y * t, turn.x * t - turn.y * s, normal));
}

// On which side of a light the shaded point lies: 1 in front, 0 where none of it arrives, -1 behind one that shines both ways.
// light_normal points to the lit side; to_vertex goes from the shaded point to any vertex (both in one frame, whichever).
fn ltc_side(light_normal: vec3<f32>, to_vertex: vec3<f32>, two_sided: bool) -> f32 {
    let height = -dot(light_normal, to_vertex);
    if abs(height) <= LTC_IN_PLANE * length(to_vertex) || (height < 0.0 && !two_sided) {
        return 0.0;
    }
    return sign(height);
}

// Starts a contour at its last vertex, so that walking on to every vertex in turn closes it.
fn ltc_begin(last: vec3<f32>) -> LtcOutline {
    let none = vec3(0.0);
    return LtcOutline(last, none, none, none, 0.0, LTC_LEVEL);
}

// Walks to the next vertex.
fn ltc_next(outline: LtcOutline, corner: vec3<f32>) -> LtcOutline {
    let start = outline.corner;
    let starts_above = start.z > LTC_HORIZON;
    let ends_above = corner.z > LTC_HORIZON;
    let normal = ltc_cross(corner, start);
    // The crossing start corner.z - corner start.z is z x (start x corner): it inherits the accuracy of the product.
    let across = select(1.0, -1.0, starts_above) * normal;
    let crossing = vec3(across.y, -across.x, 0.0);
    let p = select(crossing, start, starts_above);
    let q = select(crossing, corner, ends_above);
    let height = max(max(start.z, corner.z) - LTC_HORIZON, 0.0);
    let sine = select(height, 1.0, starts_above && ends_above);
    let turn = select(LTC_LEVEL, vec2(across.y, -normal.x), starts_above != ends_above);
    return LtcOutline(corner, p, q, normal, sine, turn);
}

// What the edge walked last adds to a lobe's sum over all contours of a polygon.
fn ltc_edge(outline: LtcOutline, m_inv: mat3x3<f32>) -> f32 {
    return ltc_edge_vector(outline, m_inv).z;
}

// The same as a vector in the lobe's space, which has the sum as its z: of it, ltc_vector makes the light's mean direction there.
fn ltc_edge_vector(outline: LtcOutline, m_inv: mat3x3<f32>) -> vec3<f32> {
    let a = m_inv[0].x;
    let c = m_inv[1].y;
    let b = m_inv[2].x;
    // Normals go by the cofactors, which keep the accuracy of the product; transformed vertices would have to be multiplied anew.
    let normal = vec3(c * outline.normal.x, a * outline.normal.y, c * (a * outline.normal.z - b * outline.normal.x));
    let p = vec3(a * outline.p.x + b * outline.p.z, c * outline.p.y, outline.p.z);
    let q = vec3(a * outline.q.x + b * outline.q.z, c * outline.q.y, outline.q.z);
    return normal * ltc_arc(normal, outline.sine, dot(p, q));
}

// The angle along the horizon from where the contours left to where they came back, which closes them, as a complex number's
// argument; it starts at LTC_LEVEL. Lobes with the same c / a, as the diffuse one and the sheen, share it.
// All crossings of a polygon lie on one line, so in any order the angles add up to less than pi: it is enough to multiply directions.
fn ltc_turn(turn: vec2<f32>, outline: LtcOutline, m_inv: mat3x3<f32>) -> vec2<f32> {
    let by = vec2(m_inv[0].x * outline.turn.x, m_inv[1].y * outline.turn.y);
    let turned = vec2(turn.x * by.x - turn.y * by.y, turn.x * by.y + turn.y * by.x);
    return turned / max(abs(turned.x) + abs(turned.y), 1e-37);
}

// The form factor from a lobe's sum and turn, and the light's side; 0 where m_inv is singular.
fn ltc_form_factor(sum: f32, turn: vec2<f32>, m_inv: mat3x3<f32>, side: f32) -> f32 {
    let share = ltc_vector(vec3(0.0, 0.0, sum), turn, side).z;
    return select(0.0, clamp(share, 0.0, 1.0), m_inv[0].x * m_inv[1].y > 0.0);
}

// The integral of the directions in which a light is seen above the horizon, over pi, in a lobe's space: its z is the form factor.
fn ltc_vector(sum: vec3<f32>, turn: vec2<f32>, side: f32) -> vec3<f32> {
    let closing = vec3(0.0, 0.0, abs(side) * ltc_angle(abs(turn.y), turn.x));
    return (side * sum + closing) / (2.0 * LTC_PI);
}

// The angle of an arc, over the length of its normal; 0 where it has none.
fn ltc_arc(normal: vec3<f32>, sine: f32, cosine: f32) -> f32 {
    let size = length(normal);
    return ltc_angle(sine * size, cosine) / max(size, 1e-18);
}

// The angle in [0, pi] of a sine >= 0 and a cosine, of any common scale; 0 for two zeros. Greatest error 3e-7.
fn ltc_angle(sine: f32, cosine: f32) -> f32 {
    let steep = sine > abs(cosine);
    let ratio = select(sine, abs(cosine), steep) / max(select(abs(cosine), sine, steep), 1e-37);
    let s = ratio * ratio;
    // Minimax for arctangent on [0,1].
    let low = ratio * ((0.0405516 * s + 0.65590577) * s + 0.99999753) / ((0.1708228 * s + 0.98917014) * s + 1.0);
    let acute = select(low, 0.5 * LTC_PI - low, steep);
    return select(acute, LTC_PI - acute, cosine < 0.0);
}

// p x q, accurate where p and q are nearly parallel. High halves have products that f32 holds exactly; the rest is small, and
// shares no factor with them, so that no compiler can fold the halves together again.
fn ltc_cross(p: vec3<f32>, q: vec3<f32>) -> vec3<f32> {
    let p_high = bitcast<vec3<f32>>(bitcast<vec3<u32>>(p) & vec3(0xfffff000u));
    let q_high = bitcast<vec3<f32>>(bitcast<vec3<u32>>(q) & vec3(0xfffff000u));
    let rest = cross(p - p_high, q + q_high) + cross(p + p_high, q - q_high);
    return (p_high.yzx * q_high.zxy - p_high.zxy * q_high.yzx) + 0.5 * rest;
}

// The lobe's density in a unit direction, per steradian: its integral over the hemisphere is 1, or 0 where m_inv is singular.
// It is the pdf of ltc_sample too.
fn ltc_density(m_inv: mat3x3<f32>, direction: vec3<f32>) -> f32 {
    let area = m_inv[0].x * m_inv[1].y - m_inv[0].y * m_inv[1].x;
    let transformed = m_inv * direction;
    let square = max(dot(transformed, transformed), 1e-37);
    return max(direction.z, 0.0) * (area / square) / (LTC_PI * square);
}

// A direction of that density from two uniform numbers in [0,1). A singular m_inv gives the normal, whose density is then 0.
fn ltc_sample(m_inv: mat3x3<f32>, uniforms: vec2<f32>) -> vec3<f32> {
    let x = m_inv[0].xy;
    let y = m_inv[1].xy;
    let area = x.x * y.y - x.y * y.x;
    if area <= 0.0 {
        return vec3(0.0, 0.0, 1.0);
    }
    let azimuth = 2.0 * LTC_PI * uniforms.x;
    let height = sqrt(1.0 - uniforms.y);
    let across = sqrt(uniforms.y) * vec2(cos(azimuth), sin(azimuth)) - height * m_inv[2].xy;
    return normalize(vec3(y.y * across.x - y.x * across.y, x.x * across.y - x.y * across.x, area * height));
}
