// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// The specular base, GGX microfacets: its table gives the matrix of a transformed cosine, its albedo and its Fresnel share.
// Copy with it: ltc.wgsl, which integrates the matrix over lights, and tables/ggx_ltc.dds (x = roughness, y = sqrt(1 - mu), two parts).
// Frame: z = normal, x = view projected on the surface, as ltc_frame makes it; mu = dot(normal, view).
// Example: let lobe = ggx_lobe(table, roughness, mu); let radiance = light * ggx_albedo(lobe, f0, f90) * form_factor;
// Ranges: roughness and mu in [0,1], clamped, alpha = roughness^2 no less than 0.001; f0 and f90 in [0,1], where albedo and base weight stay.
// Greatest error: 4e-7 of albedo, fresnel, a/c, b/c and 1/sqrt(c) with the shipped table, against f64; halves add 5e-4 of each number.

struct GgxLobe {
    m_inv: mat3x3<f32>,  // rows (a,0,b), (0,c,0), (0,0,1)
    albedo: f32,         // the share of the light from the view's direction that a perfect mirror of this roughness sends back
    fresnel: f32,        // the same weighted by (1 - dot(view, half vector))^5
}

// Below this cosine, shapes are those at it.
const GGX_GRAZING = 0.01;
// Least a / c and s: whatever is bound as the table, the matrix is finite.
const GGX_LEAST_ASPECT = 1e-5;
const GGX_LEAST_WIDTH = 1e-2;

// The lobe for the user's roughness and the view's cosine mu, from a table of any size whose node k of n sits at k/(n-1). Its texels are
// u, v, s, 1 in the rows of the first half, albedo, fresnel, 0, 1 in those of the second.
fn ggx_lobe(table: texture_2d<f32>, roughness: f32, mu: f32) -> GgxLobe {
    let size = textureDimensions(table, 0) / vec2(1u, 2u);
    let cosine = clamp(mu, 0.0, 1.0);
    let at = vec2(clamp(roughness, 0.0, 1.0), sqrt(1.0 - cosine)) * vec2<f32>(size - 1u);
    let low = min(vec2<u32>(at), size - 1u);
    let high = min(low + 1u, size - 1u);
    let weight = at - vec2<f32>(low);
    let below = vec2(0u, size.y);
    let shape = ggx_between(table, low, high, weight);
    let share = ggx_between(table, low + below, high + below, weight);
    // An exact mirror's matrix, plus the remainder that the table holds.
    let m = max(cosine, GGX_GRAZING);
    let aspect = max(m * m + shape.x, GGX_LEAST_ASPECT);
    let lean = m * sqrt((1.0 - m) * (1.0 + m)) + shape.y;
    let width = max(shape.z, GGX_LEAST_WIDTH);
    let c = 1.0 / (width * width);
    return GgxLobe(mat3x3(aspect * c, 0.0, 0.0, 0.0, c, 0.0, lean * c, 0.0, 1.0), share.x, share.y);
}

// Bilinear between four texels.
fn ggx_between(table: texture_2d<f32>, low: vec2<u32>, high: vec2<u32>, weight: vec2<f32>) -> vec4<f32> {
    let first = mix(textureLoad(table, low, 0), textureLoad(table, vec2(high.x, low.y), 0), weight.x);
    let second = mix(textureLoad(table, vec2(low.x, high.y), 0), textureLoad(table, high, 0), weight.x);
    return mix(first, second, weight.y);
}

// The share of light, per colour channel, that facets of Schlick's reflectance from f0 (head on) to f90 (grazing) send back: once, and
// made up for what they reflect more than once (Fdez-Aguera 2019, Turquin 2019). It is 1 for f0 = f90 = 1, and never more.
fn ggx_albedo(lobe: GgxLobe, f0: vec3<f32>, f90: vec3<f32>) -> vec3<f32> {
    let once = f0 * (lobe.albedo - lobe.fresnel) + f90 * lobe.fresnel;
    let gain = 1.0 + f0 * (1.0 / max(lobe.albedo, GGX_LEAST_WIDTH) - 1.0);
    return min(once * gain, vec3(1.0));
}

// How much of the diffuse base below is left: what the strongest channel of the specular albedo sends back no longer reaches it.
fn ggx_base_weight(albedo: vec3<f32>) -> f32 {
    return max(1.0 - max(albedo.r, max(albedo.g, albedo.b)), 0.0);
}
