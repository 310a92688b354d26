// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// The specular base, GGX microfacets: its table gives the matrix of a transformed cosine, its albedo and its Fresnel share.
// Copy with it: ltc.glsl, which integrates the matrix over lights, and tables/ggx_ltc.dds (x = roughness, y = sqrt(1 - mu), two parts).
// Frame: z = normal, x = view projected on the surface, as ltc_frame makes it; mu = dot(normal, view).
// Example: GgxLobe lobe = ggx_lobe(table, roughness, mu); vec3 radiance = light * ggx_albedo(lobe, f0, f90) * form_factor;
// Ranges: roughness and mu in [0,1], clamped, alpha = roughness^2 no less than 0.001; f0 and f90 in [0,1], where albedo and base weight stay.
// Greatest error: 4e-7 of albedo, fresnel, a/c, b/c and 1/sqrt(c) with the shipped table, against f64; halves add 5e-4 of each number.
// Language: GLSL ES 3.00, where `precision highp float; precision highp int; precision highp sampler2D;` come before it, or any later GLSL.

struct GgxLobe {
    mat3 m_inv;     // rows (a,0,b), (0,c,0), (0,0,1)
    float albedo;   // the share of the light from the view's direction that a perfect mirror of this roughness sends back
    float fresnel;  // the same weighted by (1 - dot(view, half vector))^5
};

// Below this cosine, shapes are those at it.
const float GGX_GRAZING = 0.01;
// Least a / c and s: whatever is bound as the table, the matrix is finite.
const float GGX_LEAST_ASPECT = 1e-5;
const float GGX_LEAST_WIDTH = 1e-2;

// Used above their definitions.
vec4 ggx_between(sampler2D table, uvec2 low, uvec2 high, vec2 weight);

// The lobe for the user's roughness and the view's cosine mu, from a table of any size whose node k of n sits at k/(n-1). Its texels are
// u, v, s, 1 in the rows of the first half, albedo, fresnel, 0, 1 in those of the second.
GgxLobe ggx_lobe(sampler2D table, float roughness, float mu) {
    uvec2 size = uvec2(textureSize(table, 0)) / uvec2(1u, 2u);
    float cosine = clamp(mu, 0.0, 1.0);
    vec2 at = vec2(clamp(roughness, 0.0, 1.0), sqrt(1.0 - cosine)) * vec2(size - 1u);
    uvec2 low = min(uvec2(at), size - 1u);
    uvec2 high = min(low + 1u, size - 1u);
    vec2 weight = at - vec2(low);
    uvec2 below = uvec2(0u, size.y);
    vec4 shape = ggx_between(table, low, high, weight);
    vec4 share = ggx_between(table, low + below, high + below, weight);
    // An exact mirror's matrix, plus the remainder that the table holds.
    float m = max(cosine, GGX_GRAZING);
    float aspect = max(m * m + shape.x, GGX_LEAST_ASPECT);
    float lean = m * sqrt((1.0 - m) * (1.0 + m)) + shape.y;
    float width = max(shape.z, GGX_LEAST_WIDTH);
    float c = 1.0 / (width * width);
    return GgxLobe(mat3(aspect * c, 0.0, 0.0, 0.0, c, 0.0, lean * c, 0.0, 1.0), share.x, share.y);
}

// Bilinear between four texels.
vec4 ggx_between(sampler2D table, uvec2 low, uvec2 high, vec2 weight) {
    vec4 first = mix(texelFetch(table, ivec2(low), 0), texelFetch(table, ivec2(high.x, low.y), 0), weight.x);
    vec4 second = mix(texelFetch(table, ivec2(low.x, high.y), 0), texelFetch(table, ivec2(high), 0), weight.x);
    return mix(first, second, weight.y);
}

// The share of light, per colour channel, that facets of Schlick's reflectance from f0 (head on) to f90 (grazing) send back: once, and
// made up for what they reflect more than once (Fdez-Aguera 2019, Turquin 2019). It is 1 for f0 = f90 = 1, and never more.
vec3 ggx_albedo(GgxLobe lobe, vec3 f0, vec3 f90) {
    vec3 once = f0 * (lobe.albedo - lobe.fresnel) + f90 * lobe.fresnel;
    vec3 gain = 1.0 + f0 * (1.0 / max(lobe.albedo, GGX_LEAST_WIDTH) - 1.0);
    return min(once * gain, vec3(1.0));
}

// How much of the diffuse base below is left: what the strongest channel of the specular albedo sends back no longer reaches it.
float ggx_base_weight(vec3 albedo) {
    return max(1.0 - max(albedo.r, max(albedo.g, albedo.b)), 0.0);
}
