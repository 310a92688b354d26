// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// The sheen of sheen.hlsl without its table: short formulas that were fitted to the table, some fifty multiply-adds and an exponential.
// Copy with it: ltc.hlsl, which integrates the matrix over lights; the weights of sheen.hlsl take this albedo too.
// Frame: z = normal, x = view projected on the surface, as ltc_frame makes it; mu = dot(normal, view).
// Example: SheenFitLobe lobe = sheen_fit_lobe(alpha, mu); float3 radiance = light * sheen_color * lobe.albedo * form_factor;
// Ranges: alpha and mu in [0,1], clamped; a > 0.002, b <= 0, r in [0,1]. Made for alpha >= 0.1; below, r is off next to mu = 0.
// Greatest error: for alpha >= 3/31, a 0.054, b 0.016, r 0.036 (mean 0.005, 0.003, 0.002) against the table; below, a 0.14, b 0.02, r 0.45.
// Language: HLSL, shader model 5.0 and later. m_inv is used as mul(m_inv, v), whatever the packing of buffers.

struct SheenFitLobe {
    float3x3 m_inv;  // rows (a,0,b), (0,a,0), (0,0,1)
    float albedo;    // r: the share of the light from the view's direction that the fibres send back up
};

// Past it the albedo is 0 to all digits, and the exponential nears what floats can hold.
static const float SHEEN_FIT_DARK = 60.0;

// Used above their definitions.
float sheen_fit_a(float y, float x);
float sheen_fit_b(float y, float x);
float sheen_fit_albedo(float y, float x);

// The lobe for a roughness alpha and the view's cosine mu: a = p^2 / q, b = -sqrt(1 - mu) (1 - alpha) p^2 / q, r = 1 / (1 + exp(p / q)), with
// polynomials p and q > 0 of their own (scripts/fit_formula).
SheenFitLobe sheen_fit_lobe(float alpha, float mu) {
    float y = clamp(alpha, 0.0, 1.0);
    float x = clamp(mu, 0.0, 1.0);
    float a = sheen_fit_a(y, x);
    float b = sheen_fit_b(y, x);
    SheenFitLobe result = { float3x3(a, 0.0, b, 0.0, a, 0.0, 0.0, 0.0, 1.0), sheen_fit_albedo(y, x) };
    return result;
}

float sheen_fit_a(float y, float x) {
    float above = 0.0712243 + x * (2.08384 + x * (0.447737 + x * 1.33883));
    float p = above + y * (-1.44859 + x * (5.11827 - x * 1.43431) + y * (11.8824 - x * 4.78599 - y * 2.86849));
    float q = 1.0 + x * (8.39524 + x * 57.9343) + y * (-18.981 - x * 20.0247 + y * 97.6674);
    return p * p / q;
}

float sheen_fit_b(float y, float x) {
    float p = 0.0141647 + x * (-0.262813 + x * 4.68426) + y * (1.11618 - x * 4.6743 + y * 3.33543);
    float q = 1.0 + x * (30.9435 + x * 50.5242) + y * (-8.88411 - x * 88.4877 + y * 35.9859);
    return -sqrt(1.0 - x) * (1.0 - y) * p * p / q;
}

float sheen_fit_albedo(float y, float x) {
    float above = 0.923733 + x * (25.714 + x * (952.057 - x * 486.046));
    float p = above + y * (-17.0376 + x * (-10.1195 - x * 6.4266) + y * (1.24115 - x * 287.551 - y * 25.5475));
    float below = 1.0 + x * (-9.89936 + x * (26.4968 - x * 6.45657));
    float q = below + y * (-8.05803 + x * (367.165 - x * 227.569) + y * (78.7201 + x * 43.9768 - y * 37.6456));
    return 1.0 / (1.0 + exp(min(p / q, SHEEN_FIT_DARK)));
}
