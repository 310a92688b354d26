// Shadows of a picture, taken over into another view: of the share of the radiance that is left, a mean over what that picture saw about the
// same place. What it did not see is shaded as what it saw nearest to it.

struct ReprojectionUniforms {
    // From this view's clip space to places relative to the origin of the other one,
    from_clip: mat4x4f,
    // and from there to the other one's clip space.
    other_clip_from: mat4x4f,
    // The eye's place in the same space (w = 1), or the direction towards it (w = 0).
    eye: vec4f,
    // What a pixel of the other view spans at distance 1; without perspective, at any distance.
    pixel: f32,
}

@group(0) @binding(0) var<uniform> reprojection_uniforms: ReprojectionUniforms;
@group(0) @binding(1) var reprojection_depth: texture_2d<f32>;
// Of the other view: places and normals, and the shares.
@group(0) @binding(2) var reprojection_guide: texture_2d<f32>;
@group(0) @binding(3) var reprojection_shares: texture_2d<f32>;

// Shares, each weighted, and the weights.
struct ReprojectionSum {
    shares: vec3f,
    weight: f32,
}

// Adds what is at a pixel of the other view: the less, the farther it is from the place. `near` is the square of the distance up to which
// it is the same.
fn reprojection_add(sum: ReprojectionSum, pixel: vec2i, place: vec3f, near: f32) -> ReprojectionSum {
    let last = vec2i(textureDimensions(reprojection_guide)) - 1;
    let at = clamp(pixel, vec2i(0), last);
    let way = textureLoad(reprojection_guide, at, 0).xyz - place;
    let off = dot(way, way) / near + 1.0;
    let weight = 1.0 / (off * off);
    return ReprojectionSum(sum.shares + weight * textureLoad(reprojection_shares, at, 0).rgb, sum.weight + weight);
}

@fragment
fn reprojection_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2u(position.xy);
    let depth = textureLoad(reprojection_depth, pixel, 0).r;
    // Nothing is there.
    if depth <= 0.0 {
        return vec4f(1.0);
    }
    let size = vec2f(textureDimensions(reprojection_depth));
    let clip = vec4f((vec2f(pixel) + 0.5) / size * vec2f(2.0, -2.0) + vec2f(-1.0, 1.0), depth, 1.0);
    let homogeneous = reprojection_uniforms.from_clip * clip;
    let place = homogeneous.xyz / homogeneous.w;
    let other = reprojection_uniforms.other_clip_from * vec4f(place, 1.0);
    // What lies behind the other eye is nowhere in its view.
    let other_size = vec2f(textureDimensions(reprojection_guide));
    let seen = clamp(other.xy / max(other.w, 1e-20) * vec2f(0.5, -0.5) + 0.5, vec2f(0.0), vec2f(1.0)) * other_size;
    let eye = reprojection_uniforms.eye;
    let span = reprojection_uniforms.pixel * mix(1.0, distance(place, eye.xyz), eye.w);
    let near = span * span;
    let low = vec2i(floor(seen - 0.5));
    var sum = ReprojectionSum(vec3f(0.0), 0.0);
    for (var index = 0; index < 4; index++) {
        sum = reprojection_add(sum, low + vec2i(index & 1, index >> 1u), place, near);
    }
    // It was seen well: its weights are about 1 each where its surface is seen head on, and less where it is steep.
    if sum.weight < 0.5 {
        for (var ring = 0; ring < 4; ring++) {
            let radius = 2 << u32(2 * ring);
            for (var index = 0; index < 9; index++) {
                sum = reprojection_add(sum, low + radius * vec2i(index % 3 - 1, index / 3 - 1), place, near);
            }
        }
    }
    return vec4f(sum.shares / max(sum.weight, 1e-30), 1.0);
}
