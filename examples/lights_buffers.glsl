// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// What lights.glsl leaves to you, by a texture of floats (RGBA32F, nearest), as WebGL 2 has no storage buffers: a row for each light.
// It stands before lights.glsl; change it to suit what you have.
// A row: normal and the number of corners, below 0 if it shines to both sides; radiance; then its corners.

// Which lights reach the point.
struct LightsRange {
    uint first;
    uint count;
};

uniform sampler2D buffered_lights;

vec4 buffered_texel(LightsRange range, uint light, uint index) {
    return texelFetch(buffered_lights, ivec2(index, range.first + light), 0);
}

uint lights_count(LightsRange range) {
    return range.count;
}

uint lights_corners(LightsRange range, uint light) {
    return uint(abs(buffered_texel(range, light, 0u).w));
}

vec3 lights_corner(LightsRange range, uint light, uint index) {
    return buffered_texel(range, light, 2u + index).xyz;
}

vec3 lights_normal(LightsRange range, uint light) {
    return buffered_texel(range, light, 0u).xyz;
}

vec3 lights_radiance(LightsRange range, uint light) {
    return buffered_texel(range, light, 1u).xyz;
}

bool lights_two_sided(LightsRange range, uint light) {
    return buffered_texel(range, light, 0u).w < 0.0;
}
