// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// What lights.metal leaves to you, by two buffers: lights, and the corners of all of them.
// It stands before lights.metal; change it to suit what you have.

#include <metal_stdlib>
using namespace metal;

// Packed, so that it is laid out as in other languages: a float3 would take 16 bytes.
struct BufferedLight {
    packed_float3 normal;
    uint first_corner;
    packed_float3 radiance;
    uint corners;  // the highest bit: whether it shines to both sides
};

// Which lights reach the point, and the buffers, which functions see by their arguments alone.
struct LightsRange {
    uint first;
    uint count;
    device const BufferedLight* lights;
    device const float4* corners;
};

inline uint lights_count(LightsRange range) {
    return range.count;
}

inline uint lights_corners(LightsRange range, uint light) {
    return range.lights[range.first + light].corners & 0x7fffffffu;
}

inline float3 lights_corner(LightsRange range, uint light, uint index) {
    return range.corners[range.lights[range.first + light].first_corner + index].xyz;
}

inline float3 lights_normal(LightsRange range, uint light) {
    return range.lights[range.first + light].normal;
}

inline float3 lights_radiance(LightsRange range, uint light) {
    return range.lights[range.first + light].radiance;
}

inline bool lights_two_sided(LightsRange range, uint light) {
    return range.lights[range.first + light].corners > 0x7fffffffu;
}
