// The filter of shadows while samples are few: of the share of the radiance that is left, which is smooth where radiance is not, a mean over
// pixels that see the same surface (a-trous wavelets, Dammertz et al. 2010, without their stop at edges of light).

// How far apart the pixels of the kernel are.
override DENOISE_STEP: i32 = 1;
// Whether shares have been taken before; otherwise this pass takes them.
override DENOISE_AGAIN: bool = false;

// A neighbour counts less, the farther it is off the plane through the pixel, as a share of their distance,
const DENOISE_SLOPE = 0.1;
// and the farther their normals are apart: a power of the cosine.
const DENOISE_POWER = 64.0;

struct DenoiseUniforms {
    // How much neighbours count, in [0, 1]: the less, the more samples there are.
    neighbours: f32,
    // Of the share that is left. By noise a sample may leave more than there is: under lights that vary, much more, or less than nothing.
    least: f32,
    most: f32,
}

@group(0) @binding(0) var<uniform> denoise_uniforms: DenoiseUniforms;
@group(0) @binding(1) var denoise_mean_radiance: texture_2d<f32>;
@group(0) @binding(2) var denoise_mean_blocked: texture_2d<f32>;
@group(0) @binding(3) var denoise_guide: texture_2d<f32>;
@group(0) @binding(4) var denoise_before: texture_2d<f32>;

@fragment
fn denoise_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let center = vec2i(position.xy);
    let last = vec2i(textureDimensions(denoise_guide)) - 1;
    let guide = textureLoad(denoise_guide, center, 0);
    let normal = denoise_normal(guide.w);
    var sum = vec3f(0.0);
    var weights = 0.0;
    for (var row = -2; row <= 2; row++) {
        for (var column = -2; column <= 2; column++) {
            let at = center + DENOISE_STEP * vec2i(column, row);
            let other = textureLoad(denoise_guide, clamp(at, vec2i(0), last), 0);
            let likeness = denoise_likeness(guide, normal, other) * select(denoise_uniforms.neighbours, 1.0, row == 0 && column == 0);
            let weight = denoise_kernel(column) * denoise_kernel(row) * likeness;
            let counts = all(at >= vec2i(0)) && all(at <= last) && weight > 0.0;
            if counts {
                sum += weight * denoise_at(at);
                weights += weight;
            }
        }
    }
    return vec4f(select(denoise_at(center), sum / weights, weights > 0.0), 1.0);
}

// Of the cubic B-spline.
fn denoise_kernel(offset: i32) -> f32 {
    return select(select(0.0625, 0.25, abs(offset) == 1), 0.375, offset == 0);
}

// How much two pixels see of the same surface; the second may be the first.
fn denoise_likeness(guide: vec4f, normal: vec3f, other: vec4f) -> f32 {
    let way = other.xyz - guide.xyz;
    let off = dot(normal, way);
    let allowed = DENOISE_SLOPE * DENOISE_SLOPE * dot(way, way);
    let is_same = floor(guide.w / 262144.0) == floor(other.w / 262144.0);
    let in_plane = exp(-min(off * off / max(allowed, 1e-30), 80.0));
    let cosine = max(dot(normal, denoise_normal(other.w)), 0.0);
    return select(0.0, in_plane * pow(cosine, DENOISE_POWER), is_same);
}

// What shadowed_packed has packed.
fn denoise_normal(packed: f32) -> vec3f {
    let bits = u32(packed);
    let flat = vec2f(f32(bits & 511u), f32((bits >> 9u) & 511u)) / 511.0 * 2.0 - 1.0;
    let height = 1.0 - abs(flat.x) - abs(flat.y);
    let below = max(-height, 0.0);
    return normalize(vec3f(flat - below * select(vec2f(-1.0), vec2f(1.0), flat >= vec2f(0.0)), height));
}

// The share of the radiance that is left; 1 where there is none.
fn denoise_at(pixel: vec2i) -> vec3f {
    if DENOISE_AGAIN {
        return textureLoad(denoise_before, pixel, 0).rgb;
    }
    let radiance = textureLoad(denoise_mean_radiance, pixel, 0).rgb;
    let left = radiance - textureLoad(denoise_mean_blocked, pixel, 0).rgb;
    let share = clamp(left / max(radiance, vec3f(1e-30)), vec3f(denoise_uniforms.least), vec3f(denoise_uniforms.most));
    return select(vec3f(1.0), share, radiance > vec3f(0.0));
}
