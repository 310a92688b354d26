// A picture over another number of pixels than it has: interpolated between the middles of its own.

struct EnlargementUniforms {
    // Where the output shows the picture's corner, and over how many pixels across and down.
    origin: vec2f,
    size: vec2f,
}

@group(0) @binding(0) var<uniform> enlargement_uniforms: EnlargementUniforms;
@group(0) @binding(1) var enlargement_picture: texture_2d<f32>;
@group(0) @binding(2) var enlargement_sampler: sampler;

@fragment
fn enlargement_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let at = (position.xy - enlargement_uniforms.origin) / enlargement_uniforms.size;
    return textureSampleLevel(enlargement_picture, enlargement_sampler, at, 0.0);
}
