// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// The multiple-scattering sheen of Zeltner, Burley and Chiang 2022: its table gives the matrix of a transformed cosine and its albedo.
// Copy with it: ltc.hlsl, which integrates the matrix over lights, and tables/sheen_ltc.dds (x = alpha, y = mu; texels a, b, r, 1).
// Frame: z = normal, x = view projected on the surface, as ltc_frame makes it; mu = dot(normal, view).
// Example: SheenLobe lobe = sheen_lobe(table, alpha, mu); float3 radiance = light * sheen_color * lobe.albedo * form_factor;
// Ranges: alpha, mu and sheen_color in [0,1], alpha and mu clamped; a >= 0, where a = 0 the matrix is singular and lights nothing.
// Greatest error: 3e-6 for 32 x 32 nodes, against f64, where neighbours differ by 2; a sampler's 8-bit weights err by up to 4e-3 of such a difference.
// Language: HLSL, shader model 5.0 and later. m_inv is used as mul(m_inv, v), whatever the packing of buffers.

struct SheenLobe {
    float3x3 m_inv;  // rows (a,0,b), (0,a,0), (0,0,1)
    float albedo;    // r: the share of the light from the view's direction that the fibres send back up
};

// The lobe for a roughness alpha and the view's cosine mu, from a table of any size whose node k of n sits at k/(n-1).
SheenLobe sheen_lobe(Texture2D table, float alpha, float mu) {
    uint2 table_size;
    table.GetDimensions(table_size.x, table_size.y);
    uint2 last = table_size - 1u;
    float2 at = clamp(float2(alpha, mu), (float2)0.0, (float2)1.0) * float2(last);
    uint2 low = min(uint2(at), last);
    uint2 high = min(low + 1u, last);
    float2 weight = at - float2(low);
    float4 grazing = lerp(table.Load(int3(low, 0)), table.Load(int3(high.x, low.y, 0)), weight.x);
    float4 upright = lerp(table.Load(int3(low.x, high.y, 0)), table.Load(int3(high, 0)), weight.x);
    float4 abr = lerp(grazing, upright, weight.y);
    SheenLobe result = { float3x3(abr.x, 0.0, abr.y, 0.0, abr.x, 0.0, 0.0, 0.0, 1.0), abr.z };
    return result;
}

// How much of the layers below the sheen is left: what its strongest channel sends back no longer reaches them.
float sheen_base_weight(float3 sheen_color, float albedo) {
    return 1.0 - max(sheen_color.r, max(sheen_color.g, sheen_color.b)) * albedo;
}

// The same by OpenPBR's rule, which does not look at the colour: weight is how much of the surface the layer covers.
float sheen_base_weight_openpbr(float weight, float albedo) {
    return 1.0 - weight * albedo;
}
