// What a frame is drawn with.

struct Frame {
    clip_from_world: mat4x4f,
    // The eye's place (w = 1) or the direction towards it (w = 0).
    eye: vec4f,
    // Weights, 0 or 1, of the lobes and the emission.
    diffuse: f32,
    specular: f32,
    sheen: f32,
    emission: f32,
    // The camera's place. Interpolated positions are relative to it: drivers err by a share of what they interpolate.
    origin: vec3f,
    // Where numbers_all has the lights,
    first_light: u32,
    ambient: vec3f,
    // Radiance is multiplied by this before it is stored, so that the targets' floats cover the range that the screen shows.
    gain: f32,
    // Which of a pixel's samples this is, the side of what it stands for, in pixels, and the start of the random numbers.
    sample: u32,
    footprint: f32,
    seed: u32,
    // and their outlines.
    first_vertex: u32,
}

@group(0) @binding(0) var<uniform> frame_now: Frame;
