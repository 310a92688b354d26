// Form factors of polygonal lights under linearly transformed cosines (Heitz et al. 2016), clipped exactly at the horizon.
// Copy with it: nothing. Lobes are matrices m_inv whose third row is (0,0,1): the identity is the diffuse one, sheen.wgsl gives another.
// Frame: z = normal, x = view projected on the surface; vertices are relative to the shaded point, counter-clockwise seen from the lit side.
// Example: outline = ltc_next(outline, frame * (vertex - position)); sum += ltc_edge(outline, m_inv);
// Ranges: coordinates 0 or 1e-6 to 1e6; any number of vertices and contours; form factors in [0,1], 1 the whole hemisphere; never NaN.
// Greatest error: 5e-7 for vertices exact in the frame, 5e-6 a millionth of its size from an edge; taking them there adds 1e-7 size / distance.

const LTC_PI = 3.14159265358979;
// A point closer to a light's plane than this share of its distance to the light's vertex is in the plane: f32 sees no side.
const LTC_IN_PLANE = 4.8e-7;
// Vertices no higher than this are below the horizon; far below the range, it keeps products of two heights from underflow.
const LTC_HORIZON = 1e-20;

// An outline on its way round: the edge walked last, cut to its part above the horizon.
struct LtcOutline {
    vertex: vec3<f32>,   // the vertex reached
    p: vec3<f32>,        // the part above the horizon starts in this direction
    q: vec3<f32>,        // and ends in this one
    normal: vec3<f32>,   // of the plane through the edge and the shaded point: q x p, up to a factor
    sine: f32,           // |q x p| = sine |normal|; 0 where the edge lies below the horizon
    pending: vec3<f32>,  // direction of a crossing of the horizon that waits for its partner; z != 0 where there is one
    leave: vec2<f32>,    // where the outline sank below the horizon
    enter: vec2<f32>,    // and where it rose again: a pair of directions that this edge completed, else 0
}

// local_startworld for a unit normal and a unit view on either side of the surface. Where they coincide x is any tangent.
fn ltc_frame(normal: vec3<f32>, view: vec3<f32>) -> mat3x3<f32> {
    // An orthonormal basis of the normal alone (Duff et al. 2017), then turned: orthogonal however close the view is to the normal.
    let side = select(-1.0, 1.0, normal.z >= 0.0);
    let u = -1.0 / (side + normal.z);
    let v = normal.x * normal.y * u;
    let s = vec3(1.0 + side * normal.x * normal.x * u, side * v, -side * normal.x);
    let t = vec3(v, side + normal.y * normal.y * u, -normal.y);
    let across = vec2(dot(view, s), dot(view, t));
    let size = length(across);
    let turn = select(vec2(1.0, 0.0), across / max(size, 1e-30), size > 1e-30);
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
    return LtcOutline(last, none, none, none, 0.0, none, none.xy, none.xy);
}

// Walks to the next vertex. Once round, no crossing is pending: what leaves the upper hemisphere comes back.
fn ltc_next(outline: LtcOutline, vertex: vec3<f32>) -> LtcOutline {
    let start = outline.vertex;
    let starts_above = start.z > LTC_HORIZON;
    let ends_above = vertex.z > LTC_HORIZON;
    let none = vec3(0.0);
    if !starts_above && !ends_above {
        return LtcOutline(vertex, none, none, none, 0.0, outline.pending, none.xy, none.xy);
    }
    let normal = ltc_cross(vertex, start);
    if starts_above && ends_above {
        return LtcOutline(vertex, start, vertex, normal, 1.0, outline.pending, none.xy, none.xy);
    }
    // The crossing start vertex.z - vertex start.z is z x (start x vertex): it inherits the accuracy of the product.
    let across = select(-1.0, 1.0, ends_above) * vec2(normal.y, -normal.x);
    let reach = max(max(abs(across.x), abs(across.y)), 1e-30);
    let size = max(length(across / reach), 1.0);
    let crossing = across / reach / size;
    let p = select(start, vec3(crossing, 0.0), ends_above);
    let q = select(vec3(crossing, 0.0), vertex, ends_above);
    let sine = max(start.z, vertex.z) / size / reach;
    // Leaving and entering alternate. All crossings of a polygon lie on one line, so any pairing of them sums to the same angle.
    if outline.pending.z == 0.0 {
        let pending = vec3(crossing, 1.0);
        return LtcOutline(vertex, p, q, normal, sine, pending, none.xy, none.xy);
    }
    let leave = select(crossing, outline.pending.xy, ends_above);
    let enter = select(outline.pending.xy, crossing, ends_above);
    return LtcOutline(vertex, p, q, normal, sine, none, leave, enter);
}

// What the edge walked last adds to a lobe's sum over all contours of a polygon.
fn ltc_edge(outline: LtcOutline, m_inv: mat3x3<f32>) -> f32 {
    if outline.sine == 0.0 {
        return 0.0;
    }
    let x = m_inv[0].xy;
    let y = m_inv[1].xy;
    let z = m_inv[2].xy;
    let area = x.x * y.y - x.y * y.x;
    // Normals go by the cofactors, which keep the accuracy of the product; transformed vertices would have to be multiplied anew.
    let n = outline.normal;
    let tilt = vec2(y.y * n.x - x.y * n.y, x.x * n.y - y.x * n.x);
    let normal = vec3(tilt, area * n.z - dot(z, tilt));
    let size = length(normal);
    var sum = 0.0;
    if size > 0.0 {
        sum = ltc_angle(size * outline.sine, dot(m_inv * outline.p, m_inv * outline.q)) * (normal.z / size);
    }
    // Along the horizon from where the outline left to where it came back.
    let leave = x * outline.leave.x + y * outline.leave.y;
    let enter = x * outline.enter.x + y * outline.enter.y;
    let turn = enter.x * leave.y - enter.y * leave.x;
    if turn == 0.0 {
        return sum;
    }
    return sum + sign(turn) * ltc_angle(abs(turn), dot(leave, enter));
}

// The form factor from a lobe's sum and the light's side.
fn ltc_form_factor(sum: f32, side: f32) -> f32 {
    return clamp(side * sum / (2.0 * LTC_PI), 0.0, 1.0);
}

// The angle in [0, pi] of a sine >= 0 and a cosine, of any common scale; 0 for two zeros. Greatest error 3e-7.
fn ltc_angle(sine: f32, cosine: f32) -> f32 {
    let ratio = min(sine, abs(cosine)) / max(max(sine, abs(cosine)), 1e-37);
    let s = ratio * ratio;
    // Minimax for arctangent on [0,1].
    let high = ((-0.0040545659 * s + 0.021862953) * s - 0.055912320) * s + 0.096421969;
    let low = ((((high * s - 0.13908629) * s + 0.19946566) * s - 0.33329861) * s + 0.99999934) * ratio;
    let acute = select(low, 0.5 * LTC_PI - low, sine > abs(cosine));
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
