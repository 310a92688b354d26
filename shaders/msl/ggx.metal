// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// The specular base, GGX microfacets: its table gives the matrix of a transformed cosine, its albedo and its Fresnel share.
// Copy with it: ltc.metal, which integrates the matrix over lights, and tables/ggx_ltc.dds (x = roughness, y = sqrt(1 - mu), two parts).
// Frame: z = normal, x = view projected on the surface, as ltc_frame makes it; mu = dot(normal, view).
// Example: GgxLobe lobe = ggx_lobe(table, roughness, mu); float3 radiance = light * ggx_albedo(lobe, f0, f90) * form_factor;
// Ranges: roughness and mu in [0,1], clamped, alpha = roughness^2 no less than 0.001; f0 and f90 in [0,1], where albedo and base weight stay.
// Greatest error: 4e-7 of albedo, fresnel, a/c, b/c and 1/sqrt(c) with the shipped table, against f64; halves add 5e-4 of each number.
// Language: Metal 1.1 and later. Half floats are not enough.

#include <metal_stdlib>
using namespace metal;

struct GgxLobe {
    float3x3 m_inv;  // rows (a,0,b), (0,c,0), (0,0,1)
    float albedo;    // the share of the light from the view's direction that a perfect mirror of this roughness sends back
    float fresnel;   // the same weighted by (1 - dot(view, half vector))^5
};

// Below this cosine, shapes are those at it.
constant float GGX_GRAZING = 0.01f;
// Least a / c and s: whatever is bound as the table, the matrix is finite.
constant float GGX_LEAST_ASPECT = 1e-5f;
constant float GGX_LEAST_WIDTH = 1e-2f;

// Used above their definitions.
inline float4 ggx_between(texture2d<float> table, uint2 low, uint2 high, float2 weight);

// The lobe for the user's roughness and the view's cosine mu, from a table of any size whose node k of n sits at k/(n-1). Its texels are
// u, v, s, 1 in the rows of the first half, albedo, fresnel, 0, 1 in those of the second.
inline GgxLobe ggx_lobe(texture2d<float> table, float roughness, float mu) {
    uint2 size = uint2(table.get_width(), table.get_height()) / uint2(1u, 2u);
    float cosine = clamp(mu, 0.0f, 1.0f);
    float2 at = float2(clamp(roughness, 0.0f, 1.0f), sqrt(1.0f - cosine)) * float2(size - 1u);
    uint2 low = min(uint2(at), size - 1u);
    uint2 high = min(low + 1u, size - 1u);
    float2 weight = at - float2(low);
    uint2 below = uint2(0u, size.y);
    float4 shape = ggx_between(table, low, high, weight);
    float4 share = ggx_between(table, low + below, high + below, weight);
    // An exact mirror's matrix, plus the remainder that the table holds.
    float m = max(cosine, GGX_GRAZING);
    float aspect = max(m * m + shape.x, GGX_LEAST_ASPECT);
    float lean = m * sqrt((1.0f - m) * (1.0f + m)) + shape.y;
    float width = max(shape.z, GGX_LEAST_WIDTH);
    float c = 1.0f / (width * width);
    return GgxLobe{float3x3(aspect * c, 0.0f, 0.0f, 0.0f, c, 0.0f, lean * c, 0.0f, 1.0f), share.x, share.y};
}

// Bilinear between four texels.
inline float4 ggx_between(texture2d<float> table, uint2 low, uint2 high, float2 weight) {
    float4 first = mix(table.read(low), table.read(uint2(high.x, low.y)), weight.x);
    float4 second = mix(table.read(uint2(low.x, high.y)), table.read(high), weight.x);
    return mix(first, second, weight.y);
}

// The share of light, per colour channel, that facets of Schlick's reflectance from f0 (head on) to f90 (grazing) send back: once, and
// made up for what they reflect more than once (Fdez-Aguera 2019, Turquin 2019). It is 1 for f0 = f90 = 1, and never more.
inline float3 ggx_albedo(GgxLobe lobe, float3 f0, float3 f90) {
    float3 once = f0 * (lobe.albedo - lobe.fresnel) + f90 * lobe.fresnel;
    float3 gain = 1.0f + f0 * (1.0f / max(lobe.albedo, GGX_LEAST_WIDTH) - 1.0f);
    return min(once * gain, float3(1.0f));
}

// How much of the diffuse base below is left: what the strongest channel of the specular albedo sends back no longer reaches it.
inline float ggx_base_weight(float3 albedo) {
    return max(1.0f - max(albedo.r, max(albedo.g, albedo.b)), 0.0f);
}
