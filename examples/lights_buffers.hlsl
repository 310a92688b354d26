// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// What lights.hlsl leaves to you, by two structured buffers: lights, and the corners of all of them.
// It stands before lights.hlsl; change it to suit what you have.

// Which lights reach the point.
struct LightsRange {
    uint first;
    uint count;
};

struct BufferedLight {
    float3 normal;
    uint first_corner;
    float3 radiance;
    uint corners;  // the highest bit: whether it shines to both sides
};

StructuredBuffer<BufferedLight> buffered_lights;
StructuredBuffer<float4> buffered_corners;

uint lights_count(LightsRange range) {
    return range.count;
}

uint lights_corners(LightsRange range, uint light) {
    return buffered_lights[range.first + light].corners & 0x7fffffffu;
}

float3 lights_corner(LightsRange range, uint light, uint index) {
    return buffered_corners[buffered_lights[range.first + light].first_corner + index].xyz;
}

float3 lights_normal(LightsRange range, uint light) {
    return buffered_lights[range.first + light].normal;
}

float3 lights_radiance(LightsRange range, uint light) {
    return buffered_lights[range.first + light].radiance;
}

bool lights_two_sided(LightsRange range, uint light) {
    return buffered_lights[range.first + light].corners > 0x7fffffffu;
}
