// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// What lights.wgsl leaves to you, by two storage buffers: lights, and the corners of all of them.
// It stands before lights.wgsl; change it to suit what you have.

// Which lights reach the point.
struct LightsRange {
    first: u32,
    count: u32,
}

struct BufferedLight {
    normal: vec3<f32>,
    first_corner: u32,
    radiance: vec3<f32>,
    corners: u32,        // the highest bit: whether it shines to both sides
}

@group(0) @binding(1) var<storage, read> buffered_lights: array<BufferedLight>;
@group(0) @binding(2) var<storage, read> buffered_corners: array<vec4<f32>>;

fn lights_count(range: LightsRange) -> u32 {
    return range.count;
}

fn lights_corners(range: LightsRange, light: u32) -> u32 {
    return buffered_lights[range.first + light].corners & 0x7fffffffu;
}

fn lights_corner(range: LightsRange, light: u32, index: u32) -> vec3<f32> {
    return buffered_corners[buffered_lights[range.first + light].first_corner + index].xyz;
}

fn lights_normal(range: LightsRange, light: u32) -> vec3<f32> {
    return buffered_lights[range.first + light].normal;
}

fn lights_radiance(range: LightsRange, light: u32) -> vec3<f32> {
    return buffered_lights[range.first + light].radiance;
}

fn lights_two_sided(range: LightsRange, light: u32) -> bool {
    return buffered_lights[range.first + light].corners > 0x7fffffffu;
}
