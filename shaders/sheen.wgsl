// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// The multiple-scattering sheen of Zeltner, Burley and Chiang 2022: its table gives the matrix of a transformed cosine and its albedo.
// Copy with it: ltc.wgsl, which integrates the matrix over lights, and tables/sheen_ltc.dds (x = alpha, y = mu; texels a, b, r, 1).
// Frame: z = normal, x = view projected on the surface, as ltc_frame makes it; mu = dot(normal, view).
// Example: let lobe = sheen_lobe(table, alpha, mu); let radiance = light * sheen_color * lobe.albedo * form_factor;
// Ranges: alpha, mu and sheen_color in [0,1], alpha and mu clamped; a >= 0, where a = 0 the matrix is singular and lights nothing.
// Greatest error: 3e-6 for 32 x 32 nodes, against f64, where neighbours differ by 2; a sampler's 8-bit weights err by up to 4e-3 of such a difference.

struct SheenLobe {
    m_inv: mat3x3<f32>,  // rows (a,0,b), (0,a,0), (0,0,1)
    albedo: f32,         // r: the share of the light from the view's direction that the fibres send back up
}

// The lobe for a roughness alpha and the view's cosine mu, from a table of any size whose node k of n sits at k/(n-1).
fn sheen_lobe(table: texture_2d<f32>, alpha: f32, mu: f32) -> SheenLobe {
    let last = textureDimensions(table, 0) - 1u;
    let at = clamp(vec2(alpha, mu), vec2(0.0), vec2(1.0)) * vec2<f32>(last);
    let low = min(vec2<u32>(at), last);
    let high = min(low + 1u, last);
    let weight = at - vec2<f32>(low);
    let grazing = mix(textureLoad(table, low, 0), textureLoad(table, vec2(high.x, low.y), 0), weight.x);
    let upright = mix(textureLoad(table, vec2(low.x, high.y), 0), textureLoad(table, high, 0), weight.x);
    let abr = mix(grazing, upright, weight.y);
    return SheenLobe(mat3x3(abr.x, 0.0, 0.0, 0.0, abr.x, 0.0, abr.y, 0.0, 1.0), abr.z);
}

// How much of the layers below the sheen is left: what its strongest channel sends back no longer reaches them.
fn sheen_base_weight(sheen_color: vec3<f32>, albedo: f32) -> f32 {
    return 1.0 - max(sheen_color.r, max(sheen_color.g, sheen_color.b)) * albedo;
}

// The same by OpenPBR's rule, which does not look at the colour: weight is how much of the surface the layer covers.
fn sheen_base_weight_openpbr(weight: f32, albedo: f32) -> f32 {
    return 1.0 - weight * albedo;
}
