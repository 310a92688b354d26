// The published real-time form (Heitz, Dupuy, Hill and Neubelt 2016, with the fitted arccosine of its later notes): per lobe,
// transform the quad, clip it by a table of sixteen cases, project it onto the sphere, sum its edges in vector form.

struct Clipped {
    v: array<vec3<f32>, 5>,
    count: u32,
}

// Where the edge from an upper to a lower vertex meets the horizon.
fn published_cut(up: vec3<f32>, down: vec3<f32>) -> vec3<f32> {
    return up.z * down - down.z * up;
}

fn published_clip(q: array<vec3<f32>, 4>) -> Clipped {
    let a = q[0];
    let b = q[1];
    let c = q[2];
    let d = q[3];
    let above = u32(a.z > 0.0) | u32(b.z > 0.0) << 1u | u32(c.z > 0.0) << 2u | u32(d.z > 0.0) << 3u;
    switch above {
        case 1u: {
            return Clipped(array(a, published_cut(a, b), published_cut(a, d), a, a), 3u);
        }
        case 2u: {
            return Clipped(array(published_cut(b, a), b, published_cut(b, c), published_cut(b, a), b), 3u);
        }
        case 3u: {
            return Clipped(array(a, b, published_cut(b, c), published_cut(a, d), a), 4u);
        }
        case 4u: {
            return Clipped(array(published_cut(c, d), published_cut(c, b), c, published_cut(c, d), c), 3u);
        }
        case 6u: {
            return Clipped(array(published_cut(b, a), b, c, published_cut(c, d), b), 4u);
        }
        case 7u: {
            return Clipped(array(a, b, c, published_cut(c, d), published_cut(a, d)), 5u);
        }
        case 8u: {
            return Clipped(array(published_cut(d, a), published_cut(d, c), d, published_cut(d, a), d), 3u);
        }
        case 9u: {
            return Clipped(array(a, published_cut(a, b), published_cut(d, c), d, a), 4u);
        }
        case 11u: {
            return Clipped(array(a, b, published_cut(b, c), published_cut(d, c), d), 5u);
        }
        case 12u: {
            return Clipped(array(published_cut(d, a), published_cut(c, b), c, d, c), 4u);
        }
        case 13u: {
            return Clipped(array(a, published_cut(a, b), published_cut(c, b), c, d), 5u);
        }
        case 14u: {
            return Clipped(array(published_cut(b, a), b, c, d, published_cut(d, a)), 5u);
        }
        case 15u: {
            return Clipped(array(a, b, c, d, a), 4u);
        }
        default: {
            return Clipped(array(a, b, c, d, a), 0u);
        }
    }
}

// The z component of an edge's contribution, between unit vectors: the angle over its sine is a fitted rational
// function.
fn published_edge(p: vec3<f32>, q: vec3<f32>) -> f32 {
    let x = dot(p, q);
    let y = abs(x);
    let acute = (0.8543985 + (0.4965155 + 0.0145206 * y) * y) / (3.4175940 + (4.1616724 + y) * y);
    let angle_over_sine = select(0.5 * inverseSqrt(max(1.0 - x * x, 1e-7)) - acute, acute, x > 0.0);
    return (p.x * q.y - p.y * q.x) * angle_over_sine;
}

fn published_lobe(at: Point, m_inv: mat3x3<f32>) -> f32 {
    let tangent = normalize(at.view - at.normal * dot(at.view, at.normal));
    let m = m_inv * transpose(mat3x3(tangent, cross(at.normal, tangent), at.normal));
    let clipped = published_clip(array(
        m * (scene.corners[0].xyz - at.position), m * (scene.corners[1].xyz - at.position),
        m * (scene.corners[2].xyz - at.position), m * (scene.corners[3].xyz - at.position)));
    if clipped.count == 0u {
        return 0.0;
    }
    let a = normalize(clipped.v[0]);
    let b = normalize(clipped.v[1]);
    let c = normalize(clipped.v[2]);
    let d = normalize(clipped.v[3]);
    let e = normalize(clipped.v[4]);
    var sum = published_edge(a, b) + published_edge(b, c);
    if clipped.count == 3u {
        sum += published_edge(c, a);
    } else if clipped.count == 4u {
        sum += published_edge(c, d) + published_edge(d, a);
    } else {
        sum += published_edge(c, d) + published_edge(d, e) + published_edge(e, a);
    }
    return max(0.0, -sum);
}

@fragment
fn published(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    let at = point(pixel.xy);
    let size = vec2<f32>(textureDimensions(specular_matrices));
    let uv = (vec2(at.roughness, dot(at.normal, at.view)) * (size - 1.0) + 0.5) / size;
    let abc = textureSampleLevel(specular_matrices, filtering, uv, 0.0);
    let weights = textureSampleLevel(specular_weights, filtering, uv, 0.0);
    let specular = published_lobe(at, mat3x3(abc.x, 0.0, 0.0, 0.0, abc.z, 0.0, abc.y, 0.0, abc.w));
    let diffuse = published_lobe(at, IDENTITY);
    return vec4(specular * (0.04 * weights.x + weights.y), diffuse, specular, 1.0);
}
