// The third pass of a frame with shadows: the means of all samples so far, of the radiance with nothing in the way of light and of what is blocked.

struct AccumulationUniforms {
    // Of the new sample, among those that there are with it.
    share: f32,
}

struct AccumulationMeans {
    @location(0) radiance: vec4f,
    @location(1) blocked: vec4f,
}

@group(0) @binding(0) var<uniform> accumulation_uniforms: AccumulationUniforms;
@group(0) @binding(1) var accumulation_radiance: texture_2d<f32>;
@group(0) @binding(2) var accumulation_blocked: texture_2d<f32>;
// The means before.
@group(0) @binding(3) var accumulation_mean_radiance: texture_2d<f32>;
@group(0) @binding(4) var accumulation_mean_blocked: texture_2d<f32>;

@fragment
fn accumulation_fragment(@builtin(position) position: vec4f) -> AccumulationMeans {
    let pixel = vec2u(position.xy);
    let radiance = textureLoad(accumulation_radiance, pixel, 0);
    let blocked = textureLoad(accumulation_blocked, pixel, 0);
    return AccumulationMeans(
        accumulation_mean(textureLoad(accumulation_mean_radiance, pixel, 0), radiance),
        accumulation_mean(textureLoad(accumulation_mean_blocked, pixel, 0), blocked),
    );
}

// Of equal samples the mean is the sample, to the bit; the first one counts alone.
fn accumulation_mean(before: vec4f, sample: vec4f) -> vec4f {
    let share = accumulation_uniforms.share;
    return select(before + share * (sample - before), sample, share >= 1.0);
}
